# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""How all figures look: colours that colour-blind readers can tell apart (Okabe and Ito), line styles that survive
grey print, sizes for a page of two columns, and files that are the same bytes for the same data."""

import itertools
import math
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

# Colours and lines of methods, by their place in the registry, so that a method looks the same in every figure.
METHOD_COLOURS = (VERMILLION, BLUE, GREEN, BLACK, PURPLE, ORANGE, SKY)
METHOD_LINES = ((0, (2.6, 0.8)), "-", (0, (5, 1, 1, 1)), ":", "--", (0, (4, 1.5)), (0, (1, 1)))

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
    return METHOD_COLOURS[method.order % len(METHOD_COLOURS)]


def colours_of(methods):
    """{label: colour}: methods keep their colour, variants of a method under other labels get those that are free."""
    colours = {method.label: colour_of(method) for method in methods if method.label == method.name}
    others = itertools.cycle([colour for colour in METHOD_COLOURS if colour not in colours.values()] or METHOD_COLOURS)
    return {method.label: colours[method.label] if method.label in colours else next(others)
            for method in {method.label: method for method in methods}.values()}


def line_of(method):
    return METHOD_LINES[method.order % len(METHOD_LINES)]


MOST_LABELLED = 7  # decades of an axis; more stand over each other


def labelled_decades(low, high):
    """Powers of ten from 10**low to 10**high that get a label: all, or every second, third, ... of many."""
    powers = range(math.ceil(low), math.floor(high) + 1)
    step = max(1, -(-len(powers) // MOST_LABELLED))
    return [10.0**power for power in powers if power % step == 0]


def note_failures(figure, failures):
    """At the foot: whose mark stands in the lane of failures, and why. @param failures {name: reason}"""
    if failures:
        figure.text(0.012, 0.004, "failed: " + "; ".join(f"{name}, {reason}" for name, reason in failures.items()), fontsize=5.5,
                    color="#444444", wrap=True, va="bottom")


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
