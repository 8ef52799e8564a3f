#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the program without all that it can do without (preset "smallest") and checks it: it links none of the parts that
are off, answers queries with the bits of the full program, and says of everything else which option and package it lacks.
Prints size and start-up of both programs as a Markdown table.

    python3 scripts/smallest_build.py [--full build/release/lmdbench] [--fresh]

Exit codes: 0 all checks passed, 1 one did not, 4 the build failed, or there is no full program."""

import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
FOLDER = os.path.join(ROOT, "build", "smallest")
PROGRAM = os.path.join(FOLDER, "lmdbench")
# In names of shared libraries; libsz is what HDF5 compresses with, linked statically itself.
LEFT_OUT = ("assimp", "fcl", "octomap", "libsz", "tbb", "xxhash")
# A cube of quads with indices from both ends, texture coordinates and a group.
CUBE_OBJ = """mtllib lost.mtl
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nvt 0 0
g sides
f 4/1 3/1 2/1 1/1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf -5 -8 -4 -1
"""
CUBE_OFF = """OFF\n8 6 0
0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1
4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7
"""
BOXES = ["query", "--moving", "cube.off", "--fixed", "cube.off", "--cutoff", "0.1", "--poses", "apart.tum", "--json"]
STARTS = 21


class Check:
    """Counts what failed and goes on."""

    def __init__(self):
        self.failed = 0

    def that(self, holds, what):
        if not holds:
            self.failed += 1
            print(f"FAILED: {what}", file=sys.stderr)


def run(program, arguments, folder):
    return subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, timeout=60)


def build(fresh):
    """Seconds of the build."""
    if fresh:
        shutil.rmtree(FOLDER, ignore_errors=True)
    begin = time.monotonic()
    for command in (["cmake", "--preset", "smallest"], ["cmake", "--build", "--preset", "smallest"]):
        done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            print(f"{done.stdout}error: {' '.join(command)} failed, see above", file=sys.stderr)
            raise SystemExit(4)
    return time.monotonic() - begin


def answers(program, arguments, folder):
    """What a query prints, without its times; the error where there is one."""
    done = run(program, arguments, folder)
    if done.returncode != 0:
        return done.returncode, done.stderr
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    for line in lines:
        del line["seconds"]
    return 0, lines


def libraries(program):
    text = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    return re.findall(r"^\s*(lib\S+)", text, re.MULTILINE)


def check_queries(check, full, folder):
    meshes = os.path.join(ROOT, "meshes")
    shapes = ["query", "--moving", "small-blob", "--fixed", "torus", "--dir", meshes, "--cutoff", "0.1", "--json"]
    cubes = [part.replace("cube.off", "cube.obj") for part in BOXES]
    with open(os.path.join(folder, "near.tum"), "w", encoding="ascii") as stream:
        for k in range(20):
            stream.write(f"{k} {0.9 - 0.02 * k} 0.05 0.02 0 0 {0.01 * k} {(1 - (0.01 * k) ** 2) ** 0.5}\n")
    shapes += ["--poses", "near.tum"]
    for query in (shapes, BOXES, cubes):
        for method in ("original", "improved", "certified", "exhaustive"):
            mine = answers(PROGRAM, [*query, "--method", method], folder)
            check.that(mine[0] == 0 and mine[1], f"{method}, {query[2]}: {mine[1]}")
            theirs = answers(full, [*query, "--method", method], folder)
            check.that(mine == theirs, f"{method}, {query[2]}: other bits than the full program")
    off, obj = answers(PROGRAM, BOXES, folder), answers(PROGRAM, cubes, folder)
    distances = [[[lmd["distance"] for lmd in line["lmds"]] for line in lines] for _, lines in (off, obj)]
    check.that(distances[0] == distances[1] and distances[0][0], "the cube as OBJ and as OFF are at other distances")


def check_messages(check, full, folder):
    def lacks(arguments, option, package):
        done = run(PROGRAM, arguments, folder)
        said = done.returncode == 4 and option in done.stderr and package in done.stderr
        check.that(said, f"{' '.join(arguments)}: exit code {done.returncode}, {done.stderr.strip()}")

    lacks(["run", "any.json", "--out", "any.h5"], "-DLMDBENCH_WITH_HDF5=ON", "libhdf5-dev")
    lacks([*BOXES, "--method", "nearest"], "-DLMDBENCH_WITH_FCL=ON", "libfcl-dev")
    lacks([part.replace("cube.off", "cube.glb") for part in BOXES], "-DLMDBENCH_WITH_ASSIMP=ON", "libassimp-dev")
    for command in re.findall(r"^  ([a-z-]+) ", run(full, ["--help"], folder).stdout.split("Subcommands:")[1], re.M):
        done = run(PROGRAM, [command, "--help"], folder)
        check.that("not expected" not in done.stderr, f"the command {command} is not even known")
    Path(folder, "concave.obj").write_text("v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf 2 3 4 1\n", encoding="ascii")
    done = run(PROGRAM, ["mesh", "info", "./concave.obj"], folder)
    check.that(done.returncode == 0, f"concave.obj: exit code {done.returncode}, {done.stderr.strip()}")
    bad = {"index.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "line 4"),
           "curve.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ncurv 0 1 1 2\n", "curv"),
           "number.obj": ("v 0 0 zero\n", "line 1"), "short.obj": ("v 0 0 0\nv 1 0 0\nf 1 2\n", "line 3")}
    for name, (text, part) in bad.items():
        Path(folder, name).write_text(text, encoding="ascii")
        done = run(PROGRAM, ["mesh", "info", f"./{name}"], folder)
        check.that(done.returncode == 3 and part in done.stderr, f"{name}: exit code {done.returncode}, {done.stderr.strip()}")


def start_ms(program, arguments, folder):
    """Median and longest wall time of a whole process [ms]."""
    times = []
    for _ in range(STARTS):
        begin = time.perf_counter()
        run(program, arguments, folder)
        times.append(1e3 * (time.perf_counter() - begin))
    return f"{statistics.median(times):.1f} ({max(times):.1f})"


def table(programs, folder):
    print(f"| program | size [kB] | shared libraries | `--version` [ms]: median (longest of {STARTS}) | query of two boxes [ms] |")
    print("|---|---|---|---|---|")
    for name, program in programs:
        print(f"| {name} | {os.path.getsize(program) // 1024} | {len(libraries(program))} "
              f"| {start_ms(program, ['--version'], folder)} | {start_ms(program, BOXES, folder)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--full", default=os.path.join(ROOT, "build", "release", "lmdbench"), help="the full program")
    parser.add_argument("--fresh", action="store_true", help="from an empty build folder")
    arguments = parser.parse_args()
    if not os.access(arguments.full, os.X_OK):
        print(f"error: {arguments.full} is no program (remedy: cmake --build --preset release)", file=sys.stderr)
        return 4
    seconds = build(arguments.fresh)
    full = os.path.abspath(arguments.full)
    check = Check()
    linked, linked_by_full = libraries(PROGRAM), libraries(full)
    for part in LEFT_OUT:
        check.that(not any(part in lib for lib in linked), f"links {part}")
        check.that(any(part in lib for lib in linked_by_full), f"the full program does not link {part}, so that nothing is shown")
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("cube.obj", CUBE_OBJ), ("cube.off", CUBE_OFF), ("cube.glb", "{}"),
                           ("apart.tum", "0 1.05 0.2 0.1 0 0 0 1\n")):
            Path(folder, name).write_text(text, encoding="ascii")
        check_queries(check, full, folder)
        check_messages(check, full, folder)
        table([("full", full), ("smallest", PROGRAM)], folder)
    print(f"built in {seconds:.0f} s; {'all checks passed' if check.failed == 0 else f'{check.failed} checks failed'}")
    return 1 if check.failed else 0


if __name__ == "__main__":
    raise SystemExit(main())
