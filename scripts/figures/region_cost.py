# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Regions of the claims on cost: K5 to K9; their rules stand in claim_rules.py. Counters decide where they can. A ratio of times has an interval: the bootstrap
over searches or blocks of frames, widened to what the single repetitions say, so that it spans the machine's moods too."""

import math

import numpy as np

from intervals import bootstrap
from region_rules import (FAILS, HOLDS, OPEN, all_of, blocks, cutoff_share, decide, groups, joined, mean_edges, mesh, of_repetitions, partner, schedule, span,
                          triangles, usable)
from tables import interval, shown


def size_columns(point):
    return {"cutoff [% of diagonal]": f"{100 * cutoff_share(point):g}", "[mean edges]": mean_edges(point)}


def k5(found, sweep):
    counts, growing = {}, []
    for point in usable(sweep.points):
        options = point.experiment["methods"][0]
        # A path may come no nearer than the cutoff.
        if not point.series.startswith("improved") or options.get("plain_cache") or not point.number("seconds_in_contact") > 0:
            continue
        candidates, kept, largest = (point.number(name) for name in ("candidates", "kept", "reduction_ratio_maximum"))
        choice = (options["visibility"], options["reduction"], options.get("leaf_cones", "one-ring"))
        counts.setdefault((mesh(point), cutoff_share(point)), {})[choice] = candidates, kept
        cell = decide(largest, largest, at_least=10, at_most=40)
        found.add({"meshes": mesh(point), **size_columns(point), **dict(zip(("visibility", "reduction", "leaf cones"), choice)),
                   "candidates": shown(candidates), "kept": shown(kept), "ratio over all": shown(candidates / kept if kept else math.nan),
                   "largest": shown(largest), "recall [%]": shown(100 * point.number("recall")), "K5": cell},
                  f"visibility {choice[0]}, {choice[1]} reduction, leaf cones {choice[2]} | {mesh(point)}, cutoff {100 * cutoff_share(point):g} %", cell)
    for (share,), points in groups(sweep.of(series="improved"), cutoff_share).items():
        by_mesh = {mesh(p): p.number("candidates") / p.number("kept") for p in points if p.number("kept")}
        values = list(by_mesh.values())
        if values:
            growing.append(f"cutoff {100 * share:g} %: " + ", ".join(f"{name} {shown(value)}" for name, value in by_mesh.items())
                           + (" (grows)" if values == sorted(values) else " (does not grow)"))
    return ["Ratio over all searches with density: " + "; ".join(growing) + ".", "", *why_k5(counts)]


def why_k5(counts):
    """What an option changes in candidates and in kept LMDs, against the defaults of the same meshes and cutoff.
    @param counts {(mesh, cutoff): {(visibility, reduction, leaf cones): (candidates, kept)}}"""
    usual = ("vertex-normal", "published", "one-ring")
    changes = {}
    for settings in counts.values():
        candidates, kept = settings.get(usual, (0, 0))
        for options, (more, left) in settings.items():
            if options == usual or not (kept and left):
                continue
            name = ", ".join(f"{words} {value}" for words, value, other in zip(("visibility", "reduction", "leaf cones"), options, usual) if value != other)
            changes.setdefault(name, []).append((more / candidates, left / kept))
    if not changes:
        return []
    return ["Why: the ratio follows the candidates, not what is kept. Against the default of the same meshes and cutoff "
            + "; ".join(f"{name} makes {span([c for c, _ in found])} times the candidates and keeps {span([k for _, k in found])} times the LMDs"
                        for name, found in changes.items()) + ".", ""]


def timed(point, name):
    """(R, N) samples of a time [s], the warm-up left out."""
    times = np.atleast_2d(point.sweep.samples(point, name))
    return times[1 if len(times) > 1 else 0:]


def searches(point):
    """Times of a point's searches in contact and of their first reductions, (R, S) [s]."""
    busy = point.sweep.samples(point, "counts").astype(bool)[point.sweep.samples(point, "global_frame").astype(int)]
    return [np.nan_to_num(timed(point, name)[:, busy]) for name in ("global_search_time", "first_reduction_time")]


def time_interval(columns, statistic):
    """(value, (low, high)) of a statistic of columns (R, N) of times that belong together by N: of the medians over the
    repetitions, with the bootstrap over N widened to the single repetitions."""
    middle = [np.median(column, axis=0) for column in columns]
    low, high = bootstrap(list(zip(*middle)), lambda rows: statistic(*np.array(rows).T))
    least, most = of_repetitions([statistic(*(column[r] for column in columns)) for r in range(min(len(column) for column in columns))])
    return statistic(*middle), (min(least, low), max(most, high))


def k6(found, sweep):
    measured = []
    originals = {(mesh(p), cutoff_share(p)): p for p in usable(sweep.of(series="original"))}
    for point in usable(sweep.of(series="improved") + sweep.of(series="improved-plain-cache")):
        one = originals.get((mesh(point), cutoff_share(point)))
        if one is None:
            continue
        (before, _), (search, reduction) = searches(one), searches(point)
        if not before.size or not search.size:
            continue
        nodes, leaves = (point.counter(name) / one.counter(name) for name in ("node_pairs", "leaf_pairs"))
        base = time_interval((search, before), lambda new, old: np.median(new) / np.median(old))
        share = time_interval((reduction, search), lambda more, new: np.quantile(more / new, 0.99))
        total = time_interval((search, reduction, before), lambda new, more, old: np.median(new + more) / np.median(old))
        cell = all_of(decide(*base[1], at_least=0.8, at_most=1.25), decide(*share[1], at_least=0.8), decide(*total[1], at_least=1.5, at_most=2.5))
        plain = point.experiment["methods"][0].get("plain_cache")
        distances = point.counter("triangle_distances") / point.counter("leaf_pairs")
        middle = float(np.median(reduction / search))
        measured.append((nodes, leaves, base[0], distances, middle, total[0]))
        found.add({"meshes": mesh(point), **size_columns(point), "cache": "plain" if plain else "ours", "node pairs, improved / original": shown(nodes),
                   "leaf pairs, improved / original": shown(leaves), "triangle distances, all, / leaf pairs": shown(distances),
                   "original's search, median [ms]": shown(1e3 * float(np.median(before))), "base ratio": interval(*base),
                   "reduction / search, median": shown(middle), "99th percentile": interval(*share), "total ratio": interval(*total), "K6": cell},
                  f"{mesh(point)}{', plain hash map as cache' if plain else ''} | cutoff {100 * cutoff_share(point):g} %", cell)
    return why_k6(measured)


def why_k6(measured):
    """@param measured of each setting node pairs, leaf pairs (improved / original), base ratio, distances a leaf pair, reduction / search, total ratio"""
    if not measured:
        return []
    nodes, leaves, base, distances, share, total = zip(*measured)
    pairs = nodes + leaves
    same = f"Both test {'the same' if min(pairs) == max(pairs) == 1 else span(pairs) + ' times the'} node and leaf pairs"
    return [f"Why: {same}, so that the base ratio ({span(base)}) is that of what stands at a leaf: one exact distance of two triangles, "
            f"{span(distances)} a leaf pair with those of the trackings, against 49 distances of points. The reduction takes {span(share)} of "
            "the search in the median; only single searches take it as long. So the total ratio is "
            f"{span(total)} and {'never' if max(total) < 2.0 else 'rarely'} reaches twice.", ""]


def updates(point):
    """Times of local updates [s] by repetition and which frames count and carry LMDs."""
    return timed(point, "local_update_time"), point.sweep.samples(point, "counts").astype(bool) & (point.sweep.samples(point, "tracked_count") > 0)


def update_ratio(one, other):
    """(value, interval) of improved / original, medians over the frames that carry LMDs; None without such frames."""
    (a, busy_a), (b, busy_b) = updates(one), updates(other)
    if not busy_a.any() or not busy_b.any():
        return None
    statistic = lambda x, y: float(np.median(y[busy_b]) / np.median(x[busy_a]))  # noqa: E731
    middle = [np.median(times, axis=0) for times in (a, b)]
    pieces = list(zip(blocks(middle[0], busy_a), blocks(middle[1], busy_b)))
    low, high = bootstrap(pieces, lambda rows: float(np.median(joined([y for _, y in rows], 0)[joined([y for _, y in rows], 1)])
                                                     / np.median(joined([x for x, _ in rows], 0)[joined([x for x, _ in rows], 1)])))
    least, most = of_repetitions([statistic(a[r], b[r]) for r in range(min(len(a), len(b)))])
    return statistic(*middle), (min(least, low), max(most, high))


def k7(found, sweep):
    ratios, times_per_lmd = {}, {}
    for one in usable(sweep.points):
        other = partner(one, sweep) if one.series.startswith("original") and "points" not in one.series else None
        ratio = update_ratio(one, other) if other is not None else None
        if ratio is None:
            continue
        ratios[(one.scene, one.period, cutoff_share(one))] = ratio[1]
        both = {"original": one, "improved": other}
        per_lmd = {name: 1e9 * p.number("local_update_per_tracked_s") for name, p in both.items()}
        times_per_lmd.setdefault(one.scene, []).append(tuple(per_lmd.values()))
        found.add({"scene": one.scene, "search every [frames]": one.period, **size_columns(one), "improved / original, median": interval(*ratio),
                   "mean": shown(other.number("local_update_filled_mean_s") / one.number("local_update_filled_mean_s")),
                   "per LMD carried": shown(per_lmd["improved"] / per_lmd["original"]),
                   **{f"{name}, median [us]": shown(1e6 * p.number("local_update_filled_median_s")) for name, p in both.items()},
                   **{f"{name} per LMD [ns]": shown(time) for name, time in per_lmd.items()},
                   **{f"{name}, empty set [ns]": shown(1e9 * p.number("local_update_empty_median_s")) for name, p in both.items()},
                   **{f"{name}, frames without LMD": shown(p.number("frames_empty")) for name, p in both.items()}})
    for (scene, period, share), (low, high) in ratios.items():
        soft = ratios.get((scene.replace("hard", "soft"), period, share if share != 0.005 else 0.05))
        if "hard" in scene and soft is not None:
            less = HOLDS if soft[1] < 0.9 * low else FAILS if soft[0] > 0.9 * high else OPEN
            found.cells[f"cutoff {100 * share:g} % | a search every {period} frames"] = all_of(
                decide(low, high, at_least=2.0), decide(*soft, at_least=1.0), less)
    return why_k7(times_per_lmd)


def why_k7(times_per_lmd):
    """@param times_per_lmd {scene: [(original, improved)]} [ns]"""
    texts = []
    for word in ("hard", "soft"):
        own = [pair for scene, pairs in times_per_lmd.items() if word in scene for pair in pairs]
        if own:
            original, improved = (span(times) for times in zip(*own))
            texts.append(f"{word}: original {original} ns, improved {improved} ns")
    if not texts:
        return []
    return ["Why: an update costs by the LMDs that it carries (sum of times over sum of LMDs: " + "; ".join(texts) + "). The original's is the dearer the "
            "larger the cutoff, because the updates that take over a search's set walk from all the pairs that it found; the improved one "
            "receives a reduced set. A median sees none of those updates, the mean and the time per LMD do.", ""]


def k8(found, roles):
    """Of the JSON of `lmdbench-study roles`, a row a repetition."""
    for label in dict.fromkeys(row["label"] for row in roles["rows"]):
        runs = [row for row in roles["rows"] if row["label"] == label]
        has_parts = all("force_share" in run for run in runs)
        ratios = against_the_others(runs, "device_share")
        method, _, profile = label.partition("-")
        name, cell = f"{method} | {profile}", ""
        if method in ("original", "improved"):
            one_core = decide(*of_repetitions([run["together"]["p99_s"] for run in runs]), at_most=1e-3)
            need_less = lambda ratios: all_of(*(decide(*of_repetitions(values), at_most=0.5) for values in ratios), one_core)  # noqa: E731
            found.cells[name] = cell = need_less(ratios)
            if has_parts:
                found.cells[f"{method}, the simulated device's motion left out | {profile}"] = need_less(against_the_others(runs, "force_share"))
        middle = lambda share: shown(1e3 * float(np.median([run[share] for run in runs])))  # noqa: E731
        times = {f"{words}, {kind}": shown(1e6 * float(np.median([run[stage][key] for run in runs])))
                 for words, stage in (("device loop", "device"), ("device and local", "together"))
                 for kind, key in (("median [us]", "median_s"), ("99 %", "p99_s"), ("largest", "maximum_s"))}
        found.add({"method and profile": label, "repetitions": len(runs), "device loop [ms/s]": middle("device_share"),
                   "of it sum and clip of the forces": middle("force_share") if has_parts else "-", "local tracking [ms/s]": middle("local_share"),
                   "global thread [ms/s]": middle("global_share"),
                   **{f"device / {other}": interval(float(np.median(values)), (min(values), max(values))) for other, values in zip(("local", "global"), ratios)},
                   **times, "above 1 ms, worst repetition": max(run["together_above_1ms"] for run in runs), "K8": cell})


def against_the_others(runs, share):
    """That share of the processor over those of local tracking and of the global thread, each a number a run."""
    return [[run[share] / run[other] if run[other] > 0 else math.inf for run in runs] for other in ("local_share", "global_share")]


def k9(found, *sweeps):
    for point in (point for series in ("improved", "original") for sweep in sweeps for point in usable(sweep.of(series=series))):
        experiment = point.experiment
        smallest = min(triangles(body["mesh"]) for body in (experiment["moving"], *experiment["fixed"]))
        if not math.isfinite(point.number("local_update_p99_s")) or not smallest > 10_000:
            continue
        times, _ = updates(point)
        counts = point.sweep.samples(point, "counts").astype(bool)
        value = float(np.quantile(np.median(times, axis=0)[counts], 0.99))
        least, most = of_repetitions([float(np.quantile(run[counts], 0.99)) for run in times])
        limits = (min(least, value), max(most, value))
        cell = decide(*limits, at_most=1e-3)
        share = f"{100 * cutoff_share(point):g} %" if math.isfinite(cutoff_share(point)) else "own cutoff"
        found.add({"method": point.series, "scene": point.scene, "moving mesh": mesh(point), "smallest mesh [triangles]": f"{smallest:.0f}", "cutoff": share,
                   "search every [frames]": point.period, "local update, median [us]": shown(1e6 * point.number("local_update_median_s")),
                   "99th percentile [us]": interval(1e6 * value, [1e6 * x for x in limits]),
                   "largest [us]": shown(1e6 * point.number("local_update_maximum_s")), "above 1 ms [%]": shown(100 * np.mean(times[:, counts] > 1e-3)),
                   "recall [%]": shown(100 * point.number("recall")), "force error, RMS [% of F_max]": shown(100 * point.force_error), "K9": cell},
                  f"{point.series} | {point.scene}, {mesh(point)}, {'' if share == 'own cutoff' else 'cutoff '}{share}, {schedule(point.period)}", cell)
