#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Compares result files with their description in results/README.md: every dataset must be described, with the units
and the number of axes that it has, and must say what it is. Exit code 1 when they differ."""

import argparse
import re
from pathlib import Path

import interpreter  # noqa: F401  (chooses one that has what follows)

import h5py

from lmdbench_results import EXIT_CHECK_FAILED, Result, run_script

README = Path(__file__).resolve().parents[2] / "results" / "README.md"
ROW = re.compile(r"^\| `([^`]+)` \| \(([^)]*)\) \| ([^|]+) \| ([^|]+) \|$")


def described(text):
    """{path: (axes, units)}; paths without a slash in front belong to the group of a method."""
    rows = {}
    for line in text.splitlines():
        match = ROW.match(line)
        if match:
            path, shape, units, _ = match.groups()
            rows[path] = (len([axis for axis in shape.split(",") if axis.strip()]), units.strip())
    return rows


def documented_path(path):
    """'/methods/LABEL/force' is described as 'force', the counters of all methods as 'counters/NAME'; of a closed loop
    '/methods/LABEL/path' is described as '/path'; loops and series of '/realtime/LABEL' share their rows, as do the meshes of '/scene'."""
    path = re.sub(r"^/scene/(?:moving|fixed_\d+|mover_\d+)/", "/scene/MESH/", path)
    path = re.sub(r"^/realtime/[^/]+/", "/realtime/LABEL/", path)
    path = re.sub(r"^(/realtime/LABEL/)(?!grants/)[^/]+/(?=(?:asked|woken|done|age)$)", r"\1LOOP/", path)
    path = re.sub(r"^(/realtime/LABEL/lateness)/[^/]+/", r"\1/SERIES/", path)
    path = re.sub(r"^/methods/[^/]+/(?=(?:path|reference|crosscheck|polylines)/)", "/", path)
    return re.sub(r"^((?:global_)?counters)/[^/]+$", r"\1/NAME", re.sub(r"^/methods/[^/]+/", "", path))


def differences(result, rows):
    """One line a difference between a file and its description."""
    found = []

    def visit(name, item):
        if not isinstance(item, h5py.Dataset):
            return
        path = "/" + name
        if documented_path(path) not in rows:
            found.append(f"{path}: is not described")
            return
        axes, units = rows[documented_path(path)]
        actual = result.text_attribute(path, "units")
        if actual != units:
            found.append(f"{path}: has units {actual}, described as {units}")
        if item.ndim != axes:
            found.append(f"{path}: has {item.ndim} axes, described with {axes}")
        if not result.text_attribute(path, "long_name"):
            found.append(f"{path}: has no long_name")

    result.h5.visititems(visit)
    return found


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="+", metavar="RESULT.h5")
    arguments = parser.parse_args(argv)
    rows = described(README.read_text(encoding="utf-8"))
    count = 0
    for file in arguments.results:
        for line in differences(Result(file), rows):
            print(f"{file}: {line}")
            count += 1
    print(f"{len(arguments.results)} files, {len(rows)} descriptions, {count} differences")
    return EXIT_CHECK_FAILED if count else 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
