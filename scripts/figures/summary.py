#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a run showed, in a table that needs no manual: for each experiment and method the time and, in the same row,
what the time bought. Reads the result files alone."""

import argparse
import os

import numpy as np

from lmdbench_results import (Result, jumps_per_second, median, quantile, run_script, true_jumps_per_second,
                              truth_of)

JUMP_SHARE = 0.25  # a change of force within one frame that a hand feels as a jerk, as a share of F_max
NOT_MEASURED = "-"


def number(value, digits=2):
    return NOT_MEASURED if not np.isfinite(value) else f"{value:.{digits}f}"


def significant(value):
    return NOT_MEASURED if not np.isfinite(value) else f"{value:.3g}"


def median_and_p99(samples):
    """'1.38 (2.10)' in milliseconds."""
    return f"{significant(median(samples) * 1e3)} ({significant(quantile(samples, 0.99) * 1e3)})"


def percents(share, adjacent):
    return NOT_MEASURED if not np.isfinite(share) else f"{100 * share:.1f} ({100 * adjacent:.1f})"


def row(method):
    truth = truth_of(method)
    local = method.median_times("local_update_time")[method.result.contact_frames()]
    if method.searches_every_frame():
        search = total = "every frame"
    else:
        search, total = (median_and_p99(samples) for samples in method.search_parts())
        if not np.any(np.isfinite(method.times("first_reduction_time"))):
            total = "none"
    counts = method.read("lmd_count")
    contact = counts[counts > 0]
    return [
        method.label,
        search,
        total,
        median_and_p99(local),
        f"{significant(median(contact))} ({int(counts.max()) if counts.size else 0})",
        percents(truth.pooled_recall(), truth.pooled_recall_adjacent()) if truth else NOT_MEASURED,
        percents(truth.pooled_precision(), truth.pooled_precision_adjacent()) if truth else NOT_MEASURED,
        f"{number(truth.rms_force_error())}" if truth else NOT_MEASURED,
        number(jumps_per_second(method, JUMP_SHARE), 1),
    ]


def truth_rows(result):
    """The truth that the methods are compared with, a row a force law in use."""
    if not result.has("/reference/frame"):
        return []
    counts = result.read("/reference/lmd_count")
    contact = counts[counts > 0]
    lmds = f"{significant(median(contact))} ({int(counts.max()) if counts.size else 0})"
    return [[f"truth, {law} law", *[NOT_MEASURED] * 3, lmds, *[NOT_MEASURED] * 3,
             number(true_jumps_per_second(result, law, JUMP_SHARE), 1)]
            for law in dict.fromkeys(method.force_law for method in result.methods.values())]


HEADINGS = ("method", "search [ms]", "+ reduction [ms]", "local update [ms]", "LMDs", "recall [%]", "precision [%]",
            "force error [N]", "jumps [1/s]")


def table(rows):
    widths = [max(len(line[i]) for line in [HEADINGS, *rows]) for i in range(len(HEADINGS))]

    def text(line):
        return "  ".join(cell.ljust(width) if i == 0 else cell.rjust(width)
                         for i, (cell, width) in enumerate(zip(line, widths)))

    return "\n".join([text(HEADINGS), "  ".join("-" * width for width in widths), *map(text, rows)])


def crosscheck_line(result):
    if not result.has("/crosscheck/fcl/frame"):
        return "FCL: not asked."
    separated = result.read("/crosscheck/fcl/separated").astype(bool)
    agrees = result.read("/crosscheck/fcl/agrees").astype(bool)
    difference = result.read("/crosscheck/fcl/relative_difference")[separated]
    difference = difference[np.isfinite(difference)]
    worst = f"{difference.max():.1e}" if difference.size else NOT_MEASURED
    disagreements = int(np.count_nonzero(~agrees))
    text = (f"FCL: exact minimum distance compared in {agrees.size} frames ({np.count_nonzero(separated)} separated), "
            f"{disagreements} disagree, worst relative difference {worst}.")
    who = result.texts("/crosscheck/fcl/exceptions/who") if result.has("/crosscheck/fcl/exceptions/who") else []
    methods = [f"{label} in {who.count(label)}" for label in result.methods if label in who]
    return text + (f" Fresh searches off by more than the tolerance: {', '.join(methods)} frames." if methods else "")


def describe(result):
    truth = next((truth_of(method) for method in result.methods.values()), None)
    lines = [f"{result.name}: {result.experiment.get('title') or 'no title'}"]
    lines.append(f"{result.time.size} frames, {result.repetitions() - result.warm_up_repetitions} timed repetitions; "
                 + (f"errors against exhaustive truth in {truth.frames.size} frames"
                    if truth else "NO TRUTH PROBE: the times stand without an error")
                 + f"; F_max {result.maximum_force():g} N a contact.")
    lines += ["", table([row(method) for method in result.methods.values()] + truth_rows(result)), "", crosscheck_line(result)]
    if result.has("/scene/warnings"):
        lines += [f"Note: {warning}" for warning in result.texts("/scene/warnings")]
    return "\n".join(lines)


LEGEND = f"""\
Times: median (99th percentile) over the searches that find candidates and over the frames in contact, each the median
of its timed repetitions. "+ reduction": search with the first reduction. In contact: any of the methods has an LMD.
LMDs: median in contact (most). Recall, precision: share of the true LMDs that the method knows, of its LMDs that are
true; the same features (in parentheses: or features that share a triangle with the true ones). Force error: root mean
square against the true force under the same law, in contact. Jumps: changes of force above {JUMP_SHARE:.0%} of F_max within
one frame, per second in contact."""


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="+", metavar="RESULT.h5")
    parser.add_argument("--files", nargs="*", default=[], metavar="FILE", help="further files to name at the end")
    arguments = parser.parse_args(argv)
    results = [Result(file) for file in arguments.results]
    for result in results:
        print(describe(result), end="\n\n")
    print(LEGEND, end="\n\n")
    machine = results[0].machine()
    print(f"Machine: {machine.get('processor', 'unknown')}, {machine.get('logical_processors', 'unknown')} processors, "
          f"load {machine.get('load_average_1_minute', 'unknown')} at the start. Ratios between methods travel to other "
          "machines, milliseconds do not.")
    print("Files:")
    for file in [*arguments.results, *arguments.files]:
        print(f"  {os.path.relpath(file)}")
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
