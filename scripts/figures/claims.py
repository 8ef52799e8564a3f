#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's claims in two runs: prints them and writes claims.md. Two runs are one setting of our free choices:
their numbers stand beside the verdict of the ledger, which rests on all settings (claim_regions.py). The claims and their rules
are in claim_rules.py."""

import argparse
import os
import textwrap

import interpreter  # noqa: F401  (chooses one that has what follows)

from claim_rules import read_verdicts, rows
from lmdbench_results import Result, run_script
from tables import table, write_text


def markdown(claims, results):
    cells = [(claim.id, claim.paper, claim.measure, claim.result, claim.in_this_setting(), f"**{claim.verdict}**: {claim.reason}") for claim in claims]
    return "\n".join([
        "# Claims", "",
        "What the paper says, what that is in numbers, and what two runs show: one setting of the free choices that the paper leaves. "
        "The verdict is over all settings that were measured (claim-regions.md), and has its reason beside it. The paper gives few "
        "numbers: the thresholds are ours and stand in the third column. Times decide where every repetition of at least two says the same.", "",
        f"Machine: {', '.join(dict.fromkeys(result.machine().get('processor', 'unknown') for result in results))}. "
        f"Results: {', '.join(f'`{os.path.basename(result.file)}`' for result in results)}.", "",
        *table(["", "the paper's words", "our measure", "our numbers", "in this setting", "verdict over all settings"], cells)])


def plain(claims):
    blocks = []
    for claim in claims:
        lines = [f"{claim.id}: {claim.verdict}: {claim.reason}"]
        for title, text in (("paper", claim.paper), ("rule", claim.measure), ("here", f"{claim.in_this_setting()}. {claim.result}")):
            lines += textwrap.wrap(text, width=110, initial_indent=f"  {title + ':':<7}", subsequent_indent=" " * 9)
        blocks.append("\n".join(lines))
    return "\n".join(blocks)


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("hard", help="result file of the experiment with hard contact")
    parser.add_argument("soft", help="result file of the experiment with soft contact")
    parser.add_argument("--verdicts", metavar="FILE", help="ledger of claim_regions.py (results/reference/claim-verdicts.json)")
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of claims.md")
    arguments = parser.parse_args(argv)
    hard, soft = Result(arguments.hard), Result(arguments.soft)
    claims = rows(hard, soft, read_verdicts(arguments.verdicts))
    write_text(markdown(claims, [hard, soft]), arguments.out, "claims.md")
    print(plain(claims))
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
