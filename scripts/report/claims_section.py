# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's claims on the page: what the page's own results say, the ledger's verdict, and links to what it rests on."""

from claim_rules import CLAIMS, read_verdicts, rows
from claim_runs import why_not
from lmdbench_results import ResultError


def claims_of(results):
    """{"hard", "soft", "claims"} of the two results that have the paper's methods, or {"problem": why there is no ledger}."""
    able = [result for result in results if {"original", "improved"} <= set(result.methods) and not why_not(result)]
    if not able:
        return {"problem": "No claim can be judged: it takes results of the driver lockstep and an open loop with methods called original and improved, "
                           "and frames in contact."}
    # Harder is what reaches less far.
    hard, soft = sorted([able[0], able[min(1, len(able) - 1)]], key=lambda result: result.scene("cutoff_m"))
    try:
        claims = rows(hard, soft, read_verdicts())
    except ResultError as error:
        return {"problem": f"No claim can be judged: {error}"}
    return {"hard": hard.name, "soft": soft.name, "claims": claims}


def evidence(claim, sections):
    """Links to the sections of the page, (id, title)."""
    titles = {section["id"]: section["title"] for section in sections}
    return [(name, titles[name]) for name in CLAIMS[claim].sections if name in titles]
