#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Error against run time of a sweep (`lmdbench work-precision`), log-log, a panel a problem (a scene, and what of its truth the
sweep varies): each series a line along its axis, one for each value of further axes, the Pareto front in grey, points without any error and points that fail in lanes of their own. And the tables:
which method at which budget, where one gets cheaper than another, and every point."""

import argparse
import itertools
import math

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import NOT_JUDGED, ROUNDING, run_script
from intervals import Rate
from sweep_results import Sweep, along_period, crossing, front, lines
from tables import as_is, shown, table, write_text

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

MARKERS = ("o", "s", "D", "^", "v", "P", "X", "<")
BUDGETS_MS = (3.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0)  # run time of a second of haptics
MOST_COLUMNS = 3  # problems side by side; more go below
MOST_PANELS = 24  # problems in one figure; the tables hold all
LONGEST_TITLE = 34  # letters of a line of a panel's title
LANE = 0.35  # height in decades of the lanes for errors of 0 and failures


def cost(point):
    return 1e3 * point.number("processor_share")


def error(point):
    return 100.0 * point.force_error


def drawn_error(point):
    return error(point) if not point.force_error < ROUNDING else 0.0


QUANTITIES = (
    ("force", "RMS force error [% of $F_{max}$]", drawn_error),
    ("missed", "missed share of true LMDs [%]", lambda point: 100.0 * (1.0 - point.number("recall"))),
)


def colours_of(sweep):
    """By series: methods of the paper keep the colours of the other figures."""
    used, colours = set(), {}
    for series in sweep.series:
        point = sweep.of(series=series)[0]
        if series == point.method:
            colours[series] = style.METHOD_COLOURS[int(point.number("method_order")) % len(style.METHOD_COLOURS)]
            used.add(colours[series])
    free = itertools.cycle([colour for colour in style.METHOD_COLOURS if colour not in used] or style.METHOD_COLOURS)
    return {series: colours.get(series) or next(free) for series in sweep.series}


def levels(points, value):
    """(low, high) decades of the positive errors."""
    positive = [value(point) for point in points if not point.trouble and value(point) > 0 and np.isfinite(value(point))]
    low = math.floor(math.log10(min(positive)) * 2 - 0.2) / 2 if positive else -1.0
    high = math.log10(max(positive)) + 0.12 if positive else 2.0
    return low, high


def draw_panel(axes, points, value, colours, markers):
    points = [point for point in points if point.trouble != NOT_JUDGED]
    low, high = levels(points, value)
    has_zero = any(not point.trouble and value(point) == 0 for point in points)
    has_failed = any(point.trouble for point in points)
    axes.set(xscale="log", yscale="log")
    zero, failed, (bottom, top) = style.lanes(axes.yaxis, axes.axhspan, low, high, LANE, has_zero, has_failed)
    axes.set_ylim(bottom, top)
    axes.yaxis.set_minor_locator(FixedLocator([step * 10.0**power for power in range(math.floor(low), math.floor(high) + 1)
                                               for step in range(2, 10) if 10**low <= step * 10.0**power < 10**high]))
    axes.xaxis.set_major_locator(FixedLocator(style.labelled(*np.log10(axes.get_xlim()))))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda at, _: f"{at:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())

    def place(point):
        return failed if point.trouble else max(value(point), zero) if value(point) > 0 else zero

    best = front(points, cost, value)
    if best:
        steps = [(cost(best[0]), top)]
        for point in best:
            steps += [(cost(point), steps[-1][1]), (cost(point), place(point))]
        axes.plot([x for x, _ in steps] + [axes.get_xlim()[1] * 1e3], [y for _, y in steps] + [steps[-1][1]],
                  color=style.PALE_GREY, lw=3.0, zorder=1, solid_capstyle="butt")
    taken = []  # boxes of labels, in inches
    for series in dict.fromkeys(point.series for point in points):
        for line in lines([point for point in points if point.series == series]):
            drawn = [point for point in line.points if np.isfinite(cost(point)) and (np.isfinite(value(point)) or point.trouble)]
            axes.plot([cost(point) for point in drawn], [place(point) for point in drawn], color=colours[series], lw=0.8,
                      ls="-" if line.place else "none", marker=markers[series], ms=4.2, mec="white", mew=0.4, zorder=3)
            for point in drawn:
                if point.trouble:
                    axes.plot(cost(point), failed, marker="x", color=colours[series], ms=5, zorder=4)
            for point in dict.fromkeys([*drawn[:1], *drawn[-1:]]):
                if line.value(point):
                    label(axes, line.value(point), cost(point), place(point), colours[series], taken)


LABEL_PT = 5.5


def label(axes, text, x, y, colour, taken):
    """Beside its point, above or below, where no other label stands; not at all where all is taken."""
    width, height = (0.55 * LABEL_PT * len(text) + 1) / 72, 1.05 * LABEL_PT / 72  # inches
    at = axes.transData.transform((x, y)) / axes.figure.dpi
    edge = axes.transAxes.transform((1.0, 0.0))[0] / axes.figure.dpi
    for dx, dy in ((3, 3), (3, -8), (-3 - 72 * width, 3), (-3 - 72 * width, -8), (3, 10), (3, -15)):
        left, bottom = at[0] + dx / 72, at[1] + dy / 72
        box = (left, bottom, left + width, bottom + height)
        if box[2] > edge + 0.02 or any(box[0] < b[2] and b[0] < box[2] and box[1] < b[3] and b[1] < box[3] for b in taken):
            continue
        taken.append(box)
        axes.annotate(style.literal(text), (x, y), xytext=(dx, dy), textcoords="offset points", fontsize=LABEL_PT, color=colour, zorder=5)
        return


def axis_names(sweep):
    """The axes that lines run along or that tell them apart, in words."""
    found = []
    for problem in sweep.problems:
        for series in sweep.series:
            for line in lines(sweep.of(series=series, problem=problem)):
                found += [place for place in [line.place, *line.fixed] if place]
    return [place.rsplit("/", 1)[-1].replace("_", " ") for place in dict.fromkeys(found)]


def titles(sweep):
    """{problem: the title of its panel}: what all problems of the figure share is not said again and again."""
    found = {problem: problem.split(", ") for problem in sweep.problems}
    names = {parts[0] for parts in found.values()}
    told = {problem: parts[1:] if len(names) == 1 and len(parts) > 1 else parts for problem, parts in found.items()}
    return {problem: ",\n".join(style.shortened(part, LONGEST_TITLE) for part in parts) for problem, parts in told.items()}


def draw(sweep):
    style.use_style()
    colours = colours_of(sweep)
    markers = dict(zip(sweep.series, itertools.cycle(MARKERS)))
    problems, panel_titles = sweep.problems[:MOST_PANELS], titles(sweep)
    columns = min(len(problems), MOST_COLUMNS)
    bands = -(-len(problems) // columns)  # rows of problems, each with all quantities
    heads = max(title.count("\n") for title in panel_titles.values())  # further lines of the titles
    key_rows = -(-(len(sweep.series) + 1) // 6)
    top = 0.66 + 0.16 * key_rows + 0.13 * heads
    height = top + 0.1 + 2.1 * len(QUANTITIES) * bands + (0.35 + 0.13 * heads) * (bands - 1)
    figure = plt.figure(figsize=(style.TWO_COLUMNS_IN, height))
    outer = figure.add_gridspec(bands, 1, left=0.085, right=0.99, bottom=0.43 / height, top=1 - top / height,
                                hspace=(0.2 * 2.1 * len(QUANTITIES) + 0.13 * heads) / (2.1 * len(QUANTITIES)))
    for band in range(bands):
        grid = outer[band].subgridspec(len(QUANTITIES), columns, wspace=0.2, hspace=0.08).subplots(squeeze=False, sharex="col")
        for column in range(columns):
            problem = problems[band * columns + column] if band * columns + column < len(problems) else None
            for row, (_, label, value) in enumerate(QUANTITIES):
                axes = grid[row][column]
                if problem is None:
                    axes.set_axis_off()
                    continue
                points = sweep.of(problem=problem)
                costs = [cost(point) for point in points if np.isfinite(cost(point))]
                if costs:
                    axes.set_xlim(min(costs) / 1.5, max(costs) * 1.5)
                draw_panel(axes, points, value, colours, markers)
                if column == 0:
                    axes.set_ylabel(label)
            if problem is not None:
                grid[0][column].set_title(panel_titles[problem], loc="left", fontsize=8)
                grid[-1][column].set_xlabel("run time [ms/s]")
    keys = [Line2D([], [], color=colours[series], marker=markers[series], ms=4.2, mec="white", mew=0.4, lw=0.8, label=style.shortened(series))
            for series in sweep.series]
    keys.append(Line2D([], [], color=style.PALE_GREY, lw=3, label="Pareto front"))
    heading = figure.text(0.085, 1 - 0.18 / height, "Error against run time of a second in contact" + (f"; labels: {', '.join(axis_names(sweep))}" if axis_names(sweep) else "")
                + (f"; {len(sweep.problems) - MOST_PANELS} more problems in the tables" if len(sweep.problems) > MOST_PANELS else ""), fontsize=7.5, fontweight="bold")
    while style.width_of(figure, heading)[1] > 0.995 and heading.get_fontsize() > 4.0:  # many axes have many names
        heading.set_fontsize(heading.get_fontsize() - 0.5)
    style.note_failures(figure, {f"{point.text()} in {point.problem}": point.trouble for point in sweep.points if point.trouble})
    figure.legend(handles=keys, loc="upper left", bbox_to_anchor=(0.075, 1 - 0.23 / height), ncol=6, handlelength=1.8, columnspacing=1.4,
                  borderpad=0.1)
    return figure


def whole(value):
    return f"{value:.0f}" if math.isfinite(value) else "-"


def budget_table(sweep):
    rows = []
    for problem in sweep.problems:
        cells = []
        for budget in BUDGETS_MS:
            able = [point for point in sweep.of(problem=problem) if not point.trouble and cost(point) <= budget]
            best = min(able, key=lambda point: (error(point), cost(point)), default=None)
            cells.append(f"{best.text()}: {shown(error(best))} %" if best else "none")
        rows.append([problem, *cells])
    return table(["problem", *(f"{budget:g} ms/s" for budget in BUDGETS_MS)], rows)


def crossings(sweep, cheaper="improved", reference="certified"):
    """Lines of a table, a row a line of points that only the period tells apart; none where nothing gets cheaper. The reference is
    its cheapest point."""
    rows = []
    for problem in sweep.problems:
        exact = min((point for point in sweep.of(problem=problem, series=reference) if not point.trouble), key=cost, default=None)
        if exact is None:
            continue
        for others, points in along_period(sweep.of(problem=problem, series=cheaper)):
            by_cost = crossing(points, cost(exact), cost)
            by_median = crossing(points, exact.number("frame_time_median_s"), lambda point: point.number("frame_time_median_s"))
            if not (math.isfinite(by_cost) or math.isfinite(by_median)):
                continue
            beyond = next((point for point in sorted(points, key=lambda point: point.period) if point.period >= by_cost), None)
            at = f"{shown(error(beyond))} (at {beyond.period})" if beyond else "-"
            recall = f"{shown(100 * beyond.number('recall'))} (at {beyond.period})" if beyond else "-"
            rows.append([", ".join([problem, *others]), whole(by_cost), whole(by_median), at, recall])
    return rows and table(["problem", "run time: every ... frames", "median frame: every ... frames", "force error there [% of F_max]",
                           "recall there [%]"], rows)


def a_second(point, name):
    """Events a second in contact with their interval; below ten of them how many in what time."""
    return Rate([point.number(name)], [point.number("seconds_in_contact")])


COLUMNS = (
    ("run time [ms/s]", cost),
    ("frame, median [us]", lambda p: 1e6 * p.number("frame_time_median_s")),
    ("99 % [us]", lambda p: 1e6 * p.number("frame_time_p99_s")),
    ("largest [us]", lambda p: 1e6 * p.number("frame_time_maximum_s")),
    ("above 1 ms", lambda p: p.number("frames_late")),
    ("force error, RMS [% of F_max]", error),
    ("99 %", lambda p: 100 * p.number("force_error_p99_n") / p.number("maximum_force_n")),
    ("largest", lambda p: 100 * p.number("force_error_maximum_n") / p.number("maximum_force_n")),
    ("of its length, RMS", lambda p: 100 * p.number("force_magnitude_error_rms_n") / p.number("maximum_force_n")),
    ("angle, median [deg]", lambda p: math.degrees(p.number("force_angle_error_median_rad"))),
    ("99 % [deg]", lambda p: math.degrees(p.number("force_angle_error_p99_rad"))),
    ("torque, RMS [mN m]", lambda p: 1e3 * p.number("torque_error_rms_n_m")),
    ("recall [%]", lambda p: 100 * p.number("recall")),
    ("with neighbours [%]", lambda p: 100 * p.number("recall_adjacent")),
    ("precision [%]", lambda p: 100 * p.number("precision")),
    ("nearest distance, largest error [um]", lambda p: 1e6 * p.number("minimum_distance_error_maximum_m")),
    ("false jumps [1/s, 95 %]", lambda p: a_second(p, "false_jumps")),
    ("missed jumps [1/s, 95 %]", lambda p: a_second(p, "missed_jumps")),
    ("true jumps [1/s, 95 %]", lambda p: a_second(p, "true_jumps")),
    # Not with the deaths, which are as many: two of each event would make the interval too narrow.
    ("births [1/s, 95 %]", lambda p: a_second(p, "births")),
    ("true births [1/s, 95 %]", lambda p: a_second(p, "true_births")),
)


def point_table(sweep, problem):
    rows = []
    best = {point.index for point in front(sweep.of(problem=problem), cost, error)}
    for point in sorted(sweep.of(problem=problem), key=lambda point: (bool(point.failure), cost(point))):
        name = f"**{point.text()}**" if point.index in best else point.text()
        if point.failure:
            rows.append([f"{name}: failed, {point.failure}", *[""] * len(COLUMNS)])
            continue
        values = [value(point) for _, value in COLUMNS]
        rows.append([f"{name}{' (' + point.trouble + ')' if point.trouble else ''}", *(found if isinstance(found, Rate) else shown(found) for found in values)])
    return table(["point", *(name for name, _ in COLUMNS)], rows)


def load(sweep):
    """A word on a machine that had other work, too: its longest times say little then."""
    average, processors = (float(sweep.machine.get(name, "nan")) for name in ("load_average_1_minute", "usable_processors"))
    if not average > processors:
        return ""
    return (f" The machine was under load (average {average:.1f} on {processors:g} processors): errors and counts do not "
            "depend on it, medians little; run times, 99th percentiles and largest times hold some of it.")


MEAN_EDGES = {"bunny-16k": 0.0128, "armadillo": 0.0068}  # of the diagonal: `lmdbench mesh info`


def cutoff_text(point):
    experiment = point.experiment
    force, moving = experiment.get("force", {}), (experiment.get("moving") or experiment["objects"][0])["mesh"]
    force = force[0] if isinstance(force, list) else force
    share = force.get("cutoff_diagonal")
    if share is None:
        return f"Cutoff {1e3 * force['cutoff_m']:g} mm." if "cutoff_m" in force else "Cutoff: the default."
    edges = f", {shown(share / MEAN_EDGES[moving], 2)} mean edges of `{moving}`" if moving in MEAN_EDGES else ""
    return f"Cutoff {100 * share:g} % of the diagonal{edges}."


def markdown(sweep, picture):
    measured = [point for point in sweep.points if not point.failure]
    checked, wrong = (sum(int(point.number(name)) for point in {p.problem: p for p in measured}.values())
                      for name in ("truth_checked_frames", "truth_wrong_frames"))
    compared = f"{checked} frames of the problems ({wrong or 'none'} differ)" if checked else "no frame"
    kernels = any(point.axis("kernel") for point in sweep.points)
    text = [
        "# Error against run time", "",
        f"{as_is(sweep.title)}. Made by `{sweep.command}` and "
        f"`scripts/figures/sweep.py {sweep.file}` at commit {sweep.commit()} on {sweep.machine.get('processor', 'one machine')}; "
        f"`certified` {'with the instructions that its points name' if kernels else 'with vector instructions'}, `original` and `improved` scalar.", "",
        f"Truth in every frame is the set of `certified`, compared with `exhaustive` in {compared}. Forces are compared under each method's own law. Points take turns in "
        f"random order; a frame counts with the median of its repetitions; reading the clock costs {sweep.clock_overhead_ns:.0f} ns of every time.{load(sweep)}", ""]
    if picture:
        text += [f"![Error against run time]({picture})", ""]
    text += ["## Which method at which budget", "",
              "Least RMS force error [% of F_max of one LMD] within so much run time of a second in contact, searches included:", "",
              *budget_table(sweep)]
    cheaper = crossings(sweep)
    if cheaper:
        text += ["## Where `improved` gets cheaper than `certified`", "",
                  "Searches rarer than every so many frames make `improved` cheaper than `certified`, and its sets older. Problems without a row: "
                  "never.", "", *cheaper]
    for problem in sweep.problems:
        text += [f"## {as_is(problem)}", "", f"{cutoff_text(sweep.of(problem=problem)[0])} Bold: on the Pareto front of force error and run time.", "", *point_table(sweep, problem)]
    return "\n".join(text)


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sweep", metavar="SWEEP.h5", help="what `lmdbench work-precision` wrote")
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of NAME.svg, NAME.png and NAME.md")
    parser.add_argument("--name", default=None, help="name of the files; that of the sweep without it")
    arguments = parser.parse_args(argv)
    sweep = Sweep(arguments.sweep)
    name = arguments.name or sweep.name
    style.leave(draw(sweep), arguments.out, name)
    print(write_text(markdown(sweep, f"{name}.png"), arguments.out, f"{name}.md"))
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
