#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 7 of the paper from result files, in the paper hard contact on the left and soft contact on the right: over time
the force, the LMD counts, the time of global searches of the methods that search now and then and track locally in between, and
the time of local updates: all methods of a result. A column a result, or a force profile where a result has several.
Beyond the paper: the true force beside both forces, and the share of true LMDs that each method knows. Times are
medians over the repetitions without the warm-up."""

import argparse
import math
import textwrap
from types import SimpleNamespace

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import ResultError, median, no_truth, reference_force, run_script, true_forces, truth_of
from tables import counted
from variants import open_results

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, MaxNLocator, NullLocator

RECALL_BINS = 40  # the recall of one frame is mostly 0 or 1
# Truth is a wide pale band, inside of which the line of a method that is right is; pale dots where
# probed frames do not follow each other.
TRUTH_WIDTH = 2.6
# A time axis ends above this quantile, so that single samples of a busy machine do not flatten the
# rest. The figure tells how many are cut off, and the largest.
AXIS_QUANTILE = 0.995
AXIS_MARGIN = 1.25
NOTABLE_EXCESS = 1.5  # a smaller excess widens the axis
SHORTEST_UPDATE_US = 0.1  # lower end of its axis; below are updates of empty sets
HAPTIC_BUDGET_US = 1000.0  # one frame at 1 kHz
NOTE = {"fontsize": 6.2, "color": "#444444"}
LETTER = 0.6  # width of one, as a share of the font's size
MOST_COLUMNS = 4
LONGEST_LABEL = 32  # letters; it stands twice in some rows
LEGEND_LAYOUTS = ((7.0, 1), (5.5, 1), (5.5, 2), (4.5, 2))


class Column:
    """A result's methods under one force profile."""

    def __init__(self, result, methods):
        self.result, self.time = result, result.time
        self.methods = methods
        # Under several profiles the column's title has the profile: names are equal in all columns.
        self.names = {method.label: method.series for method in methods}
        named = [SimpleNamespace(label=self.names[method.label], name=method.name, order=method.order) for method in methods]
        colours, rounds = style.colours_of(named), style.rounds_of(named)
        self.look = {}
        for method in self.methods:
            name = self.names[method.label]
            self.look[method.label] = {"color": colours[name], "ls": style.line_of(method) if name == method.name else style.round_line(rounds[name]),
                                       "lw": 1.0 if method.reduces else 0.6, "zorder": 2 + method.order}

    def span(self):
        """Ends of the time axis; of a single frame they stand apart."""
        half = 0.0 if self.time[-1] > self.time[0] else 0.5 / self.result.scene("frame_rate_hz")
        return self.time[0] - half, self.time[-1] + half

    def profile(self):
        return self.methods[0].profile

    def name(self):
        return self.result.name + (f", {self.profile()}" if self.profile() else "")

    def title(self):
        method = self.methods[0]
        return f"{style.shortened(self.name())}: cutoff {method.constant('cutoff_m') * 1e3:.3g} mm, $F_{{max}}$ {method.constant('maximum_force_n'):g} N"


def columns_of(results):
    """A column a result and profile."""
    columns = []
    for result in results:
        profiles = {}
        for method in result.methods.values():
            profiles.setdefault(method.profile, []).append(method)
        columns += [Column(result, methods) for methods in profiles.values()]
    return columns


def share_axes(columns, rows):
    """Variants of one experiment are there to be compared: one scale, which holds all that each shows."""
    for panels in rows:
        groups = {}
        for panel, column in zip(panels, columns):
            if panel.lines:
                groups.setdefault((column.result.experiment_name, column.profile()), []).append(panel)
        for group in (group for group in groups.values() if len(group) > 1):
            bottom = min(panel.get_ylim()[0] for panel in group)
            tallest = max(group, key=lambda panel: panel.get_ylim()[1])
            for panel in group:
                if panel is not tallest:
                    panel.sharey(tallest)
            tallest.set_ylim(bottom=bottom)


def note_beyond(axes):
    """What a search axis cuts off."""
    beyond = [value for value in drawn_values(axes) if value > axes.get_ylim()[1]] if axes.lines else []
    if not beyond:
        return
    axes.text(0.995, 0.97, f"{counted(len(beyond), 'point')} above, up to {max(beyond):.3g} ms", transform=axes.transAxes, ha="right", va="top", zorder=9,
              bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8}, **NOTE)


def truth_look(method, frames):
    """A line between frames that were not probed would show forces that there never were."""
    shape = {"lw": TRUTH_WIDTH} if np.all(np.diff(frames) == 1) else {"ls": "none", "marker": "o", "ms": 3.6, "mew": 0}
    return {"color": style.TRUTH_COLOURS[method.force_law], **shape}


def plot_force(axes, column):
    for method in column.methods:
        axes.plot(column.time, method.force_magnitude(), **column.look[method.label])
    for _, method in true_forces(column.methods):
        frames, force = reference_force(method)
        axes.plot(column.time[frames], force, **truth_look(method, frames), zorder=1, solid_capstyle="round", solid_joinstyle="round")
    limit = column.result.scene("device_maximum_force_n")
    highest = max(float(np.nanmax(line.get_ydata(), initial=0.0)) for line in axes.lines)
    if highest >= 0.99 * limit:
        axes.axhline(limit, color=style.GREY, lw=0.6, ls=(0, (1, 1.5)), zorder=1)
        axes.annotate(f"device clips at {limit:g} N", (0.0, limit), xycoords=("axes fraction", "data"), xytext=(2, 1.5),
                      textcoords="offset points", **NOTE)
        highest = 1.1 * limit
    axes.set_ylim(0, 1.03 * highest if highest > 0 else 1.0)
    axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]))


def count_ticks(highest):
    """0, 1 and powers of ten; where no power of ten lies between 1 and the highest count, that count."""
    decades = [10.0**power for power in range(math.floor(math.log10(highest)) + 1)]
    return [0.0, *decades] + ([highest] if len(decades) == 1 and highest > 1.5 else [])


def plot_counts(axes, column):
    for method in column.methods:
        axes.plot(column.time, method.read("lmd_count"), **column.look[method.label])
    for method in column.methods:
        if method.reduces:
            axes.plot(column.time, method.read("lmd_count_before_reduction"), color=style.SKY, lw=0.8, zorder=1)
    # Linear up to 1, so that 0 LMDs can be drawn; logarithmic above.
    axes.set_yscale("symlog", linthresh=1, linscale=0.5)
    highest = max(1.0, *(float(np.nanmax(line.get_ydata(), initial=0.0)) for line in axes.lines))
    axes.yaxis.set_major_locator(FixedLocator(count_ticks(highest)))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.set_ylim(0, 1.15 * highest)


def drawn_values(axes):
    values = np.concatenate([line.get_ydata() for line in axes.lines])
    return values[np.isfinite(values)]


def say_inside(axes, words):
    """In the middle, on as many lines as keep it from the panels beside it."""
    width = axes.get_position().width * axes.figure.get_figwidth() * 72 / (LETTER * NOTE["fontsize"])
    axes.text(0.5, 0.5, textwrap.fill(words, int(width)), transform=axes.transAxes, ha="center", va="center", **NOTE)


def plot_searches(axes, column):
    searching = [method for method in column.methods if method.tracks_locally]
    if not searching:
        say_inside(axes, "no method searches at a rate of its own: the local update is the whole search")
        axes.set_yticks([])
        return
    for method in searching:
        time = column.time[method.read("global_frame").astype(int)]
        search = method.median_times("global_search_time") * 1e3
        if method.reduces:
            axes.plot(time, search, color=style.SKY, lw=0.9, zorder=2)
            search = search + np.nan_to_num(method.median_times("first_reduction_time")) * 1e3
        axes.plot(time, search, **{**column.look[method.label], "lw": 0.9})
    values = drawn_values(axes)
    top = AXIS_MARGIN * np.quantile(values, AXIS_QUANTILE) if values.size else 1.0
    cut_off = values.size and values.max() > NOTABLE_EXCESS * top
    axes.set_ylim(0, top if cut_off else None)
    axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))


def plot_updates(axes, column):
    for method in column.methods:
        axes.plot(column.time, method.median_times("local_update_time") * 1e6, **{**column.look[method.label], "lw": 0.6})
    axes.set_yscale("log")
    # Down to the fastest method's median frame: below are updates of empty sets.
    medians = [median(line.get_ydata()) for line in axes.lines]
    axes.set_ylim(bottom=min(SHORTEST_UPDATE_US, 0.5 * min([value for value in medians if value > 0], default=1.0)))
    axes.yaxis.set_major_locator(LogLocator(numticks=6))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    if axes.get_ylim()[1] > HAPTIC_BUDGET_US:
        axes.axhline(HAPTIC_BUDGET_US, color=style.GREY, lw=0.6, ls=(0, (1, 1.5)), zorder=1)
        axes.annotate("1 kHz", (0.0, HAPTIC_BUDGET_US), xycoords=("axes fraction", "data"), xytext=(2, 1.5),
                      textcoords="offset points", zorder=9, bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.3}, **NOTE)


def plot_recall(axes, column):
    axes.set_ylim(-4, 104)
    axes.yaxis.set_major_locator(FixedLocator([0, 50, 100]))
    edges = np.linspace(*column.span(), RECALL_BINS + 1)
    for method in column.methods:
        truth = truth_of(method)
        if truth is None:
            say_inside(axes, no_truth(column.result))
            return
        bins = np.clip(np.digitize(column.time[truth.frames], edges) - 1, 0, RECALL_BINS - 1)
        for shares, options in ((truth.recall, {**column.look[method.label], "lw": 1.1}),
                                (truth.recall_adjacent, {**column.look[method.label], "lw": 0.8, "ls": ":"})):
            found = [truth.found_in(shares, bins == i) for i in range(RECALL_BINS)]
            axes.stairs(np.array(found) * 100.0, edges, baseline=None, **options)


def key(label, colour, line="-", width=1.2):
    return Line2D([], [], color=colour, ls=line, lw=width, label=label)


def keys_of_rows(columns):
    """Legends of the rows; what stands in several columns is told once."""
    base, laws, searches, reducing = {}, {}, {}, []
    for column in columns:
        for method in column.methods:
            look, name = column.look[method.label], style.shortened(column.names[method.label], LONGEST_LABEL)
            plain = key(name, look["color"], look["ls"], width=1.5 if method.reduces else 1.0)
            base[name] = plain
            if method.reduces:
                searches[name] = key(f"{name}, with first reduction", look["color"], look["ls"])
                reducing.append(name)
            elif method.tracks_locally:
                searches[name] = plain
        for _, method in true_forces(column.methods):
            laws[method.force_law] = Line2D([], [], **truth_look(method, reference_force(method)[0]), label=f"truth, {method.force_law} law")
    # A single method is named; the pale lines of several look alike.
    whose = f"{reducing[0]}, " if len(set(reducing)) == 1 else "any method, "
    before, alone = ([key(whose + words, style.SKY)] if reducing else [] for words in ("before reduction", "search alone"))
    near = [key("dotted: a neighbouring feature counts, too", "#444444", ":", width=0.9)]
    base = list(base.values())
    return [base + list(laws.values()), base + before, list(searches.values()) + alone, base, base + near]


ROWS = (
    (plot_force, "force [N]", 1.5),
    (plot_counts, "LMDs [1]", 1.0),
    (plot_searches, "global search [ms]", 1.0),
    (plot_updates, "local update [\u00b5s]", 1.0),
    (plot_recall, "LMDs known [%]", 0.9),
)


def draw(*results):
    columns = columns_of(results)
    if len(columns) > MOST_COLUMNS:
        raise ResultError(f"{results[0].file}: {len(columns)} columns are more than a page holds (remedy: at most {MOST_COLUMNS} results or profiles)")
    return draw_columns(columns)


def draw_columns(columns):
    style.use_style()
    heights = [height for _, _, height in ROWS]
    figure, axes = plt.subplots(
        len(ROWS), len(columns), figsize=(style.TWO_COLUMNS_IN, 8.4), sharex="col", squeeze=False,
        gridspec_kw={"height_ratios": heights, "hspace": 0.36, "wspace": max(0.16, 0.085 * len(columns)), "left": 0.092, "right": 0.974,
                     "top": 0.932, "bottom": 0.046})
    for panels, column in zip(axes.T, columns):
        for panel, (plot, _, _) in zip(panels, ROWS):
            plot(panel, column)
            for line in panel.lines:
                if len(line.get_xdata()) == 1:
                    line.set(marker="o", markersize=3.0)
    share_axes(columns, axes)
    for panel in axes[[plot for plot, _, _ in ROWS].index(plot_searches)]:
        note_beyond(panel)
    for panels, column in zip(axes.T, columns):
        box = panels[0].get_position()
        beyond = 0.4 * (axes[0, 1].get_position().x0 - axes[0, 0].get_position().x1) if len(columns) > 1 else 0.05
        title = panels[0].set_title(column.title(), pad=19, fontweight="bold", linespacing=1.1)
        style.fit_title(figure, title, box.x0 - beyond, min(box.x1 + beyond, 0.998))
        panels[-1].set(xlabel="time [s]", xlim=column.span())
    for row, ((_, label, _), keys) in enumerate(zip(ROWS, keys_of_rows(columns))):
        axes[row, 0].set_ylabel(label)
        axes[row, 0].yaxis.set_label_coords(0.026, axes[row, 0].get_position().y0 + 0.5 * axes[row, 0].get_position().height,
                                            transform=figure.transFigure)
        box = axes[row, 0].get_position()
        figure.text(0.012, box.y1 + 0.0045, "abcdefgh"[row], fontweight="bold", fontsize=8.5)
        if keys:
            style.legend_within(figure, keys, box.x0 - 0.008, box.y1 - 0.003, "lower left", LEGEND_LAYOUTS)
    return figure


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="+", metavar="RESULT.h5", help="result files, from left to right: in the paper hard, soft")
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of figure7.svg and figure7.png")
    arguments = parser.parse_args(argv)
    return style.leave(draw(*open_results(arguments.results)), arguments.out, "figure7")


if __name__ == "__main__":
    raise SystemExit(run_script(main))
