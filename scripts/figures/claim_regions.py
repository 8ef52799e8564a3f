#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Where in the space of our free choices the paper's claims hold: tables from what scripts/claims.sh runs (claim-regions.md), and
the ledger of verdicts (claim-verdicts.json), the only one: claims.py and the report show it beside the numbers of single runs. A
verdict is "reproduced" when every setting holds, "not reproduced" when none does, else "holds where"; a setting whose interval
crosses its threshold, or that rests on one repetition, is "undecided" and decides nothing. Each has one reason."""

import argparse
import json
from pathlib import Path

import interpreter  # noqa: F401  (chooses one that has what follows)
from lmdbench_results import Result, ResultError, run_script, texts_of
from readings import readings
from claim_rules import CLAIMS, VERDICTS
from region_rules import FAILS, HOLDS, MEAN_EDGE_DIAGONAL, NOT_MEASURED, OPEN, verdict
from sweep_results import Sweep, commit_of, is_sweep
from tables import table, write_text


class Roles(dict):
    """What `lmdbench-study roles --json` wrote."""

    def commit(self):
        return commit_of(self["context"]["build"])


class Run(Result):
    def commit(self):
        return commit_of(texts_of(self.h5["provenance"].attrs))


def load(file):
    """(name, evidence) of a file: a sweep's, a run's, or the roles'."""
    if str(file).endswith(".json"):
        try:
            return "roles", Roles(json.loads(Path(file).read_text(encoding="utf-8")))
        except (OSError, ValueError) as error:
            raise ResultError(f"{file}: cannot be read: {error} (remedy: lmdbench-study roles --json {file})")
    if is_sweep(file):
        sweep = Sweep(file)
        return sweep.name, sweep
    run = Run(file)
    return run.name, run


def judged(evidence):
    """{claim: (names of its evidence, text, cells)} of those whose evidence is there."""
    found = {}
    for claim, rule in CLAIMS.items():
        needs = next((names for names in rule.evidence if all(name.split("/")[0] in evidence for name in names)), ())
        parts = [(evidence[name], scene) for name, _, scene in (name.partition("/") for name in needs)]
        if parts:
            found[claim] = ([name.split("/")[0] for name in needs], *rule.judge(*(one.restricted(scene) if scene else one for one, scene in parts)))
    return found


def two_loads(claims, other):
    """What another run of some of the sweeps says: settings whose verdicts agree, that one of the runs leaves undecided, and that
    contradict each other.
    @param claims what judged() made of the one run
    @param other evidence of the other"""
    rows, contradictions = [], []
    for claim, (_, _, found) in judged(other).items():
        if claim not in claims:
            continue
        cells = claims[claim][2]
        both = [(name, cells[name], cell) for name, cell in found.items() if name in cells]
        against = [name for name, a, b in both if {a, b} == {HOLDS, FAILS}]
        contradictions += [f"{claim}, {name}" for name in against]
        rows.append([claim, len(both), sum(a == b for _, a, b in both), sum(a != b for _, a, b in both) - len(against), len(against),
                     verdict(cells)[0], verdict(found)[0]])
    return ["## The same sweeps on another load", "",
            "Each was run again (" + ", ".join(f"`{name}` at {run.commit()}" for name, run in other.items())
            + "). A setting that holds in one run and does not in the other contradicts itself.", "",
            *table(["claim", "settings in both", "the same", "undecided in one", "contradicting", "verdict", "verdict on the other load"], rows),
            *(["Contradicting: " + "; ".join(contradictions) + ".", ""] if contradictions else [])]


def markdown(evidence, claims, other=None):
    """@param evidence {name: sweep, run or roles}
    @param claims what judged() made of it
    @param other evidence of another run, of some of them"""
    lines = ["# Where the paper's claims hold", "",
             "The paper leaves constants, paths and meshes open (decision E8). `scripts/claims.sh` varies them and judges; it repeats every number here. "
             "A setting whose interval crosses its threshold is undecided and decides nothing. Scenes are two bunnies of 16,298 triangles where no other "
             f"is named; 1 mean edge is {100 * MEAN_EDGE_DIAGONAL:g} % of the diagonal."
             + (" What the other readings of decisions E1 to E13 change: [at the end](#decisions-e1-to-e13)." if "readings" in evidence else ""), "",
             *table(["claim", "in short", "verdict", "reason", "settings that hold / do not / undecided"], map(verdict_cells, entries(claims)))]
    for claim, (names, text, _) in claims.items():
        made = ", ".join(f"`{name}` at {evidence[name].commit()}" for name in names)
        lines += [f"## {claim}", "", f"{CLAIMS[claim].short}. From {made}.", "", *text]
    if other:
        lines += two_loads(claims, other)
    if "readings" in evidence:
        lines += ["## Decisions E1 to E13", "", f"What the other reading would have changed. From `readings` at {evidence['readings'].commit()}.", "",
                  *readings(evidence["readings"], evidence.get("direction-memory"))]
    return "\n".join(lines) + "\n"


def entries(claims):
    """The ledger: of every claim its one verdict, the reason, and how many settings stand behind it.
    @param claims what judged() made"""
    found = []
    for claim, rule in CLAIMS.items():
        entry = {"claim": claim, "in_short": rule.short, "verdict": NOT_MEASURED, "reason": "its sweep is not among these results"}
        if claim in claims:
            _, text, cells = claims[claim]
            why = next((line.removeprefix("Why: ").split(". ")[0].rstrip(".") for line in text if line.startswith("Why: ")), "")
            entry["verdict"], entry["reason"] = verdict(cells, why)
            entry["settings"] = {kind: sum(cell == kind for cell in cells.values()) for kind in (HOLDS, FAILS, OPEN)}
        found.append(entry)
    return found


def verdict_cells(entry):
    settings, claim = entry.get("settings"), entry["claim"]
    return [f"[{claim}](#{claim.lower()})" if settings else claim, entry["in_short"], f"**{entry['verdict']}**", entry["reason"],
            " / ".join(map(str, settings.values())) if settings else "-"]


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", metavar="FILE", help="what scripts/claims.sh leaves in results/claims: sweeps, a run, roles.json")
    parser.add_argument("--other", nargs="+", default=[], metavar="FILE", help="the same of another run, on another load: do the verdicts agree?")
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of claim-regions.md and claim-verdicts.json")
    arguments = parser.parse_args(argv)
    evidence = dict(load(name) for name in arguments.files)
    claims = judged(evidence)
    print(write_text(markdown(evidence, claims, dict(load(name) for name in arguments.other)), arguments.out, "claim-regions.md"))
    print(write_text(json.dumps(entries(claims), indent=1) + "\n", arguments.out, VERDICTS))
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
