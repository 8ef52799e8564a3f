#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The scaling figure from the file of experiments/study/scaling: run time over triangles at a fixed contact with log-log
slopes, certified's work counters over triangles, and run time over cutoff and over the number of LMDs. A point stands
at the median over the poses (work counters: at the mean). Slopes are least squares through
the medians; their 95 % intervals come from a bootstrap over poses: pose i has the same orientation and line of approach
at every size, so all sizes are drawn together."""

import argparse
import json
from pathlib import Path

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import ResultError, run_script
from tables import table_text

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

FORMAT = "lmdbench-scaling"
FORMAT_VERSION = 1
BOOTSTRAP_SAMPLES = 2000
SEED = 1  # of the bootstrap: equal files give equal figures

CERTIFIED = "certified"
# Three ways of calling certified. Name in the file: label, colour, line.
CERTIFIED_LOOKS = {
    CERTIFIED: ("certified, unrelated poses", style.GREEN, (0, (5, 1, 1, 1))),
    "certified sliding": ("certified, sliding", style.ORANGE, (0, (4, 1.5))),
    "certified coherent": ("certified, sliding, coherent", style.BLACK, "-"),
}
# Looks of the methods compared with it, in the order of the file.
PEER_LOOKS = ((style.VERMILLION, (0, (2.6, 0.8))), (style.BLUE, "-"), (style.PURPLE, ":"), (style.SKY, "--"),
              (style.GREY, (0, (1, 1))), (style.YELLOW, "-"))
REDUCED = "+reduction"  # ends the name of a search with first reduction, which replaces the search alone
STUDIES = {"dragon": "D", "bunny": "o", "armadillo": "s", "bunny-subdivided": "^"}
STUDY_LABELS = {
    "dragon": "dragon on bunny of 75k",
    "bunny": "bunny, decimated",
    "armadillo": "armadillo, decimated",
    "bunny-subdivided": "bunny, subdivided",
}
COUNTERS = {
    "node_pairs": ("node pairs tested", style.BLUE, "-"),
    "leaf_pairs": ("feature pairs tested", style.VERMILLION, (0, (2.6, 0.8))),
    "decisions": ("definition asked", style.GREEN, (0, (5, 1, 1, 1))),
    "triangle_distances": ("exact triangle distances", style.PURPLE, ":"),
}


def load(files):
    """{study: points} of all files; a study in a later file replaces that of an earlier one."""
    studies = {}
    for file in files:
        try:
            report = json.loads(Path(file).read_text(encoding="utf-8"))
        except FileNotFoundError as error:
            raise ResultError(f"{file}: there is no such file (remedy: make it with lmdbench-study scaling --json "
                              f"{file})") from error
        except json.JSONDecodeError as error:
            raise ResultError(f"{file}: {error} (remedy: run lmdbench-study scaling again)") from error
        if report.get("format") != FORMAT or report.get("format_version") != FORMAT_VERSION:
            raise ResultError(f"{file}: is no {FORMAT} of version {FORMAT_VERSION} (remedy: run lmdbench-study scaling "
                              "again)")
        for study in report["studies"]:
            studies[study["name"]] = study["points"]
    return studies


def looks(studies):
    """{name in the file: (label, colour, line)} of all that was measured: the peers, then certified."""
    points = [point for study in studies.values() for point in study]
    names = list(dict.fromkeys(name for point in points for name in point["methods"]))
    peers = [name for name in names if name not in CERTIFIED_LOOKS and name + REDUCED not in names]
    result = {name: (name, *PEER_LOOKS[index % len(PEER_LOOKS)]) for index, name in enumerate(peers)}
    return {**result, **{name: look for name, look in CERTIFIED_LOOKS.items() if name in names}}


def samples(points, method):
    """(points, poses) [us]."""
    return 1e6 * np.array([point["methods"][method]["seconds"] for point in points])


def triangles(points):
    return np.array([point["moving_triangles"] for point in points], dtype=float)


def slope_of(x, y):
    return np.polyfit(np.log(x), np.log(y), 1)[0]


def slope_with_interval(x, values):
    """Slope of the medians over poses, and the ends of its 95 % interval."""
    random = np.random.default_rng(SEED)
    poses = values.shape[1]
    draws = [slope_of(x, np.median(values[:, random.integers(0, poses, poses)], axis=1))
             for _ in range(BOOTSTRAP_SAMPLES)]
    low, high = np.quantile(draws, [0.025, 0.975])
    return slope_of(x, np.median(values, axis=1)), low, high


def sized(studies):
    """(study, its points, its mark) of those that vary the number of triangles."""
    return [(study, studies[study], marker) for study, marker in STUDIES.items() if study in studies]


def describe(axes, title, x, y="time per query [\u00b5s], median"):
    axes.set(xlabel=x, ylabel=y)
    axes.set_title(title, loc="left", fontweight="bold")


def draw_times(axes, studies):
    for _, points, marker in sized(studies):
        for method, (_, colour, line) in looks(studies).items():
            axes.plot(triangles(points), np.median(samples(points, method), axis=1), color=colour, ls=line, lw=0.8, marker=marker, ms=3.4, mec="white",
                      mew=0.4)
    describe(axes, "a  Time at gap 0.2 %, cutoff 0.5 %", "triangles of the moving mesh")


def draw_counters(axes, studies):
    for _, points, marker in sized(studies):
        for counter, (_, colour, line) in COUNTERS.items():
            values = np.array([point["methods"][CERTIFIED]["counters"][counter] for point in points], dtype=float)
            middle = np.mean(values, axis=1)  # medians of small counts would jump
            axes.plot(triangles(points), np.where(middle > 0, middle, np.nan), color=colour, ls=line, lw=0.8,
                      marker=marker, ms=3.4, mec="white", mew=0.4)
    describe(axes, "b  Work counters of certified", "triangles of the moving mesh", "work of certified per query, mean")
    keys = [Line2D([], [], color=colour, ls=line, label=label) for label, colour, line in COUNTERS.values()]
    axes.set_ylim(top=axes.get_ylim()[1] * 25)  # room for the key
    axes.legend(handles=keys, loc="upper left", ncol=2, handlelength=2.4, columnspacing=1.2)


def draw_cutoffs(axes, studies):
    points = studies["cutoff"]
    x = np.array([100 * point["cutoff"] for point in points])
    for method, (_, colour, line) in looks(studies).items():
        values = samples(points, method)
        axes.plot(x, np.median(values, axis=1), color=colour, ls=line, lw=0.9, marker="o", ms=3.2, mec="white", mew=0.4)
    describe(axes, "c  Time over cutoff, bunnies of 16k", "cutoff [% of the diagonal]")


def draw_contacts(axes, studies):
    """Times over the number of LMDs, over the poses of all cutoffs, grouped so that each group has enough poses."""
    points = studies["cutoff"]
    counts = np.concatenate([point["lmd_counts"] for point in points])
    edges = [1, 2, 3, 4, 6, 9, 13, 19, 28, 1000]
    for method, (_, colour, line) in looks(studies).items():
        values = np.concatenate(list(samples(points, method)))
        groups = [(counts >= begin) & (counts < end) for begin, end in zip(edges, edges[1:])]
        groups = [group for group in groups if np.count_nonzero(group) >= 5]
        axes.plot([np.mean(counts[group]) for group in groups], [np.median(values[group]) for group in groups],
                  color=colour, ls=line, lw=0.9, marker="o", ms=3.2, mec="white", mew=0.4)
    describe(axes, "d  Time over contacts, all cutoffs of c", "number of LMDs of the pose")


def print_slopes(studies):
    rows = []
    for study, points, _ in sized(studies):
        x = triangles(points)
        for method, (label, _, _) in looks(studies).items():
            slope, low, high = slope_with_interval(x, samples(points, method))
            rows.append([STUDY_LABELS[study], f"{x[0]:.0f} to {x[-1]:.0f}", label, f"{slope:.3f}", f"{low:.3f} to {high:.3f}"])
    print(table_text(["study", "triangles", "method", "slope of log time over log triangles", "95 % interval"], rows))


def draw(studies):
    style.use_style()
    figure, axes = plt.subplots(2, 2, figsize=(style.TWO_COLUMNS_IN, 6.0), gridspec_kw={
        "left": 0.08, "right": 0.985, "bottom": 0.07, "top": 0.845, "wspace": 0.2, "hspace": 0.32})
    for panel in axes.flat:
        panel.set(xscale="log", yscale="log")
    draw_times(axes[0, 0], studies)
    draw_counters(axes[0, 1], studies)
    draw_cutoffs(axes[1, 0], studies)
    draw_contacts(axes[1, 1], studies)
    for panel in axes.flat:
        panel.yaxis.set_major_locator(LogLocator(numticks=12))
        panel.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        panel.xaxis.set_minor_formatter(NullFormatter())
    for panel in axes[0]:
        panel.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value / 1000:g}k"))
    for panel, ticks in ((axes[1, 0], (0.25, 0.5, 1, 2, 5, 10)), (axes[1, 1], (1, 2, 5, 10, 20))):
        panel.set_xticks(ticks)
        panel.set_xticks([], minor=True)
        panel.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    keys = [Line2D([], [], color=colour, ls=line, lw=1.4, label=label) for label, colour, line in looks(studies).values()]
    first = figure.legend(handles=keys, loc="upper left", bbox_to_anchor=(0.07, 0.965), ncol=4, handlelength=2.6,
                          columnspacing=1.4, borderpad=0.1)
    figure.add_artist(first)
    marks = [Line2D([], [], color="#444444", ls="none", marker=marker, ms=4.5, mew=0, label=STUDY_LABELS[study])
             for study, _, marker in sized(studies)]
    figure.legend(handles=marks, loc="upper left", bbox_to_anchor=(0.07, 0.915), ncol=4, handlelength=1.2,
                  columnspacing=1.2, borderpad=0.1)
    figure.text(0.075, 0.973, "How run time grows with the meshes and with the contact", fontsize=8.5,
                fontweight="bold")
    return figure


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", metavar="SCALING.json", help="what lmdbench-study scaling --json wrote")
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of scaling.svg and scaling.png")
    arguments = parser.parse_args(argv)
    studies = load(arguments.files)
    missing = [name for name in ("bunny", "cutoff") if name not in studies]
    if missing:
        raise ResultError(f"{', '.join(arguments.files)}: the study '{missing[0]}' is missing (remedy: run "
                          "lmdbench-study scaling without --only)")
    print_slopes(studies)
    return style.leave(draw(studies), arguments.out, "scaling")


if __name__ == "__main__":
    raise SystemExit(run_script(main))
