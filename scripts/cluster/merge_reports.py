#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""One report of a study out of the reports of its pieces (lmdbench-study --pieces), in their order.

    merge_reports.py --out REPORT.json PIECE.json...

The same values as of the whole study run at once, but for times, and for "pieces": where and beside what each was made. Exit codes:
0 done, 2 wrong arguments, 3 pieces that do not belong together."""

import argparse
import json
import os
import sys

SUMS = ("wrong_poses",)
# Facts of a machine and hour: those of the first piece; "pieces" keeps each one's own.
CIRCUMSTANCES = ("context", "where")
# Several pieces may have these alike, but with times of their own.
FIRST_STANDS = ("builds",)


class Unlike(Exception):
    pass


def build_of(report):
    return report.get("context", {}).get("build")


def merge(reports):
    """@param reports [(name, report)]"""
    first_name, first = reports[0]
    merged = {}
    for name, report in reports:
        if build_of(report) != build_of(first):
            raise Unlike(f"{name}: /context/build: was made by another build than {first_name} "
                         "(remedy: run the workflow again with one build)")
        for key, value in report.items():
            if key in CIRCUMSTANCES:
                continue
            if key not in merged:
                merged[key] = list(value) if isinstance(value, list) else value
            elif key in SUMS:
                merged[key] += value
            elif key in FIRST_STANDS:
                merged[key] = {**value, **merged[key]}
            elif isinstance(value, list):
                merged[key] += value
            elif merged[key] != value:
                raise Unlike(f"{name}: /{key}: is {json.dumps(value)}, but {json.dumps(merged[key])} before "
                             "(remedy: merge the pieces of one study)")
    if "context" in first:
        merged["context"] = first["context"]
    merged["pieces"] = [{key: report[key] for key in CIRCUMSTANCES if key in report} for _, report in reports]
    return merged


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True, help="the report")
    parser.add_argument("pieces", nargs="+", help="reports of the pieces")
    arguments = parser.parse_args()
    reports = []
    for name in arguments.pieces:
        try:
            with open(name, encoding="utf-8") as stream:
                reports.append((name, json.load(stream)))
            if not isinstance(reports[-1][1], dict):
                raise ValueError("is no object")
        except (OSError, ValueError) as error:
            print(f"error: {name}: is no report: {error} (remedy: run the workflow again, which makes what is missing)",
                  file=sys.stderr)
            return 3
    try:
        merged = merge(reports)
    except Unlike as error:
        print(f"error: {error}", file=sys.stderr)
        return 3
    with open(arguments.out + ".new", "w", encoding="utf-8") as stream:
        json.dump(merged, stream, indent=2, sort_keys=True)
        stream.write("\n")
    os.replace(arguments.out + ".new", arguments.out)
    print(f"{len(reports)} pieces in {arguments.out}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
