# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/baseline.py, of the scripts of scripts/ci and of what they promise to other tools. The program is
named by the environment variable LMDBENCH_PROGRAM."""

import contextlib
import importlib.util
import io
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import yaml

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
sys.path.insert(0, os.path.join(ROOT, "scripts", "ci"))

import baseline  # noqa: E402
import regression  # noqa: E402
import verdict_study  # noqa: E402

PROGRAM = os.environ.get("LMDBENCH_PROGRAM", os.path.join(ROOT, "build", "release", "lmdbench"))
REVISION = re.compile(r"^[0-9a-f]{16}$")


def printed(function, *arguments):
    stream = io.StringIO()
    with contextlib.redirect_stdout(stream), contextlib.redirect_stderr(stream):
        status = function(*arguments)
    return status, stream.getvalue()


class BaselineTest(unittest.TestCase):
    def test_baselines_are_not_stale(self):
        status, text = printed(baseline.main, ["check", "--program", PROGRAM])
        self.assertEqual(status, 0, text)

    def test_every_scene_has_hashes_counters_and_ratios(self):
        for scene in baseline.SCENES:
            with open(baseline.baseline_file(baseline.FOLDER, scene), encoding="utf-8") as stream:
                content = json.load(stream)
            self.assertGreaterEqual(len(content["methods"]), 3, scene)
            for label, method in content["methods"].items():
                self.assertRegex(method["result_hash"], REVISION, f"{scene}: {label}")
                work = sum(method["counters"].values()) + sum(method["global_counters"].values())
                self.assertGreater(work, 0, f"{scene}: {label}")
        self.assertIn("improved / original", content["time_ratios"] | baseline.measure(PROGRAM, "shapes")["time_ratios"])

    def test_changes_are_noticed(self):
        scene = "combs"
        with open(baseline.baseline_file(baseline.FOLDER, scene), encoding="utf-8") as stream:
            before = json.load(stream)

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
        with tempfile.TemporaryDirectory() as folder:
            for scene in baseline.SCENES:
                shutil.copy(baseline.baseline_file(baseline.FOLDER, scene), folder)
            file = baseline.baseline_file(folder, "combs")
            with open(file, encoding="utf-8") as stream:
                content = json.load(stream)
            content["methods"]["improved"]["lmds"] += 1
            with open(file, "w", encoding="utf-8") as stream:
                json.dump(content, stream)
            os.remove(baseline.baseline_file(folder, "rocking-box"))
            status, text = printed(baseline.main, ["check", "--program", PROGRAM, "--folder", folder])
            self.assertEqual(status, 1)
            self.assertIn("combs.json: /methods/improved/lmds: ", text)
            self.assertIn("rocking-box.json: no such baseline", text)
            self.assertIn("2 differences (remedy: ", text)

    def test_missing_baseline_and_program(self):
        with tempfile.TemporaryDirectory() as folder:
            status, text = printed(baseline.main, ["check", "--program", "/does/not/exist", "--folder", folder])
            self.assertEqual(status, 4)
            self.assertIn("remedy", text)


class WorkflowTest(unittest.TestCase):
    def test_github_actions(self):
        with open(os.path.join(ROOT, "scripts", "ci", "github-actions.yml"), encoding="utf-8") as stream:
            workflow = yaml.safe_load(stream)
        steps = workflow["jobs"]["regression"]["steps"]
        self.assertEqual([step["with"]["fetch-depth"] for step in steps if "checkout" in step.get("uses", "")], [0])

    def test_gitlab(self):
        with open(os.path.join(ROOT, "scripts", "ci", "gitlab-ci.yml"), encoding="utf-8") as stream:
            job = yaml.safe_load(stream)["regression"]
        self.assertEqual(job["artifacts"]["reports"]["junit"], "build/ci/junit.xml")


class RegressionScriptTest(unittest.TestCase):
    def run_script(self, *arguments):
        return subprocess.run([os.path.join(ROOT, "scripts", "ci_regression.sh"), *arguments], capture_output=True,
                              text=True, check=False, stdin=subprocess.DEVNULL)

    def test_usage(self):
        for arguments in ([], ["no-such-revision"], ["HEAD", "HEAD", "HEAD"], ["HEAD", "--unknown", "1"],
                          ["HEAD", "--pairs", "none"], ["HEAD", "--threshold"], ["HEAD", "--threshold", "much"],
                          ["HEAD", "--experiment", "/does/not/exist.json"]):
            done = self.run_script(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn("remedy", done.stderr, arguments)


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
            return subprocess.CompletedProcess(command, regression.EXIT_CODES[verdict], out, "")
        self.runs.append((command[0], environment))
        return subprocess.CompletedProcess(command, 0, "", "")


class RuleTest(unittest.TestCase):
    """The rule, with a judge whose words are given. Answers come in the order: one round; then at every look the candidate,
    the base against itself, and the fresh rounds alone where there were suspects."""

    def decide(self, *answers, pairs=6, most=24):
        self.script = Script(answers)
        rule = regression.Regression({name: name for name in regression.NAMES}, "judge", ["scene"], "results",
                                     environments={"cand": {"A": "b"}}, generator=random.Random(1), run=self.script)
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
        rule = regression.Regression({name: name for name in regression.NAMES}, "judge", ["scene"], "results",
                                     run=lambda command, environment: subprocess.CompletedProcess(command, 3, "", "broken mesh"))
        with self.assertRaises(regression.Broken) as caught:
            rule.behaviour()
        self.assertEqual((caught.exception.side, caught.exception.log), ("base", "broken mesh"))

    def broken_side(self, fails, judge="cand"):
        """Whose fault it is where the command lines that hold a word of `fails` fail."""
        def run(command, environment):
            code = 70 if any(word in command for word in fails) else 0
            return subprocess.CompletedProcess(command, code, "", "gone")
        rule = regression.Regression({name: name for name in regression.NAMES}, judge, ["scene"], "results", run=run)
        with self.assertRaises(regression.Broken) as caught:
            rule.behaviour()
        return caught.exception.side

    def test_who_is_at_fault(self):
        self.assertEqual(self.broken_side(["cand"]), "candidate")
        self.assertEqual(self.broken_side(["null"]), "base")
        self.assertEqual(self.broken_side(["cand", "base"]), "base", "where both fail it is not the candidate")
        self.assertEqual(self.broken_side(["compare"]), "candidate", "its own judge")
        self.assertEqual(self.broken_side(["compare"], judge="another"), "judge")

    def test_another_default_of_the_candidate_is_changed(self):
        def run(command, environment):
            refused = "compare" in command
            return subprocess.CompletedProcess(command, 2 if refused else 0, "",
                                               f"cand.h5: {regression.OTHER_EXPERIMENT} base.h5: /force" if refused else "")
        rule = regression.Regression({name: name for name in regression.NAMES}, "cand", ["scene"], "results", run=run)
        word, why = rule.behaviour()
        self.assertEqual(word, "changed")
        self.assertIn("another experiment", why)


class RegressionProgramTest(unittest.TestCase):
    """The real program against itself and against one that does something else, in one round."""

    def compare(self, folder, candidate):
        return subprocess.run([sys.executable, os.path.join(ROOT, "scripts", "ci", "regression.py"), "--base", PROGRAM,
                               "--candidate", candidate, "--judge", PROGRAM, "--experiment",
                               os.path.join(ROOT, "experiments", "shapes.json"), "--set", "/frames=60", "--set",
                               "/probes/truth/stride_frames=0", "--set", "/probes/fcl/stride_frames=0", "--pairs", "1",
                               "--most", "1", "--instructions", "0", "--out", folder], capture_output=True, text=True,
                              check=False, stdin=subprocess.DEVNULL)

    def test_against_itself(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.compare(folder, PROGRAM)
            self.assertIn(done.returncode, (0, 4), done.stderr)
            self.assertRegex(done.stdout, r"verdict: (same|faster|unsure) \(.*\); 1 rounds")
            with open(os.path.join(folder, "verdict.md"), encoding="utf-8") as stream:
                self.assertIn("| improved | search |", stream.read())
            self.assertEqual(xml.etree.ElementTree.parse(os.path.join(folder, "junit.xml")).getroot().get("failures"), "0")
            for name, processes in (("base.json", 2), ("candidate.json", 1)):
                with open(os.path.join(folder, name), encoding="utf-8") as stream:
                    rows = json.load(stream)["benchmarks"]
                self.assertEqual(sum(row["name"] == "improved/search" for row in rows), processes)

    def test_another_behaviour_is_changed(self):
        with tempfile.TemporaryDirectory() as folder:
            other = os.path.join(folder, "other")
            with open(other, "w", encoding="utf-8") as stream:
                stream.write(f"#!/bin/sh\nexec {PROGRAM} \"$@\" --set /force/maximum_force_n=2\n")
            os.chmod(other, 0o755)
            done = self.compare(os.path.join(folder, "out"), other)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("verdict: changed (the candidate makes another experiment of the same scene file", done.stdout)
            root = xml.etree.ElementTree.parse(os.path.join(folder, "out", "junit.xml")).getroot()
            self.assertEqual(root.get("failures"), "1")
            self.assertIn("/force/maximum_force_n", root.find(".//failure").get("message"))


class BenchmarkFormatTest(unittest.TestCase):
    def test_compare_py_reads_it(self):
        tool = "/usr/share/benchmark/compare.py"
        if not os.path.exists(tool):
            self.skipTest("libbenchmark-tools is not installed")
        if importlib.util.find_spec("scipy") is None:
            self.skipTest("compare.py needs scipy")
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a", "b"):
                subprocess.run([PROGRAM, "--quiet", "run", os.path.join(ROOT, "experiments", "shapes.json"), "--set",
                                "/frames=60", "--set", "/probes/truth/stride_frames=0", "--set",
                                "/probes/fcl/stride_frames=0", "--out", f"{name}.h5"], cwd=folder, check=True,
                               stdout=subprocess.DEVNULL)
            done = subprocess.run([PROGRAM, "--quiet", "compare", "a.h5", "b.h5", "--benchmark", "b.json",
                                   "--benchmark-base", "a.json"], cwd=folder, check=False, stdout=subprocess.DEVNULL)
            self.assertIn(done.returncode, (0, 4))
            read = subprocess.run([sys.executable, tool, "--no-color", "benchmarks", "a.json", "b.json"], cwd=folder,
                                  capture_output=True, text=True, check=False)
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


if __name__ == "__main__":
    unittest.main()
