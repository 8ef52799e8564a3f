# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program on a small scene of its own and lets every script of scripts/figures read what it left: the result
has the format that results/README.md describes, and holds what the scripts need. Argument: the program."""

import json
import math
import os
import sys
import unittest
from pathlib import Path

TESTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
sys.path[:0] = [os.path.join(TESTS, "..", "scripts", "figures", "tests"), os.path.join(TESTS, "cli")]

from cases import ROOT, SharedScratch, call, text_of  # noqa: E402  (the folders must be found first)
import check_format  # noqa: E402
import claims  # noqa: E402
import figure7  # noqa: E402
import numpy as np  # noqa: E402
import summary  # noqa: E402
import work_precision  # noqa: E402
from init_pairs_test import grid_sphere, write_off  # noqa: E402
from lmdbench_results import Result, truth_of  # noqa: E402

PROGRAM = None


def bumpy_sphere():
    """Closed, of radius 1 m with bumps of 5 %."""
    return grid_sphere(12, 24, lambda x, y, z: 1.0 + 0.05 * math.cos(5 * math.acos(max(-1.0, min(1.0, z)))) * math.cos(4 * math.atan2(y, x)))


def write_path(file):
    """From free space to a gap of a few millimetres, turning, within 0.3 s."""
    with open(file, "w", encoding="utf-8") as stream:
        for i in range(31):
            turn = 0.01 * i
            height = 2.6 - 0.58 * min(1.0, i / 15)
            stream.write(f"{0.01 * i!r} 0 0 {height!r} 0 0 {math.sin(turn / 2)!r} {math.cos(turn / 2)!r}\n")


def profiles(*cutoffs):
    """Force profiles: one is an object, several are a list in which each has a name."""
    if len(cutoffs) == 1:
        return {"cutoff_m": cutoffs[0], "maximum_force_n": 2.0}
    return [{"name": f"to-{cutoff}", "cutoff_m": cutoff, "maximum_force_n": 2.0} for cutoff in cutoffs]


def experiment(name, cutoffs, everything):
    return {
        "name": name,
        "title": "two bumpy spheres",
        "moving": {"mesh": "sphere.off"},
        "fixed": [{"mesh": "sphere.off"}],
        "path": {"file": "path.tum"},
        "force": profiles(*cutoffs),
        "methods": [
            {"name": "original", "force_law": "linear"},
            {"name": "improved", "force_law": "exponential"},
            {"name": "improved", "label": "improved-loss-free", "force_law": "exponential", "reduction": "loss-free"},
            {"name": "certified", "force_law": "exponential"},
        ],
        "driver": {"repetitions": 3, "search_every_frames": 20, "search_latency_frames": 5},
        "probes": {"truth": {"stride_frames": 10}, "fcl": {"stride_frames": 50}},
        "record": {"lmds": everything, "torque": everything, "polylines": {"stride_frames": 10 if everything else 0}},
    }


class RealResultTest(SharedScratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        write_off(cls.at("sphere.off"), bumpy_sphere())
        write_path(cls.at("path.tum"))
        cls.hard = cls.run_program("hard", [0.2], True)
        cls.soft = cls.run_program("soft", [0.4], False)
        cls.both = cls.run_program("both", [0.2, 0.4], False)

    @classmethod
    def at(cls, name):
        return os.path.join(cls.folder, name)

    @classmethod
    def run_program(cls, name, cutoffs, everything):
        Path(cls.at(name + ".json")).write_text(json.dumps(experiment(name, cutoffs, everything)), encoding="utf-8")
        return cls.result_of(cls.at(name + ".json"), cls.at(name + ".h5"))

    @classmethod
    def result_of(cls, experiment, result, *options):
        done = call(PROGRAM, "run", experiment, "--out", result, *options)
        if done.returncode != 0:
            raise AssertionError(f"lmdbench run left with {done.returncode}:\n{done.stderr}")
        return result

    @classmethod
    def committed(cls, experiment, *options):
        """A short run of a committed experiment, for datasets that the spheres have no use for. Runs once."""
        result = cls.at(f"{experiment}-{hash(options)}.h5")
        return result if os.path.exists(result) else cls.result_of(ROOT / "experiments" / f"{experiment}.json", result, *options)

    @classmethod
    def special(cls):
        """Closed loops without and with torque, real time, LMDs without an index, meshes that deform, several that move, instances, a plugin."""
        return [cls.committed("wall", "--set", "/frames=20", "--set", "/probes/truth/stride_frames=5"),
                cls.committed("wall-6dof", "--set", "/frames=20"),
                cls.committed("shapes", "--driver", "realtime", "--set", "/frames=100"),
                cls.committed("shapes", "--set", "/frames=20", "--set", '/methods=[{"name": "certified"}]',
                              "--set", "/force/aggregation=shared"),
                cls.committed("deforming", "--set", "/frames=20"),
                cls.committed("shapes", "--set", "/frames=20", "--set", '/methods=[{"name": "good"}]', "--plugin",
                              os.path.join(os.path.dirname(PROGRAM), "tests", "plugin", "good.so")),
                cls.committed("shapes", "--set", "/frames=20", "--set", '/methods=[{"name": "certified"}]',
                              "--set", '/fixed/0/instances={"rule": "grid", "counts": [2, 1, 1], "spacing_diagonals": 1.5}'),
                cls.committed("movers", "--set", "/frames=60", "--set", "/driver/repetitions=2",
                              "--set", "/record/polylines/stride_frames=10")]

    def test_results_have_the_described_format(self):
        text = self.printed(check_format.main, self.hard, self.soft, self.both, *self.special())
        self.assertIn(" 0 differences", text)

    def test_everything_described_is_there(self):
        described = set(check_format.described(text_of(check_format.README)))
        found = set()
        for file in (self.hard, self.both, *self.special()):
            Result(file).h5.visit(lambda name: found.add(check_format.documented_path("/" + name)))
        self.assertEqual(described - found, set())

    def test_the_exact_method_agrees_with_truth_that_another_code_found(self):
        for file in (self.hard, self.soft):
            method = Result(file).method("certified")
            self.assertGreater(truth_of(method).true_count.max(), 0)
            for name in ("recall", "recall_adjacent", "precision", "precision_adjacent"):
                self.assertEqual(method.number(name), 1.0, name)
            self.assertEqual(method.number("frames_wrong"), 0.0)
            self.assertEqual(method.number("force_error_maximum_n"), 0.0)

    def test_the_summary_is_that_of_the_raw_samples(self):
        """The definitions of results/README.md, computed anew from the evidence."""
        for result in (Result(self.hard), Result(self.soft)):
            contact = result.in_contact()
            self.assertTrue(0 < contact.sum() < contact.size)
            self.assertEqual(result.number("frames_in_contact"), contact.sum())
            distance = np.fmin.reduce([method.read("minimum_distance") for method in result.methods.values()])
            self.assertTrue(np.all(contact[np.isfinite(distance)]), "a method's LMD means contact")
            frames, true_count = result.read("/reference/frame"), result.read("/reference/lmd_count")
            self.assertEqual(result.number("frames_probed"), frames.size)
            self.assertGreaterEqual(frames.min(), 5, "from the first arrival of a search on")
            np.testing.assert_array_equal(true_count > 0, contact[frames])
            for method in result.methods.values():
                self.check_summary(result, method, contact, frames, true_count)

    def check_summary(self, result, method, contact, frames, true_count):
        def same(name, expected):
            np.testing.assert_allclose(method.number(name), expected, rtol=1e-12, err_msg=f"{method.label}: {name}")

        for share, counts in (("recall", true_count), ("precision", method.read("lmd_count")[frames])):
            for name in (share, share + "_adjacent"):
                parts = method.read("truth/" + name)
                same(name, np.nansum(parts * counts) / counts[~np.isnan(parts)].sum())
        judged = contact[frames] & (result.read("/reference/contact_without_direction") == 0)
        errors = method.read("truth/force_error")[judged]
        same("force_error_rms_n", np.sqrt(np.mean(errors**2)))
        same("force_error_median_n", np.median(errors))
        same("force_error_p99_n", np.quantile(errors, 0.99))
        jumps = np.linalg.norm(np.diff(method.read("force"), axis=0), axis=1) > 0.25 * result.maximum_force()
        same("jumps", jumps.sum())
        rate = jumps.sum() / (contact.sum() / result.scene("frame_rate_hz"))
        same("jumps_per_second", rate if jumps.sum() >= 10 else np.nan)
        if method.promise == "complete-set":
            same("true_jumps", jumps.sum())  # own sets are the truth of every frame
        if method.reduces:
            same("reduction_ratio", method.read("candidates").sum() / method.read("kept_after_reduction").sum())
        local = np.median(method.times("local_update_time"), axis=0)[contact]
        same("local_update_median_s", np.median(local))
        same("local_update_p99_s", np.quantile(local, 0.99))

    def test_times_and_forces_are_numbers(self):
        result = Result(self.hard)
        self.assertEqual(result.warm_up_repetitions, 1)
        for method in result.methods.values():
            self.assertTrue(np.all(np.isfinite(method.read("force"))))
            times = method.times("local_update_time")
            self.assertEqual(times.shape, (2, result.time.size))
            self.assertTrue(np.all(times >= 0))

    def test_recipes_tell_the_programs_numbers(self):
        def told(recipe, label):
            done = call(sys.executable, ROOT / "results" / "examples" / recipe, self.hard)
            (line,) = [line for line in done.stdout.splitlines() if line.startswith(label + ":")]
            return line

        for label, method in Result(self.hard).methods.items():
            median, p99 = (1e6 * method.number(f"local_update_{name}_s") for name in ("median", "p99"))
            self.assertEqual(told("times.py", label), f"{label}: median {median:.3g} us, 99 % {p99:.3g} us")
            self.assertIn(f"{label}: {method.number('force_error_maximum_n'):.3g} N at ", told("worst_frames.py", label))
            self.assertIn(f"largest {method.number('rendered_force_maximum_n'):.3g} N", told("forces.py", label))

    def test_flipped_bytes_are_refused(self):
        damaged = self.path("damaged.h5")
        content = bytearray(Path(self.hard).read_bytes())
        for place in range(1000, len(content), len(content) // 400):
            content[place] ^= 1
        Path(damaged).write_bytes(content)
        for words in (["compare", self.hard, damaged], ["export", damaged, "--out", self.path("view")]):
            done = call(PROGRAM, *words)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("damaged.h5", done.stderr)
            self.assertIn("remedy", done.stderr)

    def test_scripts_read_them(self):
        out = self.path("figures")
        self.printed(figure7.main, self.hard, self.soft, "--out", out)
        self.printed(work_precision.main, self.hard, self.soft, "--out", out)
        self.assertIn("K10:", self.printed(claims.main, self.hard, self.soft, "--out", out))
        self.assertIn("improved-loss-free", self.printed(summary.main, self.hard, self.soft))
        self.assertEqual(sorted(os.listdir(out)), ["claims.md", "figure7.png", "figure7.svg", "work_precision.png", "work_precision.svg"])


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
