# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fifty points of a sweep on a real Slurm, whose slurmd and steps are killed in the middle, against the same sweep run at once.
Arguments: the build tree. Leaves with 77, which ctest takes for skipped, where no Slurm can be had."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np

import slurm_cluster

BUILD = os.path.abspath(sys.argv.pop(1))
ROOT = pathlib.Path(__file__).resolve().parents[2]
CLUSTER = ROOT / "scripts" / "cluster"
SKIPPED = 77
POINTS, REPETITIONS = 50, 2
# Fields that depend on times or on the machine; all others must have the same bits.
TIMED = {"processor_share", "search_share", "frames_late", "on_front", "where", "begun"}


def is_timed(name, dataset):
    unit = dataset.attrs.get("units", b"")
    unit = unit.decode() if isinstance(unit, bytes) else unit
    return name.split("/")[-1] in TIMED or (unit == "s" and not name.endswith("seconds_in_contact"))


def untimed(file):
    """Bytes of every dataset that must not depend on who measured it."""
    found = {}

    def visit(name, thing):
        if isinstance(thing, h5py.Dataset) and not name.startswith("provenance") and not is_timed(name, thing):
            value = thing[()]
            found[name] = value.tolist() if value.dtype.kind == "O" else value.tobytes()

    file.visititems(visit)
    return found


class Slurm(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="lmdbench-slurm-")))
        self.folder.chmod(0o755)
        (self.folder / "slurm").mkdir()
        self.work = self.folder / "work"
        self.work.mkdir()
        every = list(range(1, 26))
        self.sweep = self.work / "sweep.json"
        self.sweep.write_text(json.dumps({
            "name": "fifty", "title": "fifty points", "experiments": [str(ROOT / "experiments" / "shapes.json")],
            "repetitions": REPETITIONS, "truth_check_frames": 4, "set": {"/frames": 1500},
            "series": [{"method": {"name": name}, "axes": [{"/driver/search_every_frames": every,
                                                           "/driver/search_latency_frames": every}]}
                       for name in ("original", "improved")]}))

    def snakemake(self, environment, profile, *arguments):
        return ["snakemake", "--snakefile", str(CLUSTER / "Snakefile"), "--profile", str(CLUSTER / profile), "--nocolor",
                "--config", f"build={BUILD}", *arguments]

    def journal_lines(self):
        lines = []
        for part in sorted(self.work.glob("out.h5.points/*.jsonl")):
            for line in part.read_text().splitlines():
                try:
                    lines.append(json.loads(line))
                except ValueError:
                    continue  # the kill cut it off
        return lines

    def points_done(self):
        done = {}
        for line in self.journal_lines():
            if "key" in line:
                done.setdefault(line["key"], set()).add(line["repetition"])
        return sum(len(repetitions) == REPETITIONS for repetitions in done.values())

    def working_jobs(self, cluster):
        """Steps of this cluster whose job measures at this moment, each with the processes below it."""
        steps = [process for process in cluster.ours() if cluster.name_of(process).startswith("slurmstepd")]
        below = {step: cluster.descendants(step) for step in steps}
        return {step: processes for step, processes in below.items()
                if any(cluster.name_of(process) == "lmdbench" for process in processes)}

    def jobs_in_the_middle(self):
        """Jobs that have begun what they have not measured yet."""
        begun, measured = {}, set()
        for line in self.journal_lines():
            if "began" in line:
                begun[line["began"], line["repetition"]] = line["where"]["job"]
            elif "key" in line:
                measured.add((line["key"], line["repetition"]))
        return {job for place, job in begun.items() if place not in measured}

    def kill_the_node(self, cluster):
        """As a node fails: slurmd and every step. The processes of a job in the middle of a point die with it; another's, if there is
        one, live on for a while and nobody looks after them.
        @return how many jobs measured"""
        dying = None
        end = time.monotonic() + 120
        while dying is None:
            self.assertLess(time.monotonic(), end, "no job measures")
            jobs = self.working_jobs(cluster)
            if len(jobs) < 2 and time.monotonic() < end - 60:
                continue
            # The processes are stopped, so that none ends its point between the look and the kill.
            for process in (process for processes in jobs.values() for process in processes):
                cluster.kill(process, signal.SIGSTOP)
            middle = self.jobs_in_the_middle()
            dying = next((step for step, processes in jobs.items() if any(cluster.job_of(process) in middle for process in processes)), None)
            if dying is None:
                for process in (process for processes in jobs.values() for process in processes):
                    cluster.kill(process, signal.SIGCONT)
        daemon = cluster.processes.pop("slurmd")
        cluster.kill(daemon.pid)
        daemon.wait()
        for step, processes in jobs.items():
            cluster.kill(step)
            for process in processes:
                cluster.kill(process, signal.SIGKILL if step == dying else signal.SIGCONT)
        for process in cluster.ours():
            if cluster.name_of(process).startswith("slurmstepd"):
                cluster.kill(process)
        return len(jobs)

    def test_fifty_points_with_a_node_that_fails(self):
        with slurm_cluster.Cluster(self.folder / "slurm", processors=2) as cluster:
            started = time.monotonic()
            with open(self.folder / "snakemake.log", "w+", encoding="utf-8") as log:
                run = subprocess.Popen(self.snakemake(cluster.environment, "slurm", "sweep=sweep.json", "out=out.h5"),
                                       cwd=self.work, env=cluster.environment, stdout=log, stderr=log, text=True)
                try:
                    slurm_cluster.wait_for(lambda: self.points_done() >= POINTS // 3 or run.poll() is not None, 600, "a third of the points")
                    self.assertIsNone(run.poll(), "ended before the kill")
                    before = self.points_done()
                    killed = self.kill_the_node(cluster)
                    time.sleep(12)  # longer than SlurmdTimeout
                    cluster.start_node()
                    code = run.wait(900)
                finally:
                    if run.poll() is None:
                        run.kill()
                        run.wait()
                log.seek(0)
                said = log.read()
            if code != 0 or os.environ.get("LMDBENCH_SLURM_LOGS"):
                for name in ("jobs.log", "slurmctld.log", "slurmd.log"):
                    for file in self.folder.rglob(name):
                        sys.stderr.write(f"== {name}\n{file.read_text()[-6000:]}\n")
            self.assertEqual(code, 0, said[-6000:])
            took = time.monotonic() - started
        self.assertGreaterEqual(before, POINTS // 3)
        self.assertLess(before, POINTS)

        lines = self.journal_lines()
        begun, measured = {}, {}
        for line in lines:
            if "began" in line:
                begun.setdefault((line["began"], line["repetition"]), []).append(line["where"])
            elif "key" in line:
                measured.setdefault((line["key"], line["repetition"]), []).append(line)
        self.assertEqual(len(measured), POINTS * REPETITIONS, "fifty of fifty")
        again = {place: wheres for place, wheres in begun.items() if len(wheres) > 1}
        self.assertGreaterEqual(len(again), 1, "the point that was killed was begun twice")
        for place, entries in measured.items():
            self.assertLessEqual(len(entries), len(begun[place]), "no measurement without its mark")
            self.assertEqual(len(entries), 1, f"{place} was measured twice")
            where = entries[0]["where"]
            self.assertEqual(where["node"], slurm_cluster.socket.gethostname().split(".")[0])
            self.assertIn("neighbours", where)
            self.assertIn("exclusive", where)
            self.assertGreater(where["job"], 0)

        # The log names what was done again: the program's points, and Slurm's restarts by job.
        told = [line for line in said.splitlines() if "done again: point" in line]
        self.assertEqual(len(told), len(again), said[-3000:])
        jobs_log = (self.work / "out.h5.points" / "jobs.log").read_text()
        self.assertIn("lost its node, done again (restart 1)", jobs_log)
        restarted = {where["job"] for wheres in again.values() for where in wheres if where["restarts"] > 0}
        for job in restarted:
            self.assertRegex(jobs_log, rf"job {job}: points \d+: lost its node")

        local = subprocess.run([os.path.join(BUILD, "lmdbench"), "-q", "work-precision", "sweep.json", "--out", "local.h5"], cwd=self.work,
                               capture_output=True, text=True, timeout=900, check=False)
        self.assertEqual(local.returncode, 0, local.stderr)
        with h5py.File(self.work / "out.h5") as merged, h5py.File(self.work / "local.h5") as alone:
            ours, theirs = untimed(merged), untimed(alone)
            self.assertEqual(sorted(ours), sorted(theirs))
            self.assertGreater(len(ours), 50)
            for name in ours:
                self.assertEqual(ours[name], theirs[name], name)
            self.assertEqual(merged["points/failure"].shape, (POINTS,))
            extra = merged["points/begun"][()] - REPETITIONS
            self.assertEqual(int(np.sum(extra)), sum(len(wheres) - 1 for wheres in again.values()))
            np.testing.assert_array_equal(alone["points/begun"][()], REPETITIONS)
        print(f"{POINTS} points in {took:.0f} s; {before} were done when the node failed with {killed} jobs at work; "
              f"{len(again)} traversals were begun again, in jobs {sorted(restarted)}", file=sys.stderr)

        # Everything is done: a second call measures nothing.
        with slurm_cluster.Cluster(self.fresh("slurm"), processors=2) as cluster:
            size = sum(part.stat().st_size for part in self.work.glob("out.h5.points/*.jsonl"))
            done = subprocess.run(self.snakemake(cluster.environment, "slurm", "sweep=sweep.json", "out=out.h5"), cwd=self.work,
                                  env=cluster.environment, capture_output=True, text=True, timeout=300, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(sum(part.stat().st_size for part in self.work.glob("out.h5.points/*.jsonl")), size)

    def fresh(self, name):
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        return folder


if __name__ == "__main__":
    reason = slurm_cluster.why_not() or (None if shutil.which("snakemake") else "snakemake is not installed")
    if reason:
        print(f"skipped: {reason}", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
