#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What `lmdbench anatomy` tells (argument 1 is the program), against the paper's text computed here anew from the meshes'
coordinates, and the figures that are drawn from it."""

import os
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "figures", "tests"))

from cases import ROOT, Scratch, call  # noqa: E402  (the figures' tests must be found first)
import figure2  # noqa: E402
import figure3  # noqa: E402
import figure4  # noqa: E402
import figure5  # noqa: E402
import figure6  # noqa: E402
from anatomy import ask, is_all_directions  # noqa: E402
from lmdbench_results import ResultError  # noqa: E402
from mesh_drawing import unit  # noqa: E402

EXPERIMENT = str(ROOT / "experiments" / "shapes.json")
LEVELS = (1, 3, 5)
PROGRAM = None


def angle(a, b):
    return float(np.arccos(np.clip(np.dot(unit(np.array(a)), unit(np.array(b))), -1.0, 1.0)))


def face_normals(corners):
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def in_plane(points, origin, along, normal):
    """(n, 2) coordinates in a plane."""
    points = np.asarray(points) - origin
    return np.column_stack([points @ along, points @ np.cross(normal, along)])


def triangles_overlap(a, b):
    """Separating axes of two triangles in a plane."""
    for one, other in ((a, b), (b, a)):
        for k in range(3):
            side = one[(k + 1) % 3] - one[k]
            normal = np.array([-side[1], side[0]])
            if normal @ (one[(k + 2) % 3] - one[k]) > 0:
                normal = -normal
            if np.min((other - one[k]) @ normal) > 0:
                return False
    return True


class AnatomyTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.anatomy = ask(PROGRAM, EXPERIMENT, None, LEVELS)
        cls.document, cls.mesh = cls.anatomy.document, cls.anatomy.moving

    def test_normals_and_pose_are_those_of_the_meshes(self):
        np.testing.assert_allclose(self.mesh.normals, face_normals(self.mesh.corners()), atol=1e-9)
        self.assertAlmostEqual(float(np.linalg.norm(self.document["orientation"])), 1.0)

    def test_every_level_holds_every_triangle_once(self):
        self.assertEqual([entry["level"] for entry in self.document["hierarchy"]], list(LEVELS))
        for level in LEVELS:
            nodes = self.anatomy.level(level)
            self.assertEqual(len(nodes), 2 ** level)
            triangles = np.sort(np.concatenate([node["triangles"] for node in nodes]))
            np.testing.assert_array_equal(triangles, np.arange(len(self.mesh.triangles)))

    def test_spheres_hold_points_and_cones_hold_normals(self):
        narrow = 0
        for node in self.anatomy.level(LEVELS[-1]):
            distance = np.linalg.norm(self.mesh.corners(node["triangles"]) - node["centre"], axis=2)
            self.assertLessEqual(distance.max(), node["radius"] * (1 + 1e-9))
            if not is_all_directions(node):
                narrow += 1
                for normal in self.mesh.normals[self.mesh.around(node["triangles"])]:
                    self.assertLessEqual(angle(normal, node["cone_axis"]), node["cone_half_angle"] + 1e-6)
        self.assertGreater(narrow, 0)

    def test_verdicts_are_those_of_the_printed_inequalities(self):
        """G1, G2 and G3.a/b as the paper prints them, G3 read as the condition of rejection (decision E2)."""
        verdicts = []
        for case in self.document["node_tests"]:
            a, b = case["moving"], case["fixed"]
            across = np.array(b["centre"]) - a["centre"]
            distance = float(np.linalg.norm(across))
            sigma = float(np.arcsin((a["radius"] + b["radius"]) / distance))
            if distance - a["radius"] - b["radius"] > self.anatomy.cutoff:
                expected = "rejected by G1"
            elif np.pi - angle(a["cone_axis"], b["cone_axis"]) > a["cone_half_angle"] + b["cone_half_angle"]:
                expected = "rejected by G2"
            elif (angle(across, a["cone_axis"]) > sigma + a["cone_half_angle"] or angle(-across, b["cone_axis"]) > sigma + b["cone_half_angle"]):
                expected = "rejected by G3"
            else:
                expected = "accepted"
            self.assertEqual(case["verdict"], expected)
            self.assertAlmostEqual(case["centre_distance"], distance)
            self.assertAlmostEqual(case["sigma"], sigma)
            self.assertAlmostEqual(case["cone_angle"], np.pi - angle(a["cone_axis"], b["cone_axis"]), places=6)
            self.assertAlmostEqual(case["angle_moving"], angle(across, a["cone_axis"]), places=6)
            self.assertAlmostEqual(case["angle_fixed"], angle(-across, b["cone_axis"]), places=6)
            verdicts.append(case["verdict"])
        self.assertEqual(verdicts, [test for test in figure4.TESTS if test in verdicts], "in the order of the tests, each once")
        self.assertGreaterEqual(len(verdicts), 3)

    def test_nodes_of_the_moving_mesh_are_tested_at_their_pose(self):
        nodes = {node["node"]: node for node in self.anatomy.level(LEVELS[-1])}
        for case in self.document["node_tests"]:
            own = nodes[case["moving"]["node"]]
            np.testing.assert_allclose(case["moving"]["centre"], self.anatomy.R_WM @ own["centre"] + self.anatomy.p_WM, atol=1e-12)
            self.assertEqual(case["moving"]["triangles"], own["triangles"])

    def test_neighbourhoods_are_what_shares_the_feature(self):
        triangles = self.mesh.triangles
        face, wider, edge, vertex = self.document["neighbourhoods"]
        self.assertEqual([entry["kind"] for entry in (face, wider, edge, vertex)], ["face", "face", "edge", "vertex"])
        own = face["index"]
        self.assertEqual(face["triangles"], [own])
        shared = np.isin(triangles, triangles[own]).sum(axis=1)
        self.assertEqual(sorted(wider["triangles"]), sorted(np.flatnonzero(shared >= 2)))
        side = triangles[own][:2]
        self.assertEqual(edge["triangles"], list(np.flatnonzero(np.isin(triangles, side).sum(axis=1) == 2)))
        self.assertEqual(vertex["index"], triangles[own][0])
        self.assertEqual(vertex["triangles"], list(np.flatnonzero((triangles == vertex["index"]).any(axis=1))))

    def test_sight_is_overlap_of_projections_along_vertex_normals(self):
        cases = self.document["visibility"]
        self.assertEqual([case["sees"] for case in cases], [True, False])
        for case in cases:
            passes = []
            for seer, seen in (("moving", "fixed"), ("fixed", "moving")):
                side = case[f"{seer}_on_{seen}"]
                normal, corners = np.array(case[seen]["face_normal"]), np.array(case[seen]["corners"])
                starts, normals = np.array(case[seer]["corners"]), np.array(case[seer]["vertex_normals"])
                heights = (corners[0] - starts) @ normal / (normals @ normal)
                self.assertEqual(side["shadow"] is None, bool(np.any(heights <= 0)), "a normal that points away projects nowhere")
                if side["shadow"] is None:
                    self.assertTrue(side["overlaps"])
                else:
                    np.testing.assert_allclose(side["shadow"], starts + heights[:, None] * normals, atol=1e-9)
                    along = unit(corners[1] - corners[0])
                    self.assertEqual(side["overlaps"], triangles_overlap(in_plane(side["shadow"], corners[0], along, normal),
                                                                        in_plane(corners, corners[0], along, normal)))
                passes.append(side["overlaps"])
            self.assertEqual(case["sees"], all(passes))
        np.testing.assert_allclose(cases[0]["moving"]["corners"], self.anatomy.world_corners([cases[0]["triangle_moving"]])[0], atol=1e-12)


class FiguresTest(Scratch):
    def test_each_is_drawn_and_the_same_twice(self):
        for figure, levels in ((figure2, [5]), (figure3, [1, 3]), (figure4, [5]), (figure5, []), (figure6, [])):
            name, chosen = figure.__name__, [word for level in levels for word in ("--level", str(level))]
            for turn in ("first", "second"):
                self.printed(figure.main, EXPERIMENT, "--program", PROGRAM, "--out", self.path(name, turn), *chosen)
                self.assertEqual(sorted(os.listdir(self.path(name, turn))), [f"{name}.png", f"{name}.svg"])
            self.assertEqual(self.read(name, "first", f"{name}.svg"), self.read(name, "second", f"{name}.svg"), name)

    def test_says_what_is_wrong(self):
        with self.assertRaisesRegex(ResultError, "give a --time"):
            ask(PROGRAM, EXPERIMENT, 0.0, [2])
        with self.assertRaisesRegex(ResultError, "gone"):
            ask(PROGRAM, "gone.json")
        self.assertEqual(call(PROGRAM, "anatomy", EXPERIMENT, "--level", "65").returncode, 2)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
