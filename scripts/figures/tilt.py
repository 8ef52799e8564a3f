#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Where flat meets tilted: force and torque of a box that is tilted slowly over a table, from 1e-2 to 1e-12 rad, with exact
coordinates and with coordinates rounded to single precision. One LMD at every tilt: its distance is continuous, its point goes
from the corner over the edge to the middle of the face, and the torque with it (src/lmdbench/decision/DEFINITION.md).

    python3 scripts/figures/tilt.py [--program build/release/lmdbench] [--out results/figures]

Exit codes: 0 done, 1 a tilt has more or less than one LMD, 4 no program."""

import argparse
import sys
import tempfile

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from figure1 import query
from lmdbench_results import EXIT_CHECK_FAILED, run_script
from program import PROGRAM

import matplotlib.pyplot as plt

GAP, CUTOFF = 0.01, 0.05  # m; linear force, 1 at distance 0, 0 at the cutoff
TILTS = np.logspace(-2, -12, 201)
AXIS = np.array([2.0, 1.0, 0.0]) / np.sqrt(5.0)  # not along a side, so that one corner is lowest


def box(low, high, turn):
    """Vertices, turned by a rotation matrix, and triangles."""
    corners = np.array([[x, y, z] for z in (low[2], high[2]) for y in (low[1], high[1]) for x in (low[0], high[0])]) @ turn.T
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return corners, [t for f in faces for t in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]


def rotation(axis, angle):
    """Rodrigues' formula, exact to rounding for the smallest angles."""
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * k + 2.0 * np.sin(0.5 * angle) ** 2 * (k @ k)


def quaternion(axis, angle):
    return np.append(np.sin(0.5 * angle) * axis, np.cos(0.5 * angle))


def product(a, b):
    """Of quaternions x y z w."""
    return np.append(a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3]), a[3] * b[3] - a[:3] @ b[:3])


def sets_of(program, floats, folder):
    """The LMD sets over TILTS, in the world of the files, and the rotation in which those hold box and table."""
    turn_axis, turn_angle = np.array([0.6, -0.48, 0.64]), 0.7
    turn = rotation(turn_axis, turn_angle)
    meshes = {}
    for name, low, high in (("box", (-0.5, -0.5, 0.0), (0.5, 0.5, 1.0)), ("table", (-2.0, -2.0, -0.5), (2.0, 2.0, 0.0))):
        vertices, triangles = box(low, high, turn)
        meshes[name] = (vertices.astype(np.float32) if floats else vertices, triangles)
    # In the table's frame: turn back, tilt, lift, turn again.
    there, back = quaternion(turn_axis, turn_angle), quaternion(turn_axis, -turn_angle)
    poses = [(i, *(turn @ np.array([0.0, 0.0, GAP])), *product(product(there, quaternion(AXIS, tilt)), back)) for i, tilt in enumerate(TILTS)]
    return query(program, folder, meshes, CUTOFF, poses, "certified"), turn


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=PROGRAM)
    parser.add_argument("--out", default="results/figures")
    arguments = parser.parse_args(argv)
    status = 0
    with plt.rc_context(style.STYLE), tempfile.TemporaryDirectory() as folder:
        figure, axes = plt.subplots(1, 3, figsize=(style.TWO_COLUMNS_IN, 2.1), layout="constrained")
        for floats, label, colour in ((False, "exact", style.BLUE), (True, "single precision", style.GREEN)):
            sets, turn = sets_of(arguments.program, floats, folder)
            if any(len(lmds) != 1 for lmds in sets):
                print(f"{label}: {sum(len(lmds) != 1 for lmds in sets)} of {len(sets)} tilts have not one LMD", file=sys.stderr)
                status = EXIT_CHECK_FAILED
            force, torque, place = [], [], []
            for lmds in sets:
                f = np.zeros(3)
                m = np.zeros(3)
                for lmd in lmds:
                    p, q = (turn.T @ np.array(lmd[k]) for k in ("point_moving", "point_fixed"))
                    f_lmd = -(1.0 - lmd["distance"] / CUTOFF) * (q - p) / np.linalg.norm(q - p)
                    f += f_lmd
                    m += np.cross(p - np.array([0.0, 0.0, GAP + 0.5]), f_lmd)
                force.append(np.linalg.norm(f))
                torque.append(np.linalg.norm(m))
                place.append(np.linalg.norm((turn.T @ np.array(lmds[0]["point_fixed"]))[:2]) if lmds else np.nan)
            for axis, values in zip(axes, (force, torque, place)):
                axis.plot(TILTS, values, color=colour, label=label, linewidth=1.0)
        for axis, name in zip(axes, ("force [F_max]", "torque [F_max m]", "point from the middle [m]")):
            axis.set(xscale="log", xlabel="tilt [rad]", ylabel=name)
            axis.set_ylim(bottom=0.0)
        axes[0].legend(loc="lower left", frameon=False)
        style.leave(figure, arguments.out, "tilt")
    return status


if __name__ == "__main__":
    sys.exit(run_script(main))
