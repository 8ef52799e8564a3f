#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The same second of hard contact under the plain sum of the LMDs' forces and under the shared law: the second in which the
plain sum jumps most, from what `lmdbench-study continuous-force --part paths --json FILE` leaves.

    python3 scripts/figures/continuous_force.py FILE.json [--scene bunny-hard] [--out results/figures]

Exit codes: 0 done, 3 the file has no such path."""

import argparse
import json
from pathlib import Path

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import ResultError, run_script

import matplotlib.pyplot as plt

RATE_HZ = 1000
SECOND = RATE_HZ  # frames
LAWS = (("sum", "plain sum", style.VERMILLION), ("shared", "shared", style.BLUE))


def busiest_second(force):
    """First frame of the second whose largest steps add up to most."""
    steps = np.linalg.norm(np.diff(force, axis=0), axis=1)
    jumps = np.where(steps > 0.25, steps, 0.0)
    whole = np.concatenate(([0.0], np.cumsum(jumps)))
    starts = np.arange(0, max(1, len(force) - SECOND), 50)
    return int(starts[np.argmax(whole[np.minimum(starts + SECOND - 1, len(steps))] - whole[starts])])


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file")
    parser.add_argument("--scene", default="bunny-hard")
    parser.add_argument("--out", default="results/figures")
    arguments = parser.parse_args(argv)
    paths = json.loads(Path(arguments.file).read_text(encoding="utf-8")).get("paths", {})
    if arguments.scene not in paths:
        raise ResultError(f"{arguments.file}: no path {arguments.scene} (remedy: lmdbench-study continuous-force --part paths "
                          f"--scene {arguments.scene} --json FILE)")
    forces = {law: np.array(paths[arguments.scene][law]["force"]) for law, _, _ in LAWS}
    first = busiest_second(forces["sum"])
    frames = slice(first, first + SECOND)
    with plt.rc_context(style.STYLE):
        figure, axes = plt.subplots(2, 1, figsize=(style.TWO_COLUMNS_IN, 3.2), sharex=True, layout="constrained")
        time = np.arange(first, first + len(forces["sum"][frames])) / RATE_HZ
        for law, label, colour in LAWS:
            force = forces[law][frames]
            axes[0].plot(time, np.linalg.norm(force, axis=1), color=colour, label=label)
            steps = np.linalg.norm(np.diff(forces[law], axis=0), axis=1)[frames]
            axes[1].plot(time[:len(steps)], steps, color=colour)
        axes[0].set_ylabel("force [F_max]")
        axes[1].set(ylabel="change a frame [F_max]", xlabel="time [s]")
        axes[0].legend(loc="upper left", ncols=2)
        for axis in axes:
            axis.set_ylim(bottom=0.0)
        return style.leave(figure, arguments.out, "continuous-force")


if __name__ == "__main__":
    raise SystemExit(run_script(main))
