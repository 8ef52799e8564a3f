# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What two runs say of the claims K1 to K10 (claim_rules.py): numbers in a sentence, whether each part of the claim holds (no part: not measured), and
what to say where all parts hold."""

import numpy as np

from intervals import Rate
from lmdbench_results import median, quantile, truth_of
from region_rules import FAILS, HOLDS, LEAST_REPETITIONS, OPEN, all_of


def of_each(results, look):
    """(text, parts) of a rule that is asked of several results; look(result) gives them of one."""
    found = [(result.name, *look(result)) for result in results]
    return ("; ".join(f"{name}: {text}" for name, text, _ in found) + ".",
            {f"{name}: {part}": holds for name, _, parts in found for part, holds in parts.items()})


def judge(parts):
    """Whether all named parts of a claim hold in these runs (None: undecided), and which do not."""
    cells = {name: OPEN if holds is None else HOLDS if holds else FAILS for name, holds in parts.items()}
    rest = [f"{words}: {'; '.join(name for name, cell in cells.items() if cell == kind)}"
            for kind, words in ((FAILS, "not"), (OPEN, "undecided")) if kind in cells.values()]
    return all_of(*cells.values()), "; ".join(rest)


def decided(value, holds):
    """None where the value that decides was not measured."""
    return None if np.isnan(value) else bool(holds)


def inside(values, low=-np.inf, high=np.inf):
    """Whether what the repetitions say lies within limits: None where they disagree, one is not measured or there is but one, so that nothing said
    of times turns from run to run."""
    within = [decided(value, low <= value <= high) for value in values]
    return within[0] if len(within) >= LEAST_REPETITIONS and len(set(within)) == 1 else None


def said(value, digits=2, unit=""):
    return "not measured" if np.isnan(value) else f"{value:.{digits}f}{unit}"


def why_not(result):
    """What keeps a result from being judged, if anything: claims compare the paper's methods, which see the same poses, search at the same frames and
    touch something."""
    for name in ("original", "improved"):
        if name in result.methods and result.methods[name].name != name:
            return f"gives the name {name} to the method {result.methods[name].name}"
    if result.has("/realtime"):
        return "is of the driver realtime, in which each method searches when it can"
    if any(method.has("loop") for method in result.methods.values()):
        return "is of a closed loop, in which each method has poses of its own"
    return "" if result.number("frames_in_contact") > 0 else "has no frame in contact"


def both(result):
    return result.method("original"), result.method("improved")


def errors(result):
    """What stands beside every time: recall and force error of both methods."""
    texts = []
    for method in both(result):
        texts.append(f"{method.label} {said(100 * method.number('recall'), 0, ' %')} "
                     f"({said(100 * method.number('recall_adjacent'), 0, ' %')} with neighbouring features), "
                     f"{said(method.number('force_error_rms_n'), 2, ' N')}" if truth_of(method)
                     else f"{method.label} not measured")
    return f"(recall and RMS force error, {result.name}: " + "; ".join(texts) + ")"


ZERO_SHARE, STRONG_SHARE = 0.05, 0.5


def switches(method):
    """How often a second in contact the force changes within one frame from below 5 % of F_max to above 50 % or back, with
    the limits of its count."""
    result = method.result
    force = method.force_magnitude() / method.constant("maximum_force_n")
    low, high = np.minimum(force[1:], force[:-1]), np.maximum(force[1:], force[:-1])
    return Rate([np.count_nonzero((low < ZERO_SHARE) & (high > STRONG_SHARE))], [result.seconds_in_contact()])


def k1(hard, _):
    original, improved = both(hard)
    switch_o, switch_i = switches(original), switches(improved)
    large = [f"{method.label} {method.events('jumps')} (truth {'under its law ' if method is original else ''}{method.events('true_jumps')})"
             for method in (original, improved)]
    return (f"a second [95 %], or of fewer than ten how many in what time: zero-to-strong switches original {switch_o}, improved "
            f"{switch_i}; changes above 25 % of F_max {', '.join(large)}. {errors(hard)}"), {
        "the improved force switches between zero and strong at most a tenth as often":
            True if switch_i.high <= 0.1 * switch_o.low else False if switch_i.low > 0.1 * switch_o.high else None,
        "the original jumps from zero to strong and back": inside((switch_o.low, switch_o.high), 1.0)}


def k2(hard, _):
    texts, parts = [], {}
    for method in both(hard):
        middle, p99, most = (method.number(f"lmd_count_{name}") for name in ("median", "p99", "maximum"))
        share = np.mean(method.read("lmd_count")[hard.in_contact()] < 10)
        texts.append(f"{method.label} median {middle:.0f}, 99th percentile {p99:.0f}, most {most:.0f}, under 10 in {100 * share:.1f} % of frames")
        parts[f"{method.label}'s set stays under 10"] = decided(share, share >= 0.99)
    return "; ".join(texts) + ".", parts


def k3(_, soft):
    forces = [method.force_magnitude()[soft.in_contact()] for method in both(soft)]
    original, improved = (float(np.mean(force)) for force in forces)
    excess = original / improved - 1.0 if improved > 0 else float("nan")
    correlation = float(np.corrcoef(*forces)[0, 1]) if all(force.std() > 0 for force in forces) else float("nan")
    more = "not measured" if np.isnan(excess) else f"{100 * excess:+.0f} %"
    return (f"correlation {said(correlation)}; mean force original {original:.2f} N, improved {improved:.2f} N ({more}). {errors(soft)}"), {
        "the forces are very similar (correlation)": decided(correlation, correlation >= 0.8),
        "the original's is higher": decided(excess, excess > 0.0),
        "by little (up to 50 %)": decided(excess, abs(excess) <= 0.5)}


def k4(*runs):
    def look(result):
        counts = [method.read("lmd_count") for method in both(result)]
        original, improved = (float(np.mean(count[result.in_contact()])) for count in counts)
        wild, calm = (float(np.sum(np.abs(np.diff(count)))) / result.seconds_in_contact() for count in counts)
        ratio = original / improved if improved > 0 else float("nan")
        return (f"mean LMDs original {original:.2f}, improved {improved:.2f} (ratio {said(ratio)}); the number changes by original {wild:.0f}, "
                f"improved {calm:.0f} LMDs a second"), {"similar counts": decided(ratio, 2 / 3 <= ratio <= 1.5), "the original fluctuates more": wild > calm}

    return of_each(runs, look)


def k5(*runs):
    def look(result):
        ratio, most = (result.method("improved").number(name) for name in ("reduction_ratio", "reduction_ratio_maximum"))
        return f"{said(ratio, 1)} over all searches, {said(most, 1)} at most ({result.triangles():,} triangles)", {}

    largest = quantile([result.method("improved").number("reduction_ratio_maximum") for result in runs], 1.0)
    return of_each(runs, look)[0], {"up to about twenty times (10 to 40)": decided(largest, 10 <= largest <= 40)}, "as far as measured; two runs do not show the growth with the mesh"


def search_ratios(original, improved, busy, repetition):
    """Base ratio, 99th percentile of reduction / search, and total ratio of one repetition, searches in contact."""
    old, new, more = (method.times(name)[repetition][busy] for method, name in (
        (original, "global_search_time"), (improved, "global_search_time"), (improved, "first_reduction_time")))
    return median(new) / median(old), quantile(more / new, 0.99), median(new + more) / median(old)


def k6(*runs):
    def look(result):
        original, improved = both(result)
        base_o, base_i = (method.number("global_search_median_s") for method in both(result))
        busy = result.in_contact()[improved.read("global_frame").astype(int)]
        share = (improved.median_times("first_reduction_time") / improved.median_times("global_search_time"))[busy]
        base, reduction, whole = zip(*(search_ratios(original, improved, busy, r) for r in range(len(improved.times("global_search_time")))))
        return (f"base {said(base_i * 1e3, 3)} against {said(base_o * 1e3, 3)} ms (ratio {said(base_i / base_o)}); reduction / search median "
                f"{said(median(share))}, 99th percentile {said(quantile(share, 0.99))}; total ratio "
                f"{said(improved.number('search_with_reduction_median_s') / base_o)} {errors(result)}"), {
            "base time almost equal": inside(base, 0.8, 1.25),
            "the reduction can take as long as the search": inside(reduction, 0.8),
            "total about twice the original": inside(whole, 1.5, 2.5)}

    return of_each(runs, look)


def update_ratios(result):
    """Improved / original of the median local update in contact, by repetition; and of the means, which alone see the few long updates that receive a
    new set of candidates."""
    contact = result.in_contact()
    old, new = (np.median(method.times("local_update_time")[:, contact], axis=1) for method in both(result))
    mean_old, mean_new = (np.mean(method.median_times("local_update_time")[contact]) for method in both(result))
    return new[: len(old)] / old[: len(new)], mean_new / mean_old


def k7(hard, soft):
    (hard_ratios, hard_means), (soft_ratios, soft_means) = map(update_ratios, (hard, soft))
    hard_ratios, soft_ratios = hard_ratios[: len(soft_ratios)], soft_ratios[: len(hard_ratios)]
    times = [(name, *(method.number("local_update_median_s") for method in both(result))) for name, result in (("hard", hard), ("soft", soft))]
    medians = ", ".join(f"{name} {new / old:.1f} ({new * 1e6:.1f} against {old * 1e6:.1f} us)" for name, old, new in times)
    return (f"{medians}; ratio of the means, which sees the few long updates that receive a new search's set: hard {hard_means:.2f}, "
            f"soft {soft_means:.2f}. {errors(hard)} {errors(soft)}"), {
        "the local update is slower": inside(np.minimum(hard_ratios, soft_ratios), 1.0),
        "much slower when hard (at least twice)": inside(hard_ratios, 2.0),
        "less so when soft": inside(soft_ratios / hard_ratios, high=0.9)}


def k8(*_):
    return "These runs have no device loop; `lmdbench-study roles` times it in a closed loop (claim-regions.md).", {}


def k9(*runs):
    def look(result):
        triangles, texts = result.triangles(smallest=True), []
        parts = {"over 10,000 triangles a mesh": triangles > 10_000}
        for method in both(result):
            samples = method.times("local_update_time")[:, result.in_contact()]
            texts.append(f"{method.label} {1e3 * method.number('local_update_p99_s'):.3f} ms, {100 * np.mean(samples > 1e-3):.2g} % of updates above 1 ms")
            parts[f"{method.label} above 1 kHz"] = inside(np.quantile(samples, 0.99, axis=1), high=1e-3)
        return f"local update, 99th percentile: {'; '.join(texts)}; meshes of at least {triangles:,} triangles {errors(result)}", parts

    return of_each(runs, look)


def k10(*runs):
    parts, texts = {}, []
    for result in runs:
        original = result.method("original")
        near = 1 - original.number("recall_adjacent")
        if np.isnan(near):
            continue
        texts.append(f"{result.name} (dense): the original misses {100 * (1 - original.number('recall')):.1f} % of the true LMDs, "
                     f"{100 * near:.1f} % when a neighbouring feature counts")
        parts[f"{result.name}: pairs are rarely missed on a dense mesh"] = near <= 0.05
    return "; ".join(texts) + "." if parts else "The results hold no true LMD in a probed frame.", parts, "as far as measured; no result on large or unequal triangles was given"
