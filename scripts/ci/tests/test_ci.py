# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/baseline.py, of the scripts of scripts/ci and of what they promise to other tools. The program is
named by the environment variable LMDBENCH_PROGRAM."""

import contextlib
import importlib.util
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import yaml

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
sys.path.insert(0, os.path.join(ROOT, "scripts", "ci"))

import baseline  # noqa: E402
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
        self.assertTrue(any("scripts/ci_regression.sh" in step.get("run", "") for step in steps))
        self.assertEqual([step["with"]["fetch-depth"] for step in steps if "checkout" in step.get("uses", "")], [0])

    def test_gitlab(self):
        with open(os.path.join(ROOT, "scripts", "ci", "gitlab-ci.yml"), encoding="utf-8") as stream:
            job = yaml.safe_load(stream)["regression"]
        self.assertTrue(any("scripts/ci_regression.sh" in line for line in job["script"]))
        self.assertEqual(job["allow_failure"]["exit_codes"], 4)
        self.assertEqual(job["artifacts"]["reports"]["junit"], "build/ci/junit.xml")


class RegressionScriptTest(unittest.TestCase):
    def run_script(self, *arguments):
        return subprocess.run([os.path.join(ROOT, "scripts", "ci_regression.sh"), *arguments], capture_output=True,
                              text=True, check=False, stdin=subprocess.DEVNULL)

    def test_usage(self):
        for arguments in ([], ["no-such-revision"], ["HEAD", "HEAD", "HEAD"], ["HEAD", "--unknown", "1"],
                          ["HEAD", "--pairs", "none"], ["HEAD", "--threshold"]):
            done = self.run_script(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn("remedy", done.stderr, arguments)


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
    def test_table_counts_verdicts(self):
        rows = [{"variant": "again", "verdict": "same", "named": 0, "detectable": 0.02, "load": "1.0"},
                {"variant": "again", "verdict": "unsure", "named": 0, "detectable": 0.04, "load": "3.0"},
                {"variant": "planted10", "verdict": "slower", "named": 1, "detectable": 0.03, "load": "2.0"}]
        text = verdict_study.table(rows, 6)
        self.assertIn("6 processes a side, load average 1.0 to 3.0.", text)
        self.assertIn("| nothing (base again) | 2 | 0 |  | 1 | 1 | 0 | 4.0 % |", text)
        self.assertIn("| 10 % | 1 | 1 | 1 | 0 | 0 | 0 | 3.0 % |", text)

    def test_stages_change_with_the_comparison(self):
        planted = [verdict_study.stage_of(i) for i in range(len(verdict_study.STAGES) * verdict_study.ROUNDS_A_STAGE)]
        self.assertEqual(set(planted), set(verdict_study.STAGES))


if __name__ == "__main__":
    unittest.main()
