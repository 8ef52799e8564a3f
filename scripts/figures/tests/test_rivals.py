#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Measures, tables and figure of the rivals, on numbers made by hand."""

import os

import numpy as np

from cases import Scratch, text_of
import rivals


def rows_by_hand():
    labels = [rivals.SHARED, *(label for label, *_ in rivals.OURS + rivals.RIVALS)]
    rows = {label: {"promise": "force-only" if label in ("points", "proxy") else "approximation", "own": label == "gcp", "ms": 0.01 * 2.0**i,
                    "shared": 0.1 * i, "sum": 0.5, "recall": np.nan if label == "proxy" else 0.25, "precision": 0.125,
                    "steps": [0.5, 0.05, 0.0]} for i, label in enumerate(labels)}
    return {"bunny-hard": rows, "gears": rows}


class Measures(Scratch):
    def test_a_force_of_its_own_gets_the_factor_that_suits_it_best(self):
        truth = np.array([[1.0, 0, 0], [0, 2.0, 0], [0, 0, 0]])
        error, factor = rivals.scaled_error(50.0 * truth, truth)
        self.assertAlmostEqual(error, 0.0)
        self.assertAlmostEqual(factor, 0.02)
        error, factor = rivals.scaled_error(-truth, truth)
        self.assertEqual(factor, 0.0)
        self.assertAlmostEqual(error, np.sqrt(5.0 / 3.0))
        self.assertEqual(rivals.scaled_error(0.0 * truth, truth)[1], 0.0)
        for other in (0.9, 1.1):
            forces = truth + np.array([[0.1, 0.2, -0.1]])
            best, factor = rivals.scaled_error(forces, truth)
            self.assertLess(best, rivals.rms(other * factor * forces - truth))

    def test_steps_shrink_with_the_path_or_do_not(self):
        share = np.arange(401) / 400.0
        line, jump = np.zeros((401, 3)), np.zeros((401, 3))
        line[:, 0], jump[:, 0] = share, share > 0.523
        np.testing.assert_allclose(rivals.largest_steps(line), [0.25, 0.025, 0.0025])
        np.testing.assert_allclose(rivals.largest_steps(jump), [1.0, 1.0, 1.0])

    def test_a_path_is_subdivided_evenly(self):
        half = np.sqrt(0.5)
        position = np.array([[0.0, 0, 0], [1.0, 0, 0], [1.0, 2.0, 0]])
        orientation = np.array([[0, 0, 0, 1.0], [0, 0, -half, -half], [0, 0, half, half]])  # 2 is 3 negated
        places, turns = rivals.subdivided(position, orientation, 10)
        self.assertEqual(len(places), 21)
        np.testing.assert_allclose(places[[0, 5, 10, 15, 20]], [[0, 0, 0], [0.5, 0, 0], [1, 0, 0], [1, 1, 0], [1, 2, 0]])
        np.testing.assert_allclose(np.linalg.norm(turns, axis=1), 1.0)
        angles = 2.0 * np.arctan2(np.abs(turns[:11, 2]), np.abs(turns[:11, 3]))
        np.testing.assert_allclose(angles, np.linspace(0, np.pi / 2, 11), atol=1e-12)

    def test_tables_and_figure(self):
        rows = rows_by_hand()
        loops = {label: dict.fromkeys(rivals.CLOSED_LOOPS, "no contact") for label in next(iter(rows.values()))}
        text = rivals.tables(rows, loops)
        self.assertIn("| proxy | no contact | no contact |", text)
        self.assertIn("| gcp (own force) | approximation |", text)
        self.assertIn("| proxy | 0.5, 0.05, 0 | 0.5, 0.05, 0 |", text)
        row = next(line for line in text.splitlines() if line.startswith("| proxy | force-only"))
        self.assertEqual(row.split(" | ")[5], "-")
        for line in text.splitlines():
            self.assertLessEqual(line.count("|"), 8, "at most seven columns")
        rivals.draw(rows, self.folder)
        self.assertGreater(os.path.getsize(self.path("rivals.png")), 10_000)

    def test_scenes_and_rivals_are_there(self):
        for file in rivals.SCENES.values():
            self.assertIn('"methods"', text_of(file))
        build = text_of("experiments", "rivals", "CMakeLists.txt")
        for _, entry, *_ in rivals.RIVALS:
            self.assertIn(entry["name"], build)
            self.assertIn(f'"{entry["name"]}"', text_of("experiments", "rivals", f"{entry['name']}.cpp"))
