#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs on the machine's clock through the program, argument 1: what the result holds and how it is described, its page, what is refused,
and a program that is stopped or finds no room. No test rests on a tick that is in time."""

import json
import os
import resource
import signal
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "figures", "tests"))

from cases import ROOT, SharedScratch, call as call_in  # noqa: E402  (the figures' tests must be found first)
from clock_results import clocks  # noqa: E402
from lmdbench_results import Result  # noqa: E402
from realtime import run_with_a_stop  # noqa: E402

PROGRAM = None
FRAMES = 600
NO_PROBES = ("--set", '/probes={"truth": {"stride_frames": 0}, "fcl": {"stride_frames": 0}}')


def command(out, *more, seconds=None):
    return [PROGRAM, "run", "experiments/shapes.json", "--driver", "realtime", "--out", out, "--set", f"/frames={FRAMES}", "--set",
            "/driver/realtime/floor_s=0.1", "--set", '/methods/-={"name": "certified"}', *(["--set", f"/driver/realtime/seconds={seconds}"] if seconds else []), *more]


def call(arguments, **more):
    return call_in(*arguments, cwd=ROOT, **more)


def counts(clock):
    source = clock.read("frame_source")
    return [int(np.sum(source == kind)) for kind in range(3)], source.size


class Clock(SharedScratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.out = os.path.join(cls.folder, "clock.h5")
        cls.done = call(command(cls.out))
        assert cls.done.returncode == 0, cls.done.stderr

    def test_the_result_is_as_described(self):
        done = call([sys.executable, "scripts/figures/check_format.py", self.out])
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_every_frame_is_a_tick_or_a_skip(self):
        result = Result(self.out)
        self.assertEqual([clock.label for clock in clocks(result)], list(result.methods))
        for clock in clocks(result):
            (ticks, skipped, lost), frames = counts(clock)
            self.assertEqual(ticks + skipped, frames)
            self.assertEqual(lost, 0)
            self.assertEqual(result.methods[clock.label].read("force").shape, (frames, 3))
            self.assertEqual(clock.read("servo/asked").size, ticks)
            tracks = bool(result.h5[f"/methods/{clock.label}"].attrs["tracks_locally"])
            self.assertEqual("search" in clock.roles(), tracks)
            self.assertEqual(bool(clock.read("servo/age").any()), tracks)
            for series in ("servo", "response", "floor"):
                self.assertEqual(int(clock.read(f"lateness/{series}/histogram").sum()), clock.attribute("instants", f"lateness/{series}"))

            self.assertAlmostEqual(clock.skipped_per_million("servo")[0], 1e6 * skipped / frames)
            idle = sum(clock.attribute("skipped", loop) for loop in ("floor_before", "floor_after"))
            turns = sum(clock.read(f"{loop}/asked").size for loop in ("floor_before", "floor_after"))
            self.assertAlmostEqual(clock.skipped_per_million("floor")[0], 1e6 * idle / (idle + turns))

    def test_none_skipped_of_a_thousand_is_not_none_of_a_million(self):
        clock = clocks(Result(self.out))[0]
        clock.read = lambda name: np.zeros(1000)
        rate, low, high = clock.skipped_per_million("servo")
        self.assertEqual((rate, low), (0.0, 0.0))
        self.assertAlmostEqual(high, 1e6 * -np.log(0.025) / 1000, delta=1.0)

    def test_the_summary_names_lateness_and_loads(self):
        for words in ("force over empty, p99", "% of a core", "servo", "empty"):
            self.assertIn(words, self.done.stdout)
        methods = [line.split()[0] for line in self.done.stdout.splitlines() if "force over empty" in line]
        self.assertEqual(sorted(methods), sorted(Result(self.out).methods))

    def test_truth_is_compared_where_the_sets_are_known(self):
        result = Result(self.out)
        self.assertGreater(result.read("/reference/frame").size, 10)
        self.assertGreater(result.method("certified").number("recall"), 0.5)

    def test_the_page_shows_the_clock(self):
        done = call([PROGRAM, "-q", "report", self.out, "--out", self.path("page")])
        self.assertEqual(done.returncode, 0, done.stderr)
        page = self.read("page", "index.html")
        for words in ('id="clock-shapes"', "force over empty, p99", "Age of the LMD set in use", "periods without a tick"):
            self.assertIn(words, page)
        self.assertTrue(os.path.exists(self.path("page", "clock-shapes.svg")))

    def test_fewer_cores_than_roles_are_shared(self):
        for cores, pin in ((1, "true"), (2, "true"), (1, "false")):
            out = self.path(f"cores-{cores}-{pin}.h5")
            done = call(command(out, *NO_PROBES, "--set", f"/driver/realtime/cores={cores}", "--set", f"/driver/realtime/pin={pin}", "--set", "/driver/prediction=linear"))
            self.assertEqual(done.returncode, 0, done.stderr)
            for clock in clocks(Result(out)):
                used = {role: int(clock.attribute("core", role)) for role in clock.roles()}
                if pin == "false":
                    self.assertEqual(set(used.values()), {-1})
                    continue
                self.assertLessEqual(len(set(used.values())), cores)
                self.assertNotIn(-1, used.values())
                if "tracking" in used:
                    self.assertEqual(used["tracking"], used["servo"], "as the paper found that they can")
                for role in clock.roles():
                    self.assertGreater(clock.attribute("turns", role), 0, role)

    def test_a_device_calls_the_loop(self):
        out = self.path("callback.h5")
        done = call(command(out, *NO_PROBES, "--set", "/driver/realtime/servo=callback", "--set", "/driver/realtime/callback_rate_hz=400"))
        self.assertEqual(done.returncode, 0, done.stderr)
        for clock in clocks(Result(out)):
            (ticks, skipped, _), frames = counts(clock)
            self.assertEqual(ticks + skipped, frames)
            self.assertLess(ticks, 0.45 * frames)
            self.assertGreater(ticks, 10)

    def test_json_has_the_clock(self):
        done = call([*command(self.path("json.h5"), *NO_PROBES), "--json"])
        told = json.loads(done.stdout)["realtime"]
        self.assertEqual([clock["label"] for clock in told], list(Result(self.path("json.h5")).methods))
        for clock in told:
            self.assertEqual([len(rows) for rows in clock["lateness"].values()], [5] * 5)
            self.assertEqual(clock["roles"][0]["name"], "servo")

    def test_what_cannot_be_is_refused(self):
        for arguments, code, words in (
                ([*command(self.path("other.h5")), "--resume"], 2, "cannot be taken up again"),
                ([PROGRAM, "run", "experiments/shapes.json", "--driver", "sundial"], 2, "/driver/kind"),
                ([PROGRAM, "compare", self.out, self.out], 2, "no two of which are the same"),
                (command(self.path("other.h5"), "--set", "/driver/realtime/priority=99"), 2, "/driver/realtime/priority")):
            done = call(arguments)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(words, done.stderr)

    def test_the_plan_says_which_threads(self):
        plan = json.loads(call([PROGRAM, "plan", "experiments/shapes.json", "--json", "--set", "/driver/kind=realtime"]).stdout)
        self.assertIn("threads", [item["part"] for item in plan["needed"]])

    def test_a_stopped_program_loses_ticks_and_counts_them(self):
        out = self.path("stopped.h5")
        run_with_a_stop(command(out, "--set", '/methods=[{"name": "improved"}]', *NO_PROBES, seconds=4), out, 500, 0.4, cwd=ROOT)
        clock = clocks(Result(out))[0]
        (ticks, skipped, lost), frames = counts(clock)
        self.assertEqual(ticks + skipped + lost, frames)
        self.assertGreater(skipped, 300)
        frame = clock.read("servo/frame")
        self.assertTrue(np.all(np.diff(frame) > 0), "no burst after it")
        self.assertGreater(np.diff(frame).max(), 300)

    def test_without_room_nothing_takes_the_results_name(self):
        out = self.path("full.h5")
        most_bytes = os.path.getsize(self.out) // 4

        def full_disk():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (most_bytes, most_bytes))

        done = call(command(out, *NO_PROBES), preexec_fn=full_disk)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertFalse(os.path.exists(out))


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
