# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""When are two programs' times told apart: which processes are run, and which verdict of `lmdbench compare` stands. The rule
of scripts/ci_regression.sh, which builds the programs and calls this; scripts/ci/verdict_study.py measures the same code. What is
seen is evidence; scripts/ci/outcome.py makes the verdict of it, and every report.

    python3 scripts/ci/regression.py --base PROGRAM --candidate PROGRAM --experiment FILE --out DIR [option]...

Every round runs three processes in an order of its own (the six orders, shuffled anew for every six rounds): the base, the
base again as a null control, the candidate. The judge is the candidate's `lmdbench compare`, or that of --judge:

  1. Results and counters, exactly, after one round: a difference ends it, `changed`.
  2. Instructions under callgrind (scripts/ci/instructions.py), which no noise touches: more of them end it, `slower`.
  3. Times, after --pairs rounds: the candidate against both series of the base together. `same` and `faster` end it. Else
     there are as many rounds again, until --most. A stage that looks slower (a false alarm of SUSPICION over all stages) is
     a suspect, and `slower` only once the next rounds alone, which know nothing of the first, put it above 1, too (95 %,
     INTERVAL_ERROR of `lmdbench compare`). Two looks can name suspects, so an equal program is called slower with a
     probability of at most 2 x 0.05 x 0.05 = 0.5 %.
  Where the base is slower or faster than itself the machine is no judge yet: more rounds, `unsure` at the end.

A candidate that makes another experiment of the same scene file (another default) is `changed`, too. One whose run fails where
the base's does not is `broken`, as is the base's or a judge's own failure, with an exit code of its own.

Prints tables and a last line with the verdict and its reason; leaves the same as verdict.md, and junit.xml. Exit code: 0 same or
faster, 1 slower or changed, or the candidate does not run; 3 no comparison, because the base or a foreign judge does not run;
4 unsure."""

import argparse
import json
import math
import os
import random
import shutil
import subprocess
import sys
import time

import instructions
import outcome

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
SUSPICION = 0.05
# Names of equal length: the length of arguments moves a process' stack, and with it its speed.
NAMES = ("base", "null", "cand")
ORDERS = (("base", "cand", "null"), ("base", "null", "cand"), ("cand", "base", "null"), ("cand", "null", "base"),
          ("null", "base", "cand"), ("null", "cand", "base"))
# Message of `lmdbench compare` for DIFFERENT_EXPERIMENTS (comparison/compare.h).
OTHER_EXPERIMENT = "is of another experiment than"


class Broken(Exception):
    """A process failed, so there is no verdict. `side` is whose: "base", "candidate" or "judge"."""

    def __init__(self, side, what, log):
        super().__init__(what)
        self.side, self.log = side, log


class OtherExperiment(Exception):
    """The candidate made another experiment of the same scene file."""


def orders(generator):
    """Endless: every program is as often first, second and last."""
    while True:
        shuffled = list(ORDERS)
        generator.shuffle(shuffled)
        yield from shuffled


def stages(answer, verdict):
    return {(t["method"], t["stage"]) for t in answer["timings"] if t["verdict"] == verdict}


def known(number, otherwise):
    """A number of the judge's JSON, null where the processes are too few to tell."""
    return otherwise if number is None else number


class Regression:
    """One comparison. `programs` maps NAMES to executables, `environments` (optional) to variables of their processes;
    `run` is called with (command, environment) and returns a finished process: tests put another one in."""

    def __init__(self, programs, judge, scene, folder, threshold=0.05, allow=(), environments=None, generator=None,
                 run=None, say=lambda text: None):
        self.programs, self.judge, self.scene, self.folder = programs, judge, list(scene), folder
        self.options = ["--threshold", str(threshold)] + [word for name in allow for word in ("--allow", name)]
        self.environments = environments or {}
        self.orders = orders(generator or random.Random())
        self.run_process = run or self.subprocess_run
        self.say = say
        self.rounds = 0
        self.confirmed = set()  # (method, stage) pairs that are surely slower
        self.looks = []  # state after each look, for studies of the rule

    @staticmethod
    def subprocess_run(command, environment):
        try:
            return subprocess.run(command, cwd=ROOT, env=dict(os.environ, **environment), capture_output=True, text=True,
                                  check=False, stdin=subprocess.DEVNULL)
        except OSError as error:  # no program at all
            return subprocess.CompletedProcess(command, 126, "", str(error))

    def result(self, name, index):
        return os.path.join(self.folder, f"{name}-{index}.h5")

    def run(self, count):
        for _ in range(count):
            failed = {}
            for name in next(self.orders):
                done = self.run_process([self.programs[name], "--quiet", "run", *self.scene, "--out",
                                         self.result(name, self.rounds)], self.environments.get(name, {}))
                if done.returncode != 0:
                    failed["candidate" if name == "cand" else "base"] = done
            # If the base fails in the same round, scene or machine may be the reason.
            for side in ("base", "candidate"):
                if side in failed:
                    done = failed[side]
                    raise Broken(side, f"the {side}'s run left with {done.returncode}", done.stderr)
            self.rounds += 1

    def compare(self, base, candidate, first=0, options=("--json",)):
        """The judge's output on the rounds from `first` on; `base` holds one name or two, whose processes are pooled."""
        sides = [[self.result(name, i) for name in names for i in range(first, self.rounds)]
                 for names in (base, candidate)]
        done = self.run_process([self.judge, "--quiet", "compare", "--base", *sides[0], "--candidate", *sides[1],
                                 *self.options, *options], {})
        if done.returncode == 2:
            if OTHER_EXPERIMENT in done.stderr:
                raise OtherExperiment(done.stderr.strip())
            sys.stderr.write(done.stderr)
            raise SystemExit(2)
        if done.returncode not in (0, 1, 4) or not done.stdout:
            own = self.judge == self.programs["cand"]
            raise Broken("candidate" if own else "judge", f"lmdbench compare left with {done.returncode}", done.stderr)
        return done.stdout

    def against_base(self, first=0, options=()):
        try:
            return json.loads(self.compare(("base", "null"), ("cand",), first, ("--json", "--false-alarm", str(SUSPICION), *options)))
        except Broken:
            self.against_itself()  # says so where the base's processes are no replicates
            raise

    def against_itself(self):
        answer = json.loads(self.compare(("base",), ("null",)))
        if answer["verdict"] == "changed":
            raise Broken("base", "the base's results differ from run to run", "")
        return answer

    def behaviour(self):
        """The exact part, from one round; a verdict and its reason, or None."""
        self.run(1)
        try:
            changed = self.against_base()["verdict"] == "changed"
        except OtherExperiment as error:
            return "changed", f"the candidate makes another experiment of the same scene file; {error}"
        return ("changed", "results or counters differ") if changed else None

    def times(self, pairs, most):
        """The rule on times, after `behaviour`; the verdict and its reason."""
        self.run(pairs - self.rounds)
        suspects, fresh = set(), 0
        while True:
            answer = self.against_base()
            word = answer["verdict"]
            null = self.against_itself()["verdict"]
            self.looks.append({"rounds": self.rounds, "candidate": word, "base": null,
                               "highest_low": max((known(t["low"], 0.0) for t in answer["timings"]), default=0.0),
                               "detectable": max((known(t["detectable"], math.inf) for t in answer["timings"]), default=math.inf)})
            self.say(f"after {self.rounds} rounds: candidate {word}, base against itself {null}")
            trusted = null in ("same", "unsure")
            if suspects and trusted:
                alone = self.against_base(fresh)
                self.confirmed = {(t["method"], t["stage"]) for t in alone["timings"]
                                  if (t["method"], t["stage"]) in suspects - stages(answer, "same") and known(t["low"], 0.0) > 1.0}
                if self.confirmed:
                    named = ", ".join(f"{method}'s {stage}" for method, stage in sorted(self.confirmed))
                    return "slower", f"{named}: confirmed by {self.rounds - fresh} fresh rounds"
            if word in ("same", "faster") and trusted:
                return word, f"sure; the base is {null} against itself"
            if self.rounds >= most:
                if not trusted:
                    return "unsure", f"the base is {null} than itself: this machine is no judge, see lmdbench doctor"
                return "unsure", f"not sure after {self.rounds} rounds, see lmdbench doctor"
            suspects, fresh = stages(answer, "slower"), self.rounds
            self.run(min(self.rounds, most - self.rounds))


def seconds(file):
    """{method/stage, "_" for blanks: one number a process} of times in Google Benchmark's format."""
    found = {}
    with open(file, encoding="utf-8") as stream:
        for row in json.load(stream)["benchmarks"]:
            found.setdefault(row["name"], []).append(1e-9 * row["real_time"])
    return found


def gather(regression, arguments, evidence):
    """Looks at one thing after another until one decides; what was seen is in `evidence`, whatever happens."""
    try:
        if regression.behaviour() is None:
            if evidence.share > 0.0:
                try:
                    evidence.instructions, evidence.counted = instructions.compared(regression.programs["base"], regression.programs["cand"], regression.scene,
                                                                                     os.path.join(arguments.out, "callgrind"), ROOT)
                except instructions.NotCounted as error:
                    evidence.not_counted = str(error)
            if not any(check.word == "slower" for check in outcome.instruction_checks(evidence)):
                evidence.times = outcome.Times(*regression.times(arguments.pairs, arguments.most), regression.confirmed)
        files = {side: os.path.join(arguments.out, side + ".json") for side in ("base", "candidate")}
        evidence.answer = regression.against_base(0, ("--benchmark", files["candidate"], "--benchmark-base", files["base"]))
        evidence.seconds = {side: seconds(file) for side, file in files.items()}
    except OtherExperiment as error:  # no table: nothing can be compared
        evidence.other_experiment = str(error)
    except Broken as error:
        evidence.failure = outcome.Failure(error.side, "run", str(error), error.log)


def share(text):
    number = float(text)
    if not 0.0 <= number < math.inf:
        raise ValueError
    return number


def no_program(side, why, folder):
    return outcome.tell(outcome.Evidence(failure=outcome.Failure(side, "run", f"the {side}'s program: {why}", "")), folder)


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--base", required=True, metavar="PROGRAM")
    parser.add_argument("--candidate", required=True, metavar="PROGRAM")
    parser.add_argument("--judge", metavar="PROGRAM", help="whose `compare` judges (the candidate's)")
    parser.add_argument("--experiment", required=True)
    parser.add_argument("--set", action="append", default=[], metavar="PTR=VALUE", help="override of the scene, for both")
    parser.add_argument("--pairs", type=int, default=6, help="rounds before the first verdict on times (6)")
    parser.add_argument("--most", type=int, default=24, help="rounds at most (24)")
    parser.add_argument("--threshold", default="0.05", help="least effect that matters (0.05)")
    parser.add_argument("--allow", action="append", default=[], metavar="COUNTER", help="counter that may differ")
    parser.add_argument("--instructions", type=share, default=0.01, help="least change of instructions that matters; 0: no callgrind")
    parser.add_argument("--out", required=True, help="folder of results, tables and reports")
    arguments = parser.parse_args(words)
    if not 1 <= arguments.pairs <= arguments.most:
        parser.error("1 <= --pairs <= --most (remedy: leave both out for 6 and 24)")

    arguments.out = os.path.abspath(arguments.out)
    results = os.path.join(arguments.out, "results")
    shutil.rmtree(results, ignore_errors=True)
    os.makedirs(results)
    programs = {}
    for name, program in zip(NAMES, (arguments.base, arguments.base, arguments.candidate)):
        programs[name] = os.path.join(arguments.out, "bin", name, "lmdbench")
        os.makedirs(os.path.dirname(programs[name]), exist_ok=True)
        try:
            shutil.copy2(program, programs[name])
        except OSError as error:
            return no_program("candidate" if name == "cand" else "base", error, arguments.out)
    if arguments.judge and not os.path.isfile(arguments.judge):
        return no_program("judge", f"no file {arguments.judge}", arguments.out)
    scene = [os.path.abspath(arguments.experiment)] + [word for pair in arguments.set for word in ("--set", pair)]
    # A copy with a name of its own: if the judge fails, the candidate is at fault.
    own = not arguments.judge or os.path.samefile(arguments.judge, arguments.candidate)
    regression = Regression(programs, programs["cand"] if own else os.path.abspath(arguments.judge), scene, results,
                            arguments.threshold, arguments.allow, say=lambda text: print(text, file=sys.stderr))
    evidence, started = outcome.Evidence(share=arguments.instructions), time.monotonic()
    gather(regression, arguments, evidence)
    return outcome.tell(evidence, arguments.out, f"; {regression.rounds} rounds, {time.monotonic() - started:.0f} s")


if __name__ == "__main__":
    sys.exit(main())
