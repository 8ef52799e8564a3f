#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's Figure 1: two meshes near each other with their LMDs, as the program finds them. Takes an experiment, a
frame of its path and a method, asks `lmdbench query` for the set, and draws meshes, pairs and, beside it, the contact
enlarged."""

import argparse
import json
import os
import tempfile
from pathlib import Path

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import ResultError, UsageError, in_short, run_script
from mesh_drawing import FIXED, MOVING, draw_triangles, prepared, read_off, rotation, view_towards
from program import PROGRAM, answer
from tables import counted

import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection


LEAST_SPREAD = 0.05  # of the whole picture is enlarged where all LMDs are one point: triangles that intersect
DRAWN = ("mesh", "diagonal_m", "scale", "centre")  # keys of a mesh


def read_experiment(file):
    try:
        return json.loads(Path(file).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise UsageError(f"{file}: is no experiment: {in_short(error)} (remedy: name one, such as experiments/bunny-hard.json)")


def bodies_of(file, experiment):
    """The moving and the fixed mesh. What `lmdbench query` cannot be asked for would be another scene, and is refused."""
    beyond = [f"/{key}" for key in ("objects", "movers") if experiment.get(key)]
    if not beyond:
        lacking = [place for place, there in (("/moving", experiment.get("moving")), ("/fixed", experiment.get("fixed")),
                                              ("/path/file", experiment.get("path", {}).get("file")),
                                              ("/force", experiment.get("force"))) if not there]
        if lacking:
            raise UsageError(f"{file}: {', '.join(lacking)}: needed here (remedy: write it into the experiment)")
        beyond = [f"/fixed/{i}" for i in range(1, len(experiment["fixed"]))]
        bodies = (("moving", experiment["moving"]), ("fixed/0", experiment["fixed"][0]))
        beyond += [f"/{place}/{key}" for place, body in bodies for key in body if key not in DRAWN]
    if beyond:
        raise UsageError(f"{file}: {', '.join(beyond)}: not drawn here (remedy: an experiment with one moving and one fixed mesh that have no keys "
                          f"but {', '.join(DRAWN)})")
    return {"moving": experiment["moving"], "fixed": experiment["fixed"][0]}


def mesh_file(here, folder, name):
    """A name with a / or a . is a file's, as seen from the experiment; OFF alone is read."""
    if "/" not in name and "." not in name:
        return os.path.join(folder, name + ".off")
    if not name.lower().endswith(".off"):
        raise UsageError(f"{name}: not drawn here, where meshes are OFF files (remedy: a mesh of the manifest, or an OFF file of it)")
    return os.path.join(here, name)


def write_off(file, points, triangles):
    with open(file, "w", encoding="ascii") as stream:
        stream.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        stream.writelines(" ".join(repr(float(value)) for value in point) + "\n" for point in points)
        stream.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def query(program, folder, meshes, cutoff, poses, method):
    """The set of each pose: what `lmdbench query --json` prints."""
    names = []
    for name, (points, triangles) in meshes.items():
        names.append(os.path.join(folder, f"{name}.off"))
        write_off(names[-1], points, triangles)
    command = [program, "query", "--moving", names[0], "--fixed", names[1], "--cutoff", repr(cutoff), "--method", method, "--poses", "-",
               "--json"]
    lines = "".join(" ".join(repr(float(value)) for value in pose) + "\n" for pose in poses)
    return [json.loads(line)["lmds"] for line in answer(command, lines).splitlines()]


def chosen_poses(poses, time):
    """The pose at the time; without one, poses over the whole path in the order of their times."""
    if time is not None:
        if not poses[0, 0] <= time <= poses[-1, 0]:
            raise UsageError(f"--time: {time:g} s is no time of the path (remedy: give one from {poses[0, 0]:g} to {poses[-1, 0]:g})")
        return poses[[np.argmin(np.abs(poses[:, 0] - time))]]
    return poses[np.unique(np.linspace(0, len(poses) - 1, 101).astype(int))]


def index_to_show(sets, times):
    """The pose with LMDs that is nearest the middle of the path; None without one."""
    found = [i for i, lmds in enumerate(sets) if lmds]
    return min(found, key=lambda i: abs(times[i] - 0.5 * (times[0] + times[-1])), default=None)


def draw(meshes, lmds, title):
    style.use_style()
    moving, fixed = (np.array([lmd[f"point_{side}"] for lmd in lmds]) for side in ("moving", "fixed"))
    centre = 0.5 * (moving[0] + fixed[0])
    view = view_towards(meshes[1][0].mean(axis=0) - meshes[0][0].mean(axis=0))
    figure, panels = plt.subplots(1, 2, figsize=(style.TWO_COLUMNS_IN, 3.4), gridspec_kw={"left": 0.01, "right": 0.99, "bottom": 0.02, "top": 0.88})
    every = np.concatenate([points for points, _ in meshes]) @ view.T
    reach = 0.52 * np.max(every.max(axis=0)[:2] - every.min(axis=0)[:2])
    spread = max(np.max(np.linalg.norm(np.concatenate([moving, fixed]) - centre, axis=1)), 4 * np.linalg.norm(moving[0] - fixed[0]),
                 LEAST_SPREAD * reach)
    for axes, middle, half, edges, words in ((panels[0], 0.5 * (every.max(axis=0) + every.min(axis=0)), reach, "none", "whole"),
                                             (panels[1], centre @ view.T, 1.3 * spread, "#00000040", "where they meet")):
        corners = [points[triangles] for points, triangles in meshes]
        colours = np.concatenate([np.tile(colour, (len(part), 1)) for colour, part in zip((MOVING, FIXED), corners)])
        draw_triangles(axes, np.concatenate(corners), view, colours, edge=edges)
        lines = np.stack([moving @ view.T, fixed @ view.T], axis=1)[:, :, :2]
        axes.add_collection(LineCollection(lines, colors=style.VERMILLION, linewidths=1.6, zorder=5))
        for points in (lines[:, 0], lines[:, 1]):
            axes.plot(points[:, 0], points[:, 1], ls="none", marker="o", ms=2.6, color=style.VERMILLION, mec="white", mew=0.3, zorder=6)
        axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half), aspect="equal")
        axes.axis("off")
        axes.set_title(words, fontsize=8)
    figure.text(0.02, 0.945, title, fontsize=8.5, fontweight="bold")
    return figure


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("experiment", metavar="EXPERIMENT.json", help="an experiment on built meshes")
    parser.add_argument("--time", type=float, default=None, metavar="SECONDS", help="pose of the path; without it the one nearest the middle that has LMDs")
    parser.add_argument("--method", default="certified")
    parser.add_argument("--program", default=PROGRAM, metavar="FILE")
    parser.add_argument("--out", required=True, metavar="DIR", help="directory of figure1.svg and figure1.png")
    arguments = parser.parse_args(argv)
    experiment = read_experiment(arguments.experiment)
    here = os.path.dirname(arguments.experiment)
    folder = os.path.join(here, experiment.get("mesh_folder", "../meshes"))
    meshes = {}
    for role, body in bodies_of(arguments.experiment, experiment).items():
        points, triangles = read_off(mesh_file(here, folder, body["mesh"]))
        meshes[role] = (prepared(points, body), triangles)
    path = os.path.join(here, experiment["path"]["file"])
    try:
        poses = np.loadtxt(path, ndmin=2)
    except (OSError, ValueError) as error:
        raise ResultError(f"{path}: is no path: {in_short(error)} (remedy: correct the file, or /path/file of {arguments.experiment})")
    poses = chosen_poses(poses, arguments.time)
    force = experiment["force"][0] if isinstance(experiment["force"], list) else experiment["force"]
    moving = meshes["moving"][0]
    if not {"cutoff_m", "cutoff_diagonal"} & force.keys():
        raise UsageError(f"{arguments.experiment}: /force: needed here is a cutoff (remedy: write cutoff_m into the experiment)")
    cutoff = force.get("cutoff_m") or force["cutoff_diagonal"] * float(np.linalg.norm(moving.max(axis=0) - moving.min(axis=0)))
    os.makedirs(arguments.out, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        sets = query(arguments.program, scratch, meshes, cutoff, poses, arguments.method)
    shown = index_to_show(sets, poses[:, 0])
    if shown is None:
        when = "on the path" if arguments.time is None else f"at {poses[0, 0]:g} s"
        raise ResultError(f"{arguments.experiment}: no LMD within the cutoff {when} (remedy: another {'experiment' if arguments.time is None else '--time'})")
    pose, lmds = poses[shown], sets[shown]
    shapes = [(moving @ rotation(*pose[4:]).T + pose[1:4], meshes["moving"][1]), meshes["fixed"]]
    name = style.shortened(experiment.get("name", Path(arguments.experiment).stem))
    title = f"{counted(len(lmds), 'LMD')} of {arguments.method} within {1e3 * cutoff:.3g} mm, {name} at {pose[0]:g} s"
    return style.leave(draw(shapes, lmds, title), arguments.out, "figure1")


if __name__ == "__main__":
    raise SystemExit(run_script(main))
