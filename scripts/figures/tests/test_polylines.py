# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The figure of intersection polylines, from a result made by hand."""

import json
from unittest import mock

import h5py
import numpy as np

from cases import Scratch
from figure1 import write_off
from test_figure1 import CUBE, FACES
import figure_style as style
import polylines
from lmdbench_results import ResultError

POSE = {"translation_m": [10.0, 20.0, 30.0], "rotation_xyzw": [0.0, 0.0, 1.0, 0.0]}  # half a turn about z


class Polylines(Scratch):
    def result(self, **changes):
        file = self.path("cut.h5")
        experiment = {"fixed": [{"mesh": "cube", "scale": 2.0, "pose": POSE}], **changes}
        with h5py.File(file, "w") as h5:
            h5.attrs.update({"format": "lmdbench-result", "format_version": 2})
            h5["provenance/experiment"] = [json.dumps(experiment)]
            h5.create_group("methods")
            h5.create_group("scene/fixed_0").attrs["validity"] = json.dumps({"triangles": 12})
            h5["path/time"] = 1000.0 + 0.001 * np.arange(10)
            cut = h5.create_group("polylines")
            cut["frame"], cut["frame_offset"], cut["trace_time"] = [0, 5, 9], [0, 1, 1, 2], [1e-6] * 3
            cut["point_offset"], cut["closed"], cut["length"] = [0, 3, 6], np.array([1, 0], dtype="u1"), [0.1, 0.2]
            cut["point"] = np.arange(18.0).reshape(6, 3)
        write_off(self.path("cube.off"), CUBE, FACES)
        return [file, "--meshes", self.folder, "--out", self.path("out")]

    def test_the_mesh_stands_where_the_run_had_it_and_every_frame_counts_once(self):
        with mock.patch.object(polylines, "draw_mesh") as drawn, mock.patch.object(style, "leave", side_effect=lambda figure, *_: figure):
            figure = polylines.main(self.result())
        points = drawn.call_args.args[1]
        np.testing.assert_allclose([points.min(axis=0), points.max(axis=0)], [[8.0, 18.0, 30.0], [10.0, 20.0, 32.0]], atol=1e-12)
        self.assertEqual(figure.texts[0].get_text(), "cube, 12 triangles: curves of 2 frames")
        np.testing.assert_allclose(figure.axes[1].lines[0].get_xdata(), [1000.0, 1000.005, 1000.009])
        style.plt.close(figure)
        self.assertEqual(self.printed(polylines.main, *self.result()).count("polylines."), 2)

    def test_frames_without_a_curve_are_refused_with_the_remedy(self):
        arguments = self.result()
        with h5py.File(arguments[0], "a") as h5:
            h5["polylines/frame_offset"][...] = 0
        with self.assertRaisesRegex(ResultError, "cut.h5: the meshes intersect in no recorded frame .remedy"):
            polylines.main(arguments)

    def test_other_scenes_are_refused(self):
        cube = {"mesh": "cube"}
        for changes in ({"fixed": [cube, cube]}, {"movers": [cube]}, {"fixed": [{**cube, "instances": {}}]}, {"fixed": [{**cube, "deformation": {}}]}):
            with self.assertRaisesRegex(ResultError, "cut.h5: /provenance/experiment: .*remedy"):
                polylines.main(self.result(**changes))
