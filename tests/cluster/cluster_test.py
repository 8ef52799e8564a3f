# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of sweeps on a cluster without a cluster: pieces, reports put together, what is submitted and what is said of a job,
with a Slurm that only answers. Arguments: the build tree."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLUSTER = ROOT / "scripts" / "cluster"
sys.path[:0] = [str(CLUSTER), str(CLUSTER / "slurm")]

import merge_reports  # noqa: E402
import pieces  # noqa: E402
import status  # noqa: E402
import submit  # noqa: E402

BUILD = None


class Scratch(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, name, content):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).write_text(content if isinstance(content, str) else json.dumps(content))
        return str(self.folder / name)


class Pieces(Scratch):
    def test_chunks_keep_groups_apart_and_leave_out_what_is_done(self):
        points = [{"number": i, "group": i // 4, "done": i in (1, 6)} for i in range(9)]
        numbers = [[point["number"] for point in chunk] for chunk in pieces.chunks(points, 2)]
        self.assertEqual(numbers, [[0, 2], [3], [4, 5], [7], [8]])
        self.assertEqual(pieces.numbers_text([0, 2, 3, 4, 9, 10]), "0,2-4,9-10")

    def sweep(self):
        return self.write("sweep.json", {
            "name": "s", "experiments": [str(ROOT / "experiments" / "shapes.json")], "repetitions": 1, "truth_check_frames": 2,
            "set": {"/frames": 60}, "series": [{"method": {"name": "improved"}, "axes": [
                {"/driver/search_every_frames": [1, 2, 20], "/driver/search_latency_frames": [1, 2, 20]}]}]})

    def test_of_a_sweep_measure_what_lacks_and_nothing_else(self):
        program, out = os.path.join(BUILD, "lmdbench"), str(self.folder / "s.h5")
        first, collect = pieces.pieces_of_sweep(program, self.sweep(), out, points_per_job=2)
        self.assertEqual([piece.what for piece in first], ["points 0-1", "points 2"])
        refused = subprocess.run(collect, capture_output=True, text=True, check=False)
        self.assertEqual(refused.returncode, 3)
        self.assertIn("3 of 3 points are not measured: 0-2", refused.stderr)
        self.assertEqual(subprocess.run(first[1].command, capture_output=True, check=False).returncode, 0)
        of_failed = [pathlib.Path(out + ".points", name) for name in ("findings.log", first[0].name + ".done")]
        for file in of_failed:
            file.write_text("points 0-1: found something wrong", encoding="utf-8")
        second, _ = pieces.pieces_of_sweep(program, self.sweep(), out, points_per_job=2)
        self.assertFalse([file for file in of_failed if file.exists()], "points that failed are tried again")
        self.assertEqual([(piece.what, piece.name) for piece in second], [("points 0-1", first[0].name)])
        self.assertEqual(subprocess.run(second[0].command, capture_output=True, check=False).returncode, 0)
        self.assertEqual(pieces.pieces_of_sweep(program, self.sweep(), out)[0], [])
        done = subprocess.run(collect, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(os.path.exists(out))
        other, _ = pieces.pieces_of_sweep(program, self.sweep(), out, ["/set/~1frames=50"])
        self.assertEqual(len(other), 3, "other values are other points")

    def test_a_plan_is_read_as_it_was_written(self):
        pieces.write_plan(self.folder / "p", [pieces.Piece("a", "points 0", ["x", "y z"])], ["collect"])
        read, collect = pieces.read_plan(self.folder / "p")
        self.assertEqual([piece.as_json() for piece in read], [{"name": "a", "what": "points 0", "command": ["x", "y z"]}])
        self.assertEqual(collect, ["collect"])

    def test_options_that_exclude_each_other_and_wrong_numbers_are_refused(self):
        program = os.path.join(BUILD, "lmdbench")
        for arguments, said in ((["--list", "--collect"], "excludes"), (["--points", "0", "--collect"], "excludes"),
                                (["--points", "3"], "there is no point 3"), (["--points", "x"], "no list of points")):
            done = subprocess.run([program, "work-precision", self.sweep(), "--out", str(self.folder / "s.h5"), *arguments],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(said, done.stderr)
            self.assertFalse((self.folder / "s.h5.points").exists())


class Studies(Scratch):
    """Pieces of a study, run and put together, against the study at once."""

    CASES = (["recall", "--moving", "small-blob", "--fixed", "torus", "--poses", "20", "--cutoff", "0.02", "0.05"],
             ["parts", "--poses", "3", "--kind", "ring on ring", "--kind", "block on block", "--coordinates", "exact", "rounded"],
             ["completeness", "--poses", "4", "--pair", "box:box", "cube:plate", "--far-poses", "50", "--flat-poses", "0",
              "--rounded-poses", "2", "--experiment", str(ROOT / "experiments" / "shapes.json")])

    def values(self, report):
        """Without what is of the hour."""
        if isinstance(report, dict):
            return {key: self.values(value) for key, value in report.items()
                    if key not in ("context", "pieces", "where") and not key.endswith("seconds")}
        return [self.values(value) for value in report] if isinstance(report, list) else report

    def test_pieces_are_the_whole_but_for_times(self):
        program = os.path.join(BUILD, "lmdbench-study")
        if not os.path.exists(program):
            self.skipTest("built without the programs of experiments/")
        for arguments in self.CASES:
            with self.subTest(study=arguments[0]):
                if arguments[0] != "parts":
                    arguments = [*arguments, "--meshes", str(ROOT / "meshes")]
                whole, out = str(self.folder / "whole.json"), str(self.folder / (arguments[0] + ".json"))
                alone = subprocess.run([program, *arguments, "--json", whole], capture_output=True, text=True, check=False)
                self.assertIn(alone.returncode, (0, 1), alone.stderr)
                parts, merge = pieces.pieces_of_study(program, arguments, out)
                self.assertGreater(len(parts), 1)
                os.mkdir(out + ".points")
                codes = [subprocess.run(piece.command, capture_output=True, check=False).returncode for piece in parts]
                self.assertEqual(max(codes), alone.returncode)
                self.assertEqual(pieces.pieces_of_study(program, arguments, out)[0], [], "all are done")
                done = subprocess.run(merge, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                with open(whole, encoding="utf-8") as one, open(out, encoding="utf-8") as other:
                    expected, merged = json.load(one), json.load(other)
                self.assertEqual(self.values(merged), self.values(expected))
                self.assertEqual(len(merged["pieces"]), len(parts))
                for piece in merged["pieces"]:
                    self.assertIn("node", piece["where"])

    def test_a_study_that_does_not_fall_into_pieces_is_one(self):
        program = os.path.join(BUILD, "lmdbench-study")
        if not os.path.exists(program):
            self.skipTest("built without the programs of experiments/")
        done = subprocess.run([program, "--pieces", "depth", "--frames", "7", "--json", "x.json"], capture_output=True, text=True, check=False)
        self.assertEqual(json.loads(done.stdout), [["depth", "--frames=7"]], done.stderr)


class Merging(Scratch):
    PIECE = {"context": {"build": {"git_commit": "a"}, "machine": {"load": "1"}}, "seed": 1, "pairs": [1], "wrong_poses": 2,
             "builds": {"m": 1}}

    def merge(self, *reports):
        return merge_reports.merge([(f"piece {i}", report) for i, report in enumerate(reports)])

    def test_lists_follow_each_other_and_counts_add_up(self):
        merged = self.merge(self.PIECE, {**self.PIECE, "pairs": [2, 3], "wrong_poses": 5, "builds": {"m": 9, "n": 2}, "far": [4]})
        self.assertEqual((merged["pairs"], merged["wrong_poses"], merged["far"]), ([1, 2, 3], 7, [4]))
        self.assertEqual(merged["builds"], {"m": 1, "n": 2})
        self.assertEqual(len(merged["pieces"]), 2)
        self.assertEqual(self.PIECE["pairs"], [1], "its arguments are as they were")

    def test_pieces_of_other_studies_and_builds_are_refused(self):
        with self.assertRaisesRegex(merge_reports.Unlike, "piece 1: /seed: is 2, but 1 before"):
            self.merge(self.PIECE, {**self.PIECE, "seed": 2})
        with self.assertRaisesRegex(merge_reports.Unlike, "piece 1: /context/build"):
            self.merge(self.PIECE, {**self.PIECE, "context": {"build": {"git_commit": "b"}}})

    def test_files_that_are_no_reports(self):
        good, bad = self.write("good.json", self.PIECE), self.write("bad.json", "[1]")
        for pieces_, named in (((good, bad), "bad.json"), ((good, str(self.folder / "gone.json")), "gone.json")):
            done = subprocess.run([sys.executable, str(CLUSTER / "merge_reports.py"), "--out", str(self.folder / "out.json"), *pieces_],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 3)
            self.assertIn(named, done.stderr)
            self.assertFalse((self.folder / "out.json").exists())


class SlurmThatOnlyAnswers(Scratch):
    """`scontrol` and `sbatch` are scripts of the test."""

    def setUp(self):
        super().setUp()
        self.marker = str(self.folder / "out.points" / "a.done")
        os.makedirs(os.path.dirname(self.marker))
        self.environment = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"}

    def program(self, name, text):
        self.write(f"bin/{name}", "#!/bin/sh\n" + text + "\n")
        os.chmod(self.folder / "bin" / name, 0o755)

    def call(self, script, *arguments):
        return subprocess.run([sys.executable, str(CLUSTER / "slurm" / script), *arguments], cwd=self.folder, env=self.environment,
                              capture_output=True, text=True, check=False)

    def log(self):
        return pathlib.Path(os.path.dirname(self.marker), "jobs.log").read_text()

    def submit(self):
        self.program("sbatch", f'echo "$@" >>{self.folder}/asked; echo 17')
        script = self.write("job.sh", "#!/bin/sh\n# properties = " + json.dumps(
            {"rule": "piece", "threads": 1, "output": [self.marker], "params": {"what": "points 3"},
             "resources": {"mem_mb": 500, "runtime": 60}}) + "\n")
        return self.call("submit.py", script)

    def test_submits_what_may_be_done_again_and_notes_what_it_is(self):
        done = self.submit()
        self.assertEqual((done.returncode, done.stdout), (0, "17\n"), done.stderr)
        asked = (self.folder / "asked").read_text().split()
        for option in ("--parsable", "--requeue", "--cpus-per-task"):
            self.assertIn(option, asked)
        self.assertEqual(asked[asked.index("--mem") + 1], "500")
        self.assertEqual(asked[asked.index("--time") + 1], "60")
        self.assertIn("job 17: points 3: submitted", self.log())

    def test_a_refusal_of_sbatch_is_the_workflows(self):
        self.submit()
        self.program("sbatch", "echo no partition >&2; exit 1")
        done = self.call("submit.py", str(self.folder / "job.sh"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("no partition", done.stderr)

    def says(self, scontrol):
        self.program("scontrol", scontrol)
        done = self.call("status.py", "17")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def test_states(self):
        self.submit()
        for state, said in (("COMPLETED", "success"), ("RUNNING", "running"), ("PENDING", "running"), ("COMPLETING", "running"),
                            ("REQUEUED", "running"), ("FAILED", "failed"), ("TIMEOUT", "failed"), ("NODE_FAIL", "failed"),
                            ("CANCELLED", "failed"), ("OUT_OF_MEMORY", "failed"), ("PREEMPTED", "failed"), ("", "failed")):
            self.assertEqual(self.says(f"echo JobId=17 JobState={state} Restarts=0"), said, state)

    def test_a_job_that_is_held_after_a_failed_start_has_failed_and_is_cancelled(self):
        self.submit()
        self.program("scancel", f"echo $1 >{self.folder}/cancelled")
        self.assertEqual(self.says("echo JobState=PENDING Reason=launch_failed_requeued_held Restarts=1"), "failed")
        self.assertEqual((self.folder / "cancelled").read_text(), "17\n")

    def test_a_forgotten_job_is_judged_by_what_it_left(self):
        self.submit()
        forgotten = "echo slurm_load_jobs error: Invalid job id specified >&2; exit 1"
        self.assertEqual(self.says(forgotten), "failed")
        pathlib.Path(self.marker).touch()
        self.assertEqual(self.says(forgotten), "success")
        (self.folder / ".snakemake" / "lmdbench-jobs" / "17.json").unlink()
        self.assertEqual(self.says(forgotten), "failed", "nobody knows what it had to leave")

    def test_a_controller_that_does_not_answer_is_no_failure(self):
        self.submit()
        self.assertEqual(self.says("echo Unable to contact slurm controller >&2; exit 1"), "running")

    def test_the_log_names_every_restart_once(self):
        self.submit()
        for restarts in (0, 1, 1, 2):
            self.says(f"echo JobState=RUNNING Restarts={restarts}")
        lost = [line for line in self.log().splitlines() if "lost its node" in line]
        self.assertEqual(len(lost), 2)
        self.assertIn("job 17: points 3: lost its node, done again (restart 1)", lost[0])
        self.assertIn("(restart 2)", lost[1])


class Modules(unittest.TestCase):
    def test_a_script_that_is_none_of_snakemakes_is_refused(self):
        with tempfile.NamedTemporaryFile("w", suffix=".sh") as script, self.assertRaisesRegex(SystemExit, "no properties"):
            submit.properties_of(script.name)

    def test_states_do_not_overlap(self):
        self.assertFalse(status.SUCCESS & status.RUNNING)


if __name__ == "__main__":
    BUILD = os.path.abspath(sys.argv.pop(1))
    unittest.main()
