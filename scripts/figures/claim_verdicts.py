# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The ledger of verdicts that claim_regions.py writes, for whoever shows a verdict: there is one a claim."""

import json
import os

from lmdbench_results import ResultError

VERDICTS = "claim-verdicts.json"
NOT_MEASURED = "not measured"
# The one that the project keeps; scripts/claims.sh makes another.
REFERENCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "results", "reference", VERDICTS)


def read_verdicts(file=None):
    """{claim: {"verdict", "reason", ...}}; empty where the scripts stand without the project's results."""
    if file is None and not os.path.exists(REFERENCE):
        return {}
    try:
        with open(file or REFERENCE, encoding="utf-8") as stream:
            return {entry["claim"]: entry for entry in json.load(stream)}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ResultError(f"{file or REFERENCE}: is no ledger of verdicts: {error!r} (remedy: scripts/claims.sh verdicts)")
