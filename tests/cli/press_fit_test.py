# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""experiments/press-fit.json up to where the pin has landed in the clip: everything that a scene can have, in one. Its sets are the
exhaustive ones and FCL agrees (its own limits, by the exit code), the device goes through the snap, what pin and clip exert on each
other is opposite, and under `shared` no frame changes the force as much as some do under the plain sum. The parts are those of
experiments/press-fit/make.py.

    press_fit_test.py PROGRAM SOURCE
"""

import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

FRAMES = 1150
FIRST_AT_CLIP = 600  # the pin has left the magazine
PIN, CLIP = 0, 1  # columns of movers/


def check(what, holds):
    if not holds:
        sys.exit(f"press-fit: {what}")


def check_method(result, label):
    """@return the largest change of force from one frame to the next [N]"""
    method = result["methods"][label]
    force, place, movers = method["force"][:], method["loop/position"][:], method["movers/force"][:]
    for name, values in (("force", force), ("place", place), ("movers' forces", movers)):
        check(f"{label}: a {name} is not finite", np.isfinite(values).all())
    pair = movers[FIRST_AT_CLIP:, PIN] + movers[FIRST_AT_CLIP:, CLIP]
    check(f"{label}: pin and clip differ by {np.abs(pair).max()} N", np.abs(pair).max() < 1e-9)
    upward = force[FIRST_AT_CLIP:, 2]
    check(f"{label}: no snap: at most {upward.max()} N back", upward[:450].max() > 0.8)
    check(f"{label}: no snap: {upward[:500].min()} N", upward[:500].min() < -0.8)
    check(f"{label}: not seated: {place[-1, 2]} m", 0.0 < place[-1, 2] < 0.0015)
    check(f"{label}: magazine not felt", np.abs(force[:50]).max() > 0.1)
    check(f"{label}: energy does not balance", method["summary/energy_balance_error"][0] < 1e-9)
    check(f"{label}: nothing compared with truth", method["truth/frame"].size > 5 and method["fcl/frame"].size > 5)
    return np.linalg.norm(np.diff(force, axis=0), axis=1).max()


def main():
    program, source = sys.argv[1], pathlib.Path(sys.argv[2])
    parts = source / "experiments" / "press-fit"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([sys.executable, parts / "make.py", folder], check=True, stdout=subprocess.DEVNULL)
        for made in folder.iterdir():
            check(f"{made.name} is not what make.py makes", made.read_text() == (parts / made.name).read_text())
        file = folder / "result.h5"
        done = subprocess.run([program, "run", parts.with_suffix(".json"), "--out", file, "--set", f"/frames={FRAMES}",
                               "--set", "/driver/repetitions=1", "--set", "/probes/truth/stride_frames=50",
                               "--set", "/probes/fcl/stride_frames=100"], capture_output=True, text=True, check=False)
        check(f"exit code {done.returncode}: {done.stderr}", done.returncode == 0)
        with h5py.File(file) as result:
            check("not a thousand instances", len(result["scene/fixed_0/position"]) == 1000)
            check("the clip does not bend", result["scene/mover_0/deformation/largest_move"][:].max() > 1e-5)
            changes = {label: check_method(result, label) for label in result["methods"]}
    check(f"changes of force {changes}", changes["certified-shared"] < 0.5 and changes["certified-plain-sum"] > 1.0)


if __name__ == "__main__":
    main()
