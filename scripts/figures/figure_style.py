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
from lmdbench_results import NOT_JUDGED, refuse_foreign  # noqa: E402
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter  # noqa: E402

TWO_COLUMNS_IN = 7.2  # text width of a two-column page
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
# The true set and, by force law, its force; scripts/report/scene.js has the same.
TRUTH = "#D9B400"
TRUTH_COLOURS = {"linear": "#9A9A9A", "exponential": TRUTH}

# Colours and lines by place in the registry: a method looks the same in every figure.
METHOD_COLOURS = (VERMILLION, BLUE, GREEN, BLACK, PURPLE, ORANGE, SKY)
# Methods that share a colour: the first, the second, ... of them.
ROUND_LINES = ("-", (0, (7, 2)), (0, (2, 1.5)), (0, (7, 2, 2, 2)), (0, (14, 3)), (0, (7, 2, 2, 2, 2, 2)))
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


def rounds_of(methods):
    """{label: how many labels before it have its colour}: there are more methods than colours."""
    colours = colours_of(methods)
    return {label: list(colours.values())[:place].count(colour) for place, (label, colour) in enumerate(colours.items())}


def round_line(number):
    return ROUND_LINES[number % len(ROUND_LINES)]


def line_of(method):
    return METHOD_LINES[method.order % len(METHOD_LINES)]


LONGEST_NAME = 44  # letters in a key or title


def literal(name):
    """A name as a text of a figure: a dollar sign would begin a formula."""
    return name.replace("$", "\\$")


def shortened(name, longest=LONGEST_NAME):
    """The same, without its middle where it is too long: beginnings and ends tell names apart."""
    kept = longest - 3
    return literal(name if len(name) <= longest else name[: kept - kept // 2] + "..." + name[len(name) - kept // 2 :])


def width_of(figure, artist):
    """As drawn, in shares of the figure's width: left, right."""
    box = artist.get_window_extent(figure.canvas.get_renderer())
    return box.x0 / figure.bbox.width, box.x1 / figure.bbox.width


def fit_title(figure, text, left, right):
    """Breaks a title that is wider than its place after its last colon, and shrinks it as far as it must be."""
    line, two_lines = text.get_text(), ":\n".join(text.get_text().rsplit(": ", 1))
    for words, size in ((line, 8.5), (line, 7.5), (two_lines, 8.5), (two_lines, 7.0), (two_lines, 6.0), (two_lines, 5.0), (two_lines, 4.0)):
        text.set_text(words)
        text.set_fontsize(size)
        low, high = width_of(figure, text)
        if low >= left and high <= right:
            break


def legend_within(figure, keys, left, y, loc, layouts, right=0.995):
    """A legend of the whole figure from `left` on that ends before `right`.
    @param layouts  (font size, lines) in the order in which they are tried; the last one is taken in any case
    @return the legend, and its number of lines"""
    for size, lines in layouts:
        columns = -(-len(keys) // lines)
        wide = size >= 7.0
        legend = figure.legend(handles=keys, loc=loc, bbox_to_anchor=(left, y), ncol=columns, borderpad=0.1, fontsize=size, handletextpad=0.6,
                               handlelength=2.6 if wide else 1.8, columnspacing=1.6 if wide else 0.9)
        if width_of(figure, legend)[1] <= right or (size, lines) == layouts[-1]:
            return legend, -(-len(keys) // columns)
        legend.remove()
    raise ValueError("no layout")


MOST_LABELLED = 7  # decades of an axis with a label


LABELLED_STEPS = (((1, 2, 3, 5), 5), ((1, 2, 5), 6))  # within a decade, and how many labels of them stay apart


def labelled_decades(low, high):
    """Powers of ten from 10**low to 10**high that get a label: all, or every second, third, ... of many."""
    powers = range(math.ceil(low), math.floor(high) + 1)
    step = max(1, -(-len(powers) // MOST_LABELLED))
    return [10.0**power for power in powers if power % step == 0]


def labelled(low, high):
    """What gets a label from 10**low to 10**high: the finest steps that are few enough, else decades."""
    for parts, most in LABELLED_STEPS:
        steps = [float(f"{part}e{power}") for power in range(math.floor(low), math.floor(high) + 1) for part in parts]
        steps = [step for step in steps if low <= math.log10(step) <= high]
        if len(steps) <= most:
            return steps
    return labelled_decades(low, high)


def lanes(axis, span, low, high, lane, has_zero, has_failed):
    """On a logarithmic axis, beside the decades from `low` to `high`, shaded lanes so many decades wide where they are needed: for what is exactly
    0, and for what failed.
    @param span draws a stretch of the axis
    @return the middles of the two lanes, and the ends of the whole axis"""
    zero, failed = 10 ** (low - lane / 2), 10 ** (high + lane / 2)
    begin, end = 10 ** (low - lane) if has_zero else 10**low, 10 ** (high + lane) if has_failed else 10**high
    names = {zero: "0", failed: "failed"}
    axis.set_major_locator(FixedLocator([zero] * has_zero + labelled(low, high) + [failed] * has_failed))
    axis.set_major_formatter(FuncFormatter(lambda value, _: names.get(value, f"{value:g}")))
    axis.set_minor_formatter(NullFormatter())
    for first, last in ((begin, 10**low), (10**high, end)):
        if last > first:
            span(first, last, color="#F0F0F0", lw=0, zorder=0)
    return zero, failed, (begin, end)


def note_failures(figure, failures):
    """At the foot, on the one line that there is room for: whose mark stands in the lane of failures, or nowhere, and why; else how many.
    @param failures {name: reason}"""
    told = {"failed": [], "not drawn": []}
    for name, reason in failures.items():
        told["not drawn" if reason == NOT_JUDGED else "failed"].append(f"{shortened(name, 2 * LONGEST_NAME)}, {literal(reason)}")
    whole = {word: f"{word}: {'; '.join(names)}" for word, names in told.items() if names}
    counts = {word: f"{len(told[word])} {word}: see the table" for word in whole}
    note = figure.text(0.012, 0.004, "", fontsize=5.5, color="#444444", va="bottom")
    for said in (whole, *({**whole, word: counts[word]} for word in counts), counts):
        note.set_text(". ".join(said.values()))
        if width_of(figure, note)[1] <= 0.995:
            return


def save(figure, directory, name):
    """Writes name.svg and name.png and returns their paths; nothing in them depends on the clock."""
    os.makedirs(directory, exist_ok=True)
    files = []
    for suffix, metadata, options, mark in (
        ("svg", {"Date": None, "Creator": "lmdbench"}, {}, b"<dc:title>lmdbench</dc:title>"),
        ("png", {"Software": "lmdbench"}, {"dpi": PNG_DPI}, b"Software\0lmdbench"),
    ):
        file = os.path.join(directory, f"{name}.{suffix}")
        refuse_foreign(file, "figure", mark)
        figure.savefig(file + ".part", format=suffix, metadata=metadata, **options)
        os.replace(file + ".part", file)
        files.append(file)
    plt.close(figure)
    return files


def leave(figure, directory, name):
    """How a script ends that leaves a figure: names its files; the exit code."""
    print("\n".join(save(figure, directory, name)))
    return 0
