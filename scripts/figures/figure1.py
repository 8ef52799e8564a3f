#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's Figure 1: two meshes near each other with their LMDs, as the program finds them. Takes an experiment, a
frame of its path and a method, asks `lmdbench query` for the set, and draws meshes, pairs and, beside it, the contact
enlarged."""

import argparse
import json
import os
import subprocess

import numpy as np

import figure_style as style
from lmdbench_results import ResultError, run_script

import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection, PolyCollection

LIGHT = np.array([0.35, 0.45, 0.82])
MOVING, FIXED = np.array([0.68, 0.80, 0.92]), np.array([0.94, 0.86, 0.70])


def read_off(file):
    """(V, 3) vertices and (T, 3) triangles of an OFF file."""
    try:
        with open(file, encoding="ascii") as stream:
            words = [word for line in stream for word in line.split("#")[0].split()]
    except OSError as error:
        raise ResultError(f"{error} (remedy: lmdbench mesh build)")
    vertices, triangles = int(words[1]), int(words[2])
    points = np.array(words[4:4 + 3 * vertices], dtype=float).reshape(-1, 3)
    return points, np.array(words[4 + 3 * vertices:4 + 3 * vertices + 4 * triangles], dtype=int).reshape(-1, 4)[:, 1:]


def scaled(points, diagonal):
    return points if diagonal is None else points * diagonal / np.linalg.norm(points.max(axis=0) - points.min(axis=0))


def rotation(x, y, z, w):
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def write_off(file, points, triangles):
    with open(file, "w", encoding="ascii") as stream:
        stream.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        stream.writelines(" ".join(repr(float(value)) for value in point) + "\n" for point in points)
        stream.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def query(program, folder, meshes, cutoff, pose, method):
    """The set of one pose: what `lmdbench query --json` prints."""
    names = []
    for name, (points, triangles) in meshes.items():
        names.append(os.path.join(folder, f"{name}.off"))
        write_off(names[-1], points, triangles)
    command = [program, "query", "--moving", names[0], "--fixed", names[1], "--cutoff", repr(cutoff), "--method", method, "--poses", "-",
               "--json"]
    outcome = subprocess.run(command, input=" ".join(repr(float(value)) for value in pose) + "\n", capture_output=True, text=True,
                             check=False)
    if outcome.returncode != 0:
        raise ResultError(outcome.stderr.strip())
    return json.loads(outcome.stdout.splitlines()[0])["lmds"]


def view_towards(direction):
    """(3, 3) rows right, up, towards the reader; looks square at the direction of contact."""
    right = direction / np.linalg.norm(direction)
    up = np.array([0.0, 1.0, 0.0]) - right[1] * right
    up = up / np.linalg.norm(up) if np.linalg.norm(up) > 1e-6 else np.array([0.0, 0.0, 1.0])
    return np.array([right, up, np.cross(right, up)])


def draw_meshes(axes, meshes, view, alpha):
    """Painter's algorithm over all triangles that face the reader."""
    corners, colours = [], []
    for (points, triangles), colour in zip(meshes, (MOVING, FIXED)):
        seen = (points @ view.T)[triangles]
        normals = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
        length = np.linalg.norm(normals, axis=1)
        faces = (length > 0) & (normals[:, 2] > 0)
        shade = 0.45 + 0.55 * np.clip((normals[faces] / length[faces, None]) @ LIGHT, 0, 1)
        corners.append(seen[faces])
        colours.append(np.clip(colour[None, :] * shade[:, None], 0, 1))
    corners, colours = np.concatenate(corners), np.concatenate(colours)
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    axes.add_collection(PolyCollection(corners[order][:, :, :2], facecolors=colours[order], edgecolors="none" if alpha is None else alpha,
                                       linewidths=0.15, rasterized=True))


def draw(meshes, lmds, title):
    style.use_style()
    moving, fixed = (np.array([lmd[f"point_{side}"] for lmd in lmds]) for side in ("moving", "fixed"))
    centre = 0.5 * (moving[0] + fixed[0])
    view = view_towards(meshes[1][0].mean(axis=0) - meshes[0][0].mean(axis=0))
    figure, panels = plt.subplots(1, 2, figsize=(style.TWO_COLUMNS_IN, 3.4), gridspec_kw={"left": 0.01, "right": 0.99, "bottom": 0.02, "top": 0.88})
    every = np.concatenate([points for points, _ in meshes]) @ view.T
    reach = 0.52 * np.max(every.max(axis=0)[:2] - every.min(axis=0)[:2])
    spread = max(np.max(np.linalg.norm(np.concatenate([moving, fixed]) - centre, axis=1)), 4 * np.linalg.norm(moving[0] - fixed[0]))
    for axes, middle, half, edges, words in ((panels[0], 0.5 * (every.max(axis=0) + every.min(axis=0)), reach, None, "whole"),
                                             (panels[1], centre @ view.T, 1.3 * spread, "#00000040", "where they meet")):
        draw_meshes(axes, meshes, view, edges)
        lines = np.stack([moving @ view.T, fixed @ view.T], axis=1)[:, :, :2]
        axes.add_collection(LineCollection(lines, colors=style.VERMILLION, linewidths=1.6, zorder=5))
        for points in (lines[:, 0], lines[:, 1]):
            axes.plot(points[:, 0], points[:, 1], ls="none", marker="o", ms=2.6, color=style.VERMILLION, mec="white", mew=0.3, zorder=6)
        axes.set_xlim(middle[0] - half, middle[0] + half)
        axes.set_ylim(middle[1] - half, middle[1] + half)
        axes.set_aspect("equal")
        axes.axis("off")
        axes.set_title(words, fontsize=8)
    figure.text(0.02, 0.945, title, fontsize=8.5, fontweight="bold")
    return figure


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("experiment", metavar="EXPERIMENT.json", help="an experiment on built meshes")
    parser.add_argument("--time", type=float, default=None, metavar="SECONDS", help="pose of the path; the middle without it")
    parser.add_argument("--method", default="certified")
    parser.add_argument("--program", default="build/release/lmdbench", metavar="FILE")
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of figure1.svg and figure1.png")
    arguments = parser.parse_args(argv)
    with open(arguments.experiment, encoding="utf-8") as stream:
        experiment = json.load(stream)
    here = os.path.dirname(arguments.experiment)
    folder = os.path.join(here, experiment.get("mesh_folder", "../meshes"))
    bodies = [experiment["moving"], experiment["fixed"][0]]
    meshes = {}
    for role, body in zip(("moving", "fixed"), bodies):
        points, triangles = read_off(os.path.join(folder, body["mesh"] + ".off"))
        meshes[role] = (scaled(points, body.get("diagonal_m")), triangles)
    poses = np.loadtxt(os.path.join(here, experiment["path"]["file"]))
    at = 0.5 * poses[-1, 0] if arguments.time is None else arguments.time
    pose = poses[np.argmin(np.abs(poses[:, 0] - at))]
    force = experiment["force"][0] if isinstance(experiment["force"], list) else experiment["force"]
    moving = meshes["moving"][0]
    cutoff = force.get("cutoff_m") or force["cutoff_diagonal"] * float(np.linalg.norm(moving.max(axis=0) - moving.min(axis=0)))
    os.makedirs(arguments.out, exist_ok=True)
    lmds = query(arguments.program, arguments.out, meshes, cutoff, pose, arguments.method)
    for role in meshes:
        os.remove(os.path.join(arguments.out, f"{role}.off"))
    if not lmds:
        raise ResultError(f"{arguments.experiment}: no LMD within the cutoff at {pose[0]:g} s (remedy: another --time)")
    placed = [(moving @ rotation(*pose[4:]).T + pose[1:4], meshes["moving"][1]), meshes["fixed"]]
    title = f"{len(lmds)} LMD{'s' * (len(lmds) != 1)} of {arguments.method} within {1e3 * cutoff:.3g} mm, {experiment['name']} at {pose[0]:g} s"
    for file in style.save(draw(placed, lmds, title), arguments.out, "figure1"):
        print(file)
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
