#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Measures, tables and figure of the rivals, on numbers made by hand."""

import argparse
import json
import os

import numpy as np

from cases import Scratch, text_of
import rivals


def rows_by_hand():
    labels = [rivals.SHARED, *(label for label, *_ in rivals.OURS + rivals.RIVALS)]
    rows = {label: {"promise": "force-only" if label in ("points", "proxy") else "approximation", "own": label == "gcp", "ms": np.nan if label == "improved" else 0.01 * 2.0**i,
                    "path ms": 0.0625 if label in ("certified", "improved") else np.nan, "shared": 0.1 * i, "sum": 0.5, "recall": np.nan if label == "proxy" else 0.25, "precision": 0.125,
                    "steps": [0.5, 0.05, 0.0]} for i, label in enumerate(labels)}
    return {"bunny-hard": rows, "gears": rows}


class Played:
    """A result: a still scene with one force step, each method's numbers told by how it was run."""

    def __init__(self, labels, frames, number):
        self.frames = frames
        self.experiment = {"methods": [{"label": label} for label in labels]}
        self.methods = {label: self.Method(label, frames, number) for label in labels}
        self.method = self.methods.get

    class Method:
        def __init__(self, label, frames, number):
            self.promise, self.frames, self.value = "force-only" if label == "proxy" else "complete-set", frames, number

        def number(self, name):
            return self.value / 1e3 if name == "frame_time_median_s" else self.value / 100 if name == "recall" else self.value / 10

        def read(self, name):
            force = np.zeros((self.frames, 3))
            force[self.frames // 2:, 0] = 1.0
            return force if name == "force" else np.ones(self.frames)

    def read(self, name):
        return np.tile([0.0, 0, 0, 1], (self.frames, 1))[:, -3 if name == "/path/position" else 0:]

    def in_contact(self):
        return np.ones(self.frames, bool)

    def maximum_force(self):
        return 1.0

    def scene(self, name):
        return 1000.0


class PlayedScene(rivals.Scene):
    NUMBERS = {("path", "sum"): 1.0, ("path", "shared"): 2.0, ("poses", "sum"): 3.0, ("poses", "shared"): 4.0}

    def run(self, what, methods, law, path=None, repetitions=1, truth=0):
        frames = len(text_of(path).splitlines()) if path else 20
        self.probed = {**getattr(self, "probed", {}), (what, law): truth}
        return Played([entry["label"] for entry in methods], frames, self.NUMBERS.get((what, law), 0.0))


class Measures(Scratch):
    def test_what_is_compared_is_of_the_same_poses_and_measured(self):
        arguments = argparse.Namespace(out=self.folder, poses=10, stretch=1)
        scene = PlayedScene(arguments, "gears")
        rows = scene.rows()
        for label, ms in ((rivals.SHARED, 4.0), ("certified", 3.0), ("barrier", 3.0)):
            self.assertEqual((rows[label]["ms"], rows[label]["recall"], rows[label]["precision"]), (ms, ms / 100, ms / 10), label)
        for label, ms in ((rivals.SHARED, 2.0), ("certified", 1.0), ("improved", 1.0)):
            self.assertEqual(rows[label]["path ms"], ms, label)
        self.assertTrue(np.isnan([rows["improved"]["ms"], rows["improved"]["recall"], rows["proxy"]["recall"], rows["barrier"]["path ms"]]).all())
        self.assertEqual((scene.probed["poses", "sum"], scene.probed["poses", "shared"]), (1, 1))

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
        start = np.tile([[7.0, 0, 0]], (rivals.REST, 1))  # before a first search is back
        np.testing.assert_allclose(rivals.largest_steps(np.concatenate([start, line])), [0.25, 0.025, 0.0025])
        np.testing.assert_allclose(rivals.largest_steps(np.concatenate([start, jump])), [1.0, 1.0, 1.0])

    def test_a_path_is_subdivided_evenly(self):
        half = np.sqrt(0.5)
        position = np.array([[0.0, 0, 0], [1.0, 0, 0], [1.0, 2.0, 0]])
        orientation = np.array([[0, 0, 0, 1.0], [0, 0, -half, -half], [0, 0, half, half]])  # 2 is 3 negated
        places, turns = rivals.subdivided(position, orientation, 10)
        for of, first in ((places, position[0]), (turns, orientation[0])):
            np.testing.assert_allclose(of[:rivals.REST], np.tile(first, (rivals.REST, 1)))
        places, turns = places[rivals.REST:], turns[rivals.REST:]
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
        self.assertIn("| certified | approximation | 0.02 (0.0625) |", text)
        self.assertIn("| improved | approximation | - (0.0625) |", text)
        for line in text.splitlines():
            self.assertLessEqual(line.count("|"), 8, "at most seven columns")
        rivals.draw(rows, self.folder)
        self.assertGreater(os.path.getsize(self.path("rivals.png")), 10_000)

    def test_scenes_and_rivals_are_there(self):
        for file in rivals.SCENES.values():
            self.assertIn('"methods"', text_of(file))
            self.assertGreaterEqual(rivals.REST, 2 * json.loads(text_of(file))["driver"]["search_every_frames"], file)
        build = text_of("experiments", "rivals", "CMakeLists.txt")
        for _, entry, *_ in rivals.RIVALS:
            self.assertIn(entry["name"], build)
            code = text_of("experiments", "rivals", f"{entry['name']}.cpp")
            for word in {*entry, *entry.values()} - {"name"}:
                if isinstance(word, str):
                    self.assertIn(f'"{word}"', code)
