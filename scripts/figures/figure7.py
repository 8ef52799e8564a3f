#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 7 of the paper from two result files: hard contact on the left, soft contact on the right; over time the
force, the LMD counts, the time of global searches and of local updates of the methods that search now and then and
track locally in between.
Beyond the paper: the true force beside both forces, and the share of true LMDs that each method knows. Times are
medians over the repetitions without the warm-up."""

import argparse

import numpy as np

import figure_style as style
from lmdbench_results import Result, reference_force, run_script, truth_of

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, MaxNLocator, NullLocator

RECALL_BINS = 40  # a frame has so few LMDs that its own recall is mostly 0 or 1
# Truth is a wide pale band: where a method is right, its line runs inside.
TRUTH_COLOURS = {"linear": style.PALE_GREY, "exponential": style.YELLOW}
TRUTH_WIDTH = 2.6
# A time axis ends above this quantile: what a busy machine adds to single samples must not flatten the rest. What is
# cut off is told with its number and largest value.
AXIS_QUANTILE = 0.995
AXIS_MARGIN = 1.25
NOTABLE_EXCESS = 1.5  # what exceeds the axis by less widens it instead
SHORTEST_UPDATE_US = 0.1  # lower end of its axis: below lies the update of an empty set
HAPTIC_BUDGET_US = 1000.0  # one frame at 1 kHz
NOTE = {"fontsize": 6.2, "color": "#444444"}


def shown(result):
    """Methods at two rates, under their own names."""
    return [method for method in result.methods.values() if method.tracks_locally and method.label == method.name]


def look(method):
    return {"color": style.colour_of(method), "ls": style.line_of(method), "lw": 1.0 if method.reduces else 0.6,
            "zorder": 2 + method.order}


def note(axes, text):
    axes.text(0.995, 0.97, text, transform=axes.transAxes, ha="right", va="top", zorder=9,
              bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8}, **NOTE)


def plot_force(axes, result):
    for method in shown(result):
        axes.plot(result.time, method.force_magnitude(), **look(method))
    for law in dict.fromkeys(method.force_law for method in shown(result)):
        frames, force = reference_force(result, law)
        if frames.size:
            axes.plot(result.time[frames], force, lw=TRUTH_WIDTH, color=TRUTH_COLOURS[law], zorder=1,
                      solid_capstyle="round", solid_joinstyle="round")
    limit = result.scene("device_maximum_force_n")
    highest = max(float(line.get_ydata().max(initial=0.0)) for line in axes.lines)
    if highest >= 0.99 * limit:
        axes.axhline(limit, color=style.GREY, lw=0.6, ls=(0, (1, 1.5)), zorder=1)
        axes.annotate(f"device clips at {limit:g} N", (0.0, limit), xycoords=("axes fraction", "data"), xytext=(2, 1.5),
                      textcoords="offset points", **NOTE)
        highest = 1.1 * limit
    axes.set_ylim(0, 1.03 * highest if highest > 0 else 1.0)
    axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]))


def plot_counts(axes, result):
    for method in shown(result):
        axes.plot(result.time, method.read("lmd_count"), **look(method))
    for method in shown(result):
        if method.reduces:
            axes.plot(result.time, method.read("lmd_count_before_reduction"), color=style.SKY, lw=0.8, zorder=1)
    # Linear up to 1, so that no LMD at all has its place; logarithmic above.
    axes.set_yscale("symlog", linthresh=1, linscale=0.5)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.set_ylim(bottom=0)


def plot_searches(axes, result):
    for method in shown(result):
        time = result.time[method.read("global_frame").astype(int)]
        search = method.median_times("global_search_time") * 1e3
        if method.reduces:
            axes.plot(time, search, color=style.SKY, lw=0.9, zorder=2)
            search = search + np.nan_to_num(method.median_times("first_reduction_time")) * 1e3
        axes.plot(time, search, **{**look(method), "lw": 0.9})
    values = np.concatenate([line.get_ydata() for line in axes.lines])
    values = values[np.isfinite(values)]
    top = AXIS_MARGIN * np.quantile(values, AXIS_QUANTILE) if values.size else 1.0
    beyond = values[values > top]
    if beyond.size and beyond.max() > NOTABLE_EXCESS * top:
        note(axes, f"{beyond.size} above, up to {beyond.max():.3g} ms")
        axes.set_ylim(0, top)
    else:
        axes.set_ylim(bottom=0)
    axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))


def plot_updates(axes, result):
    for method in shown(result):
        axes.plot(result.time, method.median_times("local_update_time") * 1e6, **{**look(method), "lw": 0.6})
    axes.set_yscale("log")
    axes.set_ylim(bottom=SHORTEST_UPDATE_US)
    axes.yaxis.set_major_locator(LogLocator(numticks=12))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    if axes.get_ylim()[1] > HAPTIC_BUDGET_US:
        axes.axhline(HAPTIC_BUDGET_US, color=style.GREY, lw=0.6, ls=(0, (1, 1.5)), zorder=1)
        axes.annotate("1 kHz", (0.0, HAPTIC_BUDGET_US), xycoords=("axes fraction", "data"), xytext=(2, 1.5),
                      textcoords="offset points", **NOTE)


def plot_recall(axes, result):
    axes.set_ylim(-4, 104)
    axes.yaxis.set_major_locator(FixedLocator([0, 50, 100]))
    edges = np.linspace(result.time[0], result.time[-1], RECALL_BINS + 1)
    for method in shown(result):
        truth = truth_of(method)
        if truth is None:
            axes.text(0.5, 0.5, "no truth probe in this run", transform=axes.transAxes, ha="center", va="center")
            return
        bins = np.clip(np.digitize(result.time[truth.frames], edges) - 1, 0, RECALL_BINS - 1)
        for shares, options in ((truth.recall, {**look(method), "lw": 1.1}),
                                (truth.recall_adjacent, {**look(method), "lw": 0.8, "ls": ":"})):
            found = [truth.found_in(shares, bins == i) for i in range(RECALL_BINS)]
            axes.stairs(np.array(found) * 100.0, edges, baseline=None, **options)


def key(label, colour, line="-", width=1.2):
    return Line2D([], [], color=colour, ls=line, lw=width, label=label)


def keys_of_rows(result):
    methods = shown(result)
    base = [key(method.label, style.colour_of(method), style.line_of(method), width=1.5 if method.reduces else 1.0)
            for method in methods]
    laws = [key(f"truth, {law} law", TRUTH_COLOURS[law], width=TRUTH_WIDTH)
            for law in dict.fromkeys(method.force_law for method in methods)]
    searches = []
    for method, plain in zip(methods, base):
        if method.reduces:
            searches.append(key(f"{method.label}, search alone", style.SKY))
            searches.append(key(f"{method.label}, with first reduction", style.colour_of(method), style.line_of(method)))
        else:
            searches.append(plain)
    near = [key("dotted: a neighbouring feature counts, too", "#444444", ":", width=0.9)]
    return [
        base + laws,
        base + [key(f"{method.label}, before reduction", style.SKY) for method in methods if method.reduces],
        searches,
        base,
        base + near,
    ]


ROWS = (
    (plot_force, "force [N]", 1.5),
    (plot_counts, "LMDs [1]", 1.0),
    (plot_searches, "global search [ms]", 1.0),
    (plot_updates, "local update [\u00b5s]", 1.0),
    (plot_recall, "LMDs known [%]", 0.9),
)


def heading(name, result):
    return f"{name} contact: cutoff {result.scene('cutoff_m') * 1e3:g} mm, $F_{{max}}$ {result.maximum_force():g} N"


def draw(hard, soft):
    style.use_style()
    heights = [height for _, _, height in ROWS]
    figure, axes = plt.subplots(
        len(ROWS), 2, figsize=(style.TWO_COLUMNS_IN, 8.4), sharex="col",
        gridspec_kw={"height_ratios": heights, "hspace": 0.36, "wspace": 0.16, "left": 0.092, "right": 0.992,
                     "top": 0.932, "bottom": 0.046})
    for column, (name, result) in enumerate((("hard", hard), ("soft", soft))):
        for panel, (plot, _, _) in zip(axes[:, column], ROWS):
            plot(panel, result)
        axes[0, column].set_title(heading(name, result), pad=19, fontweight="bold")
        axes[-1, column].set_xlabel("time [s]")
        axes[-1, column].set_xlim(result.time[0], result.time[-1])
    for row, ((_, label, _), keys) in enumerate(zip(ROWS, keys_of_rows(hard))):
        axes[row, 0].set_ylabel(label)
        axes[row, 0].yaxis.set_label_coords(-0.125, 0.5)
        box = axes[row, 0].get_position()
        figure.text(0.012, box.y1 + 0.0045, "abcdefgh"[row], fontweight="bold", fontsize=8.5)
        figure.legend(handles=keys, loc="lower left", bbox_to_anchor=(box.x0 - 0.008, box.y1 - 0.003), ncol=len(keys),
                      handlelength=2.6, columnspacing=1.6, borderpad=0.1, handletextpad=0.6)
    return figure


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("hard", help="result file of the experiment with hard contact")
    parser.add_argument("soft", help="result file of the experiment with soft contact")
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of figure7.svg and figure7.png")
    arguments = parser.parse_args(argv)
    figure = draw(Result(arguments.hard), Result(arguments.soft))
    for file in style.save(figure, arguments.out, "figure7"):
        print(file)
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
