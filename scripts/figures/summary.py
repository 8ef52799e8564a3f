#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a run showed, in a table that needs no manual: for each experiment and method the time and, in the same row,
what the time bought. Every number is read from the summary that the program wrote into the result file."""

import argparse
import os

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

from lmdbench_results import no_truth, run_script, true_forces, truth_of
from tables import counted, percent, shown
from variants import open_results

NOT_MEASURED = "-"


def median_and_p99(method, time):
    """'1.38 (2.10)' in milliseconds."""
    return f"{shown(method.number(time + '_median_s') * 1e3)} ({shown(method.number(time + '_p99_s') * 1e3)})"


def percents(method, name):
    share, adjacent = method.number(name), method.number(name + "_adjacent")
    return NOT_MEASURED if not np.isfinite(share) else f"{percent(share)} ({percent(adjacent)})"


def median_and_most(median, most):
    return NOT_MEASURED if not np.isfinite(most) else f"{shown(median)} ({most:.0f})"


def row(method):
    if method.searches_every_frame():
        search = total = "every frame"
    else:
        search = median_and_p99(method, "global_search")
        total = median_and_p99(method, "search_with_reduction") if method.reduces else "none"
    return [
        method.label,
        search,
        total,
        median_and_p99(method, "local_update"),
        median_and_most(method.number("lmd_count_median"), method.number("lmd_count_maximum")),
        percents(method, "recall"),
        percents(method, "precision"),
        shown(method.number("force_error_rms_n")),
        str(method.events("jumps")),
    ]


def truth_rows(result):
    """The truths that the methods are compared with: one for each law that methods share poses and profile under."""
    rows = []
    for what, method in true_forces(result.methods.values()):
        group = method.reference()
        # The program sums up the sets that all methods share.
        lmds = (median_and_most(result.number("true_lmd_count_median"), result.number("true_lmd_count_maximum")) if group == "/reference"
                else NOT_MEASURED)
        name = what + (f", {method.profile}" if method.profile else "")
        rows.append([name, *[NOT_MEASURED] * 3, lmds, *[NOT_MEASURED] * 3, str(method.events("true_jumps"))])
    return rows


HEADINGS = ("method", "search [ms]", "+ reduction [ms]", "local update [ms]", "LMDs", "recall [%]", "precision [%]",
            "force error [N]", "jumps [1/s, 95 %]")


def table(rows):
    widths = [max(len(line[i]) for line in [HEADINGS, *rows]) for i in range(len(HEADINGS))]

    def text(line):
        return "  ".join(cell.ljust(width) if i == 0 else cell.rjust(width)
                         for i, (cell, width) in enumerate(zip(line, widths)))

    return "\n".join([text(HEADINGS), "  ".join("-" * width for width in widths), *map(text, rows)])


def crosscheck_lines(result):
    """A line for all methods, or one for each that has poses or a profile of its own."""
    groups = {}
    for method in result.methods.values():
        group = method.at_its_frames("crosscheck/fcl")
        if result.has(f"{group}/frame"):
            groups.setdefault(group, "" if group == "/crosscheck/fcl" else f", frames of {method.label}")
    return [crosscheck_line(result, *of) for of in groups.items()] or ["FCL: not asked."]


def crosscheck_line(result, group, whose):
    separated = result.read(f"{group}/separated").astype(bool)
    agrees = result.read(f"{group}/agrees").astype(bool)
    difference = result.read(f"{group}/relative_difference")[separated]
    difference = difference[np.isfinite(difference)]
    worst = f"{difference.max():.1e}" if difference.size else NOT_MEASURED
    disagreements = int(np.count_nonzero(~agrees))
    text = (f"FCL{whose}: exact minimum distance compared in {agrees.size} frames ({np.count_nonzero(separated)} separated), "
            f"{disagreements} disagree, worst relative difference {worst}.")
    who = result.texts(f"{group}/exceptions/who") if result.has(f"{group}/exceptions/who") else []
    methods = [f"{label} in {who.count(label)}" for label in result.methods if label in who]
    return text + (f" Fresh searches off by more than the tolerance: {', '.join(methods)} frames." if methods else "")


def true_jumps(result):
    """Where the true jumps were counted."""
    label = result.text_attribute("/summary", "truth_of_every_frame")
    return f", true jumps of every frame by {label}, whose sets are the exhaustive ones there" if label else ", true jumps there, too"


def maximum_forces(result):
    """Of the profiles, in their order."""
    return ", ".join(dict.fromkeys(f"{method.constant('maximum_force_n'):g}" for method in result.methods.values()))


def whose_contact(result):
    """Of what the run's one count is: in a closed loop every device goes its own way, and meets the mesh less often; every profile has its cutoff."""
    profiles = result.experiment.get("force", {})
    return (f" under {profiles[0]['name']}" if isinstance(profiles, list) and len(profiles) > 1 else "") + (
        " on the path that the hand means" if result.experiment.get("loop", {}).get("kind") == "closed" else "")


def describe(result):
    truth = next((truth_of(method) for method in result.methods.values()), None)
    lines = [f"{result.name}: {result.experiment.get('title') or 'no title'}"]
    lines.append(f"{counted(result.time.size, 'frame')}, {result.number('frames_in_contact'):.0f} in contact{whose_contact(result)}; "
                 f"{counted(repetitions - result.warm_up_repetitions, 'timed repetition') if (repetitions := result.repetitions()) else 'times were not kept'}; "
                 + (f"errors against exhaustive truth in {counted(truth.frames.size, 'frame')}{true_jumps(result)}"
                    if truth else f"{no_truth(result).upper()}: the times stand without an error")
                 + f"; F_max {maximum_forces(result)} N a contact.")
    lines += ["", table([row(method) for method in result.methods.values()] + truth_rows(result)), "", *crosscheck_lines(result)]
    if result.has("/scene/warnings"):
        lines += [f"Note: {warning}" for warning in result.texts("/scene/warnings")]
    return "\n".join(lines)


LEGEND = """\
The numbers are the program's own, defined in results/README.md. In contact: the meshes are within the cutoff of each other.
Times: median (99th percentile) over the searches and frames in contact, each the median of its timed repetitions.
"+ reduction": search with the first reduction. LMDs: median in contact (most). Recall, precision: share of the true LMDs
that the method knows, of its LMDs that are true; the same features (in parentheses: neighbouring features count). Force
error: root mean square against the true force under the same law, in contact. Jumps: changes of force above 25 % of F_max
within one frame, per second in contact, with the interval of their count (95 %, Poisson); fewer than ten are told as "number in
seconds" and have an interval, but no rate."""


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="+", metavar="RESULT.h5")
    parser.add_argument("--files", nargs="*", default=[], metavar="FILE", help="further files to name at the end")
    arguments = parser.parse_args(argv)
    results = open_results(arguments.results)
    for result in results:
        print(describe(result), end="\n\n")
    print(LEGEND, end="\n\n")
    for machine in (result.machine() for result in results):
        print(f"Machine: {machine.get('processor', 'unknown')}, {machine.get('logical_processors', 'unknown')} processors, "
              f"load {machine.get('load_average_1_minute', 'unknown')} at the start.")
    print("Ratios between methods travel to other machines, milliseconds do not.")
    print("Files:")
    for file in [*arguments.results, *arguments.files]:
        print(f"  {os.path.relpath(file)}")
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
