# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's claims on the page: what the page's own results say, the ledger's verdict, and links to what it rests on."""

from claim_rules import read_verdicts, rows
from lmdbench_results import ResultError

# Where the evidence of a claim stands, by the sections' ids; a page links to those that it has.
EVIDENCE = {
    "K1": ("frames", "sweep-claim-k1", "study-claim-regions", "study-jumps"),
    "K2": ("frames", "study-claim-regions"),
    "K3": ("figure7", "sweep-claim-k3", "study-claim-regions", "study-hard-soft"),
    "K4": ("frames", "figure7", "study-claim-regions"),
    "K5": ("figure7", "sweep-claim-k5", "study-claim-regions", "study-recall-bunny-bunny"),
    "K6": ("frames", "study-claim-regions", "study-global-search"),
    "K7": ("frames", "sweep-claim-k7", "study-claim-regions"),
    "K8": ("study-claim-regions", "study-claims"),
    "K9": ("answer", "frames", "study-scaling"),
    "K10": ("work_precision", "sweep-claim-k10", "study-claim-regions", "study-recall-armadillo-bunny"),
    "K11": ("study-claim-regions", "study-extreme"),
    "K12": ("study-claim-regions", "study-deep-contact"),
}


def claims_of(results):
    """{"hard", "soft", "claims"} of the two results that have the paper's methods, or {"problem": why there is no ledger}."""
    # On the machine's clock (/realtime) each method searches when it can: their searches do not stand beside each other.
    able = [result for result in results if {"original", "improved"} <= set(result.methods) and result.number("frames_in_contact") > 0
            and not result.has("/realtime")]
    if not able:
        return {"problem": "No claim can be judged: it takes results of the driver lockstep with methods called original and improved, and frames "
                           "in contact."}
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
    return [(name, titles[name]) for name in EVIDENCE.get(claim, ()) if name in titles]
