#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The work-precision figure: what error each method leaves for what run time, log-log, a point a method and
experiment. Errors are against the exhaustive LMD set under the method's own force law; run time is all-in per haptic
frame: the local update and the frame's share of the global searches. A point stands at the median over the frames in
contact, its whisker ends at the 99th percentile; each frame counts with the median of its repetitions. A method that
fails is shown as a failure, not left out."""

import argparse
import math
from types import SimpleNamespace

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import MISSES_ALL, NOT_JUDGED, ROUNDING, ResultError, misses_all, no_truth, run_script, truth_of
from variants import open_results

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "p", "h", "d", "8", "*")
HAPTIC_BUDGET_MS = 1.0  # one frame at 1 kHz
# Width of the lanes for errors of exactly 0 and for failures, as a share of the logarithmic range.
LANE_SHARE = 0.2
MARGIN = 0.1  # decades between points and the ends of an axis
SHORTEST_RANGE = 0.6  # decades
NEAR = 0.35  # decades from an axis to the budget that it still reaches for
LEGEND_LAYOUTS = tuple((7.0, lines) for lines in range(1, 6)) + ((5.5, 5), (5.5, 8), (5.5, 12))


class Point:
    """A method in an experiment."""

    def __init__(self, result, method):
        self.method = method
        self.experiment = result.name
        self.mark = result.name + (f", {method.profile}" if method.profile else "")
        self.median_ms = method.number("frame_time_median_s") * 1e3
        self.p99_ms = method.number("frame_time_p99_s") * 1e3
        if truth_of(method) is None:
            raise ResultError(f"{result.file}: {no_truth(result)}, so its times have no error to stand beside "
                              "(remedy: run with /probes/truth/stride_frames above 0 over more frames than a search takes)")
        error = method.number("force_error_rms_n") / method.constant("maximum_force_n")
        self.force_error = 0.0 if error < ROUNDING else error
        self.missed = 1.0 - method.number("recall")
        self.missed_adjacent = 1.0 - method.number("recall_adjacent")
        forces = method.read("force")
        self.failure = ""
        if not np.all(np.isfinite(forces)):
            self.failure = "force is not finite"
        elif not np.isfinite(self.force_error):
            self.failure = NOT_JUDGED
        elif misses_all(method.number("recall"), self.force_error):
            self.failure = MISSES_ALL


# Quantity, a more lenient one (an open mark on the same level), its most in decades, label.
PANELS = (
    ("force_error", None, math.inf, "RMS force error / $F_{max}$ of one LMD [1]"),
    ("missed", "missed_adjacent", 0.0, "missed share of true LMDs [1]"),
)


def error_axis(axes, errors, any_failed, most=math.inf):
    """Logarithmic range of the finite positive errors, with a shaded lane for errors of exactly 0 on its left and one
    for failures on its right where they are needed; returns the places of the two lanes and their width in decades."""
    positive = [error for error in errors if np.isfinite(error) and error > 0]
    low, high = decades(positive, SHORTEST_RANGE) if positive else (-3.0, 0.0)
    low, high = (min(low, most - SHORTEST_RANGE), most) if high > most else (low, high)
    lane = LANE_SHARE * (high - low)
    axes.set_xscale("log")
    zero, failed, limits = style.lanes(axes.xaxis, axes.axvspan, low, high, lane, any(error == 0 for error in errors), any_failed)
    axes.set_xlim(limits)
    axes.xaxis.set_minor_locator(FixedLocator(small_marks(low, high)))
    return zero, failed, lane


def decades(values, shortest=0.0):
    """The range of values, in decades: they stay a tenth of a decade from its ends."""
    low, high = (np.floor((np.log10(min(values)) - MARGIN) * 20) / 20, np.ceil((np.log10(max(values)) + MARGIN) * 20) / 20)
    return low, max(high, low + shortest)


def small_marks(low, high):
    """Labels may leave out decades; those get small marks."""
    every = [10.0**power for power in range(math.floor(low), math.floor(high) + 1)]
    small = every if len(every) > style.MOST_LABELLED else [step * decade for decade in every for step in range(1, 10)]
    return [mark for mark in small if 10**low <= mark < 10**high]


def time_axis(axes, points):
    """Logarithmic range of the run times; the budget is in it where it is near."""
    times = [time for point in points for time in (point.median_ms, point.p99_ms) if np.isfinite(time) and time > 0]
    low, high = decades(times or [HAPTIC_BUDGET_MS], SHORTEST_RANGE)
    budget = math.log10(HAPTIC_BUDGET_MS)
    low, high = (min(low, budget - MARGIN) if budget > low - NEAR else low), (max(high, budget + MARGIN) if budget < high + NEAR else high)
    axes.set_yscale("log")
    axes.set_ylim(10**low, 10**high)
    axes.yaxis.set_major_locator(FixedLocator(style.labelled(low, high)))
    axes.yaxis.set_minor_locator(FixedLocator(small_marks(low, high)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())


def spread(index, count, lane_decades):
    """Factor that keeps the points of one lane apart, which all have the same error."""
    return 10 ** (0.3 * lane_decades * ((index + 0.5) / count - 0.5))


def draw_panel(axes, points, quantity, lenient, most, label, markers, colours, lines):
    points = [point for point in points if point.failure != NOT_JUDGED]
    errors = [getattr(point, name) for point in points for name in (quantity, lenient) if name]
    zero, failed, lane_decades = error_axis(axes, errors, any(point.failure for point in points), most)
    in_lane = [point for point in points if point.failure or getattr(point, quantity) == 0]
    for point in points:
        error = getattr(point, quantity)
        colour = colours[point.method.series]
        bad = bool(point.failure)
        if not bad and not np.isfinite(error):
            continue  # no set is promised that could miss an LMD
        lane = spread(in_lane.index(point), len(in_lane), lane_decades) if point in in_lane else 1.0
        place = failed * lane if bad else (error if error > 0 else zero * lane)
        if lenient and not bad:
            open_error = getattr(point, lenient)
            open_place = open_error if open_error > 0 else zero * lane
            axes.plot([place, open_place], [point.median_ms] * 2, color=colour, lw=0.6, ls=":", zorder=2)
            axes.plot(open_place, point.median_ms, marker=markers[point.mark], ms=5.4, color="white", mec=colour,
                      mew=0.9, zorder=3)
        axes.plot([place, place], [point.median_ms, point.p99_ms], color=colour, lw=0.9, ls=lines[point.method.series], zorder=2)
        axes.plot(place, point.p99_ms, marker="_", ms=5, color=colour, zorder=2)
        axes.plot(place, point.median_ms, marker="x" if bad else markers[point.mark], ms=6, color=colour,
                  mec=colour if bad else "white", mew=1.4 if bad else 0.6, zorder=3)
    axes.set_xlabel(label)


def mark_budget(axes):
    """One haptic frame, or on which side of the range it is."""
    low, high = axes.get_ylim()
    note = {"textcoords": "offset points", "color": "#555555", "fontsize": 6.5, "zorder": 9,
            "bbox": {"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.4}}
    if low <= HAPTIC_BUDGET_MS <= high:
        axes.axhline(HAPTIC_BUDGET_MS, color=style.GREY, lw=0.8, ls=(0, (2, 2)), zorder=1)
        axes.annotate("1 ms", (0.0, HAPTIC_BUDGET_MS), xycoords=("axes fraction", "data"), xytext=(3, 2), **note)
    elif HAPTIC_BUDGET_MS > high:
        axes.annotate("budget of 1 ms: above", (0.0, 1.0), xycoords="axes fraction", xytext=(3, -8), **note)
    else:
        axes.annotate("budget of 1 ms: below", (0.0, 0.0), xycoords="axes fraction", xytext=(3, 3), **note)


def draw(results, narrow=False):
    """@param narrow  for a page as wide as a telephone: the panels stand over each other"""
    style.use_style()
    points = [Point(result, method) for result in results for method in result.methods.values()]
    names = list(dict.fromkeys(point.mark for point in points))
    methods = [SimpleNamespace(label=method.series, name=method.name, order=method.order) for method in (point.method for point in points)]
    colours, lines = style.colours_of(methods), {label: style.round_line(number) for label, number in style.rounds_of(methods).items()}
    markers = dict(zip(names, MARKERS * (len(names) // len(MARKERS) + 1)))
    width, height, rows = (0.5 * style.TWO_COLUMNS_IN, 6.2, len(PANELS)) if narrow else (style.TWO_COLUMNS_IN, 3.5, 1)
    inch = 3.5 / height
    figure, axes = plt.subplots(rows, len(PANELS) // rows, figsize=(width, height), sharey=True, gridspec_kw={
        "left": 0.2 if narrow else 0.102, "right": 0.985, "bottom": 0.145 * inch, "top": 0.92, "wspace": 0.08, "hspace": 0.22})
    for panel, quantities in zip(axes, PANELS):
        draw_panel(panel, points, *quantities, markers, colours, lines)
    time_axis(axes[0], points)
    for panel in axes:
        mark_budget(panel)
    for panel in axes if narrow else axes[:1]:
        panel.set_ylabel("run time per frame in contact [ms]\nmedian, whisker to 99th percentile")
    keys = [Line2D([], [], color=colour, lw=2.5 if lines[label] == "-" else 1.2, ls=lines[label], label=style.shortened(label))
            for label, colour in colours.items()]
    keys += [Line2D([], [], color="#444444", ls="none", marker=markers[name], ms=5.5, mew=0, label=style.shortened(name))
             for name in names if len(names) > 1]
    if len(names) > len(MARKERS):
        keys.append(Line2D([], [], ls="none", label=f"marks repeat: there are {len(MARKERS)}"))
    keys.append(Line2D([], [], color="white", ls="none", marker="o", ms=5, mec="#444444", mew=0.9,
                       label="open: neighbouring features count as found"))
    style.note_failures(figure, {f"{point.method.label} in {point.experiment}": point.failure for point in points if point.failure})
    _, key_lines = style.legend_within(figure, keys, 0.02 if narrow else 0.095, 0.995, "upper left", LEGEND_LAYOUTS)
    axes[0].get_gridspec().update(top=0.975 - 0.055 * inch * key_lines)
    return figure


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="+", metavar="RESULT.h5", help="result files with a truth probe")
    parser.add_argument("--out", required=True, metavar="DIR",
                        help="directory of work_precision.svg and work_precision.png")
    arguments = parser.parse_args(argv)
    return style.leave(draw(open_results(arguments.results)), arguments.out, "work_precision")


if __name__ == "__main__":
    raise SystemExit(run_script(main))
