#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Attribution of force jumps on sets made by hand."""

import collections
import unittest
import unittest.mock

import h5py
import numpy as np

import cases
import jumps
from lmdbench_results import ResultError
from synthetic import write_result

STEP = 1e-5
CUTOFF = 1e-3


def pair(distance, force=1.0, x=0.0):
    return jumps.Pair(distance, np.array([0.0, 0.0, force]), np.array([x, 0.0, 0.0]))


def kinds(before, after, true_before, true_after, known="a"):
    return [kind for kind, _ in jumps.events(before, after, true_before, true_after, STEP, CUTOFF, known)]


class Attribution(unittest.TestCase):
    def test_nothing_happens_to_pairs_that_live_on(self):
        self.assertEqual(kinds({"a": pair(5e-4)}, {"a": pair(4e-4)}, {"a": 0}, {"a": 0}), [])

    def test_true_births_and_deaths_are_folds_or_cross_the_cutoff(self):
        middle, edge = {"a": pair(5e-4)}, {"a": pair(CUTOFF - 0.5 * STEP)}
        self.assertEqual(kinds({}, middle, {}, middle), ["fold"])
        self.assertEqual(kinds(middle, {}, middle, {}), ["fold"])
        self.assertEqual(kinds({}, edge, {}, edge), ["cutoff"])
        self.assertEqual(kinds(edge, {}, edge, {}), ["cutoff"])

    def test_hand_over_counts_only_the_change_of_force(self):
        before, after = {"a": pair(5e-4, 1.0)}, {"b": pair(5e-4 + 0.9 * STEP, 1.01, 40 * STEP)}
        self.assertEqual(jumps.events(before, after, before, after, STEP, CUTOFF, "a")[0][0], "hand-over")
        self.assertAlmostEqual(jumps.events(before, after, before, after, STEP, CUTOFF, "a")[0][1], 0.01)

    def test_far_pair_or_other_distance_is_no_hand_over(self):
        before = {"a": pair(5e-4)}
        for after in ({"b": pair(5e-4, x=60 * STEP)}, {"b": pair(5e-4 + 2 * STEP)}):
            self.assertEqual(kinds(before, after, before, after), ["fold", "fold"])

    def test_nearest_partner_takes_the_hand_over(self):
        before = {"a": pair(5e-4)}
        after = {"far": pair(5e-4, x=30 * STEP), "near": pair(5e-4, x=STEP)}
        self.assertEqual(kinds(before, after, before, after), ["hand-over", "fold"])

    def test_what_only_the_method_does_is_its_fault(self):
        one = {"a": pair(5e-4)}
        self.assertEqual(kinds({}, one, one, one), ["age"], "it came late")
        self.assertEqual(kinds(one, {}, {}, {}), ["age"], "it stayed too long")
        self.assertEqual(kinds(one, {}, one, one), ["loss"])
        self.assertEqual(kinds({}, one, {}, {}), ["false"])
        self.assertEqual(kinds(one, {}, {}, {}, known=""), ["false"], "the reference never had it")


class Law(unittest.TestCase):
    def test_ends_and_middle(self):
        for name in ("linear", "exponential"):
            self.assertEqual(jumps.law(0.0, 1.0, 0.1, 3.0, 4.0, name), 3.0)
            self.assertEqual(jumps.law(1.0, 1.0, 0.1, 3.0, 4.0, name), 0.0)
        self.assertAlmostEqual(jumps.law(0.55, 1.0, 0.1, 3.0, 4.0, "linear"), 1.5)
        self.assertAlmostEqual(jumps.law(0.55, 1.0, 0.1, 3.0, 4.0, "exponential"), 3.0 * np.expm1(2.0) / np.expm1(4.0))


class Results(cases.Scratch):
    def test_what_has_no_direction_is_no_jump_and_is_counted(self):
        text = jumps.table({"a": collections.defaultdict(list, {"fold": [0.5, np.nan, 1.0], "loss": [np.nan]})}, 2.0, 4.0)
        self.assertIn("| 2, 0.25/s, 0.50; 1 without direction |", text)
        self.assertIn("| none; 1 without direction |", text)
        self.assertNotIn("nan", text)

    def test_the_reference_is_the_method_not_what_a_label_says(self):
        file = write_result(self.path("renamed.h5"), frames=3, methods=("improved", "certified"))
        with h5py.File(file, "a") as h5:
            h5.move("methods/certified", "methods/exact")
            h5.move("methods/improved", "methods/certified")
            h5["scene"].attrs.update({"saturation_m": 0.0, "sharpness": 4.0})
            h5["scene/moving"].attrs["diagonal_m"] = 1.0
            h5["path/position"], h5["path/orientation"] = np.zeros((3, 3)), np.tile([0.0, 0, 0, 1], (3, 1))
        found = {"improved": [{}, {"a": pair(5e-4)}, {"a": pair(5e-4)}], "certified": [{}, {}, {}]}
        with unittest.mock.patch.object(jumps, "sets_of", lambda method, *_: found[method.name]):
            result, _, _ = jumps.attribute(file)
        self.assertEqual({label: {kind: len(jump) for kind, jump in kinds.items()} for label, kinds in result.items()}, {"certified": {"false": 1}, "exact": {}})

    def test_other_scenes_are_refused(self):
        changes = {"movers": lambda h5: h5.create_group("path/movers/position"), "deforms": lambda h5: h5["scene/moving"].attrs.create("deformation", "bend"),
                   "closed loop": lambda h5: h5.create_group("methods/original/path/position"),
                   "no plain sum .shared.": lambda h5: h5["methods/original"].attrs.create("aggregation", "shared"),
                   "force profiles .stiff.": lambda h5: h5["methods/original"].attrs.create("profile", "stiff")}
        for number, (words, change) in enumerate(changes.items()):
            file = write_result(self.path(f"other{number}.h5"), frames=100)
            with h5py.File(file, "a") as h5:
                change(h5)
            with self.assertRaisesRegex(ResultError, f"other{number}.h5: has .*{words}.*remedy"):
                jumps.attribute(file)
        with self.assertRaisesRegex(ResultError, "plain.h5: /methods/certified: is missing beside original, improved .*remedy"):
            jumps.attribute(write_result(self.path("plain.h5"), frames=100))


class Travel(unittest.TestCase):
    def test_shift_and_turn_add_up(self):
        half = 0.005
        turned = [np.sin(half), 0.0, 0.0, np.cos(half)]
        way = jumps.travel(np.array([[0.0, 0, 0], [0.003, 0.004, 0]]), np.array([[0.0, 0, 0, 1], turned]), 2.0)
        self.assertAlmostEqual(way[0], 0.005 + 0.01 * 2.0)

    def test_a_point_turns_with_the_mesh(self):
        quarter = np.sqrt(0.5)
        there = jumps.turned(np.array([1.0, 2.0, 3.0]), np.array([[0.0, 0, 0, 1], [0.0, 0, quarter, quarter]]))
        np.testing.assert_allclose(there, [[1, 2, 3], [-2, 1, 3]], atol=1e-12)
