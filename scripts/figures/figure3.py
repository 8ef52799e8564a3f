#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's Figure 3, levels of a spatialized normal cone hierarchy, on a real mesh: bounding spheres on the left, normal
cones on the right. Cones of all directions are drawn as dotted circles: at the top of the hierarchy they are the rule."""

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from anatomy import is_all_directions, main_of
from lmdbench_results import run_script
from mesh_drawing import PATCHES, PLAIN, draw_cone, draw_sphere, draw_triangles, frame, view_onto

import matplotlib.pyplot as plt

LEVELS = (2, 5, 8)
VIEW = view_onto(np.array([0.25, 0.25, 1.0]))
CONES_FACE = 0.15  # cosine; cones that point away by more are behind the mesh


def draw(anatomy, levels):
    mesh = anatomy.moving
    figure, panels = plt.subplots(len(levels), 2, figsize=(style.TWO_COLUMNS_IN, 3.35 * len(levels)), squeeze=False,
                                  gridspec_kw={"left": 0.03, "right": 0.99, "bottom": 0.01, "top": 0.955, "wspace": 0.02, "hspace": 0.1})
    corners = mesh.corners()
    seen = mesh.vertices @ VIEW.T
    for row, level in zip(panels, levels):
        nodes = anatomy.level(level)
        colours = np.empty((len(corners), 3))
        for i, node in enumerate(nodes):
            colours[node["triangles"]] = PATCHES[i % len(PATCHES)]
        draw_triangles(row[0], corners, VIEW, colours)
        draw_triangles(row[1], corners, VIEW, PLAIN)
        width = 1.1 / (1.0 + 0.25 * level)
        reach = 0.0
        for node in nodes:
            centre, axis = np.array(node["centre"]), np.array(node["cone_axis"])
            draw_sphere(row[0], centre, node["radius"], VIEW, style.BLUE, lw=width, zorder=3)
            reach = max(reach, np.max(np.abs((VIEW @ centre)[:2] - 0.5 * (seen.min(axis=0) + seen.max(axis=0))[:2]) + node["radius"]))
            if is_all_directions(node):
                draw_sphere(row[1], centre, 0.5 * node["radius"], VIEW, style.VERMILLION, lw=width, ls=":", zorder=3)
            elif VIEW[2] @ axis > CONES_FACE:
                draw_cone(row[1], centre, axis, node["cone_half_angle"], 0.75 * node["radius"], VIEW, style.VERMILLION)
        middle = 0.5 * (seen.min(axis=0) + seen.max(axis=0))
        for axes in row:
            frame(axes, middle - reach, middle + reach, margin=0.0)
        every = sum(map(is_all_directions, nodes))
        row[0].set_title(f"level {level}: {len(nodes)} spheres", fontsize=8)
        row[1].set_title(f"level {level}: {len(nodes)} cones, {every} of all directions", fontsize=8)
    figure.text(0.02, 0.983, f"Hierarchy of {mesh.name}, {len(mesh.triangles)} triangles; cones on the far side are left out", fontsize=8.5, fontweight="bold")
    return figure


main = main_of("figure3", __doc__, draw, LEVELS)

if __name__ == "__main__":
    raise SystemExit(run_script(main))
