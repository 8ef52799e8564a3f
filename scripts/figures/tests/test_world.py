#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a world, from a result made by hand."""

import os

import h5py
import numpy as np

from cases import Scratch
from figure1 import write_off
from test_figure1 import CUBE, FACES
import world
from lmdbench_results import ResultError


def write(file, instances=True, lmds=True):
    """Six boxes in two entries, three frames; in the second one LMDs of bodies 1, 1 and 5."""
    with h5py.File(file, "w") as h5:
        h5.attrs.update({"format": "lmdbench-result", "format_version": 2})
        scene = h5.create_group("scene")
        scene.create_group("moving").attrs.update({"mesh": "box", "diagonal_m": 1.0})
        for index, (first, count) in enumerate(((0, 4), (4, 2))):
            group = scene.create_group(f"fixed_{index}")
            group.attrs.update({"mesh": "box", "diagonal_m": 1.0})
            if instances:
                group.attrs["first_fixed_body"] = first
                group["position"] = np.array([[2.0 * (first + i), float(index), 0.0] for i in range(count)])
                group["orientation"] = np.tile([0.0, 0.0, 0.0, 1.0], (count, 1))
        path = h5.create_group("path")
        path["time"] = np.arange(3) / 1000.0
        path["position"] = np.array([[2.0, 1.0, 0.0], [2.5, 1.0, 0.0], [3.0, 1.0, 0.0]])
        path["orientation"] = np.tile([0.0, 0.0, 0.0, 1.0], (3, 1))
        method = h5.create_group("methods/certified")
        method["counters/pairs_touched"] = np.array([0, 2, 1])
        if lmds:
            group = method.create_group("lmds")
            group["frame_offset"] = np.array([0, 0, 3, 4])
            group["fixed_body"] = np.array([1, 1, 5, 1])
            group["point_fixed"] = np.ones((4, 3))


class WorldFigure(Scratch):
    def setUp(self):
        super().setUp()
        self.file = self.path("world.h5")
        write_off(self.path("box.off"), CUBE, FACES)

    def test_names_instances_and_finds_the_frame_of_most(self):
        write(self.file)
        with h5py.File(self.file) as file:
            found = world.World(file, "certified")
        self.assertEqual(found.count(), 6)
        self.assertEqual(found.frame_of_most(), 1)
        self.assertEqual(sorted(found.bodies(1)), [1, 1, 5])
        self.assertEqual(list(found.place(5)[1]), [10.0, 1.0, 0.0])
        self.assertEqual(list(found.counters["pairs_touched"]), [0, 2, 1])
        with self.assertRaisesRegex(ResultError, "world.h5: fixed body 6 .*remedy"):
            found.place(6)

    def test_in_a_closed_loop_the_device_of_the_method_moves(self):
        write(self.file)
        with h5py.File(self.file, "a") as file:
            file["methods/certified/path/position"] = np.full((3, 3), 7.0)
            file["methods/certified/path/orientation"] = file["path/orientation"][:]
            found = world.World(file, "certified")
        self.assertEqual(found.position[1].tolist(), [7.0, 7.0, 7.0])

    def test_places_meshes_by_their_diagonal(self):
        corners = world.Meshes(self.folder).corners("box", 2.0, np.array([5.0, 0.0, 0.0]), np.array([0.0, 0.0, 0.0, 1.0]))
        points = corners.reshape(-1, 3)
        self.assertAlmostEqual(np.linalg.norm(points.max(axis=0) - points.min(axis=0)), 2.0)
        np.testing.assert_allclose(0.5 * (points.max(axis=0) + points.min(axis=0)), [5.0, 0.0, 0.0], atol=1e-12)

    def test_draws(self):
        write(self.file)
        self.assertEqual(world.main([self.file, "--meshes", self.folder, "--out", self.folder]), 0)
        self.assertGreater(os.path.getsize(self.path("world.png")), 10_000)

    def test_says_what_is_missing(self):
        write(self.file, instances=False)
        with self.assertRaisesRegex(ResultError, "no instances"):
            world.main([self.file])
        write(self.file, lmds=False)
        with self.assertRaisesRegex(ResultError, "record/lmds"):
            world.main([self.file])
        write(self.file)
        with h5py.File(self.file, "a") as file:
            lmds = file["methods/certified/lmds"]
            lmds["frame_offset"][...] = 0
            del lmds["fixed_body"]
            lmds["fixed_body"] = np.empty(0, dtype=int)
        with self.assertRaisesRegex(ResultError, "no LMD in any frame .remedy"):
            world.main([self.file])
