# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What two runs say of the claims K1 to K10 (claim_rules.py): numbers in a sentence, whether each part of the claim holds (no part: not measured), the
numbers, and what to say where all parts hold."""

from dataclasses import dataclass

import numpy as np

from intervals import Rate
from lmdbench_results import median, quantile, truth_of
from region_rules import FAILS, HOLDS, LEAST_REPETITIONS, OPEN, all_of


@dataclass
class Runs:
    """What the claims are judged by: a run with hard contact and one with soft; `others` on other meshes, for the dependence on
    density (K5); `unequal` on meshes with large or unequal triangles (K10)."""

    hard: object
    soft: object
    others: tuple = ()
    unequal: tuple = ()

    @property
    def pair(self):
        return [self.hard, self.soft]


def of_each(results, look):
    """(text, parts, numbers) of a rule that is asked of several results; look(result) gives them of one."""
    found = [(result.name, *look(result)) for result in results]
    return ("; ".join(f"{name}: {text}" for name, text, _, _ in found) + ".",
            {f"{name}: {part}": holds for name, _, parts, _ in found for part, holds in parts.items()},
            {name: numbers for name, _, _, numbers in found})


def judge(parts):
    """Whether all named parts of a claim hold in these runs (None: undecided), and which do not."""
    cells = {name: OPEN if holds is None else HOLDS if holds else FAILS for name, holds in parts.items()}
    rest = [f"{words}: {'; '.join(name for name, cell in cells.items() if cell == kind)}"
            for kind, words in ((FAILS, "not"), (OPEN, "undecided")) if kind in cells.values()]
    return all_of(*cells.values()), "; ".join(rest)


def inside(values, low=-np.inf, high=np.inf):
    """Whether what the repetitions say lies within limits: None where they disagree or there is but one, so that nothing said of
    times turns from run to run."""
    within = [bool(low <= value <= high) for value in values]
    return within[0] if len(within) >= LEAST_REPETITIONS and len(set(within)) == 1 else None


def both(result):
    return result.method("original"), result.method("improved")


def errors(result):
    """What stands beside every time: recall and force error of both methods."""
    texts = []
    for method in both(result):
        texts.append(f"{method.label} {100 * method.number('recall'):.0f} % "
                     f"({100 * method.number('recall_adjacent'):.0f} % with neighbouring features), "
                     f"{method.number('force_error_rms_n'):.2f} N" if truth_of(method)
                     else f"{method.label} not measured")
    return f"(recall and RMS force error, {result.name}: " + "; ".join(texts) + ")"


ZERO_SHARE, STRONG_SHARE = 0.05, 0.5


def switches(method):
    """How often a second in contact the force changes within one frame from below 5 % of F_max to above 50 % or back, with
    the limits of its count."""
    result = method.result
    force = method.force_magnitude() / result.maximum_force()
    low, high = np.minimum(force[1:], force[:-1]), np.maximum(force[1:], force[:-1])
    seconds = result.seconds_in_contact()
    return Rate([np.count_nonzero((low < ZERO_SHARE) & (high > STRONG_SHARE))], [seconds])


def events(rate):
    return {"count": rate.count, "seconds": rate.seconds, "per_second": rate.value, "low": rate.low, "high": rate.high}


def k1(runs):
    original, improved = both(runs.hard)
    switch_o, switch_i = switches(original), switches(improved)
    large = {method.label: method.events("jumps") for method in both(runs.hard)}
    true = {method.label: method.events("true_jumps") for method in both(runs.hard)}
    text = (f"a second [95 %], or of fewer than ten how many in what time: zero-to-strong switches original {switch_o}, improved "
            f"{switch_i}; changes above 25 % of F_max original {large['original']} (truth under its law {true['original']}), improved "
            f"{large['improved']} (truth {true['improved']}). " + errors(runs.hard))
    return text, {
        "the improved force switches between zero and strong at most a tenth as often":
            True if switch_i.high <= 0.1 * switch_o.low else False if switch_i.low > 0.1 * switch_o.high else None,
        "the original jumps from zero to strong and back": inside((switch_o.low, switch_o.high), 1.0),
    }, {"switches": {"original": events(switch_o), "improved": events(switch_i)},
        "large_changes": {name: events(rate) for name, rate in large.items()},
        "true_large_changes": {name: events(rate) for name, rate in true.items()}}


def k2(runs):
    counts = {method.label: {name: method.number(f"lmd_count_{name}") for name in ("median", "p99", "maximum")} for method in both(runs.hard)}
    share = {method.label: float(np.mean(method.read("lmd_count")[runs.hard.in_contact()] < 10)) for method in both(runs.hard)}
    text = "; ".join(f"{label} median {value['median']:.0f}, 99th percentile {value['p99']:.0f}, most {value['maximum']:.0f}, under 10 in "
                     f"{100 * share[label]:.1f} % of frames" for label, value in counts.items())
    return (text + ".", {f"{label}'s set stays under 10": value["p99"] < 10 for label, value in counts.items()},
            {"lmd_count": counts, "share_under_10": share})


def k3(runs):
    contact = runs.soft.in_contact()
    force_o, force_i = (method.force_magnitude()[contact] for method in both(runs.soft))
    mean_o, mean_i = float(np.mean(force_o)), float(np.mean(force_i))
    excess = mean_o / mean_i - 1.0 if mean_i > 0 else float("nan")
    varying = force_o.std() > 0 and force_i.std() > 0
    correlation = float(np.corrcoef(force_o, force_i)[0, 1]) if varying else float("nan")
    text = (f"correlation {correlation:.2f}; mean force original {mean_o:.2f} N, improved {mean_i:.2f} N ({100 * excess:+.0f} %). "
            + errors(runs.soft))
    return text, {
        "the forces are very similar (correlation)": correlation >= 0.8,
        "the original's is higher": excess > 0.0,
        "by little (up to 50 %)": abs(excess) <= 0.5,
    }, {"correlation": correlation, "mean_force_n": {"original": mean_o, "improved": mean_i}}


def k4(runs):
    def look(result):
        contact, seconds = result.in_contact(), result.seconds_in_contact()
        mean = {m.label: float(np.mean(m.read("lmd_count")[contact])) for m in both(result)}
        change = {m.label: float(np.sum(np.abs(np.diff(m.read("lmd_count"))))) / seconds for m in both(result)}
        ratio = mean["original"] / mean["improved"] if mean["improved"] > 0 else float("nan")
        text = (f"mean LMDs original {mean['original']:.2f}, improved {mean['improved']:.2f} (ratio {ratio:.2f}); LMDs gained and lost per "
                f"second original {change['original']:.0f}, improved {change['improved']:.0f}")
        return (text, {"similar counts": 2 / 3 <= ratio <= 1.5, "the original fluctuates more": change["original"] > change["improved"]},
                {"mean": mean, "changes_per_second": change})

    return of_each(runs.pair, look)


def k5(runs):
    def look(result):
        improved, triangles = result.method("improved"), result.triangles()
        ratio, most = improved.number("reduction_ratio"), improved.number("reduction_ratio_maximum")
        return (f"{ratio:.1f} over all searches, {most:.1f} at most ({triangles:,} triangles)", {},
                {"reduction_ratio": ratio, "reduction_ratio_maximum": most, "triangles": triangles})

    results = [*runs.pair, *runs.others]
    text, _, numbers = of_each(results, look)
    found = [look(result)[2] for result in results]  # two of them may have one name
    parts = {"up to about twenty times (10 to 40)": 10 <= max(one["reduction_ratio_maximum"] for one in found) <= 40}
    thin, dense = (end(one["triangles"] for one in found) for end in (min, max))
    if dense < 2 * thin:
        return text, parts, numbers, "as far as measured; results of one density do not show the growth with the mesh"
    of_thin, of_dense = (np.mean([one["reduction_ratio"] for one in found if one["triangles"] == density]) for density in (thin, dense))
    return text, {**parts, "larger for denser meshes": of_dense > of_thin}, numbers


def search_ratios(original, improved, busy, repetition):
    """Base ratio, 99th percentile of reduction / search, and total ratio of one repetition, searches in contact."""
    old, new, more = (method.times(name)[repetition][busy] for method, name in (
        (original, "global_search_time"), (improved, "global_search_time"), (improved, "first_reduction_time")))
    return median(new) / median(old), quantile(more / new, 0.99), median(new + more) / median(old)


def k6(runs):
    def look(result):
        original, improved = both(result)
        base_o, base_i = (method.number("global_search_median_s") for method in both(result))
        total = improved.number("search_with_reduction_median_s") / base_o
        busy = result.in_contact()[improved.read("global_frame").astype(int)]
        share = (improved.median_times("first_reduction_time") / improved.median_times("global_search_time"))[busy]
        base, reduction, whole = zip(*(search_ratios(original, improved, busy, r) for r in range(len(improved.times("global_search_time")))))
        text = (f"base {base_i * 1e3:.3f} against {base_o * 1e3:.3f} ms (ratio {base_i / base_o:.2f}); reduction / search median "
                f"{median(share):.2f}, 99th percentile {quantile(share, 0.99):.2f}; total ratio {total:.2f} {errors(result)}")
        return text, {
            "base time almost equal": inside(base, 0.8, 1.25),
            "the reduction can take as long as the search": inside(reduction, 0.8),
            "total about twice the original": inside(whole, 1.5, 2.5),
        }, {"base_ratio": base_i / base_o, "reduction_share_median": median(share), "reduction_share_p99": quantile(share, 0.99),
            "total_ratio": total}

    return of_each(runs.pair, look)


def local_ratio(result):
    """Ratio of the medians, the medians, and the ratio of the means: an update that receives a new set of candidates
    is long, and only the mean sees these few."""
    times = {m.label: m.median_times("local_update_time")[result.in_contact()] for m in both(result)}
    middle = {m.label: m.number("local_update_median_s") for m in both(result)}
    means = np.mean(times["improved"]) / np.mean(times["original"])
    return middle["improved"] / middle["original"], middle, float(means)


def update_ratios(result):
    """Improved / original of the median local update, by repetition."""
    contact = result.in_contact()
    new, old = (np.median(result.method(label).times("local_update_time")[:, contact], axis=1) for label in ("improved", "original"))
    return new[: len(old)] / old[: len(new)]


def k7(runs):
    hard, soft = ({"ratio": ratio, "times": times, "means": means} for ratio, times, means in map(local_ratio, runs.pair))
    hard_ratios, soft_ratios = map(update_ratios, runs.pair)
    hard_ratios, soft_ratios = hard_ratios[: len(soft_ratios)], soft_ratios[: len(hard_ratios)]
    medians = ", ".join(f"{name} {one['ratio']:.1f} ({one['times']['improved'] * 1e6:.1f} against {one['times']['original'] * 1e6:.1f} us)"
                        for name, one in (("hard", hard), ("soft", soft)))
    text = (f"{medians}; ratio of the means, which sees the few long updates that receive a new search's set: hard {hard['means']:.2f}, "
            f"soft {soft['means']:.2f}. {errors(runs.hard)} {errors(runs.soft)}")
    return text, {
        "the local update is slower": inside(np.minimum(hard_ratios, soft_ratios), 1.0),
        "much slower when hard (at least twice)": inside(hard_ratios, 2.0),
        "less so when soft": inside(soft_ratios / hard_ratios, high=0.9),
    }, {name: {"hard": hard[key], "soft": soft[key]}
        for name, key in (("ratio", "ratio"), ("ratio_of_means", "means"), ("local_update_s", "times"))}


def k8(_):
    return "These runs have no device loop; `lmdbench-study roles` times it in a closed loop (claim-regions.md).", {}, {}


def k9(runs):
    def look(result):
        improved, triangles = result.method("improved"), result.triangles(smallest=True)
        samples = improved.times("local_update_time")
        late, p99 = float(np.mean(samples > 1e-3)), improved.number("local_update_p99_s")
        text = (f"local update 99th percentile {p99 * 1e3:.3f} ms ({1e-3 / p99:.0f} times the rate of 1 kHz), {100 * late:.3f} % of updates "
                f"above 1 ms; meshes of at least {triangles:,} triangles {errors(result)}")
        return text, {
            "over 10,000 triangles a mesh": triangles > 10_000,
            "above 1 kHz": inside(np.quantile(samples[:, result.in_contact()], 0.99, axis=1), high=1e-3),
        }, {"local_update_p99_s": p99, "share_above_1ms": late, "smallest_mesh_triangles": triangles}

    return of_each(runs.pair, look)


def k10(runs):
    parts, texts, numbers = {}, [], {}
    for result, dense in [(r, True) for r in runs.pair] + [(r, False) for r in runs.unequal]:
        original = result.method("original")
        if truth_of(original) is None:
            continue
        missed, near = 1 - original.number("recall"), 1 - original.number("recall_adjacent")
        texts.append(f"{result.name} ({'dense' if dense else 'large or unequal'}): the original misses "
                     f"{100 * missed:.1f} % of the true LMDs, {100 * near:.1f} % when a neighbouring feature counts")
        numbers[result.name] = {"missed": missed, "missed_adjacent": near, "dense": dense}
        if dense:
            parts[f"{result.name}: pairs are rarely missed on a dense mesh"] = near <= 0.05
        else:
            parts[f"{result.name}: pairs are missed on large or unequal triangles"] = near >= 0.1
    if not parts:
        return "The results have no truth probe.", {}, {}
    return "; ".join(texts) + ".", parts, numbers, "" if runs.unequal else "as far as measured; no result on large or unequal triangles was given"
