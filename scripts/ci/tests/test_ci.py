# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/baseline.py, of the scripts of scripts/ci and of what they promise to other tools. The program is
named by the environment variable LMDBENCH_PROGRAM."""

import importlib.util
import json
import os
import random
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree

import yaml

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "figures", "tests"))

from cases import PROGRAM, ROOT, SCRIPTS, Scratch, call, text_of  # noqa: E402  (the figures' tests must be found first)
import baseline  # noqa: E402
import outcome  # noqa: E402
import regression  # noqa: E402
import verdict_study  # noqa: E402

REVISION = r"^[0-9a-f]{16}$"
SHORT_RUN = [ROOT / "experiments" / "shapes.json", "--set", "/frames=60", "--set", "/probes/truth/stride_frames=0", "--set", "/probes/fcl/stride_frames=0"]


def baseline_of(scene):
    return json.loads(text_of(baseline.baseline_file(baseline.FOLDER, scene)))


class ReleaseCheckTest(unittest.TestCase):
    def test_what_is_no_positive_whole_number_is_refused(self):
        """A study of '1e6' poses was one of none, and passed."""
        for name in ("LMDBENCH_POSES", "LMDBENCH_SEED", "LMDBENCH_FUZZ_MINUTES"):
            for value, code in (("1e6", 2), ("0", 2), ("-5", 2), ("08", 2), ("x", 2), ("7", 0), ("", 0)):
                done = call(SCRIPTS / "release_check.sh", "--list", env=os.environ | {name: value})
                self.assertEqual(done.returncode, code, (name, value))
                self.assertEqual(name in done.stderr and "remedy" in done.stderr, code == 2, done.stderr)


class BaselineTest(Scratch):
    def test_baselines_are_not_stale(self):
        self.printed(baseline.main, "check", "--without-times", "--program", PROGRAM)

    def test_every_scene_has_hashes_counters_and_ratios(self):
        for scene in baseline.SCENES:
            content = baseline_of(scene)
            self.assertGreaterEqual(len(content["methods"]), 3, scene)
            for label, method in content["methods"].items():
                self.assertRegex(method["result_hash"], REVISION, f"{scene}: {label}")
                work = sum(method["counters"].values()) + sum(method["global_counters"].values())
                self.assertGreater(work, 0, f"{scene}: {label}")
        self.assertIn("improved / original", content["time_ratios"] | baseline.measure(PROGRAM, "shapes")["time_ratios"])

    def test_changes_are_noticed(self):
        before = baseline_of("combs")

        def changed(change):
            other = json.loads(json.dumps(before))
            change(other)
            return baseline.differences(before, other)

        def count(other):
            other["methods"]["improved"]["counters"]["tracking_steps"] += 1

        def result(other):
            other["methods"]["original"]["result_hash"] = "0" * 16

        def method(other):
            del other["methods"]["certified"]

        def ratio(factor):
            def change(other):
                key = sorted(other["time_ratios"])[0]
                other["time_ratios"][key] *= factor
            return change

        self.assertEqual(changed(lambda other: None), [])
        self.assertEqual(len(changed(count)), 1)
        self.assertEqual(len(changed(result)), 1)
        self.assertGreater(len(changed(method)), 1)
        self.assertEqual(changed(ratio(2.0)), [])
        self.assertEqual(len(changed(ratio(3.5))), 1)
        self.assertEqual(len(changed(ratio(0.25))), 1)

    def test_a_stale_baseline_is_named(self):
        shutil.copy(baseline.baseline_file(baseline.FOLDER, "shapes"), self.folder)
        content = baseline_of("combs")
        content["methods"]["improved"]["lmds"] += 1
        self.write("combs.json", json.dumps(content))
        text = self.printed(baseline.main, "check", "--program", PROGRAM, "--folder", self.folder, code=1)
        self.assertIn("combs.json: /methods/improved/lmds: ", text)
        others = baseline.SCENES.keys() - {"shapes", "combs"}
        for name in others:
            self.assertIn(f"{name}.json: no such baseline", text)
        self.assertIn(f"{1 + len(others)} differences (remedy: ", text)

    def test_a_damaged_baseline_is_named(self):
        content = baseline_of("combs")
        content["time_ratios"]["improved / original"] = 0
        self.assertEqual(baseline.differences(content, content), ["/time_ratios/improved / original: 0 is no ratio: the baseline is damaged"])
        for name in baseline.SCENES:
            self.write(name + ".json", "{")
        text = self.printed(baseline.main, "check", "--program", PROGRAM, "--folder", self.folder, code=1)
        self.assertIn("combs.json: the baseline is damaged: ", text)

    def test_missing_baseline_and_program(self):
        self.assertIn("remedy", self.printed(baseline.main, "check", "--program", "/does/not/exist", "--folder", self.folder, code=4))


class WorkflowTest(unittest.TestCase):
    def test_github_actions(self):
        steps = yaml.safe_load(text_of("scripts", "ci", "github-actions.yml"))["jobs"]["regression"]["steps"]
        self.assertEqual([step["with"]["fetch-depth"] for step in steps if "checkout" in step.get("uses", "")], [0])

    def test_gitlab(self):
        job = yaml.safe_load(text_of("scripts", "ci", "gitlab-ci.yml"))["regression"]
        self.assertEqual(job["artifacts"]["reports"]["junit"], "build/ci/junit.xml")


class RegressionScriptTest(unittest.TestCase):
    def test_usage(self):
        for arguments in ([], ["no-such-revision"], ["HEAD", "HEAD", "HEAD"], ["HEAD", "--unknown", "1"],
                          ["HEAD", "--pairs", "none"], ["HEAD", "--threshold"], ["HEAD", "--threshold", "much"],
                          ["HEAD", "--experiment", "/does/not/exist.json"]):
            done = call(SCRIPTS / "ci_regression.sh", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn("remedy", done.stderr, arguments)


class WrongCallsTest(Scratch):
    """No traceback, and the exit code of the contract."""

    def regression(self, *arguments):
        done = call(sys.executable, SCRIPTS / "ci" / "regression.py", "--experiment", "none.json", "--out", self.path("out"), *arguments)
        self.assertNotIn("Traceback", done.stderr)
        return done

    def test_programs_that_are_not_there(self):
        text = self.write("text", "no program")
        for base, candidate, word, code in (("/none", PROGRAM, "no comparison", 3), (self.folder, PROGRAM, "no comparison", 3),
                                            (text, PROGRAM, "no comparison", 3), (PROGRAM, "/none", "broken", 1)):
            done = self.regression("--base", base, "--candidate", candidate)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(f"verdict: {word} (", done.stdout)
        self.assertEqual(self.regression("--base", PROGRAM, "--candidate", PROGRAM, "--judge", "/none").returncode, 3)

    def test_what_is_no_share(self):
        for value in ("y", "nan", "-1", "inf"):
            done = self.regression("--base", PROGRAM, "--candidate", PROGRAM, f"--instructions={value}")
            self.assertEqual(done.returncode, 2, value)
            self.assertIn("--instructions", done.stderr)

    def test_an_outcome_of_nothing(self):
        done = call(sys.executable, SCRIPTS / "ci" / "outcome.py")
        self.assertEqual(done.returncode, 2)
        self.assertIn("usage: ", done.stderr)


def timing(verdict, low=0.98, stage="search"):
    return {"method": "m", "stage": stage, "verdict": verdict, "low": low, "detectable": 0.02}


class Script:
    """Processes that never run: `answers` are what the judge says, in turn; an answer is (verdict, timings...)."""

    def __init__(self, answers):
        self.answers, self.runs, self.compared = list(answers), [], []

    def __call__(self, command, environment):
        if "compare" in command:
            self.compared.append(command)
            verdict, *timings = self.answers.pop(0)
            out = json.dumps({"verdict": verdict, "timings": timings or [timing(verdict)]})
            return subprocess.CompletedProcess(command, outcome.EXIT_CODES[verdict], out, "")
        self.runs.append((command[0], environment))
        return subprocess.CompletedProcess(command, 0, "", "")


def rule_of(run, judge="judge", **options):
    return regression.Regression({name: name for name in regression.NAMES}, judge, ["scene"], "results", run=run, **options)


class RuleTest(unittest.TestCase):
    """The rule, with a judge whose words are given. Answers come in the order: one round; then at every look the candidate,
    the base against itself, and the fresh rounds alone where there were suspects."""

    def decide(self, *answers, pairs=6, most=24):
        self.script = Script(answers)
        rule = rule_of(self.script, environments={"cand": {"A": "b"}}, generator=random.Random(1))
        decision = rule.behaviour() or rule.times(pairs, most)
        self.assertEqual(self.script.answers, [], "not all was asked")
        return decision

    def test_same_after_six_rounds_in_every_order_once(self):
        self.assertEqual(self.decide(("same",), ("same",), ("unsure",))[0], "same")
        names = [name for name, _ in self.script.runs]
        rounds = [tuple(names[i:i + 3]) for i in range(0, len(names), 3)]
        self.assertEqual(sorted(rounds), sorted(regression.ORDERS))
        self.assertTrue(all(environment == ({"A": "b"} if name == "cand" else {}) for name, environment in self.script.runs))

    def test_both_series_of_the_base_judge_the_candidate(self):
        self.decide(("same",), ("same",), ("same",))
        command = self.script.compared[1]
        sides = command[command.index("--base") + 1:command.index("--candidate")]
        self.assertEqual(len(sides), 12)
        self.assertEqual(sum("null" in file for file in sides), 6)
        self.assertIn("--false-alarm", command)
        self.assertNotIn("--false-alarm", self.script.compared[2], "the base against itself")

    def test_changed_ends_after_one_round(self):
        self.assertEqual(self.decide(("changed",))[0], "changed")
        self.assertEqual(len(self.script.runs), 3)

    def test_slower_is_confirmed_by_fresh_rounds(self):
        word, why = self.decide(("same",), ("slower",), ("same",),
                                ("slower",), ("same",), ("unsure", timing("unsure", 1.01)))
        self.assertEqual(word, "slower")
        self.assertIn("m's search", why)
        self.assertEqual(len(self.script.runs), 36)
        self.assertFalse(any("-5.h5" in word for word in self.script.compared[-1]), "rounds of the first look")
        self.assertTrue(any("-6.h5" in word for word in self.script.compared[-1]))

    def test_slower_alone_is_never_enough(self):
        slower = (("slower",), ("same",))
        self.assertEqual(self.decide(("same",), *slower, *slower, ("same", timing("same", 0.99)), *slower,
                                     ("same", timing("same", 1.0)))[0], "unsure")
        self.assertEqual(self.decide(("same",), *slower, most=6)[0], "unsure")
        self.assertEqual(len(self.script.runs), 18)

    def test_another_stage_does_not_confirm(self):
        first = ("slower", timing("slower"), timing("same", stage="reduction"))
        fresh = ("slower", timing("unsure", 0.99), timing("slower", 1.2, stage="reduction"))
        self.assertEqual(self.decide(("same",), first, ("same",), ("unsure",), ("same",), fresh, most=12)[0], "unsure")

    def test_a_suspect_that_turns_out_the_same_is_let_go(self):
        fresh = ("unsure", timing("unsure", 1.01))
        self.assertEqual(self.decide(("same",), ("slower",), ("same",), ("same",), ("same",), fresh)[0], "same")

    def test_unsure_gets_as_many_rounds_again(self):
        unsure = (("unsure",), ("same",))
        self.assertEqual(self.decide(("same",), *unsure, *unsure, *unsure)[0], "unsure")
        self.assertEqual(len(self.script.runs), 3 * 24)
        self.assertEqual(self.decide(("same",), *unsure, ("faster",), ("unsure",))[0], "faster")
        self.assertEqual(self.decide(("same",), *unsure, *unsure, most=10)[0], "unsure")
        self.assertEqual(len(self.script.runs), 3 * 10)

    def test_a_base_that_differs_from_itself_is_no_judge(self):
        fresh = ("slower", timing("slower", 1.2))
        for word in ("slower", "faster"):
            decision = self.decide(("same",), ("same",), (word,), ("slower",), (word,), ("slower",), (word,))
            self.assertEqual(decision[0], "unsure")
            self.assertIn("no judge", decision[1])
        self.assertEqual(self.decide(("same",), ("slower",), ("slower",), ("slower",), ("same",), fresh)[0], "slower")

    def test_a_process_that_fails_is_told(self):
        with self.assertRaises(regression.Broken) as caught:
            rule_of(lambda command, environment: subprocess.CompletedProcess(command, 3, "", "broken mesh")).behaviour()
        self.assertEqual((caught.exception.side, caught.exception.log), ("base", "broken mesh"))

    def broken_side(self, fails, judge="cand"):
        """Whose fault it is where the command lines that hold a word of `fails` fail."""
        def run(command, environment):
            code = 70 if any(word in command for word in fails) else 0
            return subprocess.CompletedProcess(command, code, "", "gone")
        with self.assertRaises(regression.Broken) as caught:
            rule_of(run, judge).behaviour()
        return caught.exception.side

    def test_who_is_at_fault(self):
        self.assertEqual(self.broken_side(["cand"]), "candidate")
        self.assertEqual(self.broken_side(["null"]), "base")
        self.assertEqual(self.broken_side(["cand", "base"]), "base", "where both fail it is not the candidate")
        self.assertEqual(self.broken_side(["compare"]), "candidate", "its own judge")
        self.assertEqual(self.broken_side(["compare"], judge="another"), "judge")

    def test_a_base_that_changes_from_run_to_run_is_at_fault(self):
        def run(command, environment):
            if "compare" not in command:
                return subprocess.CompletedProcess(command, 0, "", "")
            pooled = sum("base-" in word or "null-" in word for word in command[command.index("--base"):command.index("--candidate")]) > 1
            out = "" if pooled else json.dumps({"verdict": "changed", "timings": []})
            return subprocess.CompletedProcess(command, 3 if pooled else 1, out, "are no replicates")
        with self.assertRaises(regression.Broken) as caught:
            rule_of(run, "cand").behaviour()
        self.assertEqual(caught.exception.side, "base")

    def test_what_the_judge_refuses_is_a_mistake_of_the_call(self):
        def run(command, environment):
            return subprocess.CompletedProcess(command, 2 if "compare" in command else 0, "", "no counter 'nosuch'")
        with self.assertRaises(SystemExit) as caught:
            rule_of(run).behaviour()
        self.assertEqual(caught.exception.code, 2)

    def test_another_default_of_the_candidate_is_changed(self):
        def run(command, environment):
            refused = "compare" in command
            return subprocess.CompletedProcess(command, 2 if refused else 0, "",
                                               f"cand.h5: {regression.OTHER_EXPERIMENT} base.h5: /force" if refused else "")
        word, why = rule_of(run, "cand").behaviour()
        self.assertEqual(word, "changed")
        self.assertIn("another experiment", why)


class OutcomeTest(Scratch):
    """Evidence that the gate's tests (test_gate.py) cannot play."""

    def told(self, code, verdict, times, instructions=None, **others):
        """(console, {test case: word} of what junit.xml does not call passed)."""
        timings = [dict(timing(verdict), ratio=1.1, high=1.2), dict(timing("same", stage="reduction"), ratio=1.0, high=1.02)]
        evidence = outcome.Evidence(answer={"differences": [], "timings": timings}, times=times, instructions=instructions, **others)
        console = self.printed(lambda _: outcome.tell(evidence, self.folder), code=code)
        self.assertEqual(console, self.read("verdict.md"))
        cases = xml.etree.ElementTree.fromstring(self.read("junit.xml")).iter("testcase")
        return console, {case.get("name"): case[0].get("type") for case in cases if len(case)}

    def test_a_suspect_that_no_fresh_rounds_confirmed_fails_nothing(self):
        console, cases = self.told(4, "slower", outcome.Times("unsure", "not sure after 24 rounds", set()))
        self.assertEqual(cases, {"callgrind": outcome.NOT_JUDGED, "all stages": "unsure", "search": "unsure"})
        self.assertIn("| m | search | - | - | 1.100 | 0.980 to 1.2 | 2 % | unsure |", console)

    def test_what_fresh_rounds_confirmed_fails_whatever_all_rounds_say(self):
        console, cases = self.told(1, "unsure", outcome.Times("slower", "m's search: confirmed", {("m", "search")}))
        self.assertEqual(cases, {"callgrind": outcome.NOT_JUDGED, "all stages": "slower", "search": "slower"})
        self.assertTrue(console.startswith("**slower: m's search: confirmed**\n"), console)

    def test_a_base_that_is_no_judge_is_unsure_though_every_stage_looks_the_same(self):
        _, cases = self.told(4, "same", outcome.Times("unsure", "the base is slower than itself", set()))
        self.assertEqual(cases, {"callgrind": outcome.NOT_JUDGED, "all stages": "unsure"})

    def test_a_share_of_instructions_and_functions_of_one_side(self):
        same = outcome.Times("same", "sure", set())
        counts = [("A::search", 1000, 1010), ("B::search", 1000, None), ("C::track", None, 5)]
        console, cases = self.told(0, "same", same, counts)
        self.assertEqual(cases, {"B::search": outcome.NOT_JUDGED, "C::track": outcome.NOT_JUDGED})
        self.assertIn("| A::search | 1000 | 1010 | +1.00 % | unknown | same |", console)
        self.assertIn("| C::track | - | 5 | - | unknown | not judged |", console)
        console, cases = self.told(1, "unsure", None, counts, share=0.009)
        self.assertEqual((cases["A::search"], cases["search"]), ("slower", outcome.NOT_JUDGED))
        self.assertTrue(console.startswith("**slower: +1.00 % instructions in A::search, counted by callgrind (frames: unknown)**\n"), console)

    def test_instructions_of_frames_without_contact_judge_nothing_but_more_of_them(self):
        same = outcome.Times("same", "sure", set())
        for counted, candidate, word in (((400, 0), 1010, outcome.NOT_JUDGED), ((400, 1), 1010, None), ((400, 0), 1011, "slower")):
            console, cases = self.told(word == "slower", "same", same, [("A::search", 1000, candidate)], counted=counted)
            self.assertEqual(cases.get("A::search"), word, counted)
            self.assertIn(f" % | first 400, {counted[1]} in contact | {word or 'same'} |", console)

    def test_times_of_a_label_with_a_blank(self):
        rows = [{"name": "my_method/local_update", "real_time": 2000.0}]
        found = regression.seconds(self.write("base.json", json.dumps({"benchmarks": rows})))
        evidence = outcome.Evidence(answer={"differences": [], "timings": [dict(timing("same", stage="local update"), method="my method", ratio=1.0, high=1.02)]},
                                    seconds={"base": found, "candidate": found}, times=outcome.Times("same", "sure", set()))
        self.assertIn("| my method | local update | 2 | 2 |", self.printed(lambda _: outcome.tell(evidence, self.folder)))

    def test_what_xml_cannot_hold(self):
        log = "\x1b[31merror:\x1b[0m expected ';' & <more>\n"
        self.told(1, "same", None, failure=outcome.Failure("candidate", "build", "\x07 & <it>", log))
        error = xml.etree.ElementTree.fromstring(self.read("junit.xml")).find(".//error")
        self.assertEqual((error.get("message"), error.text), ("? & <it>", "?[31merror:?[0m expected ';' & <more>"))


class RegressionProgramTest(Scratch):
    """The real program against itself and against one that does something else, in one round."""

    def compare(self, candidate):
        """The finished comparison, and its junit.xml."""
        done = call(sys.executable, SCRIPTS / "ci" / "regression.py", "--base", PROGRAM, "--candidate", candidate, "--judge", PROGRAM, "--experiment",
                    *SHORT_RUN, "--pairs", "1", "--most", "1", "--instructions", "0", "--out", self.path("out"))
        return done, xml.etree.ElementTree.fromstring(self.read("out", "junit.xml"))

    def test_against_itself(self):
        done, junit = self.compare(PROGRAM)
        self.assertIn(done.returncode, (0, 4), done.stderr)
        self.assertRegex(done.stdout, r"verdict: (same|faster|unsure) \(.*\); 1 rounds")
        self.assertIn("| improved | search |", self.read("out", "verdict.md"))
        self.assertEqual(junit.get("failures"), "0")
        for name, processes in (("base.json", 2), ("candidate.json", 1)):
            rows = json.loads(self.read("out", name))["benchmarks"]
            self.assertEqual(sum(row["name"] == "improved/search" for row in rows), processes)

    def test_another_behaviour_is_changed(self):
        other = self.write("other", f"#!/bin/sh\nexec {PROGRAM} \"$@\" --set /force/maximum_force_n=2\n")
        os.chmod(other, 0o755)
        done, junit = self.compare(other)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("verdict: changed (", done.stdout)
        self.assertEqual(junit.get("failures"), "1")
        self.assertIn("/force/maximum_force_n", junit.find(".//failure").get("message"))


class BenchmarkFormatTest(Scratch):
    def test_compare_py_reads_it(self):
        tool = "/usr/share/benchmark/compare.py"
        if not os.path.exists(tool):
            self.skipTest("libbenchmark-tools is not installed")
        if importlib.util.find_spec("scipy") is None:
            self.skipTest("compare.py needs scipy")
        for name in ("a", "b"):
            done = call(PROGRAM, "--quiet", "run", *SHORT_RUN, "--out", f"{name}.h5", cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
        done = call(PROGRAM, "--quiet", "compare", "a.h5", "b.h5", "--benchmark", "b.json", "--benchmark-base", "a.json", cwd=self.folder)
        self.assertIn(done.returncode, (0, 4), done.stderr)
        read = call(sys.executable, tool, "--no-color", "benchmarks", "a.json", "b.json", cwd=self.folder)
        self.assertEqual(read.returncode, 0, read.stderr)
        self.assertIn("improved/search", read.stdout)


class StudyTest(unittest.TestCase):
    def row(self, variant, verdict, named=False):
        return {"condition": "idle", "variant": variant, "verdict": verdict, "named": named, "rounds": 6, "seconds": 2.0,
                "load": 1.0, "looks": [{"highest_low": 1.0}]}

    def test_table_counts_verdicts(self):
        rows = [self.row("again", "same"), self.row("again", "unsure"), self.row("10", "slower", True),
                self.row("10", "slower", False)]
        text = verdict_study.table(rows)
        self.assertIn("| idle | nothing | 2 | 0 (0.0 %, 0.0 to 84.2) |  | 1 (50.0 %, 1.3 to 98.7) | 1 | 0 | 6.0 | "
                      "2.0, 2.0, 2.0 | 1.0 to 1.0 |", text)
        self.assertIn("| idle | 10 % | 2 | 2 (100.0 %, 15.8 to 100.0) | 1 | 0 (0.0 %, 0.0 to 84.2) | 0 | 0 |", text)

    def test_stages_change_with_the_comparison(self):
        found = {verdict_study.planted("5", i)[0] for i in range(len(verdict_study.STAGES))}
        self.assertEqual(found, set(verdict_study.STAGES))

    def test_the_planted_variable_names_no_method_for_the_base_and_has_one_length(self):
        for index in range(len(verdict_study.STAGES)):
            stage, ours, theirs = verdict_study.planted("10", index)
            self.assertEqual(ours, stage + ":10")
            self.assertEqual(len(ours), len(theirs))
            self.assertNotIn(theirs.split(":")[0], {name.split(":")[0] for name in verdict_study.STAGES})
