#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's Figure 2, a normal cone, on a real mesh: a patch of the surface with the normals that its cone has to cover,
and the same normals at one point with the cone that the program keeps for the patch."""

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from anatomy import is_all_directions, main_of
from lmdbench_results import ResultError, run_script
from mesh_drawing import PATCHES, PLAIN, draw_cone, draw_triangles, frame, view_onto

import matplotlib.pyplot as plt

LEVELS = (8,)
WANTED_HALF_ANGLE = np.radians(40.0)  # wide enough to see, and still a cone
TILT_DEG = 62.0


def chosen_node(nodes):
    """The node whose cone is nearest to the wanted one; a cone of all directions cannot be drawn."""
    able = [node for node in nodes if not is_all_directions(node) and len(node["triangles"]) > 1]
    if not able:
        raise ResultError("every cone of this level is all directions (remedy: a deeper --level)")
    return min(able, key=lambda node: abs(node["cone_half_angle"] - WANTED_HALF_ANGLE))


def arrows(axes, starts, ends, colour, width):
    for start, end in zip(starts, ends):
        axes.annotate("", end[:2], start[:2], arrowprops={"arrowstyle": "-|>", "color": colour, "lw": width, "mutation_scale": 4,
                                                         "shrinkA": 0, "shrinkB": 0}, zorder=6)


def draw(anatomy, levels):
    mesh = anatomy.moving
    node = chosen_node(anatomy.level(levels[-1]))
    axis = np.array(node["cone_axis"])
    covered = mesh.around(node["triangles"])
    nearby = mesh.around(mesh.around(covered))
    view = view_onto(axis, TILT_DEG)
    figure, panels = plt.subplots(1, 2, figsize=(style.TWO_COLUMNS_IN, 2.5), gridspec_kw={"left": 0.01, "right": 0.99, "bottom": 0.02, "top": 0.84, "wspace": 0.04})
    colours = np.tile(PLAIN, (len(nearby), 1))
    colours[np.isin(nearby, covered)] = 0.5 * (PLAIN + PATCHES[0])
    colours[np.isin(nearby, node["triangles"])] = PATCHES[0]
    draw_triangles(panels[0], mesh.corners(nearby), view, colours, edge="#00000055", width=0.3)
    centres = mesh.corners(covered).mean(axis=1)
    length = 0.45 * node["radius"]
    arrows(panels[0], centres @ view.T, (centres + length * mesh.normals[covered]) @ view.T, style.BLUE, 0.5)
    seen = np.concatenate([mesh.corners(nearby).reshape(-1, 3), centres + length * mesh.normals[covered]]) @ view.T
    frame(panels[0], seen.min(axis=0), seen.max(axis=0), margin=0.01)
    panels[0].set_ylim(seen[:, 1].min(), seen[:, 1].max())
    panels[0].set_title(f"a patch of {len(node['triangles'])} triangles; {len(covered)} normals round its corners", fontsize=8)

    origin = np.zeros(3)
    arrows(panels[1], np.zeros((len(covered), 3)), mesh.normals[covered] @ view.T, style.BLUE, 0.5)
    draw_cone(panels[1], origin, axis, node["cone_half_angle"], 1.15, view, style.VERMILLION, zorder=4)
    panels[1].set(xlim=(-1.25, 1.25), ylim=(-0.05, 1.3), aspect="equal")
    panels[1].axis("off")
    panels[1].annotate("axis $C$", (view @ (1.15 * axis))[:2], xytext=(4, 2), textcoords="offset points", color=style.VERMILLION)
    panels[1].set_title(f"its cone: half angle $\\phi$ = {np.degrees(node['cone_half_angle']):.1f}\u00b0", fontsize=8)
    figure.text(0.02, 0.945, f"Normal cone of node {node['node']}, level {levels[-1]}, of {mesh.name}", fontsize=8.5, fontweight="bold")
    return figure


main = main_of("figure2", __doc__, draw, LEVELS)

if __name__ == "__main__":
    raise SystemExit(run_script(main))
