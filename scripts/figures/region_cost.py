# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Regions of the claims on cost: K5 to K9. Counters decide where they can. A ratio of times has an interval: the bootstrap
over searches or blocks of frames, widened to what the single repetitions say, so that it spans the machine's moods too."""

import math

import numpy as np

from intervals import bootstrap
from region_rules import (FAILS, HOLDS, OPEN, all_of, blocks, cutoff_share, decide, groups, joined, mean_edges, mesh, of_repetitions, partner, span, triangles,
                          usable)
from tables import interval, shown, table


def options_text(options):
    return f"visibility {options['visibility']}, {options['reduction']} reduction, leaf cones {options.get('leaf_cones', 'one-ring')}"


def k5(sweep):
    rows, cells, counts = [], {}, {}
    for point in usable(sweep.points):
        options = point.experiment["methods"][0]
        if not point.series.startswith("improved") or options.get("plain_cache"):
            continue
        candidates, kept = point.number("candidates"), point.number("kept")
        ratio = candidates / kept if kept else math.nan
        largest = point.number("reduction_ratio_maximum")
        if not point.number("seconds_in_contact") > 0:
            continue  # the path stays beyond the cutoff
        cell = HOLDS if 10 <= largest <= 40 else FAILS
        cells[f"{options_text(options)} | {mesh(point)}, cutoff {100 * cutoff_share(point):g} %"] = cell
        choice = (options["visibility"], options["reduction"], options.get("leaf_cones", "one-ring"))
        counts.setdefault((mesh(point), cutoff_share(point)), {})[choice] = candidates, kept
        rows.append([mesh(point), f"{100 * cutoff_share(point):g}", mean_edges(point), *choice, shown(candidates), shown(kept), shown(ratio),
                     shown(largest), shown(100 * point.number("recall")), cell])
    text = ["Rule: the largest ratio of candidates to LMDs that the first reduction keeps lies between 10 and 40. Counts, the same in every "
            "run: no interval. The ratio over all searches is sum over sum.", ""]
    text += table(["meshes", "cutoff [% of diagonal]", "[mean edges]", "visibility", "reduction", "leaf cones", "candidates", "kept",
                   "ratio over all", "largest", "recall [%]", "K5"], rows)
    growing = []
    for (share,), points in groups(sweep.of(series="improved"), cutoff_share).items():
        by_mesh = {mesh(p): p.number("candidates") / p.number("kept") for p in points if p.number("kept")}
        values = list(by_mesh.values())
        if not values:
            continue
        growing.append(f"cutoff {100 * share:g} %: " + ", ".join(f"{name} {shown(value)}" for name, value in by_mesh.items())
                       + (" (grows)" if values == sorted(values) else " (does not grow)"))
    return text + ["Ratio over all searches with density: " + "; ".join(growing) + ".", ""] + why_k5(counts), cells


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


class Searches:
    """Times of a point's searches in contact, (R, S) [s], the warm-up left out."""

    def __init__(self, point):
        counts = point.sweep.samples(point, "counts").astype(bool)
        busy = counts[point.sweep.samples(point, "global_frame").astype(int)]
        self.search, self.reduction = (self._measured(point, name, busy) for name in ("global_search_time", "first_reduction_time"))

    @staticmethod
    def _measured(point, name, busy):
        times = np.atleast_2d(point.sweep.samples(point, name))
        return np.nan_to_num(times[1 if len(times) > 1 else 0:][:, busy])


def time_interval(columns, statistic):
    """(value, (low, high)) of a statistic of columns (R, N) of times that belong together by N: of the medians over the
    repetitions, with the bootstrap over N widened to the single repetitions."""
    middle = [np.median(column, axis=0) for column in columns]
    low, high = bootstrap(list(zip(*middle)), lambda rows: statistic(*np.array(rows).T))
    least, most = of_repetitions([statistic(*(column[r] for column in columns)) for r in range(min(len(column) for column in columns))])
    return statistic(*middle), (min(least, low), max(most, high))


def k6(sweep):
    rows, cells, measured = [], {}, []
    originals = {(mesh(p), cutoff_share(p)): p for p in usable(sweep.of(series="original"))}
    for point in usable(sweep.of(series="improved") + sweep.of(series="improved-plain-cache")):
        one = originals.get((mesh(point), cutoff_share(point)))
        if one is None:
            continue
        a, b = Searches(one), Searches(point)
        if not a.search.size or not b.search.size:
            continue
        nodes, leaves = (point.counter(name) / one.counter(name) for name in ("node_pairs", "leaf_pairs"))
        base = time_interval((b.search, a.search), lambda new, old: np.median(new) / np.median(old))
        share = time_interval((b.reduction, b.search), lambda reduction, search: np.quantile(reduction / search, 0.99))
        total = time_interval((b.search, b.reduction, a.search), lambda new, more, old: np.median(new + more) / np.median(old))
        cell = all_of(decide(*base[1], at_least=0.8, at_most=1.25), decide(*share[1], at_least=0.8), decide(*total[1], at_least=1.5, at_most=2.5))
        cache = "plain" if point.experiment["methods"][0].get("plain_cache") else "ours"
        cells[f"{mesh(point)}{', plain hash map as cache' if cache == 'plain' else ''} | cutoff {100 * cutoff_share(point):g} %"] = cell
        distances = point.counter("triangle_distances") / point.counter("leaf_pairs")
        middle = float(np.median(b.reduction / b.search))
        measured.append((nodes, leaves, base[0], distances, middle, total[0]))
        rows.append([mesh(point), f"{100 * cutoff_share(point):g}", mean_edges(point), cache, shown(nodes), shown(leaves), shown(distances),
                     shown(1e3 * float(np.median(a.search))), interval(*base), shown(middle), interval(*share), interval(*total), cell])
    text = ["Rule: base ratio 0.8 to 1.25; the reduction can take as long as the search: 99th percentile of reduction / search at least 0.8; "
            "total ratio 1.5 to 2.5; all by the ends of their intervals (bootstrap over the searches in contact, widened to the single "
            "repetitions; points interleaved in random order). The counters beside them are the same in every run. Cache: ours is an "
            "open-addressing table, plain a std::unordered_map.", ""]
    text += table(["meshes", "cutoff [% of diagonal]", "[mean edges]", "cache", "node pairs, improved / original", "leaf pairs, improved / original",
                   "triangle distances, all, / leaf pairs", "original's search, median [ms]", "base ratio", "reduction / search, median",
                   "99th percentile", "total ratio", "K6"], rows)
    return text + why_k6(measured), cells


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
            f"{span(total)} and rarely reaches twice.", ""]


def updates(point):
    """Times of local updates [s] by repetition and which frames count and carry LMDs."""
    times = np.atleast_2d(point.sweep.samples(point, "local_update_time"))
    counts = point.sweep.samples(point, "counts").astype(bool)
    return times[1 if len(times) > 1 else 0:], counts & (point.sweep.samples(point, "tracked_count") > 0)


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


def k7(sweep):
    rows, ratios, cells, times_per_lmd = [], {}, {}, {}
    for one in usable(sweep.points):
        other = partner(one, sweep) if one.series.startswith("original") and "points" not in one.series else None
        found = update_ratio(one, other) if other is not None else None
        if found is None:
            continue
        ratios[(one.scene, one.period, cutoff_share(one))] = found[1]
        per_lmd = [1e9 * p.number("local_update_per_tracked_s") for p in (one, other)]
        times_per_lmd.setdefault(one.scene, []).append(per_lmd)
        rows.append([one.scene, one.period, f"{100 * cutoff_share(one):g}", mean_edges(one), interval(*found),
                     shown(other.number("local_update_filled_mean_s") / one.number("local_update_filled_mean_s")), shown(per_lmd[1] / per_lmd[0]),
                     *(shown(1e6 * p.number("local_update_filled_median_s")) for p in (one, other)), *(shown(x) for x in per_lmd),
                     *(shown(1e9 * p.number("local_update_empty_median_s")) for p in (one, other)),
                     *(shown(p.number("frames_empty")) for p in (one, other))])
    for (scene, period, share), (low, high) in ratios.items():
        soft = ratios.get((scene.replace("hard", "soft"), period, share if share != 0.005 else 0.05))
        if "hard" not in scene or soft is None:
            continue
        less = HOLDS if soft[1] < 0.9 * low else FAILS if soft[0] > high else OPEN
        cells[f"cutoff {100 * share:g} % | a search every {period} frames"] = all_of(
            decide(low, high, at_least=2.0), decide(*soft, at_least=1.0), less)
    text = ["Rule: the improved update is at least twice the original's when hard, slower when soft, and less so when soft by a tenth. Only frames "
            "whose set is not empty (an empty set costs no more than the clock); per LMD: sum of times over sum of LMDs carried. Reading the "
            f"clock costs {1e9 * sweep.clock_overhead:.0f} ns of each update. 95 % intervals: bootstrap over blocks of frames, widened to the single "
            "repetitions.", ""]
    text += table(["scene", "search every [frames]", "cutoff [% of diagonal]", "[mean edges]", "improved / original, median", "mean", "per LMD carried",
                   "original, median [us]", "improved, median [us]", "original per LMD [ns]", "improved per LMD [ns]", "original, empty set [ns]",
                   "improved, empty set [ns]", "original, frames without LMD", "improved, frames without LMD"], rows)
    return text + why_k7(times_per_lmd), cells


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


def against_the_others(runs, share):
    """That share of the processor over those of local tracking and of the global thread, each a number a run."""
    return [[run[share] / run[other] if run[other] > 0 else math.inf for run in runs] for other in ("local_share", "global_share")]


def k8(roles):
    """Of the JSON of `lmdbench-study roles`, a row a repetition."""
    rows, cells = [], {}
    labels = list(dict.fromkeys(row["label"] for row in roles["rows"]))
    for label in labels:
        runs = [row for row in roles["rows"] if row["label"] == label]
        has_parts = all("force_share" in run for run in runs)
        ratios = against_the_others(runs, "device_share")
        late = [run["together"]["p99_s"] for run in runs]
        if label.startswith(("original", "improved")):
            method, _, profile = label.partition("-")
            one_core = decide(*of_repetitions(late), at_most=1e-3)
            need_less = lambda found: all_of(*(decide(*of_repetitions(values), at_most=0.5) for values in found), one_core)  # noqa: E731
            cells[f"{method} | {profile}"] = need_less(ratios)
            if has_parts:
                cells[f"{method}, the simulated device's motion left out | {profile}"] = need_less(against_the_others(runs, "force_share"))
        middle = lambda name: shown(1e3 * float(np.median([run[name] for run in runs])))  # noqa: E731
        stage = lambda name, key: shown(1e6 * float(np.median([run[name][key] for run in runs])))  # noqa: E731
        rows.append([label, len(runs), middle("device_share"), middle("force_share") if has_parts else "-", middle("local_share"), middle("global_share"),
                     *(interval(float(np.median(values)), (min(values), max(values))) for values in ratios),
                     *(stage("device", key) for key in ("median_s", "p99_s", "maximum_s")),
                     *(stage("together", key) for key in ("median_s", "p99_s", "maximum_s")),
                     max(run["together_above_1ms"] for run in runs), cells.get(label.replace("-", " | ", 1), "")])
    text = ["Rule: the device loop (sum of the forces, clip, motion of the simulated device) takes at most half the processor time of local "
            "tracking and at most half that of the global thread, and 99 % of the frames of device loop and local tracking together stay "
            "under 1 ms, so that one core serves both; intervals: lowest and highest repetition. Closed loop of "
            f"`experiments/{roles['experiment']}.json`, a search every 20 frames. A method that searches in every frame has no global thread. A real "
            "device is moved by a hand: the motion that the closed loop simulates stands in the device loop, and is also left out as settings of their own.", ""]
    return text + table(["method and profile", "repetitions", "device loop [ms/s]", "of it sum and clip of the forces", "local tracking [ms/s]", "global thread [ms/s]",
                         "device / local", "device / global", "device loop, median [us]", "99 %", "largest", "device and local, median [us]",
                         "99 %", "largest", "above 1 ms, worst repetition", "K8"], rows), cells


def k9(*sweeps):
    rows, cells = [], {}
    for sweep in sweeps:
        for point in usable(sweep.points):
            if point.method != "improved" or not point.series == "improved" or not math.isfinite(point.number("local_update_p99_s")):
                continue
            experiment = point.experiment
            smallest = min(triangles(body["mesh"]) for body in (experiment["moving"], *experiment["fixed"]))
            if not smallest > 10_000:
                continue
            times, _ = updates(point)
            counts = point.sweep.samples(point, "counts").astype(bool)
            singles = [float(np.quantile(run[counts], 0.99)) for run in times]
            value = float(np.quantile(np.median(times, axis=0)[counts], 0.99))
            least, most = of_repetitions(singles)
            limits = (min(least, value), max(most, value))
            cell = decide(*limits, at_most=1e-3)
            share = f"cutoff {100 * cutoff_share(point):g} %" if math.isfinite(cutoff_share(point)) else "own cutoff"
            cells[f"{point.scene}, {mesh(point)}, {share} | a search every {point.period} frames"] = cell
            rows.append([point.scene, mesh(point), f"{smallest:.0f}", share.replace("cutoff ", ""), point.period,
                         shown(1e6 * point.number("local_update_median_s")), interval(1e6 * value, tuple(1e6 * x for x in limits)),
                         shown(1e6 * point.number("local_update_maximum_s")), shown(1e-3 / value),
                         shown(100 * point.number("recall")), shown(100 * point.force_error), cell])
    text = ["Rule: the 99th percentile of the improved local update is under 1 ms on meshes of more than 10,000 triangles each, in every "
            "repetition (interval: lowest and highest one).", ""]
    return text + table(["scene", "moving mesh", "smallest mesh [triangles]", "cutoff", "search every [frames]", "local update, median [us]", "99th percentile [us]",
                         "largest [us]", "1 kHz, times", "recall [%]", "force error, RMS [% of F_max]", "K9"], rows), cells
