#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What method `certified` costs over its tuned constants: each is changed in a worktree of its own, the program built, and
instructions of its searches counted under callgrind along the first frames of recorded paths; no load of the machine
moves them. LMD sets must stay the same. Prints a Markdown table; * is the committed value. Meshes must be built.

    python3 scripts/tuned_constants.py [--frames 3000] [--only NAME]... [EXPERIMENT...]

Exit codes: 0 done, 1 a set changed, 2 usage, 4 no build or no callgrind."""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
TREE = os.path.join(ROOT, "build", "tuned", "tree")
FORECAST = "src/lmdbench/methods/certified/keep/motion_forecast.cpp"
TOUCHING = "src/lmdbench/methods/certified/decide/touching_pairs.cpp"
LIFETIME = "src/lmdbench/methods/certified/keep/wide_lifetime.h"
POLICY = "src/lmdbench/methods/certified/keep/coherence_policy.h"
REFIT = "src/lmdbench/methods/certified/deform/wide_refit.cpp"
BOUNDS = "src/lmdbench/methods/certified/deform/refit_bounds.cpp"
CERTIFIED = "src/lmdbench/methods/certified/certified.cpp"
BUILD = "src/lmdbench/methods/certified/build/build_wide_hierarchy.cpp"
PARTITION = "src/lmdbench/methods/certified/build/wide_partition.cpp"
TRAVERSAL = "src/lmdbench/methods/certified/traverse/wide_traversal.h"
# name: file, text around the value, values
CONSTANTS = {
    "CONE_GAIN": (TRAVERSAL, "CONE_GAIN = {}F", ("0.05", "0.1", "0.2", "0.4", "100.0")),
    "PARALLEL_COST": (PARTITION, "PARALLEL_COST = {}F;", ("0.05", "0.1", "0.2", "0.4", "100.0")),
    "LARGEST_TURNED": (PARTITION, "LARGEST_TURNED = {};", ("0", "64", "512", "4096")),
    # --only LEAST_LONG_SHARE experiments/extreme/peg-square.json
    "LEAST_LONG_SHARE": (BUILD, "LEAST_LONG_SHARE = {};", ("0.0", "0.1", "0.25", "0.5", "2.0")),
    "LARGEST_HORIZON": (FORECAST, "LARGEST_HORIZON = {},", ("1.0", "2.0", "4.0", "8.0", "16.0")),
    "HORIZON_CUTOFFS": (FORECAST, "HORIZON_CUTOFFS = {},", ("0.25", "0.5", "1.0", "2.0", "4.0")),
    "MOST_CORNER_PAIRS": (TOUCHING, "MOST_CORNER_PAIRS = {};", ("0", "16", "64", "1024")),  # experiments/extreme/peg-square.json moves it
    # For deforming meshes: --only MOST_GROWTH experiments/deforming.json
    "MOST_GROWTH": (REFIT, "MOST_GROWTH = {};", ("1.05", "1.15", "1.3", "1.6", "4.0")),
    "REFIT_STEPS": (BOUNDS, "REFIT_STEPS = {},", ("0", "1", "3", "6")),
    "FIRST_REFIT_STEP": (BOUNDS, "FIRST_REFIT_STEP = {};", ("2", "4", "8")),
    "FEW_TESTS": (CERTIFIED, "FEW_TESTS = {},", ("16", "64", "256")),
    "SHARE_OF_TESTS": (CERTIFIED, "SHARE_OF_TESTS = {};", ("2", "4", "8", "16")),
    "LEAST_SHARE": (LIFETIME, "LEAST_SHARE = {}F;", ("0.0", "0.25", "0.5", "0.75")),
    "LARGEST_SHARE": (POLICY, "LARGEST_SHARE = {};", ("0.3", "0.4", "0.6")),
    "HORIZON_TURN": (FORECAST, "HORIZON_TURN = {};", ("0.0025", "0.005", "0.01", "0.02", "0.04")),
}
SCENE = ("--set", '/methods=[{"name":"certified","force_law":"exponential"}]', "--set", "/driver/repetitions=1", "--set",
         "/probes/truth/stride_frames=0", "--set", "/probes/fcl/stride_frames=0")


def fail(message):
    print(f"error: {message}", file=sys.stderr)
    sys.exit(4)


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL, **options)
    if done.returncode != 0:
        fail(f"{' '.join(command[:6])} ...: {(done.stderr or done.stdout)[-800:]}")
    return done


def build():
    run(["cmake", "--preset", "release", "-DLMDBENCH_BUILD_TESTS=OFF", "-DLMDBENCH_BUILD_EXPERIMENTS=OFF",
         "-DLMDBENCH_WITH_CGAL=OFF", "-DLMDBENCH_WARNINGS_AS_ERRORS=ON"], cwd=TREE)  # cached by test.sh
    run(["cmake", "--build", "--preset", "release", "--target", "lmdbench"], cwd=TREE)
    return os.path.join(TREE, "build", "release", "lmdbench")


def instructions(program, experiment, frames, folder):
    """(instructions a frame, hash of their LMD sets and forces); a path may have fewer frames"""
    out = os.path.join(folder, "r.h5")
    done = run(["valgrind", "--tool=callgrind", "--toggle-collect=lmdbench::Certified::search*",
                "--toggle-collect=lmdbench::WideHierarchy::follow*",
                f"--callgrind-out-file={folder}/callgrind.out", program, "run", experiment, "--verbose",
                *SCENE, "--set", f"/frames={frames}", "--out", out], env=os.environ | {"OPENSSL_ia32cap": ":~0x0"})
    counted = re.search(r"Collected : (\d+)", done.stderr)
    named = re.search(r"hash ([0-9a-f]{16})", done.stdout)
    ran = re.search(r"(\d+) frames", done.stdout)
    if not counted or not named or not ran or int(counted[1]) == 0:  # an inlined search has no name to count
        fail("callgrind saw no search, or the program said something unexpected")
    os.remove(out)
    return int(counted[1]) / int(ran[1]), named[1]


def costs(program, experiments, frames):
    """Instructions a frame and the hash, of each experiment."""
    with tempfile.TemporaryDirectory(prefix="tuned-") as folder:
        return [instructions(program, experiment, frames, folder) for experiment in experiments]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("experiments", nargs="*", default=[os.path.join(ROOT, "experiments", name) for name in ("bunny-hard.json", "armadillo-bunny.json")])
    parser.add_argument("--frames", type=int, default=3000)
    parser.add_argument("--only", action="append", choices=list(CONSTANTS), help="this constant; may be given again")
    arguments = parser.parse_args()
    if arguments.frames < 1:
        parser.error("--frames must be 1 or more")
    if not shutil.which("valgrind"):
        fail("there is no valgrind (remedy: apt-get install valgrind)")
    experiments = [os.path.abspath(file) for file in arguments.experiments]
    inside = subprocess.run(["git", "-C", TREE, "rev-parse", "--show-toplevel"], capture_output=True, text=True, check=False)
    if inside.stdout.strip() != os.path.realpath(TREE):  # what a killed call left: git would act on the repository around it
        shutil.rmtree(TREE, ignore_errors=True)
        run(["git", "-C", ROOT, "worktree", "prune"])
        run(["git", "-C", ROOT, "worktree", "add", "--quiet", "--detach", TREE])
    try:
        run(["git", "-C", TREE, "checkout", "--quiet", "--force", "--detach",
             run(["git", "-C", ROOT, "rev-parse", "HEAD"]).stdout.strip()])
        committed = costs(build(), experiments, arguments.frames)
        names = [os.path.splitext(os.path.basename(file))[0] for file in experiments]
        print(f"| constant | value | {' | '.join(f'{name}: instructions a frame (share)' for name in names)} |")
        print("|---|---|" + "---|" * len(names), flush=True)
        changed = False
        for name in arguments.only or CONSTANTS:
            file, pattern, values = CONSTANTS[name]
            path = os.path.join(TREE, file)
            text = Path(path).read_text(encoding="utf-8")
            here = re.search(re.escape(pattern).replace(r"\{\}", r"([0-9.]+)"), text)
            if not here:
                fail(f"{file} has no '{pattern}' (remedy: mend the list in scripts/tuned_constants.py)")
            for value in values:
                same = float(value) == float(here[1])
                rows = committed
                if not same:
                    Path(path).write_text(text.replace(here[0], pattern.format(value)), encoding="utf-8")
                    rows = costs(build(), experiments, arguments.frames)
                changed |= any(row[1] != old[1] for row, old in zip(rows, committed))
                cells = " | ".join(f"{row[0]:.0f} ({row[0] / old[0]:.3f}){'' if row[1] == old[1] else ' OTHER SETS'}"
                                   for row, old in zip(rows, committed))
                print(f"| {name} | {value}{' *' if same else ''} | {cells} |", flush=True)
            Path(path).write_text(text, encoding="utf-8")
    finally:
        subprocess.run(["git", "-C", ROOT, "worktree", "remove", "--force", TREE], check=False, capture_output=True)
    return 1 if changed else 0


if __name__ == "__main__":
    sys.exit(main())
