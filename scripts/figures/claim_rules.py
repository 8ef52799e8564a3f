# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's claims K1 to K12, an entry each: its words, what is measured of it and where, and when it holds; with the ledger of their verdicts, of
which there is one a claim. The paper gives few numbers, so the thresholds are ours: they read its words ("almost the same", "slightly") and are
not fitted to what a run shows. A claim that does not reproduce is a finding."""

import json
from dataclasses import dataclass
from pathlib import Path

import claim_runs
import region_cost
import region_force
import region_sets
from lmdbench_results import ResultError, in_short
from region_rules import FAILS, HOLDS, NOT_MEASURED, OPEN, Found


@dataclass
class Rule:
    """Two runs are one setting of our free choices: `look` finds numbers there and whether the parts of the claim hold. The verdict is over the
    settings of sweeps, which `settings` judges."""

    short: str
    rule: str  # when it holds
    settings: object  # settings(Found, evidence, ...) adds rows and cells, and returns what stands below their table
    evidence: tuple  # names of results, the first of the lists that is there whole: SWEEP, a run, the roles, or SWEEP/SCENE
    sections: tuple  # of the page of a run which its own numbers rest on, by their ids
    paper: str = ""  # its words
    note: str = ""  # on what stands in the table of settings; formatted with the evidence
    # look(hard, soft): numbers in a sentence, {part of the claim: whether it holds}, and what to
    # say where all hold. None where two runs cannot tell.
    look: object = None

    def judge(self, *evidence):
        """(lines, cells) of all settings."""
        found = Found()
        below = self.settings(found, *evidence)
        failed = [f"{point.scene}, {point.series}: {point.failure}" for one in evidence for point in getattr(one, "points", ()) if point.failure]
        if failed:
            below = [*(below or []), f"{len(failed)} points failed and have no numbers: {'; '.join(list(dict.fromkeys(failed))[:3])}.", ""]
        return [f"Rule: {self.rule} {self.note.format(*evidence)}".rstrip(), "", *found.table(), *(below or [])], found.cells


# A budget sweep varies the search period alone; a claim of hard or soft contact takes its scene.
CLAIMS = {
    "K1": Rule(
        short="Hard: the improved force is stable, the original's jumps between zero and strong",
        paper="Hard: our method shows good force stability, the original jumps quickly from zero to strong force and back (6.1).",
        rule="the original switches between below 5 % and above 50 % of F_max within a frame at least once a second in contact, and the improved one at most a tenth "
             "as often, both by the ends of their 95 % intervals.",
        note="Intervals: Poisson, and bootstrap over paths. Truth is in every frame, under the method's own law.",
        look=claim_runs.k1, settings=region_force.k1, evidence=(("claim-k1",), ("budget/bunny-hard",)),
        sections=("frames", "sweep-claim-k1", "study-claim-regions", "study-jumps")),
    "K2": Rule(
        short="Hard: the working set holds under 10 LMDs",
        paper="Hard: the working set of LMDs is relatively small (under 10) (6.1).",
        rule="of the frames in contact 99 % have at most 9 LMDs within the cutoff.",
        note="Mean over the paths; 95 % interval by bootstrap over paths.",
        look=claim_runs.k2, settings=region_force.k2, evidence=(("claim-k1",), ("budget/bunny-hard",)), sections=("frames", "study-claim-regions")),
    "K3": Rule(
        short="Soft: forces are similar, the original's slightly higher",
        paper="Soft: the resulting forces are very similar with both methods; the original generates slightly higher force (6.1).",
        rule="the original's mean force is 1 to 1.5 times the improved one's and the lengths of the two forces correlate by at least 0.8.",
        note="95 % intervals: bootstrap over blocks of frames. The ratio is split: law = true linear mean / true exponential mean, both clipped as the setting says; "
             "LMDs = a method's mean force / the true mean under its law and clip. ratio = law x original's LMDs / improved's LMDs.",
        look=claim_runs.k3, settings=region_force.k3, evidence=(("claim-k3",), ("budget/bunny-soft",)),
        sections=("figure7", "sweep-claim-k3", "study-claim-regions", "study-hard-soft")),
    "K4": Rule(
        short="LMD counts are similar, the original's fluctuates more",
        paper="Both methods maintain a similar number of LMD pairs, though the original fluctuates more wildly (6.1).",
        rule="the mean numbers of LMDs within the cutoff lie within a factor of 1.5 of each other, and the original's set gains and loses more LMDs a second than the "
             "improved one's (of two runs: its number changes by more).",
        note="Gained and lost: neighbouring features are the same LMD. 95 % intervals by bootstrap over paths.",
        look=claim_runs.k4, settings=region_force.k4, evidence=(("claim-k1",), ("budget/bunny-hard",)), sections=("frames", "figure7", "study-claim-regions")),
    "K5": Rule(
        short="The reduction drops up to twenty times, more on denser meshes",
        paper="The reduction process is able to reduce the total number of LMD pairs up to twenty times; with more complex meshes the factor is greater (6.1), an "
              "order of magnitude in high-poly models (4.2.1).",
        rule="the largest ratio of candidates to LMDs that the first reduction keeps lies between 10 and 40.",
        note="Counts, the same in every run: no interval. The ratio over all searches is sum over sum.",
        look=claim_runs.k5, settings=region_cost.k5, evidence=(("claim-k5",),),
        sections=("figure7", "sweep-claim-k5", "study-claim-regions", "study-recall-bunny-bunny")),
    "K6": Rule(
        short="Searches cost the same; the reduction as much again; together about twice the original",
        paper="The base time of the global search is almost the same; the reduction after it can take the same time as the search itself; search and first reduction "
              "are approximately two times longer than the original (6.1).",
        rule="searches in contact: base ratio 0.8 to 1.25; the reduction can take as long as the search: 99th percentile of reduction / search at least 0.8; total "
             "ratio 1.5 to 2.5.",
        note="All by the ends of their intervals: bootstrap over the searches, widened to the single repetitions; points interleaved in random order. The counters "
             "beside them are the same in every run. Cache: ours is an open-addressing table, plain a std::unordered_map.",
        look=claim_runs.k6, settings=region_cost.k6, evidence=(("claim-k5",),), sections=("frames", "study-claim-regions", "study-global-search")),
    "K7": Rule(
        short="The local update is slower, much slower when hard",
        paper="The local update time is worse with our method, much worse with the hard force simulation; with soft force the difference is not as dramatic (6.1).",
        rule="the improved update is at least twice the original's when hard, slower when soft, and less so when soft by a tenth.",
        note="Only frames whose set is not empty (an empty set costs no more than the clock); per LMD: sum of times over sum of LMDs carried. Reading the clock costs "
             "{0.clock_overhead_ns:.0f} ns of each update. 95 % intervals: bootstrap over blocks of frames, widened to the single repetitions.",
        look=claim_runs.k7, settings=region_cost.k7, evidence=(("claim-k7",), ("budget",)), sections=("frames", "sweep-claim-k7", "study-claim-regions")),
    "K8": Rule(
        short="The device loop needs much less than the other threads and can share a core with local tracking",
        paper="The Phantom loop consumes much less processing power than the other threads and can run together with local LMD tracking on one core (6.1).",
        rule="the device loop (sum of the forces, clip, motion of the simulated device) takes at most half the processor time of local tracking and at most half that "
             "of the global thread, and 99 % of the frames of device loop and local tracking together stay under 1 ms, so that one core serves both.",
        note="Intervals: lowest and highest repetition. Closed loop of `experiments/{0[experiment]}.json`, a search every 20 frames. A method that searches in every "
             "frame has no global thread. A real device is moved by a hand: the motion that the closed loop simulates stands in the device loop, and is also left out "
             "as settings of their own.",
        look=claim_runs.k8, settings=region_cost.k8, evidence=(("roles",),), sections=("study-claim-regions", "study-claims")),
    "K9": Rule(
        short="Updates above 1 kHz with over 10,000 triangles a mesh",
        paper="The original attains update rates usually exceeding 1 kHz (3), 1000 Hz is the lowest acceptable frequency (1), the bunnies have over 10,000 "
              "triangles each (6).",
        rule="the 99th percentile of a method's local update is under 1 ms on meshes of more than 10,000 triangles each, in every repetition.",
        note="Interval: lowest and highest one.",
        look=claim_runs.k9, settings=region_cost.k9, evidence=(("claim-k7", "claim-k5"), ("claim-k7",), ("budget",)), sections=("answer", "frames", "study-scaling")),
    "K10": Rule(
        short="The original misses pairs on large or unequal triangles, rarely on dense ones",
        paper="Missing pairs are infrequent on models with a dense triangle mesh, but become apparent with models containing large triangles (3).",
        rule="of the true LMDs, neighbouring features counting as found, the original misses at most 5 % on dense meshes (bunnies) and at least 10 % on large or "
             "unequal triangles.",
        note="Fresh: a search in every frame whose result is used in it; aged: a search every 20 frames that takes 20. `improved` under the same schedule is the "
             "control. Counts over one path: the same in every run.",
        look=claim_runs.k10, settings=region_sets.k10, evidence=(("claim-k10", "claim-k10-unequal"), ("claim-k10",), ("claim-k10-unequal",)),
        sections=("work_precision", "sweep-claim-k10", "study-claim-regions", "study-recall-armadillo-bunny")),
    "K11": Rule(
        short="Works on models with holes and on moving objects",
        rule="no point fails, and the improved method's fresh sets have recall and precision of at least 95 % (same features), on meshes with holes, with fins, and on "
             "others.",
        note="In every scene one of the objects moves; sets depend on the relative pose alone, so a second mover would change nothing. Counts: the same in every run.",
        settings=region_sets.k11, evidence=(("claim-k10-unequal",),), sections=("study-claim-regions", "study-extreme")),
    "K12": Rule(
        short="Precise intersection polylines are a by-product",
        rule="where closed meshes intersect, the search of `improved` finds every pair of triangles that cross, every curve is closed, and its points lie on both "
             "surfaces within 1e-9 of the diagonal; checked against all triangles by another program (numpy).",
        note="The curves are traced from the pairs of `certified`, one pair a segment. `improved` searches in every frame, at a cutoff of 1e-9 m, which leaves the "
             "pairs that cross. Counts and points: the same in every run.",
        settings=region_sets.k12, evidence=(("bunny-cut", "bunny-cut-ball"),), sections=("study-claim-regions", "study-deep-contact")),
}

VERDICTS = "claim-verdicts.json"
# The one that the project keeps; scripts/claims.sh makes another.
REFERENCE = Path(__file__).resolve().parents[2] / "results" / "reference" / VERDICTS


def read_verdicts(file=None):
    """{claim: {"verdict", "reason", ...}}; empty where the scripts stand without the project's results."""
    if file is None and not REFERENCE.exists():
        return {}
    try:
        return {entry["claim"]: entry for entry in json.loads(Path(file or REFERENCE).read_text(encoding="utf-8"))}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ResultError(f"{file or REFERENCE}: is no ledger of verdicts: {type(error).__name__}: {in_short(error)} (remedy: scripts/claims.sh verdicts)")


@dataclass
class Claim:
    """One row: a claim, what these runs say of it, and the ledger's verdict."""

    id: str
    paper: str
    measure: str  # the rule
    result: str  # our numbers in a sentence
    setting: str  # whether the claim holds in these runs: HOLDS, FAILS, OPEN or NOT_MEASURED
    because: str = ""  # which of its parts do not, or are undecided
    verdict: str = NOT_MEASURED  # over all settings
    reason: str = ""

    def in_this_setting(self):
        """For people; `because` begins with a word of its own, which the setting has said already where it is the same."""
        said = {FAILS: "not: ", OPEN: "undecided: "}.get(self.setting, "\0")
        return self.setting + (f": {self.because.removeprefix(said)}" if self.because else "")


def rows(hard, soft, verdicts):
    """[Claim] of what two runs show. @param verdicts what read_verdicts() read"""
    for result in (hard, soft):
        if why := claim_runs.why_not(result):
            raise ResultError(f"{result.file}: {why}, so no claim can be judged (remedy: an open loop of the driver lockstep with frames in contact, methods "
                              "under their own names)")
    claims = []
    missing = {"verdict": NOT_MEASURED, "reason": "no ledger of verdicts (remedy: scripts/claims.sh)"}
    for name, rule in CLAIMS.items():
        text, parts, *caveat = rule.look(hard, soft) if rule.look else ("Other scenes than those of two runs decide.", {})
        setting, because = claim_runs.judge(parts) if parts else (NOT_MEASURED, "")
        if setting == HOLDS and caveat:
            because = caveat[0]
        entry = verdicts.get(name, missing)
        claims.append(Claim(name, rule.paper or f"{rule.short}.", rule.rule, text, setting, because, entry["verdict"], entry["reason"]))
    return claims
