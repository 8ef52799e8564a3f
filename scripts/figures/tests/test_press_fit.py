#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The figure of the press-fit, of a result made by hand."""

import json
import os
from types import SimpleNamespace

import h5py
import numpy as np

from cases import ROOT, Scratch
from test_figure1 import CUBE, FACES
import press_fit
from lmdbench_results import ResultError

EXPERIMENT = ROOT / "experiments" / "press-fit.json"
FRAMES = 60


def write(file, lmds=True):
    """A pin that goes straight down into a clip on a belt that stands; one contact, from the tenth frame on."""
    with h5py.File(file, "w") as h5:
        h5.attrs.update({"format": "lmdbench-result", "format_version": 2})
        h5["provenance/experiment"] = [EXPERIMENT.read_text(encoding="utf-8")]
        h5["path/time"] = np.arange(FRAMES) / 50.0
        movers = np.zeros((FRAMES, 2, 3))
        h5["path/movers/position"] = movers
        scene = h5.create_group("scene")
        scene.attrs["cutoff_m"] = 0.001
        scene["fixed_0/position"] = np.full((4, 3), 0.1)
        scene.create_group("mover_0").attrs["first_mover"] = 1
        for label, aggregation in (("certified-plain-sum", "sum"), ("certified-shared", "shared")):
            method = h5.create_group(f"methods/{label}")
            method.attrs.update({"method": "certified", "aggregation": aggregation, "method_order": 2, "tracks_locally": 0,
                                 "trackings_after_search": 0})
            method["path/position"] = np.column_stack([np.zeros(FRAMES), np.zeros(FRAMES), np.linspace(0.012, 0.0005, FRAMES)])
            method["path/orientation"] = np.tile([0.0, 0.0, 0.0, 1.0], (FRAMES, 1))
            method["force"] = np.column_stack([np.zeros((FRAMES, 2)), np.sin(np.linspace(0.0, 6.0, FRAMES))])
            if lmds:
                count = FRAMES - 10
                method["lmds/frame_offset"] = np.concatenate([np.zeros(10, int), np.arange(count + 1)])
                method["lmds/moving_body"] = np.zeros(count, int)
                method["lmds/fixed_body"] = np.full(count, 5)
                method["lmds/distance"] = np.full(count, 0.0005)
                method["lmds/point_moving"] = np.tile([0.003, 0.0, 0.008], (count, 1))
                method["lmds/point_fixed"] = np.tile([0.0035, 0.0, 0.008], (count, 1))


class PressFit(Scratch):
    def test_cut_of_a_cube_is_its_outline(self):
        points, triangles = np.array(CUBE, dtype=float), np.array(FACES)
        low, high = points.min(axis=0), points.max(axis=0)
        outlines = press_fit.section(points, triangles, 0.3 * low[1] + 0.7 * high[1])
        self.assertEqual(len(outlines), 1)
        np.testing.assert_allclose([outlines[0].min(axis=0), outlines[0].max(axis=0)], [low[[0, 2]], high[[0, 2]]])

    def test_contacts_pair_off_one_with_one(self):
        here = np.array([[0.0, 0.0, 0.0], [1e-4, 0.0, 0.0], [0.01, 0.0, 0.0]])
        self.assertEqual(list(press_fit.unmatched(here, here[:1])), [1, 2])  # two near one: one is new
        self.assertEqual(list(press_fit.unmatched(here, here[::-1])), [])
        self.assertEqual(list(press_fit.unmatched(here[:0], here)), [])

    def test_births_and_deaths_are_of_contacts_within_the_cutoff(self):
        row = [0.0] * 6 + [0.0005, 5.0]
        far = [0.01] * 6 + [0.00099, 5.0]
        sets = [np.array(rows).reshape(-1, 8) for rows in ([], [row], [row, far], [row, row], [])]
        track = SimpleNamespace(lmds=sets, contacts=lambda frame, body: sets[frame])
        self.assertEqual(press_fit.events(track, 5, np.zeros((5, 3)), 0.001), ([1, 3], [4, 4]))

    def test_a_clip_between_two_shapes_is_half_way(self):
        entry = json.loads(EXPERIMENT.read_text(encoding="utf-8"))["movers"][0]
        clip = press_fit.Clip(entry, str(EXPERIMENT.parent))
        np.testing.assert_allclose(clip.at(22.5 * 0.04), 0.5 * (clip.shapes[22] + clip.shapes[23]), atol=1e-12)
        np.testing.assert_array_equal(clip.at(99.0), clip.shapes[-1])
        self.assertGreater(np.abs(clip.shapes[26] - clip.shapes[0]).max(), 1e-3)

    def test_draws(self):
        write(self.path("press-fit.h5"))
        self.printed(press_fit.main, self.path("press-fit.h5"), "--experiments", str(EXPERIMENT.parent), "--out", self.folder)
        self.assertGreater(os.path.getsize(self.path("press-fit.png")), 20_000)

    def test_says_what_is_missing(self):
        write(self.path("press-fit.h5"), lmds=False)
        with self.assertRaisesRegex(ResultError, "press-fit.json"):
            press_fit.main([self.path("press-fit.h5"), "--experiments", str(EXPERIMENT.parent)])
        write(self.path("far.h5"))
        with h5py.File(self.path("far.h5"), "a") as h5:
            for method in h5["methods"].values():
                method["lmds/frame_offset"][...] = 0
        with self.assertRaisesRegex(ResultError, "far.h5: certified-shared: .*remedy"):
            press_fit.main([self.path("far.h5"), "--experiments", str(EXPERIMENT.parent)])
