# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What `lmdbench anatomy` prints, for Figures 2 to 6 of the paper: the meshes of an experiment at one pose, and what the
program's own node tests, neighbourhoods and visibility pre-test make of them."""

import argparse
import json

import numpy as np

import figure_style as style
from mesh_drawing import rotation
from program import PROGRAM, answer


class Mesh:
    """(V, 3) vertices in the mesh's frame, (T, 3) triangles, (T, 3) face normals."""

    def __init__(self, entry):
        self.name = style.shortened(entry["mesh"])
        self.vertices = np.array(entry["vertices"])
        self.triangles = np.array(entry["triangles"])
        self.normals = np.array(entry["face_normals"])

    def corners(self, triangles=slice(None)):
        """(n, 3, 3)"""
        return self.vertices[self.triangles[triangles]]

    def around(self, triangles):
        """Triangles that share a vertex with some of these; these among them."""
        return np.flatnonzero(np.isin(self.triangles, self.triangles[triangles]).any(axis=1))


class Anatomy:
    def __init__(self, document):
        self.document = document
        self.moving, self.fixed = Mesh(document["moving"]), Mesh(document["fixed"])
        self.cutoff = document["cutoff"]
        self.R_WM, self.p_WM = rotation(*document["orientation"]), np.array(document["position"])

    def level(self, level):
        """Nodes of a level of the moving mesh's hierarchy, in its frame."""
        return next(entry["nodes"] for entry in self.document["hierarchy"] if entry["level"] == level)

    def world_corners(self, triangles):
        """(n, 3, 3) of the moving mesh."""
        return self.moving.corners(triangles) @ self.R_WM.T + self.p_WM


def is_all_directions(node):
    return node["cone_half_angle"] > np.pi - 1e-9


def ask(program, experiment, time=None, levels=()):
    command = [program, "-q", "anatomy", experiment, *(["--time", repr(time)] if time is not None else [])]
    for level in levels:
        command += ["--level", str(level)]
    return Anatomy(json.loads(answer(command)))


def main_of(name, doc, draw, levels=()):
    """main(argv) of a figure that is drawn from one Anatomy."""
    def main(argv):
        parser = argparse.ArgumentParser(description=doc)
        parser.add_argument("experiment", metavar="EXPERIMENT.json", help="an experiment whose meshes are there")
        parser.add_argument("--time", type=float, default=None, metavar="SECONDS", help="pose of the path; the middle of the contact without it")
        parser.add_argument("--level", type=int, action="append", metavar="N", help=f"levels of the hierarchy; {', '.join(map(str, levels))} without it")
        parser.add_argument("--program", default=PROGRAM, metavar="FILE")
        parser.add_argument("--out", required=True, metavar="DIR", help=f"directory of {name}.svg and {name}.png")
        arguments = parser.parse_args(argv)
        style.use_style()
        chosen = arguments.level or list(levels)
        return style.leave(draw(ask(arguments.program, arguments.experiment, arguments.time, chosen), chosen), arguments.out, name)
    return main
