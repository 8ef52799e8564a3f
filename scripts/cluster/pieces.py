# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What of a sweep or a study is still to be measured, as pieces that one job each measures. The program knows the points and
which of them are done; here they are only put together."""

import hashlib
import json
import os
import shlex
import subprocess
from pathlib import Path


class Piece:
    """One job's work. `name` stays the same for the same work, whatever else is still to do."""

    def __init__(self, name, what, command):
        self.name, self.what, self.command = name, what, command

    def as_json(self):
        return {"name": self.name, "what": self.what, "command": self.command}


def _name(*parts):
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


def _ask(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(done.returncode)  # the program has told the reason
    return json.loads(done.stdout)


def numbers_text(numbers):
    """0-3,7 of rising numbers: how `--points` wants them."""
    ranges = []
    for number in numbers:
        if ranges and number == ranges[-1][1] + 1:
            ranges[-1][1] = number
        else:
            ranges.append([number, number])
    return ",".join(str(first) if first == last else f"{first}-{last}" for first, last in ranges)


def chunks(points, most):
    """Points that are not done, `most` together at most, those of one group only: they share their scene and its truth."""
    result = []
    for point in points:
        if point["done"]:
            continue
        if not result or len(result[-1]) == most or result[-1][0]["group"] != point["group"]:
            result.append([])
        result[-1].append(point)
    return result


def pieces_of_sweep(program, sweep, out, overrides=(), points_per_job=1):
    common = [program, "work-precision", sweep, "--out", out, *(part for value in overrides for part in ("--set", value))]
    points = _ask([*common, "--list", "--json"])
    pieces = []
    for chunk in chunks(points, points_per_job):
        numbers = numbers_text([point["number"] for point in chunk])
        pieces.append(Piece(_name(*(point["key"] for point in chunk)), f"points {numbers}", [*common, "--points", numbers]))
    for name in ("findings.log", *(piece.name + ".done" for piece in pieces)):  # points that failed are tried again
        Path(out + ".points", name).unlink(missing_ok=True)
    return pieces, [*common, "--collect"]


def pieces_of_study(program, arguments, out):
    """`lmdbench-study --pieces` says into which calls a study falls. Their reports are kept in `<out>.points/` by name."""
    calls = _ask([program, "--pieces", *arguments])
    pieces, reports = [], []
    for call in calls:
        name = _name(_version(program), *call)
        report = os.path.join(out + ".points", name + ".json")
        reports.append(report)
        if not os.path.exists(report):
            pieces.append(Piece(name, shlex.join(call), [program, "--name-node", *call, "--json", report]))
    if len(pieces) == len(reports):
        Path(out + ".points", "findings.log").unlink(missing_ok=True)  # of another build
    merge = os.path.join(os.path.dirname(os.path.abspath(__file__)), "merge_reports.py")
    return pieces, ["/usr/bin/env", "python3", merge, "--out", out, *reports]


def _version(program):
    """A report of another build is another report."""
    return hashlib.sha256(Path(program).read_bytes()).hexdigest()


def write_plan(folder, pieces, collect):
    os.makedirs(folder, exist_ok=True)
    place = os.path.join(folder, "plan.json")
    Path(place + ".new").write_text(json.dumps({"pieces": [piece.as_json() for piece in pieces], "collect": collect}, indent=1), encoding="utf-8")
    os.replace(place + ".new", place)


def read_plan(folder):
    plan = json.loads(Path(folder, "plan.json").read_text(encoding="utf-8"))
    return [Piece(**piece) for piece in plan["pieces"]], plan["collect"]
