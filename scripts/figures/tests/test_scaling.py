# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the scaling figure on synthetic studies whose times follow known power laws."""

import json
import os

import numpy as np

from cases import Scratch
import scaling
from lmdbench_results import ResultError

POSES = 30
# Exponent of time over triangles.
EXPONENTS = {"original": 0.5, "improved+reduction": 0.25, "fcl-cold": 0.125, "certified": 0.0,
             "certified sliding": 0.0625, "certified coherent": -0.25}


def point(triangles, cutoff=0.005, noise=None):
    """Every pose has a time of its own, which grows by the same power."""
    base = 1e-6 * np.linspace(1.0, 2.0, POSES)
    noise = np.ones(POSES) if noise is None else noise
    return {
        "moving": "m", "fixed": "f", "moving_triangles": triangles, "fixed_triangles": 1000, "gap": 0.002,
        "cutoff": cutoff, "lmd_counts": [1 + i % 7 for i in range(POSES)],
        "methods": {name: {"seconds": list(noise * base * triangles ** exponent), "objection": "",
                           "counters": {counter: [10 + i for i in range(POSES)] for counter in scaling.COUNTERS}}
                    for name, exponent in EXPONENTS.items()},
    }


def study(name, points):
    return {"name": name, "about": name, "points": points}


def standard_studies(factor=1):
    return [study("bunny", [point(factor * n) for n in (1000, 4000, 16000)]),
            study("cutoff", [point(16000, cutoff) for cutoff in (0.0025, 0.005, 0.02)])]


class ScalingTest(Scratch):
    def report(self, name, studies, **changes):
        return self.write(name, json.dumps({"format": scaling.FORMAT, "format_version": scaling.FORMAT_VERSION, "studies": studies, **changes}))

    def test_a_power_law_has_its_exponent_as_slope(self):
        points = [point(n) for n in (1000, 4000, 16000)]
        for method, exponent in EXPONENTS.items():
            slope, low, high = scaling.slope_with_interval(scaling.triangles(points), scaling.samples(points, method))
            # All poses grow alike, so any sample of them will do.
            np.testing.assert_allclose([slope, low, high], exponent, atol=1e-9)

    def test_the_interval_holds_the_slope_and_tells_unequal_poses(self):
        random = np.random.default_rng(3)
        points = [point(n, noise=np.exp(0.3 * random.standard_normal(POSES))) for n in (1000, 4000, 16000)]
        slope, low, high = scaling.slope_with_interval(scaling.triangles(points), scaling.samples(points, "original"))
        self.assertLess(low, slope)
        self.assertLess(slope, high)
        self.assertGreater(high - low, 0.01)
        self.assertLess(abs(slope - 0.5), 0.15)

    def test_samples_are_microseconds_a_point_and_pose(self):
        values = scaling.samples([point(10000)], "original")
        self.assertEqual(values.shape, (1, POSES))
        self.assertAlmostEqual(values[0, 0], 100.0)

    def test_a_later_file_replaces_a_study(self):
        first = self.report("first.json", standard_studies())
        second = self.report("second.json", [study("bunny", [point(7)])])
        studies = scaling.load([first, second])
        self.assertEqual([p["moving_triangles"] for p in studies["bunny"]], [7])
        self.assertEqual(len(studies["cutoff"]), 3)

    def test_other_files_are_refused(self):
        self.write("broken.json", "{")
        self.report("other.json", [], format="something-else")
        self.report("newer.json", [], format_version=scaling.FORMAT_VERSION + 1)
        for name in ("gone.json", "broken.json", "other.json", "newer.json"):
            with self.assertRaisesRegex(ResultError, f"{name}.*remedy"):
                scaling.load([self.path(name)])

    def test_a_missing_study_is_named(self):
        file = self.report("few.json", standard_studies()[:1])
        with self.assertRaisesRegex(ResultError, "'cutoff' is missing.*remedy"):
            scaling.main([file, "--out", self.path("out")])

    def test_the_figure_is_the_same_in_every_run_and_the_slopes_are_printed(self):
        file = self.report("scaling.json", standard_studies())
        for folder in ("a", "b"):
            text = self.printed(scaling.main, file, "--out", self.path(folder))
            self.assertIn("| bunny, decimated | 1000 to 16000 | original | 0.500 | 0.500 to 0.500 |", text)
            self.assertGreater(os.path.getsize(self.path(folder, "scaling.png")), 10_000)
        image = self.read("a", "scaling.svg")
        self.assertEqual(image, self.read("b", "scaling.svg"))
        for label in ("Time over cutoff", "Work counters of certified"):
            self.assertIn(label, image)
