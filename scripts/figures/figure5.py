#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's Figure 5, the triangles that local tracking looks at, on a real mesh: for a contact point inside a triangle
(both readings of the paper's drawing), on an edge and at a vertex, as the program's tracking takes them."""

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from anatomy import main_of
from lmdbench_results import run_script
from mesh_drawing import PATCHES, PLAIN, draw_triangles, frame, view_onto
from tables import counted

import matplotlib.pyplot as plt

WORDS = {("face", "incident"): "(a) inside: the triangle", ("face", "edge neighbours"): "(a) inside, wider reading",
         ("edge", "incident"): "(b) on an edge", ("vertex", "incident"): "(c) at a vertex"}


def contact_point(mesh, entry):
    """The middle of the feature: of all vertices that every one of its triangles has."""
    if entry["kind"] == "face":
        return mesh.corners([entry["index"]])[0].mean(axis=0)
    shared = set(mesh.triangles[entry["triangles"][0]]).intersection(*(mesh.triangles[t] for t in entry["triangles"]))
    return mesh.vertices[sorted(shared)].mean(axis=0)


def draw(anatomy, _):
    mesh, entries = anatomy.moving, anatomy.document["neighbourhoods"]
    every = np.unique(np.concatenate([entry["triangles"] for entry in entries]))
    nearby = mesh.around(mesh.around(every))
    view = view_onto(mesh.normals[every].mean(axis=0))
    seen = mesh.corners(every).reshape(-1, 3) @ view.T
    figure, panels = plt.subplots(1, len(entries), figsize=(style.TWO_COLUMNS_IN, 2.4),
                                  gridspec_kw={"left": 0.01, "right": 0.99, "bottom": 0.02, "top": 0.76, "wspace": 0.05})
    for axes, entry in zip(panels, entries):
        colours = np.tile(PLAIN, (len(nearby), 1))
        colours[np.isin(nearby, entry["triangles"])] = PATCHES[1]
        draw_triangles(axes, mesh.corners(nearby), view, colours, edge="#00000077", width=0.4)
        point = view @ contact_point(mesh, entry)
        axes.plot(point[0], point[1], "o", ms=4, color=style.VERMILLION, mec="white", mew=0.5, zorder=5)
        frame(axes, seen.min(axis=0), seen.max(axis=0), margin=0.2)
        count = len(entry["triangles"])
        axes.set_title(f"{WORDS[entry['kind'], entry['reading']]}\n{counted(count, 'triangle')}", fontsize=7.5)
    figure.text(0.02, 0.925, f"Neighbourhoods of local tracking on {mesh.name}", fontsize=8.5, fontweight="bold")
    return figure


main = main_of("figure5", __doc__, draw, (0,))

if __name__ == "__main__":
    raise SystemExit(run_script(main))
