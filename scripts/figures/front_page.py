#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The plot of the front page: force error against time a frame of every method in hard contact, from the table of a sweep.

    python3 scripts/figures/front_page.py [results/reference/work-precision.md] [--scene bunny-hard] [--out results/reference]

Exit codes: 0 done, 3 the page has no such scene."""

import argparse
import re
from pathlib import Path

import interpreter  # noqa: F401  (chooses one that has what follows)

import figure_style as style
from lmdbench_results import ResultError, run_script

import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

PAGE = Path(__file__).resolve().parents[2] / "results" / "reference" / "work-precision.md"
MEDIAN, LATE, ERROR = "frame, median [us]", "99 % [us]", "force error, RMS [% of F_max]"
ZERO = 1.3  # errors of 0 are drawn here
# Series of the sweep: colour, name, and offset of the name from the last point.
METHODS = {"original": (style.VERMILLION, "original", (-4, 7)), "improved": (style.BLUE, "improved", (4, 6)),
           "nearest": (style.PURPLE, "nearest: FCL, one contact", (-24, 7)), "certified": (style.GREEN, "certified, coherent", (-86, 8)),
           "certified-cold": (style.GREEN, "certified, from scratch in every frame", (-4, 8))}
NUMBERED = (1, 20, 100, 500)  # frames between searches that get a label


def points(page, scene):
    """{series: [(frames between searches, or None; median [us]; 99 % [us]; error [%])]}"""
    section = re.search(rf"(?ms)^## {re.escape(scene)}$(.*?)(?=^## |\Z)", page)
    rows = [[cell.strip(" *") for cell in line.strip().strip("|").split("|")] for line in (section.group(1) if section else "").splitlines()
            if line.startswith("| ")]
    if not rows:
        raise ResultError(f"no table of {scene} (remedy: name a scene of the page)")
    column = {name: rows[0].index(name) for name in (MEDIAN, LATE, ERROR)}
    found = {}
    for row in rows[1:]:
        series, _, setting = row[0].partition(", ")
        every = re.fullmatch(r"a search every (\d+) frames", setting)
        found.setdefault(series, []).append((int(every.group(1)) if every else None, *(float(row[column[name]]) for name in (MEDIAN, LATE, ERROR))))
    return found


def draw(found):
    figure, axis = plt.subplots(figsize=(style.TWO_COLUMNS_IN, 3.3), layout="constrained")
    axis.set(xscale="log", yscale="log", xlim=(0.3, 1150), ylim=(0.95, 150), xlabel="time a frame [\u00b5s]: median, and to the right 99 % of frames",
             ylabel="force error, RMS [% of $F_{max}$]")
    axis.axhspan(0.95, 1.9, color="#F0F0F0", lw=0, zorder=0)
    for series, (colour, name, offset) in METHODS.items():
        line = [(every, median, late, error if error > 0 else ZERO) for every, median, late, error in found[series]]
        line.sort(key=lambda point: point[1])
        axis.hlines([point[3] for point in line], [point[1] for point in line], [point[2] for point in line], color=colour, alpha=0.3, lw=1.6, zorder=2)
        axis.plot([point[1] for point in line], [point[3] for point in line], color=colour, marker="o", ms=4.5, mec="white", mew=0.5, zorder=3)
        for every, median, _, error in line:
            if every in NUMBERED:
                # Not below the leftmost: the line may go straight down from there.
                beside = every == max(NUMBERED)
                axis.annotate(str(every), (median, error), xytext=(-5, -2.5) if beside else (0, -10), textcoords="offset points",
                              ha="right" if beside else "center", fontsize=6.5, color=colour)
        axis.annotate(name, (line[-1][1], line[-1][3]), xytext=offset, textcoords="offset points", color=colour, fontsize=8, fontweight="bold")
    axis.axvline(1000, color=style.GREY, lw=0.8, ls="--")
    axis.annotate("1 ms: the frame is over", (1000, 120), xytext=(-4, 0), textcoords="offset points", ha="right", va="center",
                  fontsize=7, color="#555555")
    axis.annotate("numbers: frames from one search to the next", (0.32, 7), fontsize=7, color="#555555")
    axis.xaxis.set_major_formatter(FuncFormatter(lambda at, _: f"{at:g}"))
    axis.yaxis.set_major_locator(FixedLocator([ZERO, 2, 5, 10, 20, 50, 100]))
    axis.yaxis.set_major_formatter(FuncFormatter(lambda at, _: "0" if at == ZERO else f"{at:g}"))
    axis.yaxis.set_minor_locator(NullLocator())
    return figure


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", nargs="?", type=Path, default=PAGE, help="what scripts/figures/sweep.py wrote")
    parser.add_argument("--scene", default="bunny-hard")
    parser.add_argument("--out", default=str(PAGE.parent))
    arguments = parser.parse_args(argv)
    with plt.rc_context(style.STYLE):
        return style.leave(draw(points(arguments.page.read_text(encoding="utf-8"), arguments.scene)), arguments.out, "front-page")


if __name__ == "__main__":
    raise SystemExit(run_script(main))
