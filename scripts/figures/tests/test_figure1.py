# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 1 from a program that answers as `lmdbench query --json` does."""

import json
import os

import numpy as np

from cases import Scratch
import figure1
from lmdbench_results import ResultError, UsageError

CUBE = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
LMD = {"distance": 0.1, "point_moving": [1.0, 0.5, 0.5], "point_fixed": [1.1, 0.5, 0.5]}


class Figure1(Scratch):
    def experiment(self, lmds, **changes):
        figure1.write_off(self.write("meshes/cube.off", ""), CUBE, FACES)
        self.write("paths/p.tum", "# a path\n0 0 0 0 0 0 0 1\n2 1 0 0 0 0 0.7071067811865476 0.7071067811865476\n")
        answer = json.dumps({"time": 0, "lmds": lmds})
        program = self.write("program", f"#!/bin/sh\necho \"$@\" > {self.folder}/asked\ncat > {self.folder}/pose\ncp \"$3\" {self.folder}/moved\necho '{answer}'\n")
        os.chmod(program, 0o755)
        experiment = self.write("experiments/e.json", json.dumps({
            "name": "e", "moving": {"mesh": "cube", "diagonal_m": 2.0}, "fixed": [{"mesh": "cube"}], "path": {"file": "../paths/p.tum"},
            "force": {"cutoff_diagonal": 0.1}, **changes}))
        return ["--program", program, "--out", self.path("out"), "--time", "1.9", experiment]

    def test_asks_for_the_pose_and_cutoff_of_the_experiment_and_leaves_two_figures(self):
        self.assertEqual(figure1.main(self.experiment([LMD])), 0)
        self.assertIn("--cutoff 0.2", self.read("asked"), "a tenth of the scaled mesh's diagonal")
        self.assertTrue(self.read("pose").startswith("2.0 1.0"), "the pose nearest to the time")
        self.assertEqual(sorted(os.listdir(self.path("out"))), ["figure1.png", "figure1.svg"])
        mine = self.write("out/moving.off", "mine")
        figure1.main(self.experiment([LMD]))
        self.assertEqual(self.read(mine), "mine")

    def test_meshes_lie_as_in_a_run(self):
        scaled = figure1.prepared(CUBE, {"mesh": "cube", "diagonal_m": 2.0})
        np.testing.assert_allclose(scaled.max(axis=0) + scaled.min(axis=0), 0.0, atol=1e-12)
        self.assertAlmostEqual(np.linalg.norm(scaled.max(axis=0) - scaled.min(axis=0)), 2.0)
        np.testing.assert_array_equal(figure1.prepared(CUBE, {"mesh": "cube"}), CUBE)
        np.testing.assert_array_equal(figure1.prepared(CUBE, {"mesh": "cube", "scale": 0.5, "centre": True}), 0.5 * CUBE - 0.25)
        self.assertEqual(figure1.main(self.experiment([LMD])), 0)
        with open(self.path("moved"), encoding="ascii") as stream:
            self.assertTrue(stream.read().splitlines()[2].startswith("-"), "a corner of the mesh that is asked about")

    def test_other_scenes_are_refused(self):
        cube = {"mesh": "cube"}
        for changes, place in (({"objects": [cube, cube]}, "/objects"), ({"movers": [cube]}, "/movers"), ({"fixed": [cube, cube]}, "/fixed/1"),
                               ({"fixed": [{**cube, "pose": {}}]}, "/fixed/0/pose"), ({"moving": {**cube, "orient": "outward"}}, "/moving/orient")):
            with self.assertRaisesRegex(ResultError, f"e.json: {place}: not drawn.*remedy"):
                figure1.main(self.experiment([LMD], **changes))

    def test_without_a_time_the_pose_with_lmds_nearest_the_middle_is_shown(self):
        times = [0.0, 1.0, 2.0, 3.0, 4.0]
        self.assertEqual(figure1.index_to_show([[LMD], [], [], [LMD], [LMD]], times), 3)
        self.assertIsNone(figure1.index_to_show([[]] * 5, times))
        poses = np.arange(4000.0)[:, None]
        self.assertEqual(figure1.chosen_poses(poses, None)[[0, -1], 0].tolist(), [0.0, 3999.0])

    def test_no_time_of_the_path_is_refused(self):
        for time in ("99", "-1", "nan"):
            with self.assertRaisesRegex(UsageError, "--time: .* s is no time of the path .remedy: give one from 0 to 2"):
                figure1.main([*self.experiment([LMD]), f"--time={time}"])

    def test_a_mesh_file_is_read_from_beside_the_experiment(self):
        figure1.write_off(self.write("experiments/own.off", ""), CUBE, FACES)
        self.assertEqual(figure1.main(self.experiment([LMD], moving={"mesh": "./own.off"}, force={"cutoff_m": 0.2})), 0)
        with self.assertRaisesRegex(UsageError, "own.stl: not drawn here.*remedy"):
            figure1.main(self.experiment([LMD], moving={"mesh": "./own.stl"}))

    def test_what_an_experiment_leaves_out_is_named(self):
        for changes, words in (({"path": {}}, "e.json: /path/file: needed here"), ({"force": {"maximum_force_n": 1}}, "e.json: /force: .*cutoff_m")):
            with self.assertRaisesRegex(UsageError, words):
                figure1.main(self.experiment([LMD], **changes))

    def test_intersecting_triangles_alone_are_enlarged(self):
        meshes = [(CUBE, FACES), (CUBE + [1.0, 0.0, 0.0], FACES)]
        figure = figure1.draw(meshes, [{"point_moving": [1.0, 0.5, 0.5], "point_fixed": [1.0, 0.5, 0.5]}], "")
        whole, enlarged = (np.ptp(axes.get_xlim()) for axes in figure.axes)
        figure1.plt.close(figure)
        self.assertGreater(enlarged / whole, 0.01)

    def test_no_lmd_is_said_and_not_drawn(self):
        with self.assertRaisesRegex(ResultError, "no LMD within the cutoff at 2 s"):
            figure1.main(self.experiment([]))

    def test_off_files_come_back_as_they_went(self):
        file = self.path("a.off")
        figure1.write_off(file, CUBE / 3.0, FACES)
        points, faces = figure1.read_off(file)
        np.testing.assert_array_equal(points, CUBE / 3.0)
        np.testing.assert_array_equal(faces, FACES)

    def test_what_is_no_off_file_of_triangles_is_named(self):
        for name, text in (("quads.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"), ("cut.off", "OFF\n3 1 0\n0 0\n"), ("empty.off", "")):
            with self.assertRaisesRegex(ResultError, f"{name}: is no OFF file of triangles.*remedy"):
                figure1.read_off(self.write(name, text))

    def test_view_and_rotation_are_rotations(self):
        half = np.sqrt(0.5)
        np.testing.assert_allclose(figure1.rotation(0, 0, half, half) @ [1, 0, 0], [0, 1, 0], atol=1e-12)
        for direction in ([1.0, 2.0, 3.0], [0.0, 1.0, 0.0]):
            view = figure1.view_towards(np.array(direction))
            np.testing.assert_allclose(view @ view.T, np.eye(3), atol=1e-12)
            self.assertAlmostEqual(float(np.linalg.det(view)), 1.0)
            self.assertGreater(float((view @ direction)[0]), 0.0, "the fixed mesh stands on the right")
