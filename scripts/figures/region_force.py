# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Regions of the claims on force and LMD counts: K1 to K4; their rules stand in claim_rules.py."""

import math

import numpy as np

from intervals import bootstrap
from region_rules import FAILS, HOLDS, OPEN, all_of, blocks, cutoff_share, decide, in_edges, joined, partner, rate, schedule, settings, usable
from tables import interval, shown, table


def k1(found, sweep):
    for one, control in settings(sweep):
        switches, others = rate(one.points, "switches"), rate(control, "switches")
        # A tenth: low of the one against high of the other, so that neither rests on one event.
        cell = "" if not control else (FAILS if others.low > 0.1 * switches.high or switches.high < 1.0
                                       else HOLDS if switches.low >= 1.0 and others.high <= 0.1 * switches.low else OPEN)
        names = ("true_switches", "jumps", "true_jumps", "false_jumps", "missed_jumps")
        found.add({**one.columns, "in contact [s]": shown(switches.seconds), "switches [1/s]": switches,
                   **{f"{name.replace('_', ' ')} [1/s]": rate(one.points, name) for name in names},
                   "force error, RMS [% of F_max]": shown(100 * np.mean([p.force_error for p in one.points])),
                   "K1 against improved": cell}, one.words if control else None, cell)


def over_paths(points, statistic):
    """Mean of a number over paths with its bootstrap interval."""
    values = [statistic(point) for point in points]
    return float(np.mean(values)), bootstrap(values, lambda sample: float(np.mean(sample)))


def k2(found, sweep):
    for one, _ in settings(sweep):
        value, limits = over_paths(one.points, lambda p: p.number("lmd_count_p99"))
        # A number of every method at the cutoff swept in mean edges; under 10 is at most 9.
        cell = decide(*limits, at_most=9.0)
        words = [schedule(one.period), *([f"G5 {one.angle} deg"] if one.angle != "-" else []), *(["edge neighbours"] if "edge-neighbours" in one.series else [])]
        name = f"{one.series.split('-')[0]}, cutoff {in_edges(one.share)} mean edges | {', '.join(words)}"
        found.add({**one.columns, "LMDs, median": shown(np.mean([p.number("lmd_count_median") for p in one.points])),
                   "99th percentile": interval(value, limits), "most": shown(max(p.number("lmd_count_maximum") for p in one.points)), "K2": cell},
                  name if one.series != "improved-linear" else None, cell)  # the sets of `improved`


def both_lengths(one, other):
    counts = one.sweep.samples(one, "counts").astype(bool) & other.sweep.samples(other, "counts").astype(bool)
    return tuple(point.sweep.samples(point, "force_magnitude")[counts] for point in (one, other))


def ratio_of_means(rows):
    return float(np.mean(joined(rows, 0)) / np.mean(joined(rows, 1)))


def correlation(rows):
    return float(np.corrcoef(joined(rows, 0), joined(rows, 1))[0, 1])


def k3(found, sweep):
    for one in usable(sweep.points):
        other = partner(one, sweep) if one.series.startswith("original") else None
        if other is None:
            continue
        pieces = blocks(*both_lengths(one, other))
        ratio, similar = bootstrap(pieces, ratio_of_means), bootstrap(pieces, correlation)
        law = one.number("true_force_mean_n") / other.number("true_force_mean_n")
        free = [shown(p.number("force_mean_n") / p.number("true_force_mean_n")) for p in (one, other)]
        frames = np.sum(one.sweep.samples(one, "counts"))
        clipped = [shown(100 * p.number("frames_clipped") / frames) for p in (one, other)]
        force, edges = one.experiment["force"], in_edges(cutoff_share(one))
        clip, sharpness, saturation = force["clip"], f"{force['sharpness']:g}", f"{force.get('saturation_cutoff', 0):g}"
        cell = all_of(decide(*similar, at_least=0.8), decide(*ratio, at_least=1.0, at_most=1.5))
        found.add({"search every [frames]": one.period, "clip": clip, "sharpness": sharpness, "saturation [cutoff]": saturation,
                   "cutoff [% of diagonal]": f"{100 * cutoff_share(one):g}", "[mean edges]": edges, "ratio of means": interval(ratio_of_means(pieces), ratio),
                   "of it the law": shown(law), "LMDs, original": free[0], "LMDs, improved": free[1], "clipped, original [% of frames]": clipped[0],
                   "clipped, improved": clipped[1], "correlation": interval(correlation(pieces), similar), "K3": cell},
                  f"clip {clip} | sharpness {sharpness}, saturation {saturation}, cutoff {edges} mean edges, {schedule(one.period)}", cell)
    return split(found.rows)


def split(rows):
    """The clip's own part, where one setting was swept with both clips: it is in both factors, so it shows as a difference."""
    setting = ("search every [frames]", "sharpness", "saturation [cutoff]", "cutoff [% of diagonal]", "[mean edges]")
    by_device = {tuple(row[name] for name in setting): row for row in reversed(rows) if row["clip"] == "device"}
    lines = []
    for row in rows:
        free = by_device.get(tuple(row[name] for name in setting)) if row["clip"] == "maximum" else None
        if free is not None:
            lines.append([row["sharpness"], row["saturation [cutoff]"], row["[mean edges]"], *(r["ratio of means"].split(" ")[0] for r in (free, row)),
                          *(f"{free[name]} to {row[name]}" for name in ("of it the law", "LMDs, original", "LMDs, improved"))])
    return ["What the clip makes of it, from the device's largest force to F_max:", "",
            *table(["sharpness", "saturation [cutoff]", "cutoff [mean edges]", "ratio, clip device", "ratio, clip maximum", "the law",
                    "LMDs, original", "LMDs, improved"], lines)] if lines else []


def changes(points):
    seconds = sum(p.number("seconds_in_contact") for p in points)
    return sum(p.number("births") + p.number("deaths") for p in points) / seconds if seconds > 0 else math.nan


def k4(found, sweep):
    for one, control in settings(sweep):
        by_path = {p.axis("file"): p for p in control}
        pairs = [(p, by_path[p.axis("file")]) for p in one.points if p.axis("file") in by_path]
        if not control:
            continue
        count = lambda sample, index: sum(pair[index].number("lmd_count_mean") for pair in sample)  # noqa: E731
        ratio = lambda sample: count(sample, 0) / count(sample, 1)  # noqa: E731
        wild = lambda sample: changes([p for p, _ in sample]) / changes([p for _, p in sample])  # noqa: E731
        counts, fluctuation = bootstrap(pairs, ratio), bootstrap(pairs, wild)
        cell = all_of(decide(*counts, at_least=2 / 3, at_most=1.5), decide(*fluctuation, at_least=1.0))
        original, improved = (shown(np.mean([p.number("lmd_count_mean") for p in points])) for points in zip(*pairs))
        found.add({**one.columns, "paths": len(pairs), "LMDs, original / improved": interval(ratio(pairs), counts), "original": original,
                   "improved": improved, "true": shown(np.mean([p.number("true_lmd_count_mean") for p, _ in pairs])),
                   "births and deaths, original / improved": interval(wild(pairs), fluctuation), "K4": cell}, one.words, cell)
