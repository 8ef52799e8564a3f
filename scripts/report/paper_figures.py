# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's Figures 1 to 6 on the page: pictures that scripts/figures/figure1.py to figure6.py have drawn."""

import os

from lmdbench_results import ResultError
from studies import picture

WIDTH = 1000  # pixels, three quarters of the page: text stays readable

# What each figure shows, in the paper's words if it has some.
FIGURES = (
    ("figure1", "Two meshes near each other and their local minimum distance pairs, and the contact enlarged."),
    ("figure2", "A normal cone: the normals round a patch of the surface, and the cone that has to cover them."),
    ("figure3", "Levels of the spatialized normal cone hierarchy, coarse to fine: each patch is a node."),
    ("figure4", "Four cases of the tests on two nodes: what passes and what is rejected, with the angles that decide."),
    ("figure5", "The neighbourhoods that local tracking tests round a contact point in a face, on an edge, at a vertex."),
    ("figure6", "The visibility pre-test: corners moved along their vertex normals onto the other triangle's plane."),
)


def paper_figures(folder):
    """[{"id", "title", "text", "picture"}] of those of the figures that the folder holds."""
    shown = [{"id": name, "title": f"Figure {name.removeprefix('figure')}", "text": text, "picture": picture(file, WIDTH)}
             for name, text in FIGURES if os.path.isfile(file := os.path.join(folder, name + ".png"))]
    if not shown:
        raise ResultError(f"{folder}: holds none of figure1.png to figure6.png (remedy: draw them with scripts/figures/figure1.py to "
                          "figure6.py, --out this folder)")
    return shown
