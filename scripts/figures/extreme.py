#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the methods make of the extreme scenes: a row a scene and method, with its errors against exhaustive truth.
Reads the result files alone. With --check it fails where a value is not a number that must be one, or where a method
that promises the true set does not have it in every probed frame."""

import argparse
import json

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

from lmdbench_results import EXIT_CHECK_FAILED, Result, no_truth, run_script, truth_of
from tables import percent, shown, table_text, write_text

COMPLETE_SET = "complete-set"  # promise of a method with the true set
HEADINGS = ("scene", "method", "contact frames", "LMDs", "recall [%]", "precision [%]", "frames wrong",
            "distance error [cutoff]", "force error [F_max]", "force jump [F_max]", "true jump", "not a number",
            "median, p99, largest frame [us]", "frames above 1 ms", "stands")
NOT_MEASURED = "-"
# Values that must be numbers in every frame, and in every frame with an LMD.
ALWAYS = ("force", "torque", "effective_stiffness")
WITH_LMDS = ("minimum_distance",)
DEADLINE_S = 1e-3  # one haptic frame
# A method passes a scene if it has nearly all true LMDs and its force is never far off.
STANDS_RECALL = 0.99
STANDS_FORCE = 0.25  # of F_max: a hand feels that as a jerk (JUMP_SHARE of summary.py)


def not_a_number(method):
    """How many values are not finite that must be."""
    with_lmds = method.read("lmd_count") > 0
    count = sum(int(np.count_nonzero(~np.isfinite(method.read(name)))) for name in ALWAYS)
    count += sum(int(np.count_nonzero(~np.isfinite(method.read(name)[with_lmds]))) for name in WITH_LMDS)
    truth = truth_of(method)
    return count + (int(np.count_nonzero(~np.isfinite(truth.force_error[truth.force_is_known]))) if truth else 0)


def frame_times(method):
    """Of every frame the least of all repetitions [s]: what another program takes away it takes from few of them."""
    return np.atleast_2d(method.read("local_update_time")).min(axis=0)


def measure(method):
    result = method.result
    force = method.constant("maximum_force_n")
    row = {"scene": result.name.removeprefix("extreme-"), "method": method.label, "promise": method.promise,
           "frames_in_contact": int(result.number("frames_in_contact")),
           "frames_probed": int(result.number("frames_probed"))}
    for name in ("frames_touching", "lmd_count_maximum", "frames_wrong"):
        row[name] = method.number(name)
    for name in ("recall", "precision", "recall_adjacent", "precision_adjacent"):
        row[name] = method.number(name)
    row["distance_error_cutoff"] = method.number("minimum_distance_error_maximum_m") / result.scene("cutoff_m")
    for name in ("force_error", "force_jump", "true_force_jump"):
        row[name + "_fmax"] = method.number(name + "_maximum_n") / force
    row["not_a_number"] = not_a_number(method)
    times = frame_times(method)
    row["frames"] = len(times)
    row["frame_median_s"], row["frame_p99_s"] = float(np.median(times)), float(np.quantile(times, 0.99))
    row["frame_largest_s"], row["frames_late"] = float(times.max()), int(np.count_nonzero(times > DEADLINE_S))
    row["unjudged"] = "" if np.isfinite(row["recall_adjacent"]) else no_truth(result) if truth_of(method) is None else "no true LMD in a probed frame"
    row["why_not"] = why_not(row)
    row["stands"] = None if row["unjudged"] and not row["why_not"] else not row["why_not"]
    return row


def why_not(row):
    """What keeps a method from standing in a scene, in words; empty where it stands."""
    reasons = []
    if row["not_a_number"]:
        reasons.append(f"{row['not_a_number']} values missing")
    if row["recall_adjacent"] < STANDS_RECALL:
        reasons.append(f"misses {100 * (1 - row['recall_adjacent']):.0f} % of the LMDs")
    if row["force_error_fmax"] > STANDS_FORCE:
        reasons.append(f"force off by {row['force_error_fmax']:.2g} F_max")
    return reasons


def cells(row):
    def both(share):
        strict, adjacent = row[share], row[share + "_adjacent"]
        return NOT_MEASURED if not np.isfinite(strict) else f"{percent(strict)} ({percent(adjacent)})"

    stands = "yes" if row["stands"] else f"not judged: {row['unjudged']}" if row["stands"] is None else "no: " + ", ".join(row["why_not"])
    return [row["scene"], row["method"], f"{row['frames_in_contact']} ({shown(row['frames_touching'], 9)})", shown(row["lmd_count_maximum"], 9),
            both("recall"), both("precision"), f"{shown(row['frames_wrong'], 9)} of {row['frames_probed']}",
            *(shown(row[name], 2) for name in ("distance_error_cutoff", "force_error_fmax", "force_jump_fmax", "true_force_jump_fmax")), str(row["not_a_number"]),
            ", ".join(f"{1e6 * row[name]:.3g}" for name in ("frame_median_s", "frame_p99_s", "frame_largest_s")),
            f"{row['frames_late']} of {row['frames']}", stands]


def markdown(rows):
    return table_text(HEADINGS, map(cells, rows))


def standings(rows):
    """A line a method: in how many scenes it stands of those in which it is judged, and in how many each criterion fails."""
    def worst(rows, name, extreme, words):
        measured = [row for row in rows if np.isfinite(row[name])]
        return words(extreme(measured, key=lambda row: row[name])) if measured else NOT_MEASURED

    lines = []
    for method in dict.fromkeys(row["method"] for row in rows):
        own = [row for row in rows if row["method"] == method]
        judged = [row["stands"] for row in own if row["stands"] is not None]
        lines.append([method, f"{sum(judged)} of {len(judged)}", sum(row["recall_adjacent"] < STANDS_RECALL for row in own),
                      sum(row["force_error_fmax"] > STANDS_FORCE for row in own), sum(row["not_a_number"] > 0 for row in own),
                      worst(own, "recall_adjacent", min, lambda row: f"{percent(row['recall_adjacent'])} ({row['scene']})"),
                      worst(own, "force_error_fmax", max, lambda row: f"{row['force_error_fmax']:.2g} ({row['scene']})")])
    return table_text(["method", "stands", "misses LMDs", "force off", "values missing", "fewest LMDs known [%]", "worst force error [F_max]"], lines)


LEGEND = f"""\
*Recall, precision*: pooled over the probed frames, same features (in parentheses: neighbouring features count). *Force error*: the largest, of the
probed frames in which no triangles intersect, against the true force under the same law. *Times*: the local update, of every frame the least of all
repetitions; `original` and `improved` search beside it. *Stands*: recall with neighbouring features at least {STANDS_RECALL:.0%}, force never off by
more than {STANDS_FORCE:.0%} of F_max, no value missing; else what is in the way. In the file, *contact frames*: the meshes are within the cutoff (in
parentheses: frames with an LMD at distance 0); *LMDs*: most in a frame; *frames wrong*: probed frames whose set is not the true one, counted from the
first in which a search can have arrived; *force jump*: the largest change from a probed frame to the next. Numbers are defined in results/README.md."""


def complaints(rows):
    for row in rows:
        place = f"{row['scene']}, {row['method']}"
        if row["not_a_number"]:
            yield f"{place}: {row['not_a_number']} values are not a number"
        if row["frames_probed"] == 0:
            yield f"{place}: no probed frame: {row['unjudged']} (remedy: /probes/truth/stride_frames above 0)"
        if row["promise"] == COMPLETE_SET and row["frames_wrong"] > 0:
            yield f"{place}: {row['frames_wrong']:.0f} of {row['frames_probed']} sets are not the true one"


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="+", metavar="RESULT.h5")
    parser.add_argument("--out", metavar="NAME", help="also write NAME.md and NAME.json")
    parser.add_argument("--check", action="store_true", help="exit code 1 where a promise is broken")
    arguments = parser.parse_args(argv)
    rows = [measure(method) for file in arguments.results for method in Result(file).methods.values()]
    text = standings(rows) + "\n\n" + markdown(rows) + "\n\n" + LEGEND + "\n"
    print(text, end="")
    if arguments.out:
        write_text("# Extreme scenes\n\n" + text, f"{arguments.out}.md")
        known = [{key: None if value != value else value for key, value in row.items()} for row in rows]
        write_text(json.dumps(known, indent=1) + "\n", f"{arguments.out}.json")
    broken = list(complaints(rows)) if arguments.check else []
    for complaint in broken:
        print(f"broken: {complaint}")
    return EXIT_CHECK_FAILED if broken else 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
