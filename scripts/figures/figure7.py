#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 7 of the paper from two result files: hard contact on the left, soft contact on the right; over time the
force, the LMD counts, the time of global searches and of local updates of the original and the improved algorithm.
Beyond the paper: the true force beside both forces, and the share of true LMDs that each method knows. Times are
medians over the repetitions without the warm-up."""

import argparse

import numpy as np

import figure_style as style
from lmdbench_results import Result, reference_force, run_script, truth_of

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, MaxNLocator

METHODS = ("original", "improved")
RECALL_BINS = 40  # a frame has so few LMDs that its own recall is mostly 0 or 1
TRUTH_COLOURS = {"linear": style.GREY, "exponential": style.BLACK}
# A time axis ends above this quantile: what a busy machine adds to single samples must not flatten the rest. What is
# cut off is marked at the upper edge with its number and largest value.
AXIS_QUANTILE = 0.995
AXIS_MARGIN = 1.25


def plot_force(axes, result):
    for label in METHODS:
        method = result.method(label)
        axes.plot(result.time, method.force_magnitude(), color=style.colour_of(method), ls=style.line_of(method),
                  lw=0.7, zorder=2 + METHODS.index(label))
    for law in dict.fromkeys(result.method(label).force_law for label in METHODS):
        frames, force = reference_force(result, law)
        if frames.size:
            axes.plot(result.time[frames], force, ls="none", marker=".", ms=1.6, mew=0, color=TRUTH_COLOURS[law],
                      zorder=5)
    axes.set_ylim(bottom=0)


def plot_counts(axes, result):
    for label in METHODS:
        method = result.method(label)
        axes.plot(result.time, method.read("lmd_count"), color=style.colour_of(method), ls=style.line_of(method),
                  lw=0.7, zorder=2 + METHODS.index(label))
    improved = result.method("improved")
    axes.plot(result.time, improved.read("lmd_count_before_reduction"), color=style.SKY, lw=0.8, zorder=1)
    # Linear up to 1, so that no LMD at all has its place; logarithmic above.
    axes.set_yscale("symlog", linthresh=1, linscale=0.5)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.set_ylim(bottom=0)


def plot_searches(axes, result):
    for label in METHODS:
        method = result.method(label)
        time = result.time[method.read("global_frame").astype(int)]
        search = method.median_times("global_search_time") * 1e3
        if label == "improved":
            total = search + np.nan_to_num(method.median_times("first_reduction_time")) * 1e3
            axes.plot(time, search, color=style.SKY, lw=0.9, zorder=2)
            axes.plot(time, total, color=style.colour_of(method), ls=style.line_of(method), lw=0.9, zorder=3)
        else:
            axes.plot(time, search, color=style.colour_of(method), ls=style.line_of(method), lw=0.9, zorder=4)
    limit_time_axis(axes)


def plot_updates(axes, result):
    for label in METHODS:
        method = result.method(label)
        axes.plot(result.time, method.median_times("local_update_time") * 1e3, color=style.colour_of(method),
                  ls=style.line_of(method), lw=0.6, zorder=2 + METHODS.index(label))
    limit_time_axis(axes)


def plot_recall(axes, result):
    for label in METHODS:
        method = result.method(label)
        truth = truth_of(method)
        if truth is None:
            axes.text(0.5, 0.5, "no truth probe in this run", transform=axes.transAxes, ha="center", va="center")
            break
        edges = np.linspace(result.time[0], result.time[-1], RECALL_BINS + 1)
        bins = np.clip(np.digitize(result.time[truth.frames], edges) - 1, 0, RECALL_BINS - 1)
        recall = [truth.pooled(truth.recall[bins == i], truth.true_count[bins == i]) for i in range(RECALL_BINS)]
        axes.stairs(np.array(recall) * 100.0, edges, baseline=None, color=style.colour_of(method),
                    ls=style.line_of(method), lw=1.0, zorder=2 + METHODS.index(label))
    axes.set_ylim(-3, 103)


def limit_time_axis(axes):
    """Cuts single extreme samples off the axis and says so."""
    values = np.concatenate([line.get_ydata() for line in axes.lines])
    values = values[np.isfinite(values)]
    if not values.size:
        return
    top = AXIS_MARGIN * np.quantile(values, AXIS_QUANTILE)
    beyond = values[values > top]
    if not beyond.size:
        axes.set_ylim(bottom=0)
        return
    axes.set_ylim(0, top)
    axes.text(0.995, 0.97, f"{beyond.size} above, up to {beyond.max():.3g} ms", transform=axes.transAxes, ha="right",
              va="top", fontsize=6, color="#555555")


def key(label, colour, line="-", marker=None, width=1.2):
    return Line2D([], [], color=colour, ls=line, marker=marker, ms=3, mew=0, lw=width, label=label)


def keys_of_rows(result):
    original, improved = (result.method(label) for label in METHODS)
    base = [key("original", style.colour_of(original), style.line_of(original)),
            key("improved", style.colour_of(improved), style.line_of(improved))]
    laws = [key(f"truth, {law} law", TRUTH_COLOURS[law], "none", ".")
            for law in dict.fromkeys(method.force_law for method in (original, improved))]
    return [
        base + laws,
        base + [key("improved, before reduction", style.SKY)],
        [base[0], key("improved, search alone", style.SKY),
         key("improved, with first reduction", style.colour_of(improved), style.line_of(improved))],
        base,
        base,
    ]


ROWS = (
    (plot_force, "force [N]", 1.35),
    (plot_counts, "LMDs [1]", 1.0),
    (plot_searches, "global search [ms]", 1.0),
    (plot_updates, "local update [ms]", 1.0),
    (plot_recall, "true LMDs\nknown [%]", 0.8),
)


def draw(results):
    """One figure with a column a result; `results` maps the column's heading to the result."""
    style.use_style()
    heights = [height for _, _, height in ROWS]
    figure, axes = plt.subplots(
        len(ROWS), len(results), figsize=(style.TWO_COLUMNS_IN, 8.3), sharex="col", squeeze=False,
        gridspec_kw={"height_ratios": heights, "hspace": 0.42, "wspace": 0.2, "left": 0.085, "right": 0.99,
                     "top": 0.935, "bottom": 0.05})
    for column, (heading, result) in enumerate(results.items()):
        for row, (plot, _, _) in enumerate(ROWS):
            plot(axes[row, column], result)
            axes[row, column].yaxis.set_major_locator(axes[row, column].yaxis.get_major_locator()
                                                      if plot is plot_counts else MaxNLocator(4, min_n_ticks=3))
        axes[0, column].set_title(heading, pad=20, fontweight="bold")
        axes[-1, column].set_xlabel("time [s]")
        axes[-1, column].set_xlim(result.time[0], result.time[-1])
    for row, ((_, label, _), keys) in enumerate(zip(ROWS, keys_of_rows(next(iter(results.values()))))):
        axes[row, 0].set_ylabel(label)
        box = axes[row, 0].get_position()
        figure.legend(handles=keys, loc="lower left", bbox_to_anchor=(box.x0 - 0.008, box.y1 + 0.001), ncol=len(keys),
                      handlelength=2.6, columnspacing=1.6, borderpad=0.1, handletextpad=0.6)
    figure.align_ylabels(axes[:, 0])
    return figure


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("hard", help="result file of the experiment with hard contact")
    parser.add_argument("soft", help="result file of the experiment with soft contact")
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of figure7.svg and figure7.png")
    arguments = parser.parse_args(argv)
    figure = draw({"hard contact": Result(arguments.hard), "soft contact": Result(arguments.soft)})
    for file in style.save(figure, arguments.out, "figure7"):
        print(file)
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
