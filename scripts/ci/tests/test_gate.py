# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The gate as CI services run it: the commands of both workflow files, on a repository whose commits do not build, do not run,
differ, are slower or the same; and that console, verdict.md, junit.xml and exit code say one thing. Builds are played: `cmake`
leaves a program that copies results made beforehand, whose times are known, and hands `compare` to the real program, which the
environment variable LMDBENCH_PROGRAM names. Callgrind's counts are played, too."""

import os
import random
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path

import h5py
import yaml

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "figures", "tests"))

from cases import PROGRAM, ROOT, SCRIPTS, SharedScratch, call, text_of  # noqa: E402  (the figures' tests must be found first)

ROUNDS = 24  # as many as ci_regression.sh runs at most

CMAKE = """#!/bin/sh
[ "$1" = --build ] || exit 0
read -r behaviour <behaviour
if [ "$behaviour" = no-build ]; then echo "src/main.cpp:1: error: expected ';' & <more>" >&2; exit 1; fi
mkdir -p build/release
cat >build/release/lmdbench <<END
#!/bin/sh
behaviour=$behaviour
. {folder}/program.sh
END
chmod +x build/release/lmdbench
"""

# What every fake program does; `kind` is where its results come from.
PLAYED = """
[ $behaviour != no-start ] || { echo 'missing library' >&2; exit 127; }
case "$*" in *compare*|--help) exec {program} "$@" ;; esac
[ $behaviour != no-run ] || { echo 'a bug of ours' >&2; exit 70; }
while [ "$1" != --out ]; do shift; done
kind=$behaviour
[ -z "$PLAYED_LOAD" ] || kind=load
[ -d {folder}/results/$kind ] || kind=same
cp {folder}/results/$kind/$(basename "$2") "$2"
"""

SETARCH = """#!/bin/sh
shift
exec "$@"
"""

VALGRIND = """#!/bin/sh
echo 'shapes: 767 frames, 612 in contact; errors are not measured'
grep behaviour= "$3" >"${2#--callgrind-out-file=}"
"""

# The spinning candidate takes 5 % more instructions in one search.
CALLGRIND_ANNOTATE = """#!/bin/sh
search=2,000,000
! grep -q spins "$3" || search=2,100,000
echo " $search (50.00%)  ???:lmdbench::Certified::search(lmdbench::Pose const&) [/lmdbench]"
echo " 1,000,000 (25.00%)  ???:lmdbench::Improved::track(lmdbench::Pose const&) [/lmdbench]"
"""


def make_results(folder):
    """results/KIND/NAME-ROUND.h5: copies of one result with times of their own; the spread is 0.3 %, 60 % under load."""
    template = os.path.join(folder, "template.h5")
    subprocess.run([PROGRAM, "--quiet", "run", ROOT / "experiments" / "shapes.json", "--set", "/frames=60", "--set", "/probes/truth/stride_frames=0",
                    "--set", "/probes/fcl/stride_frames=0", "--out", template], check=True, stdout=subprocess.DEVNULL)
    generator = random.Random(30)
    for kind, names, factor, spread in (("same", ("base", "null", "cand"), 1.0, 0.003), ("slower", ("cand",), 1.3, 0.003),
                                        ("faster", ("cand",), 0.7, 0.003),
                                        ("differs", ("cand",), 1.0, 0.003), ("loses-frame", ("cand",), 1.0, 0.003), ("load", ("base", "null", "cand"), 1.0, 0.6)):
        os.makedirs(os.path.join(folder, "results", kind))
        for name in names:
            for index in range(ROUNDS):
                file = os.path.join(folder, "results", kind, f"{name}-{index}.h5")
                shutil.copy(template, file)
                with h5py.File(file, "r+") as h5:
                    del h5.attrs["content_sha256"]  # on purpose
                    for method in h5["methods"].values():
                        for dataset in [d for d in method if d.endswith("_time")]:
                            method[dataset][...] = method[dataset][()] * factor * generator.lognormvariate(0.0, spread)
                    if kind == "differs":
                        h5["methods/improved/force"][3] += 0.001
                    if kind == "loses-frame":
                        lose_last_frame(h5["methods/improved"])


def lose_last_frame(method):
    """Of every dataset that has one row a frame."""
    frames = len(method["force"])
    for name, dataset in list(method.items()):
        if isinstance(dataset, h5py.Dataset) and len(dataset) == frames:
            values, attributes = dataset[:-1], dict(dataset.attrs)
            del method[name]
            method[name] = values
            method[name].attrs.update(attributes)


# Exit code, outcome of GitLab's job, and of GitHub's step with its annotation.
FAILED = ("failed", "error")
OUTCOMES = {"same": (0, "passed", ("passed", "")), "faster": (0, "passed", ("passed", "")), "unsure": (4, "warning", ("passed", "notice")),
            "slower": (1, "failed", FAILED), "changed": (1, "failed", FAILED), "broken": (1, "failed", FAILED), "no comparison": (3, "failed", FAILED)}


class GateTest(SharedScratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        make_results(cls.folder)
        tools = os.path.join(cls.folder, "tools")
        os.makedirs(tools)
        for name, text in (("cmake", CMAKE), ("setarch", SETARCH), ("valgrind", VALGRIND), ("callgrind_annotate", CALLGRIND_ANNOTATE)):
            Path(tools, name).write_text(text.replace("{folder}", cls.folder), encoding="utf-8")
            os.chmod(os.path.join(tools, name), 0o755)
        Path(cls.folder, "program.sh").write_text(PLAYED.replace("{folder}", cls.folder).replace("{program}", PROGRAM), encoding="utf-8")
        cls.environment = {"PATH": f"{tools}:{os.path.dirname(sys.executable)}:/usr/bin:/bin", "HOME": cls.folder,
                           "PYTHONDONTWRITEBYTECODE": "1"}
        cls.repository = os.path.join(cls.folder, "repository")
        shutil.copytree(SCRIPTS, os.path.join(cls.repository, "scripts"),
                        ignore=shutil.ignore_patterns("__pycache__"))
        os.makedirs(os.path.join(cls.repository, "experiments"))
        shutil.copy(ROOT / "experiments" / "shapes.json", os.path.join(cls.repository, "experiments"))
        cls.git("init", "--quiet")
        cls.commits = {}
        for behaviour in ("same", "base", "slower", "faster", "differs", "loses-frame", "spins", "no-build", "no-run", "no-start"):
            Path(cls.repository, "behaviour").write_text(behaviour + "\n", encoding="utf-8")
            cls.git("add", "--all")
            cls.git("-c", "user.name=t", "-c", "user.email=t@example.org", "commit", "--quiet", "--message", behaviour)
            cls.commits[behaviour] = cls.git("rev-parse", "HEAD").strip()
        cls.github = yaml.safe_load(text_of("scripts", "ci", "github-actions.yml"))["jobs"]["regression"]
        cls.gitlab = yaml.safe_load(text_of("scripts", "ci", "gitlab-ci.yml"))["regression"]

    @classmethod
    def git(cls, *words):
        return subprocess.run(["git", "-C", cls.repository, *words], check=True, capture_output=True, text=True,
                              env=cls.environment).stdout

    def shell(self, lines, **variables):
        return call("bash", "-e", "-c", lines, cwd=self.repository, env={**self.environment, **variables})

    def built(self, name):
        return os.path.join(self.repository, "build", "ci", name)

    def on_gitlab(self, base, candidate, **variables):
        """(outcome of the job, its finished script)."""
        done = self.shell("\n".join(self.gitlab["script"]), CI_MERGE_REQUEST_DIFF_BASE_SHA=self.commits[base],
                          CI_COMMIT_SHA=self.commits[candidate], **variables)
        allowed = self.gitlab["allow_failure"]["exit_codes"]
        return {0: "passed", allowed: "warning"}.get(done.returncode, "failed"), done

    def test_a_machine_that_cannot_be_set_up_has_compared_nothing(self):
        setup = self.gitlab["before_script"][-1]
        self.assertIn("./scripts/setup.sh", setup)
        done = call("bash", "-e", "-c", setup.replace("./scripts/setup.sh", "(exit 4)"))
        self.assertEqual(done.returncode, 3, "4 is a warning here")

    def on_github(self, code):
        """(outcome of the step, its annotation, the job's summary), where ci_regression.sh leaves again what it left on GitLab."""
        (step,) = [step for step in self.github["steps"] if step.get("name") == "Compare with the base"]
        lines = re.sub(r"\$\{\{[^}]*\}\}", "HEAD", step["run"])
        gate, verdict = Path(self.repository, "scripts", "ci_regression.sh"), self.built("verdict.md")
        original = gate.read_bytes()
        shutil.copy(verdict, verdict + ".kept")
        gate.write_text(f"#!/bin/sh\ncp {verdict}.kept {verdict}\nexit {code}\n", encoding="utf-8")
        done = self.shell(lines, GITHUB_ACTIONS="true", GITHUB_STEP_SUMMARY=self.write("summary.md", ""))
        gate.write_bytes(original)
        notes = [line for line in done.stdout.splitlines() if line.startswith("::")]
        return "failed" if done.returncode else "passed", notes[0] if notes else "", self.read("summary.md")

    def words_of_junit(self):
        """The words of all failures and errors, and of what was skipped; what is counted is there."""
        root = xml.etree.ElementTree.parse(self.built("junit.xml")).getroot()
        told = {kind: [case.get("type") for case in root.iter(kind)] for kind in ("failure", "error", "skipped")}
        self.assertEqual([int(root.get(count)) for count in ("failures", "errors", "skipped")], [len(words) for words in told.values()])
        return set(told["failure"]), set(told["error"]), set(told["skipped"]) - {"not judged"}

    def check(self, base, candidate, word, why, told=(), **variables):
        """One verdict, whoever is asked; `told` are parts of verdict.md."""
        code, gitlab, github = OUTCOMES[word]
        job, done = self.on_gitlab(base, candidate, **variables)
        self.assertEqual((job, done.returncode), (gitlab, code), done.stdout + done.stderr)
        markdown = Path(self.built("verdict.md")).read_text(encoding="utf-8")
        headline = re.fullmatch(r"\*\*([a-z ]+): (.*)\*\*", markdown.splitlines()[0])
        self.assertEqual(headline[1], word, markdown)
        self.assertRegex(headline[2], why)
        self.assertTrue(done.stdout.endswith(markdown), done.stdout)
        self.assertTrue(markdown.splitlines()[-1].startswith(f"verdict: {word} ({headline[2]})"), markdown)
        for part in told:
            self.assertIn(part, markdown)
        failures, errors, skipped = self.words_of_junit()
        self.assertEqual(failures, {word} & {"slower", "changed"})
        self.assertEqual(errors, {word} & {"broken", "no comparison"})
        self.assertEqual("unsure" in skipped, word == "unsure", skipped)
        step, note, summary = self.on_github(code)
        self.assertEqual((step, note), (github[0], github[1] and f"::{github[1]}::{word}: {headline[2]}".replace("%", "%25")))
        self.assertEqual(summary, markdown)

    def test_one_verdict(self):
        for case in (
                ("base", "same", "same", "sure; the base is", ["| improved | search |", "| Certified::search | 2000000 | 2000000 | +0.00 % | first 767, 612 in contact | same |"]),
                ("base", "faster", "faster", "sure; the base is", ["| Certified::search |"]),
                ("base", "slower", "slower", "'s .*: confirmed by [0-9]+ fresh rounds$", ["| slower |", "| Certified::search |"]),
                ("base", "spins", "slower", r"^\+5.00 % instructions in Certified::search, counted by callgrind \(frames: first 767, 612 in contact\)$",
                 ["| +5.00 % | first 767, 612 in contact | slower |", "| Improved::track | 1000000 | 1000000 | +0.00 % |"]),
                ("base", "differs", "changed", "results or counters differ: improved: `force` differs in frame 3: ", ["| improved | `force` | 3 |"]),
                ("base", "loses-frame", "changed", r"^results or counters differ: improved: .* differs: \[60\] became \[59\] \(and [0-9]+ more\)$", ["| improved | `force` |"]),
                ("base", "no-build", "broken", "^the candidate [0-9a-f]+ does not build$", ["error: expected ';' & <more>"]),
                ("base", "no-run", "broken", "^the candidate's run left with 70$", ["a bug of ours"]),
                ("base", "no-start", "broken", "^the candidate [0-9a-f]+ does not start$", ["missing library"]),
                ("no-build", "same", "no comparison", "^the base [0-9a-f]+ does not build, or this machine cannot build it$"),
                ("no-build", "no-build", "no comparison", "^the base"),
                ("no-run", "same", "no comparison", "^the base's run left with 70$"),
                ("no-run", "no-run", "no comparison", "^the base's run")):
            with self.subTest(base=case[0], candidate=case[1]):
                self.check(*case)

    def test_under_load_is_unsure(self):
        self.check("base", "same", "unsure", "no judge|not sure after 24 rounds", PLAYED_LOAD="1")
