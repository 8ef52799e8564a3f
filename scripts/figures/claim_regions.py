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


def part(evidence, scene):
    return evidence.restricted(scene) if isinstance(evidence, Sweep) else evidence


def judged(evidence):
    """(claim, words, names of its evidence or None, text, cells) of every claim."""
    for claim, rule in CLAIMS.items():
        needs = next((names for names in rule.evidence if all(name.split("/")[0] in evidence for name in names)), None)
        if needs is None:
            yield claim, rule.short, None, [], {}
            continue
        text, cells = rule.judge(*(part(evidence[name.split("/")[0]], name.partition("/")[2]) for name in needs))
        yield claim, rule.short, needs, text, cells


def two_loads(claims, other):
    """What another run of some of the sweeps says: settings whose verdicts agree, that one of the runs leaves undecided, and that
    contradict each other.
    @param claims what judged() made of the one run
    @param other evidence of the other"""
    cells = {claim: found for claim, _, needs, _, found in claims if needs}
    rows, contradictions = [], []
    for claim, _, needs, _, found in judged(other):
        if needs is None or claim not in cells:
            continue
        both = [(name, cells[claim][name], cell) for name, cell in found.items() if name in cells[claim]]
        against = [name for name, a, b in both if {a, b} == {HOLDS, FAILS}]
        contradictions += [f"{claim}, {name}" for name in against]
        rows.append([claim, len(both), sum(a == b for _, a, b in both), sum(a != b for _, a, b in both) - len(against), len(against),
                     verdict(cells[claim])[0], verdict(found)[0]])
    text = ["## The same sweeps on another load", "",
            "Each was run again (" + ", ".join(f"`{name}` at {run.commit()}" for name, run in other.items())
            + "). A setting that holds in one run and does not in the other contradicts itself.", "",
            *table(["claim", "settings in both", "the same", "undecided in one", "contradicting", "verdict", "verdict on the other load"], rows)]
    return text + (["Contradicting: " + "; ".join(contradictions) + ".", ""] if contradictions else [])


def markdown(evidence, other=None):
    """@param evidence {name: sweep, run or roles}
    @param other the same of another run, of some of them"""
    details, claims = [], list(judged(evidence))
    for claim, words, needs, text, _ in claims:
        if needs is None:
            continue
        made = ", ".join(f"`{name.split('/')[0]}` at {evidence[name.split('/')[0]].commit()}" for name in needs)
        details += [f"## {claim}", "", f"{words}. From {made}.", "", *text]
    if other:
        details += two_loads(claims, other)
    if "readings" in evidence:
        details += ["## Decisions E1 to E13", "", f"What the other reading would have changed. From `readings` at {evidence['readings'].commit()}.", "",
                    *readings(evidence["readings"], evidence.get("direction-memory"))]
    head = ["# Where the paper's claims hold", "",
            "The paper leaves constants, paths and meshes open (decision E8). `scripts/claims.sh` varies them and judges; it repeats every number here. "
            "A setting whose interval crosses its threshold is undecided and decides nothing. Scenes are two bunnies of 16,298 triangles where no other "
            f"is named; 1 mean edge is {100 * MEAN_EDGE_DIAGONAL:g} % of the diagonal."
            + (" What the other readings of decisions E1 to E13 change: [at the end](#decisions-e1-to-e13)." if "readings" in evidence else ""), ""]
    return "\n".join(head + verdict_table(entries(claims)) + details) + "\n"


def entries(claims):
    """The ledger: of every claim that was measured its one verdict, the reason, and how many settings stand behind it.
    @param claims what judged() made"""
    found = []
    for claim, words, needs, text, cells in claims:
        entry = {"claim": claim, "in_short": words, "verdict": NOT_MEASURED, "reason": "its sweep is not among these results"}
        if needs is not None:
            why = next((line.removeprefix("Why: ").rstrip(".") for line in text if line.startswith("Why: ")), "")
            entry["verdict"], entry["reason"] = verdict(cells, why)
            entry["settings"] = {kind: sum(cell == kind for cell in cells.values()) for kind in (HOLDS, FAILS, OPEN)}
        found.append(entry)
    return found


def verdict_table(found):
    rows = []
    for entry in found:
        settings = entry.get("settings")
        name = f"[{entry['claim']}](#{entry['claim'].lower()})" if settings else entry["claim"]
        rows.append([name, entry["in_short"], f"**{entry['verdict']}**", entry["reason"],
                     " / ".join(str(settings[kind]) for kind in (HOLDS, FAILS, OPEN)) if settings else "-"])
    return table(["claim", "in short", "verdict", "reason", "settings that hold / do not / undecided"], rows)


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", metavar="FILE", help="what scripts/claims.sh leaves in results/claims: sweeps, a run, roles.json")
    parser.add_argument("--other", nargs="+", default=[], metavar="FILE", help="the same of another run, on another load: do the verdicts agree?")
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of claim-regions.md and claim-verdicts.json")
    arguments = parser.parse_args(argv)
    evidence = dict(load(name) for name in arguments.files)
    print(write_text(markdown(evidence, dict(load(name) for name in arguments.other)), arguments.out, "claim-regions.md"))
    print(write_text(json.dumps(entries(judged(evidence)), indent=1) + "\n", arguments.out, VERDICTS))
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
