# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Regions of the claims on force and LMD counts: K1 to K4."""


import numpy as np

from intervals import bootstrap
from region_rules import (FAILS, HOLDS, OPEN, all_of, blocks, cutoff_share, decide, groups, in_edges, joined, partner, rate, tolerance,
                          usable)
from tables import interval, shown, table


def schedule(period):
    return "a search in every frame" if period == 1 else f"a search every {period} frames"


def k1(sweep):
    rows, cells = [], {}
    improved = groups(sweep.of(series="improved") + sweep.of(series="improved-cutoff"), lambda p: p.period, cutoff_share)
    everything = groups(sweep.points, lambda p: p.series, lambda p: p.period, tolerance, cutoff_share)
    for (series, period, angle, share), points in everything.items():
        switches, jumps = rate(points, "switches"), rate(points, "jumps")
        cell = ""
        against = improved.get((period, share)) if series.startswith("original") else None
        if against:
            control = rate(against, "switches")
            # Low of one against high of the other, times a tenth: neither rests on one event.
            cell = (FAILS if control.low > 0.1 * switches.high or switches.high < 1.0
                    else HOLDS if switches.low >= 1.0 and control.high <= 0.1 * switches.low else OPEN)
            wider = ", Fig. 5 (a) with edge neighbours" if "edge-neighbours" in series else ""
            cells[f"cutoff {in_edges(share)} mean edges, G5 {angle:.0f} deg{wider} | {schedule(period)}"] = cell
        rows.append([series, period, f"{angle:.0f}" if angle is not None else "-", in_edges(share), len(points),
                     shown(sum(p.number("seconds_in_contact") for p in points)), switches, rate(points, "true_switches"), jumps,
                     rate(points, "true_jumps"), rate(points, "false_jumps"), rate(points, "missed_jumps"),
                     shown(100 * np.mean([p.force_error for p in points])), cell])
    text = ["Rule: the original switches between below 5 % and above 50 % of F_max within a frame at least once a second in contact, and "
            "the improved one at most a tenth as often, both by the ends of their 95 % intervals (Poisson, and bootstrap over paths). "
            "Truth is in every frame, under the method's own law.", ""]
    text += table(["series", "search every [frames]", "G5 [deg]", "cutoff [mean edges]", "paths", "in contact [s]", "switches [1/s]",
                   "true switches [1/s]", "jumps [1/s]", "true jumps [1/s]", "false jumps [1/s]", "missed jumps [1/s]",
                   "force error, RMS [% of F_max]", "K1 against improved"], rows)
    return text, cells


def over_paths(points, statistic):
    """Mean of a number over paths with its bootstrap interval."""
    values = [statistic(point) for point in points]
    return float(np.mean(values)), bootstrap(values, lambda sample: float(np.mean(sample)))


def k2(sweep):
    rows, cells = [], {}
    for (series, period, angle, share), points in groups(sweep.points, lambda p: p.series, lambda p: p.period, tolerance, cutoff_share).items():
        value, limits = over_paths(points, lambda p: p.number("lmd_count_p99"))
        # One number of each method at the cutoff in mean edges; under 10 is at most 9.
        cell = decide(*limits, at_most=9.0)
        name = f"{series.split('-')[0]}, cutoff {in_edges(share)} mean edges"
        extra = ", ".join(text for text in (schedule(period), f"G5 {angle:.0f} deg" if angle is not None else "",
                                            "edge neighbours" if "edge-neighbours" in series else "") if text)
        if series != "improved-linear":  # the sets of `improved`
            cells[f"{name} | {extra}"] = cell
        rows.append([series, period, f"{angle:.0f}" if angle is not None else "-", in_edges(share), len(points),
                     shown(np.mean([p.number("lmd_count_median") for p in points])), interval(value, limits),
                     shown(max(p.number("lmd_count_maximum") for p in points)), cell])
    text = ["Rule: of the frames in contact of a path, 99 % have at most 9 LMDs within the cutoff; mean over the paths, 95 % interval by "
            "bootstrap over paths.", ""]
    return text + table(["series", "search every [frames]", "G5 [deg]", "cutoff [mean edges]", "paths", "LMDs, median", "99th percentile",
                         "most", "K2"], rows), cells


def both_lengths(one, other):
    counts = one.sweep.samples(one, "counts").astype(bool) & other.sweep.samples(other, "counts").astype(bool)
    return tuple(point.sweep.samples(point, "force_magnitude")[counts] for point in (one, other))


def ratio_of_means(rows):
    return float(np.mean(joined(rows, 0)) / np.mean(joined(rows, 1)))


def correlation(rows):
    return float(np.corrcoef(joined(rows, 0), joined(rows, 1))[0, 1])


def k3(sweep):
    rows, cells = [], {}
    for one in usable(sweep.points):
        other = partner(one, sweep) if one.series.startswith("original") else None
        if other is None:
            continue
        a, b = both_lengths(one, other)
        force = one.experiment["force"]
        pieces = blocks(a, b)
        ratio, similar = bootstrap(pieces, ratio_of_means), bootstrap(pieces, correlation)
        law = one.number("true_force_mean_n") / other.number("true_force_mean_n")
        free = [p.number("force_mean_n") / p.number("true_force_mean_n") for p in (one, other)]
        saturation = force.get("saturation_cutoff", 0)
        cell = all_of(decide(*similar, at_least=0.8), decide(*ratio, at_least=1.0, at_most=1.5))
        cells[f"clip {force['clip']} | sharpness {force['sharpness']:g}, saturation {saturation:g}, cutoff {in_edges(cutoff_share(one))} "
              f"mean edges, {schedule(one.period)}"] = cell
        frames = np.sum(one.sweep.samples(one, "counts"))
        rows.append([one.period, force["clip"], f"{force['sharpness']:g}", f"{saturation:g}", f"{100 * cutoff_share(one):g}",
                     in_edges(cutoff_share(one)), interval(ratio_of_means(pieces), ratio), shown(law), shown(free[0]), shown(free[1]),
                     shown(100 * one.number("frames_clipped") / frames), shown(100 * other.number("frames_clipped") / frames),
                     interval(correlation(pieces), similar), cell])
    text = ["Rule: the original's mean force is 1 to 1.5 times the improved one's and the lengths of the two forces correlate by at least 0.8 "
            "(95 % intervals: bootstrap over blocks of frames). The ratio is split: law = true linear mean / true exponential mean, both "
            "clipped as the setting says; LMDs = a method's mean force / the true mean under its law and clip. "
            "ratio = law x original's LMDs / improved's LMDs.", ""]
    text += table(["search every [frames]", "clip", "sharpness", "saturation [cutoff]", "cutoff [% of diagonal]", "[mean edges]",
                   "ratio of means", "of it the law", "LMDs, original", "LMDs, improved", "clipped, original [% of frames]",
                   "clipped, improved", "correlation", "K3"], rows)
    return text + split(rows), cells


def split(rows):
    """The clip's own part, where one setting was swept with both clips: it is in both factors, so it shows as a difference."""
    lines = []
    for row in rows:
        free = next((other for other in rows if other[1] == "device" and row[1] == "maximum" and other[2:6] == row[2:6]
                     and other[0] == row[0]), None)
        if free is not None:
            lines.append([row[2], row[3], row[5], free[6].split(" ")[0], row[6].split(" ")[0],
                          f"{free[7]} to {row[7]}", f"{free[8]} to {row[8]}", f"{free[9]} to {row[9]}"])
    if not lines:
        return []
    return ["What the clip makes of it, from the device's largest force to F_max:", "",
            *table(["sharpness", "saturation [cutoff]", "cutoff [mean edges]", "ratio, clip device", "ratio, clip maximum", "the law",
                    "LMDs, original", "LMDs, improved"], lines)]


def changes(points):
    return (sum(p.number("births") + p.number("deaths") for p in points) / sum(p.number("seconds_in_contact") for p in points))


def k4(sweep):
    rows, cells = [], {}
    for (series, period, angle, share), points in groups(sweep.points, lambda p: p.series, lambda p: p.period, tolerance, cutoff_share).items():
        if not series.startswith("original"):
            continue
        others = groups(sweep.of(series="improved") + sweep.of(series="improved-cutoff"), lambda p: p.period, cutoff_share).get((period, share))
        if not others:
            continue
        by_path = {p.axis("file"): p for p in others}
        pairs = [(p, by_path[p.axis("file")]) for p in points if p.axis("file") in by_path]
        count = lambda sample, index: sum(pair[index].number("lmd_count_mean") for pair in sample)  # noqa: E731
        ratio = lambda sample: count(sample, 0) / count(sample, 1)  # noqa: E731
        wild = lambda sample: changes([p for p, _ in sample]) / changes([p for _, p in sample])  # noqa: E731
        counts, fluctuation = bootstrap(pairs, ratio), bootstrap(pairs, wild)
        cell = all_of(decide(*counts, at_least=2 / 3, at_most=1.5), decide(*fluctuation, at_least=1.0))
        wider = ", Fig. 5 (a) with edge neighbours" if "edge-neighbours" in series else ""
        cells[f"cutoff {in_edges(share)} mean edges, G5 {angle:.0f} deg{wider} | {schedule(period)}"] = cell
        truth = np.mean([p.number("true_lmd_count_mean") for p, _ in pairs])
        rows.append([series, period, f"{angle:.0f}", in_edges(share), len(pairs), interval(ratio(pairs), counts),
                     shown(np.mean([p.number("lmd_count_mean") for p, _ in pairs])), shown(np.mean([p.number("lmd_count_mean") for _, p in pairs])),
                     shown(truth), interval(wild(pairs), fluctuation), cell])
    text = ["Rule: the mean numbers of LMDs within the cutoff lie within a factor of 1.5 of each other, and the original's set gains and loses "
            "more LMDs a second than the improved one's; 95 % intervals by bootstrap over paths.", ""]
    return text + table(["series", "search every [frames]", "G5 [deg]", "cutoff [mean edges]", "paths", "LMDs, original / improved",
                         "original", "improved", "true", "births and deaths, original / improved", "K4"], rows), cells
