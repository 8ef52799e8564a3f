#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What an LMD is, in a picture: two parts seen along the axis that both are extruded along, their local minimum distance pairs as `lmdbench query`
finds them within the cutoff, the nearest pair among them, and the force that each pair gives. Prints the files."""

import argparse
import tempfile

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import ResultError, run_script
from figure1 import query
from program import PROGRAM

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

CUTOFF = 0.55
PUSH = 1.3  # length of the arrow of the largest force
THICKNESS = 0.2


def tool(count=160):
    """A trefoil, counter-clockwise."""
    angle = 2.0 * np.pi * np.arange(count) / count
    radius = 1.0 + 0.28 * np.cos(3.0 * angle - 4.4)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def ground(count=160):
    """A hump between two hollows, counter-clockwise; its underside is flat."""
    x = np.linspace(2.2, -2.2, count)
    y = -1.2 + 0.06 * x * x + 0.18 * np.cos(2.86 * x)
    return np.vstack([np.column_stack([x, y]), [[-2.2, -1.9], [2.2, -1.9]]])


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def caps(outline):
    """The polygon in triangles, by cutting ears off."""
    left, triangles = list(range(len(outline))), []
    while len(left) > 3:
        for k in range(len(left)):
            a, b, c = (left[(k + i) % len(left)] for i in (-1, 0, 1))
            corners = outline[[a, b, c]]
            others = [i for i in left if i not in (a, b, c)]
            inside = any(all(cross(corners[i], corners[(i + 1) % 3], outline[other]) >= 0.0 for i in range(3)) for other in others)
            if cross(*corners) > 0.0 and not inside:
                triangles.append((a, b, c))
                left.pop(k)
                break
        else:
            raise ResultError("an outline crosses itself (remedy: choose another)")
    return triangles + [tuple(left)]


def extruded(outline):
    """A closed mesh: vertices, triangles."""
    n = len(outline)
    vertices = [(x, y, z) for z in (-0.5 * THICKNESS, 0.5 * THICKNESS) for x, y in outline]
    triangles = [(a + n, b + n, c + n) for a, b, c in caps(outline)] + [(c, b, a) for a, b, c in caps(outline)]
    for k in range(n):
        following = (k + 1) % n
        triangles += [(k, following, following + n), (k, following + n, k + n)]
    return np.array(vertices), np.array(triangles)


def pairs_of(program, moving, fixed):
    """[(distance, point of the tool, point of the ground)], the nearest first."""
    with tempfile.TemporaryDirectory() as folder:
        (lmds,) = query(program, folder, {"tool": extruded(moving), "ground": extruded(fixed)}, CUTOFF, [[0, 0, 0, 0, 0, 0, 0, 1]], "certified")
    return sorted(((lmd["distance"], *(np.array(lmd[point][:2]) for point in ("point_moving", "point_fixed"))) for lmd in lmds), key=lambda pair: pair[0])


def draw(moving, fixed, pairs):
    style.use_style()
    figure, axes = plt.subplots(figsize=(0.75 * style.TWO_COLUMNS_IN, 2.75), gridspec_kw={"left": 0.01, "right": 0.99, "bottom": 0.09, "top": 0.99})
    for outline, colour, words, place in ((moving, "#CFE3F2", "moving part", (0.0, 0.05)), (fixed, "#E3E0DA", "fixed part", (0.0, -1.6))):
        axes.fill(*outline.T, facecolor=colour, edgecolor="#555555", lw=0.8)
        axes.annotate(words, place, ha="center", va="center")
    for k, (distance, point, foot) in enumerate(pairs):
        colour = style.VERMILLION if k == 0 else style.BLUE
        axes.plot(*np.column_stack([point, foot]), color=colour, lw=1.6, marker="o", ms=3)
        push = PUSH * (1.0 - distance / CUTOFF) * (point - foot) / distance
        axes.annotate("", point + push, point, arrowprops={"arrowstyle": "-|>", "color": style.GREEN, "lw": 1.4, "shrinkA": 2, "shrinkB": 0})
    axes.set_aspect("equal")
    axes.set_axis_off()
    keys = [Line2D([], [], color=style.VERMILLION, marker="o", ms=3, lw=1.6, label="nearest pair"),
            Line2D([], [], color=style.BLUE, marker="o", ms=3, lw=1.6, label="further LMDs within the cutoff"),
            Line2D([], [], color=style.GREEN, lw=1.4, label="force of each, on the moving part")]
    style.legend_within(figure, keys, 0.03, 0.0, "lower left", ((7.0, 1), (6.0, 1)))
    return figure


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=PROGRAM)
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of lmd.svg and lmd.png")
    arguments = parser.parse_args(argv)
    pairs = pairs_of(arguments.program, tool(), ground())
    return style.leave(draw(tool(), ground(), pairs), arguments.out, "lmd")


if __name__ == "__main__":
    raise SystemExit(run_script(main))
