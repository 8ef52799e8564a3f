# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""How all figures look: colours that colour-blind readers can tell apart (Okabe and Ito), line styles that survive
grey print, sizes for a page of two columns, and files that are the same bytes for the same data."""

import itertools
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)

TWO_COLUMNS_IN = 7.2  # text width of a page of two columns
PNG_DPI = 300

VERMILLION = "#D55E00"
BLUE = "#0072B2"
GREEN = "#009E73"
PURPLE = "#CC79A7"
ORANGE = "#E69F00"
SKY = "#56B4E9"
BLACK = "#000000"
YELLOW = "#F0E442"
GREY = "#8A8A8A"
PALE_GREY = "#C4C4C4"

METHOD_COLOURS = {"original": VERMILLION, "improved": BLUE, "certified": GREEN, "exhaustive": BLACK}
METHOD_LINES = {"original": (0, (2.6, 0.8)), "improved": "-", "certified": (0, (5, 1, 1, 1)), "exhaustive": ":"}
OTHER_COLOURS = (PURPLE, ORANGE, SKY)

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 7.5,
    "axes.labelsize": 7.5,
    "axes.titlesize": 8.5,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "lines.linewidth": 0.9,
    "axes.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "grid.linewidth": 0.4,
    "grid.color": "#DDDDDD",
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "svg.hashsalt": "lmdbench",
    "svg.fonttype": "path",
    "path.simplify": True,
    "path.simplify_threshold": 0.2,
}


def use_style():
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(STYLE)


def colour_of(method):
    return METHOD_COLOURS.get(method.name, PURPLE)


def colours_of(labels):
    """{label: colour}: methods keep their colour, further labels (variants of a method, new methods) get the others."""
    others = itertools.cycle(OTHER_COLOURS)
    return {label: METHOD_COLOURS[label] if label in METHOD_COLOURS else next(others) for label in labels}


def line_of(method):
    return METHOD_LINES.get(method.name, "--")


def save(figure, directory, name):
    """Writes name.svg and name.png and returns their paths; nothing in them depends on the clock."""
    os.makedirs(directory, exist_ok=True)
    files = []
    for suffix, metadata, options in (
        ("svg", {"Date": None, "Creator": "lmdbench"}, {}),
        ("png", {"Software": "lmdbench"}, {"dpi": PNG_DPI}),
    ):
        file = os.path.join(directory, f"{name}.{suffix}")
        figure.savefig(file + ".part", format=suffix, metadata=metadata, **options)
        os.replace(file + ".part", file)
        files.append(file)
    plt.close(figure)
    return files
