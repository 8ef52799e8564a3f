#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's Figure 6, the visibility pre-test, computed: of the triangle pairs that the node tests leave, the nearest one that
is seen and the nearest one that is culled. Above both triangles with their corners moved along the vertex normals, below what
the pre-test compares in each plane."""

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from anatomy import main_of
from lmdbench_results import run_script
from mesh_drawing import frame, unit, view_towards

import matplotlib.pyplot as plt
from matplotlib.patches import Polygon

A_COLOUR, B_COLOUR = style.BLUE, style.ORANGE
SIDES = (("moving", "fixed", "A", "B", A_COLOUR, B_COLOUR), ("fixed", "moving", "B", "A", B_COLOUR, A_COLOUR))


def polygon(axes, points, colour, filled=0.35, **options):
    axes.add_patch(Polygon(points[:, :2], closed=True, facecolor=colour, edgecolor="none", alpha=filled))
    axes.add_patch(Polygon(points[:, :2], closed=True, fill=False, edgecolor=colour, lw=0.9, **options))


def name_corner(axes, points, text, colour):
    axes.annotate(text, points[:, :2].mean(axis=0), ha="center", va="center", color=colour, fontsize=8, fontweight="bold", zorder=7)


def draw_space(axes, case):
    """Both triangles and the shadow of A on the plane of B, seen along B's plane."""
    a, b = np.array(case["moving"]["corners"]), np.array(case["fixed"]["corners"])
    normal = np.array(case["fixed"]["face_normal"])
    view = view_towards(unit(normal))[[1, 0, 2]] * [[1], [-1], [1]]  # B lies flat, A is above
    view = np.array([view[0], np.cos(0.35) * view[1] + np.sin(0.35) * view[2], -np.sin(0.35) * view[1] + np.cos(0.35) * view[2]])
    if np.mean((a - b[0]) @ view.T, axis=0)[1] < np.mean((b - b[0]) @ view.T, axis=0)[1]:
        view = -view * [[1], [1], [-1]]
    seen_a, seen_b = a @ view.T, b @ view.T
    polygon(axes, seen_b, B_COLOUR)
    points = [seen_a, seen_b]
    shadow = case["moving_on_fixed"]["shadow"]
    if shadow is not None:
        shadow = np.array(shadow) @ view.T
        points.append(shadow)
        polygon(axes, shadow, A_COLOUR, 0.12, ls=(0, (2, 1.5)))
        for start, end in zip(seen_a, shadow):
            axes.annotate("", end[:2], start[:2], arrowprops={"arrowstyle": "-|>", "color": style.GREY, "lw": 0.6, "mutation_scale": 5,
                                                             "shrinkA": 0, "shrinkB": 0})
    polygon(axes, seen_a, A_COLOUR)
    name_corner(axes, seen_a, "A", A_COLOUR)
    name_corner(axes, seen_b, "B", "#8A5F00")
    points = np.concatenate(points)
    frame(axes, points.min(axis=0), points.max(axis=0))


def draw_plane(axes, case, seer, seen, seer_name, seen_name, seer_colour, seen_colour):
    """What one side of the pre-test compares, square on to the plane."""
    side = case[f"{seer}_on_{seen}"]
    normal = np.array(case[seen]["face_normal"])
    corners = np.array(case[seen]["corners"])
    along = unit(corners[1] - corners[0])
    view = np.array([along, np.cross(normal, along), normal])
    target = corners @ view.T
    polygon(axes, target, seen_colour)
    name_corner(axes, target, seen_name, style.BLACK)
    points = [target]
    if side["shadow"] is None:
        words = f"{seer_name} has no projection on the plane of {seen_name}: passes"
    else:
        shadow = np.array(side["shadow"]) @ view.T
        points.append(shadow)
        polygon(axes, shadow, seer_colour, ls=(0, (2, 1.5)))
        name_corner(axes, shadow, seer_name + "$_1$", style.BLACK)
        words = f"{seer_name}$_1$ and {seen_name} " + ("overlap: passes" if side["overlaps"] else "do not overlap: culled")
    points = np.concatenate(points)
    frame(axes, points.min(axis=0), points.max(axis=0))
    axes.text(0.5, -0.01, words, transform=axes.transAxes, ha="center", va="top", fontsize=7)


def draw(anatomy, _):
    cases = anatomy.document["visibility"]
    figure, panels = plt.subplots(len(cases), 3, figsize=(style.TWO_COLUMNS_IN, 2.5 * len(cases) + 0.5), squeeze=False,
                                  gridspec_kw={"left": 0.03, "right": 0.99, "bottom": 0.04, "top": 1 - 0.55 / (2.5 * len(cases) + 0.5), "wspace": 0.06,
                                               "hspace": 0.28})
    for row, case in zip(panels, cases):
        draw_space(row[0], case)
        for axes, side in zip(row[1:], SIDES):
            draw_plane(axes, case, *side)
            axes.set_title(f"plane of {side[3]}", fontsize=7.5)
        verdict = "seen" if case["sees"] else "culled"
        row[0].set_title(f"{verdict}: {1e3 * case['distance']:.2g} mm apart", fontsize=8, fontweight="bold",
                         color=style.GREEN if case["sees"] else style.VERMILLION)
        row[0].text(0.5, -0.01, "corners of A along their vertex normals", transform=row[0].transAxes, ha="center", va="top", fontsize=7)
    figure.text(0.02, 0.965, f"Visibility pre-test on triangles of {anatomy.moving.name} (A) and {anatomy.fixed.name} (B)", fontsize=8.5, fontweight="bold")
    return figure


main = main_of("figure6", __doc__, draw, (0,))

if __name__ == "__main__":
    raise SystemExit(run_script(main))
