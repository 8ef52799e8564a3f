#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's Figure 4, the tests on two nodes, computed: for each verdict that the program's node tests give on one level of
two real meshes, the nearest pair of nodes whose spheres do not overlap. A test depends on lengths and angles alone, which are
drawn true: G1 the spheres and the cutoff, G2 the cone of A against the reversed cone of B, G3.a and G3.b each cone against
the cone of all directions from one sphere to the other."""

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from anatomy import main_of
from lmdbench_results import run_script
from mesh_drawing import FIXED, MOVING, draw_sphere, draw_triangles, frame, view_towards

import matplotlib.pyplot as plt
from matplotlib.patches import Circle, Wedge

LEVELS = (8,)
TESTS = ("rejected by G1", "rejected by G2", "rejected by G3", "accepted")
A_COLOUR, B_COLOUR, LINES_COLOUR = style.BLUE, style.ORANGE, style.GREY


def reached(verdict, test):
    """Whether the traversal makes test 0, 1 or 2 of a pair with this verdict: it stops at the first rejection."""
    return test <= TESTS.index(verdict)


def passes(verdict, test):
    return test < TESTS.index(verdict)


def wedge(axes, centre, middle, half_angle, colour, radius=1.0):
    low, high = np.degrees(middle - half_angle), np.degrees(middle + half_angle)
    axes.add_patch(Wedge(centre, radius, low, high, facecolor=colour, edgecolor=colour, alpha=0.35, lw=0.5))
    axes.plot([centre[0], centre[0] + radius * np.cos(middle)], [centre[1], centre[1] + radius * np.sin(middle)], color=colour, lw=0.9)


def draw_patches(axes, anatomy, case):
    a, b = case["moving"], case["fixed"]
    centres = np.array(a["centre"]), np.array(b["centre"])
    view = view_towards(centres[1] - centres[0])
    draw_triangles(axes, anatomy.world_corners(a["triangles"]), view, MOVING, edge="#00000050", behind=True)
    draw_triangles(axes, anatomy.fixed.corners(b["triangles"]), view, FIXED, edge="#00000050", behind=True)
    for centre, node, colour in ((centres[0], a, A_COLOUR), (centres[1], b, B_COLOUR)):
        draw_sphere(axes, centre, node["radius"], view, colour, lw=0.8, zorder=4)
        start, along = view @ centre, view @ np.array(node["cone_axis"]) * node["radius"]
        axes.annotate("", (start + along)[:2], start[:2], zorder=6,
                      arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 0.9, "mutation_scale": 6, "shrinkA": 0, "shrinkB": 0})
    reach = [(view @ c)[:2] + s * node["radius"] for c, node in zip(centres, (a, b)) for s in (-1, 1)]
    frame(axes, np.min(reach, axis=0), np.max(reach, axis=0))


def draw_g1(axes, anatomy, case):
    a, b, distance = case["moving"]["radius"], case["fixed"]["radius"], case["centre_distance"]
    axes.add_patch(Circle((0, 0), a + anatomy.cutoff, facecolor="#EEEEEE", edgecolor=style.GREY, lw=0.6, ls=(0, (2, 2))))
    axes.add_patch(Circle((0, 0), a, facecolor="white", edgecolor=A_COLOUR, lw=0.9))
    axes.add_patch(Circle((distance, 0), b, facecolor="#FFFFFF99", edgecolor=B_COLOUR, lw=0.9))
    axes.plot([0, distance], [0, 0], color=style.BLACK, lw=0.6, marker=".", ms=2.5)
    reach = max(a + anatomy.cutoff, b)
    frame(axes, np.array([-a - anatomy.cutoff, -reach]), np.array([distance + max(b, 0), reach]))
    return f"gap {1e3 * (distance - a - b):.3g} mm, cutoff {1e3 * anatomy.cutoff:.3g} mm"


def draw_g2(axes, _, case):
    wedge(axes, (0, 0), 0.0, case["moving"]["cone_half_angle"], A_COLOUR)
    wedge(axes, (0, 0), case["cone_angle"], case["fixed"]["cone_half_angle"], B_COLOUR, 0.86)
    frame(axes, np.array([-1.0, -1.0]), np.array([1.0, 1.0]))
    return compared(case["cone_angle"], case["moving"]["cone_half_angle"] + case["fixed"]["cone_half_angle"])


def draw_g3(axes, _, case):
    words = []
    for centre, side, colour in (((-1.15, 0), "moving", A_COLOUR), ((1.15, 0), "fixed", B_COLOUR)):
        wedge(axes, centre, 0.0, case["sigma"], LINES_COLOUR)
        wedge(axes, centre, case[f"angle_{side}"], case[side]["cone_half_angle"], colour, 0.86)
        words.append(compared(case[f"angle_{side}"], case["sigma"] + case[side]["cone_half_angle"]))
    frame(axes, np.array([-2.15, -1.0]), np.array([2.15, 1.0]), margin=0.02)
    return "a: " + "; b: ".join(words)


def compared(angle, reach):
    """An angle against what the cones reach, with digits enough to tell them apart."""
    digits = next((digits for digits in range(4) if f"{np.degrees(angle):.{digits}f}" != f"{np.degrees(reach):.{digits}f}"), 4)
    return f"{np.degrees(angle):.{digits}f}\u00b0 {'>' if angle > reach else chr(0x2264)} {np.degrees(reach):.{digits}f}\u00b0"


def draw(anatomy, levels):
    cases = anatomy.document["node_tests"]
    headings = ("nodes A and B", "test 1 (G1)\nspheres within the cutoff", "test 2 (G2)\ncone A, cone B reversed", "test 3 (G3.a, G3.b)\ncones, directions A to B", "result")
    figure, panels = plt.subplots(len(cases), 5, figsize=(style.TWO_COLUMNS_IN, 1.55 * len(cases) + 0.75), squeeze=False,
                                  gridspec_kw={"left": 0.01, "right": 0.99, "bottom": 0.03, "top": 1 - 0.72 / (1.55 * len(cases) + 0.75),
                                               "wspace": 0.08, "hspace": 0.16, "width_ratios": (1.25, 1.25, 1, 1.45, 0.75)})
    for row, case in zip(panels, cases):
        draw_patches(row[0], anatomy, case)
        for test, (axes, draw_test) in enumerate(zip(row[1:4], (draw_g1, draw_g2, draw_g3))):
            words = draw_test(axes, anatomy, case)
            made = reached(case["verdict"], test)
            mark = ("passes" if passes(case["verdict"], test) else "rejects") if made else "not made"
            cell = axes.get_position(original=True)
            figure.text(0.5 * (cell.x0 + cell.x1), cell.y0, f"{mark}: {words}" if made else mark, ha="center", va="top", fontsize=6,
                        color=style.BLACK if made else style.GREY)
            if not made:
                for artist in (*axes.patches, *axes.lines):
                    artist.set_alpha(0.12)
        row[4].axis("off")
        accepted = case["verdict"] == "accepted"
        row[4].text(0.5, 0.5, case["verdict"].replace(" by", "\nby"), transform=row[4].transAxes, ha="center", va="center", fontsize=8.5,
                    fontweight="bold", color=style.GREEN if accepted else style.VERMILLION)
    for axes, words in zip(panels[0], headings):
        cell = axes.get_position(original=True)
        figure.text(0.5 * (cell.x0 + cell.x1), cell.y1 + 0.008, words, ha="center", va="bottom", fontsize=7)
    figure.text(0.01, 0.975, f"Tests on two nodes, level {levels[-1]} of {anatomy.moving.name} against {anatomy.fixed.name}", fontsize=8.5,
                fontweight="bold")
    return figure


main = main_of("figure4", __doc__, draw, LEVELS)

if __name__ == "__main__":
    raise SystemExit(run_script(main))
