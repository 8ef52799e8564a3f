# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's claims K1 to K10: its words, our measure, and the numbers of result files, which are one setting of the many that the
verdict rests on (claim_verdicts.py): the rule says whether the claim holds in it. The paper gives few numbers, so the thresholds
are ours: they read its words ("almost the same", "slightly") and are not fitted to what a run shows. A claim that does not
reproduce is a finding."""

from dataclasses import dataclass, field

import numpy as np

from claim_verdicts import NOT_MEASURED
from intervals import Rate
from lmdbench_results import median, quantile, truth_of
from region_rules import FAILS, HOLDS, LEAST_REPETITIONS, OPEN, all_of


@dataclass
class Claim:
    """One row: a claim, what these runs say of it, and the ledger's verdict."""

    id: str
    paper: str
    measure: str  # our reading of the words, with the rule
    result: str  # our numbers in a sentence
    setting: str  # whether the claim holds in these runs: HOLDS, FAILS, OPEN or NOT_MEASURED
    because: str = ""  # which of its parts do not, or are undecided
    numbers: dict = field(default_factory=dict)
    verdict: str = NOT_MEASURED  # over all settings
    reason: str = ""

    def in_this_setting(self):
        """For people; `because` begins with a word of its own, which the setting has said already where it is the same."""
        said = {FAILS: "not: ", OPEN: "undecided: "}.get(self.setting, "\0")
        return self.setting + (f": {self.because.removeprefix(said)}" if self.because else "")


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


def k1(hard):
    original, improved = both(hard)
    switch_o, switch_i = switches(original), switches(improved)
    large = {method.label: method.events("jumps") for method in both(hard)}
    true = {method.label: method.events("true_jumps") for method in both(hard)}
    setting, because = judge({
        "the improved force switches between zero and strong at most a tenth as often":
            True if switch_i.high <= 0.1 * switch_o.low else False if switch_i.low > 0.1 * switch_o.high else None,
        "the original jumps from zero to strong and back": inside((switch_o.low, switch_o.high), 1.0),
    })
    return Claim(
        "K1", "Hard: our method shows good force stability, the original jumps quickly from zero to strong force and "
        "back (6.1).",
        "Changes within one frame (1 ms at 1 kHz) between below 5 % and above 50 % of F_max, per second in contact: at "
        "least 1 for the original, at most a tenth of it for the improved one, by the ends of their 95 % intervals (Poisson).",
        f"a second [95 %], or of fewer than ten how many in what time: zero-to-strong switches original {switch_o}, improved "
        f"{switch_i}; changes above 25 % of F_max original {large['original']} (truth under its law {true['original']}), improved "
        f"{large['improved']} (truth {true['improved']}). " + errors(hard),
        setting, because,
        {"switches": {"original": events(switch_o), "improved": events(switch_i)},
         "large_changes": {name: events(rate) for name, rate in large.items()},
         "true_large_changes": {name: events(rate) for name, rate in true.items()}})


def k2(hard):
    counts = {}
    for method in both(hard):
        counts[method.label] = {name: method.number(f"lmd_count_{name}") for name in ("median", "p99", "maximum")}
    share = {method.label: float(np.mean(method.read("lmd_count")[hard.in_contact()] < 10)) for method in both(hard)}
    text = "; ".join(f"{label} median {value['median']:.0f}, 99th percentile {value['p99']:.0f}, most "
                     f"{value['maximum']:.0f}, under 10 in {100 * share[label]:.1f} % of frames"
                     for label, value in counts.items())
    return Claim("K2", "Hard: the working set of LMDs is relatively small (under 10) (6.1).",
                 "LMDs within the cutoff, frames in contact: the 99th percentile is under 10 for both methods.",
                 text + ".", *judge({f"{label}'s set stays under 10": value["p99"] < 10 for label, value in counts.items()}),
                 {"lmd_count": counts, "share_under_10": share})


def k3(soft):
    original, improved = both(soft)
    contact = soft.in_contact()
    force_o, force_i = original.force_magnitude()[contact], improved.force_magnitude()[contact]
    mean_o, mean_i = float(np.mean(force_o)), float(np.mean(force_i))
    excess = mean_o / mean_i - 1.0 if mean_i > 0 else float("nan")
    varying = force_o.std() > 0 and force_i.std() > 0
    correlation = float(np.corrcoef(force_o, force_i)[0, 1]) if varying else float("nan")
    setting, because = judge({
        "the forces are very similar (correlation)": correlation >= 0.8,
        "the original's is higher": excess > 0.0,
        "by little (up to 50 %)": abs(excess) <= 0.5,
    })
    return Claim("K3", "Soft: the resulting forces are very similar with both methods; the original generates slightly "
                 "higher force (6.1).",
                 "Lengths of the force over the frames in contact: correlation at least 0.8; the original's mean is 0 "
                 "to 50 % above the improved one's.",
                 f"correlation {correlation:.2f}; mean force original {mean_o:.2f} N, improved {mean_i:.2f} N "
                 f"({100 * excess:+.0f} %). " + errors(soft),
                 setting, because,
                 {"correlation": correlation, "mean_force_n": {"original": mean_o, "improved": mean_i}})


def k4(results):
    parts, texts, numbers = {}, [], {}
    for result in results:
        original, improved = both(result)
        contact = result.in_contact()
        mean = {m.label: float(np.mean(m.read("lmd_count")[contact])) for m in (original, improved)}
        seconds = result.seconds_in_contact()
        change = {m.label: float(np.sum(np.abs(np.diff(m.read("lmd_count"))))) / seconds for m in (original, improved)}
        ratio = mean["original"] / mean["improved"] if mean["improved"] > 0 else float("nan")
        parts[f"{result.name}: similar counts"] = 2 / 3 <= ratio <= 1.5
        parts[f"{result.name}: the original fluctuates more"] = change["original"] > change["improved"]
        texts.append(f"{result.name}: mean LMDs original {mean['original']:.2f}, improved {mean['improved']:.2f} "
                     f"(ratio {ratio:.2f}); LMDs gained and lost per second original {change['original']:.0f}, "
                     f"improved {change['improved']:.0f}")
        numbers[result.name] = {"mean": mean, "changes_per_second": change}
    return Claim("K4", "Both methods maintain a similar number of LMD pairs, though the original fluctuates more wildly "
                 "(6.1).",
                 "Frames in contact: means within a factor of 1.5; the original gains and loses more LMDs per second.",
                 "; ".join(texts) + ".", *judge(parts), numbers)


def k5(results):
    """On further results with other meshes the dependence on density can be judged as well."""
    texts, numbers, largest, pooled = [], {}, [], []
    for result in results:
        improved = result.method("improved")
        ratio, most = improved.number("reduction_ratio"), improved.number("reduction_ratio_maximum")
        triangles = result.triangles()
        largest.append(most)
        pooled.append((triangles, ratio))
        texts.append(f"{result.name}: {ratio:.1f} over all searches, {most:.1f} at most ({triangles:,} triangles)")
        numbers[result.name] = {"reduction_ratio": ratio, "reduction_ratio_maximum": most, "triangles": triangles}
    top = max(largest)
    parts = {"up to about twenty times (10 to 40)": 10 <= top <= 40}
    densities = sorted({triangles for triangles, _ in pooled})
    one_density = True
    if len(densities) > 1 and densities[-1] >= 2 * densities[0]:
        thin = np.mean([value for triangles, value in pooled if triangles == densities[0]])
        dense = np.mean([value for triangles, value in pooled if triangles == densities[-1]])
        parts["larger for denser meshes"] = dense > thin
        one_density = False
    setting, because = judge(parts)
    if setting == HOLDS and one_density:
        because = "as far as measured; results of one density do not show the growth with the mesh"
    return Claim("K5", "The reduction process is able to reduce the total number of LMD pairs up to twenty times; with more "
                 "complex meshes the factor is greater (6.1), an order of magnitude in high-poly models (4.2.1).",
                 "Candidates divided by those left after the first reduction: the largest ratio of a search lies between "
                 "10 and 40; the ratio of the sums over all searches grows with the triangle count where results of "
                 "several densities are given.",
                 "; ".join(texts) + ".", setting, because, numbers)


def search_ratios(original, improved, busy, repetition):
    """Base ratio, 99th percentile of reduction / search, and total ratio of one repetition, searches in contact."""
    old, new, more = (method.times(name)[repetition][busy] for method, name in (
        (original, "global_search_time"), (improved, "global_search_time"), (improved, "first_reduction_time")))
    return median(new) / median(old), quantile(more / new, 0.99), median(new + more) / median(old)


def k6(results):
    parts, texts, numbers = {}, [], {}
    for result in results:
        original, improved = both(result)
        base_o, base_i = (method.number("global_search_median_s") for method in both(result))
        base = base_i / base_o
        total = improved.number("search_with_reduction_median_s") / base_o
        busy = result.in_contact()[improved.read("global_frame").astype(int)]
        share = (improved.median_times("first_reduction_time") / improved.median_times("global_search_time"))[busy]
        single = [search_ratios(original, improved, busy, r) for r in range(len(improved.times("global_search_time")))]
        parts[f"{result.name}: base time almost equal"] = inside([one[0] for one in single], 0.8, 1.25)
        parts[f"{result.name}: the reduction can take as long as the search"] = inside([one[1] for one in single], 0.8)
        parts[f"{result.name}: total about twice the original"] = inside([one[2] for one in single], 1.5, 2.5)
        texts.append(
            f"{result.name}: base {base_i * 1e3:.3f} against {base_o * 1e3:.3f} ms (ratio {base:.2f}); "
            f"reduction / search median {median(share):.2f}, 99th percentile {quantile(share, 0.99):.2f}; total ratio "
            f"{total:.2f} {errors(result)}")
        numbers[result.name] = {"base_ratio": base, "reduction_share_median": median(share),
                                "reduction_share_p99": quantile(share, 0.99), "total_ratio": total}
    return Claim("K6", "The base time of the global search is almost the same; the reduction after it can take the same time "
                 "as the search itself; search and first reduction are approximately two times longer than the "
                 "original (6.1).",
                 "Medians over searches in contact: base ratio 0.8 to 1.25; 99th percentile of reduction / search "
                 "at least 0.8; total ratio 1.5 to 2.5; undecided where repetitions disagree or there is one.",
                 "; ".join(texts) + ".", *judge(parts), numbers)


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


def k7(hard, soft):
    (ratio_hard, time_hard, mean_hard), (ratio_soft, time_soft, mean_soft) = local_ratio(hard), local_ratio(soft)
    hard_ratios, soft_ratios = update_ratios(hard), update_ratios(soft)
    hard_ratios, soft_ratios = hard_ratios[: len(soft_ratios)], soft_ratios[: len(hard_ratios)]
    setting, because = judge({
        "the local update is slower": inside(np.minimum(hard_ratios, soft_ratios), 1.0),
        "much slower when hard (at least twice)": inside(hard_ratios, 2.0),
        "less so when soft": inside(soft_ratios / hard_ratios, high=0.9),
    })
    return Claim("K7", "The local update time is worse with our method, much worse with the hard force simulation; with soft "
                 "force the difference is not as dramatic (6.1).",
                 "Ratio of the median local update times, frames in contact: above 1 for both, at least 2 when hard, "
                 "smaller by a tenth or more when soft; undecided where repetitions disagree or there is one.",
                 f"hard {ratio_hard:.1f} ({time_hard['improved'] * 1e6:.1f} against {time_hard['original'] * 1e6:.1f} us), "
                 f"soft {ratio_soft:.1f} ({time_soft['improved'] * 1e6:.1f} against {time_soft['original'] * 1e6:.1f} us); "
                 f"ratio of the means, which sees the few long updates that receive a new search's set: hard "
                 f"{mean_hard:.2f}, soft {mean_soft:.2f}. "
                 + errors(hard) + " " + errors(soft),
                 setting, because, {"ratio": {"hard": ratio_hard, "soft": ratio_soft},
                                    "ratio_of_means": {"hard": mean_hard, "soft": mean_soft},
                                    "local_update_s": {"hard": time_hard, "soft": time_soft}})


def k8():
    return Claim("K8", "The Phantom loop consumes much less processing power than the other threads and can run together with "
                 "local LMD tracking on one core (6.1).",
                 "Processor time of the device loop against the local and global threads.",
                 "These runs have no device loop; `lmdbench-study roles` times it in a closed loop (claim-regions.md).", NOT_MEASURED)


def k9(results):
    parts, texts, numbers = {}, [], {}
    for result in results:
        improved = result.method("improved")
        samples = improved.times("local_update_time")
        late = float(np.mean(samples > 1e-3))
        p99 = improved.number("local_update_p99_s")
        triangles = result.triangles(smallest=True)
        parts[f"{result.name}: over 10,000 triangles a mesh"] = triangles > 10_000
        parts[f"{result.name}: above 1 kHz"] = inside(np.quantile(samples[:, result.in_contact()], 0.99, axis=1), high=1e-3)
        texts.append(f"{result.name}: local update 99th percentile {p99 * 1e3:.3f} ms ({1e-3 / p99:.0f} times the rate of "
                     f"1 kHz), {100 * late:.3f} % of updates above 1 ms; meshes of at least {triangles:,} triangles "
                     + errors(result))
        numbers[result.name] = {"local_update_p99_s": p99, "share_above_1ms": late, "smallest_mesh_triangles": triangles}
    return Claim("K9", "Update rates usually exceed 1 kHz (3), with bunnies of over 10,000 triangles each (6).",
                 "The 99th percentile of the improved local update is under 1 ms in every repetition (two at least) on meshes of more than 10,000 "
                 "triangles.", "; ".join(texts) + ".", *judge(parts), numbers)


def k10(results, unequal):
    """`unequal`: results on meshes with large or unequal triangles, for the first half of the claim."""
    parts, texts, numbers = {}, [], {}
    for result, dense in [(r, True) for r in results] + [(r, False) for r in unequal]:
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
        return Claim("K10", K10_PAPER, K10_MEASURE, "The results have no truth probe.", NOT_MEASURED)
    setting, because = judge(parts)
    if not unequal and setting == HOLDS:
        because = "as far as measured; no result on large or unequal triangles was given"
    return Claim("K10", K10_PAPER, K10_MEASURE, "; ".join(texts) + ".", setting, because, numbers)


K10_PAPER = ("Missing pairs are infrequent on models with a dense triangle mesh, but become apparent with models containing "
             "large triangles (3).")
K10_MEASURE = ("Share of true LMDs that the original's working set lacks, neighbouring features counting as found: at most "
               "5 % on dense meshes, at least 10 % on meshes of large or unequal triangles.")


def rows(hard, soft, verdicts, others=(), unequal=()):
    """@param verdicts what read_verdicts() read"""
    pair = [hard, soft]
    claims = [k1(hard), k2(hard), k3(soft), k4(pair), k5([*pair, *others]), k6(pair), k7(hard, soft), k8(), k9(pair), k10(pair, unequal)]
    for claim in claims:
        entry = verdicts.get(claim.id, {"verdict": NOT_MEASURED, "reason": "no ledger of verdicts (remedy: scripts/claims.sh)"})
        claim.verdict, claim.reason = entry["verdict"], entry["reason"]
    return claims
