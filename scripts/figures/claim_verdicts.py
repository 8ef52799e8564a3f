# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The ledger of verdicts that claim_regions.py writes, for whoever shows a verdict: there is one a claim."""

import json
from pathlib import Path

from lmdbench_results import ResultError

VERDICTS = "claim-verdicts.json"
NOT_MEASURED = "not measured"
# The project's own; scripts/claims.sh makes another one.
REFERENCE = Path(__file__).resolve().parents[2] / "results" / "reference" / VERDICTS


def read_verdicts(file=None):
    """{claim: {"verdict", "reason", ...}}; empty where the scripts stand without the project's results."""
    if file is None and not REFERENCE.exists():
        return {}
    try:
        return {entry["claim"]: entry for entry in json.loads(Path(file or REFERENCE).read_text(encoding="utf-8"))}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ResultError(f"{file or REFERENCE}: is no ledger of verdicts: {error!r} (remedy: scripts/claims.sh verdicts)")
