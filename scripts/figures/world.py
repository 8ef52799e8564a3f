#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""A world of instances with its contacts, from a result with LMD lists of an experiment whose fixed mesh has "instances": where the
instances stand and the path goes, the frame in which most of them are in contact, LMDs over time by instance, and how many instances
a frame looks at. Meshes are drawn from the built OFF files that the result names."""

import argparse
import os

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import ResultError, open_h5, run_script, text
from mesh_drawing import FIXED, MOVING, draw_triangles, placed, read_off, rotation, view_onto

import matplotlib.pyplot as plt

VIEW = view_onto(np.array([0.0, 0.0, 1.0]), 20.0)
OTHERS = "0.8"  # instances without contact


class World:
    """What a result knows of its world and of one method's contacts."""

    def __init__(self, file, method):
        fixed = [name for name in file["scene"] if name.startswith("fixed_") and "position" in file["scene"][name]]
        if not fixed:
            raise ResultError(f"{file.filename}: no instances in its scene (remedy: run experiments/world.json)")
        group = file["methods"][method] if method in file["methods"] else None
        if group is None or "lmds" not in group:
            raise ResultError(f"{file.filename}: no LMD lists of {method} (remedy: --set /record/lmds=true)")
        self.file, self.entries = file.filename, []
        for name in sorted(fixed, key=lambda name: int(name.split("_")[1])):
            entry = file["scene"][name]
            self.entries.append({"first": int(entry.attrs["first_fixed_body"]), "mesh": text(entry.attrs["mesh"]),
                                 "diagonal": float(entry.attrs["diagonal_m"]), "position": entry["position"][:],
                                 "orientation": entry["orientation"][:]})
        moving = file["scene/moving"].attrs
        self.moving = {"mesh": text(moving["mesh"]), "diagonal": float(moving["diagonal_m"])}
        self.time = file["path/time"][:]
        path = group.get("path", file["path"])  # in a closed loop that of the method's device, not of the hand
        self.position, self.orientation = (path[name][:] for name in ("position", "orientation"))
        lmds = group["lmds"]
        self.offset = lmds["frame_offset"][:].astype(int)
        self.body = lmds["fixed_body"][:].astype(int)
        self.points = lmds["point_fixed"][:]
        # Names of older files, in which instances are counted, not pairs.
        names = ("pairs_touched", "pairs_searched", "broad_phase_queries", "instances_touched", "instances_searched")
        self.counters = {name: group["counters"][name][:] for name in names if name in group.get("counters", {})}

    def count(self):
        return sum(len(entry["position"]) for entry in self.entries)

    def bodies(self, frame):
        return self.body[self.offset[frame]:self.offset[frame + 1]]

    def frame_of_most(self):
        """The frame with contacts of most instances; of several the one with most LMDs."""
        return max(range(len(self.offset) - 1), key=lambda frame: (len(set(self.bodies(frame))), len(self.bodies(frame))))

    def place(self, body):
        """Entry, position and orientation of an instance."""
        for entry in self.entries:
            index = body - entry["first"]
            if 0 <= index < len(entry["position"]):
                return entry, entry["position"][index], entry["orientation"][index]
        raise ResultError(f"{self.file}: fixed body {body} is in contact and no instance: not drawn here (remedy: a run whose fixed meshes are "
                          "instances)")


class Meshes:
    def __init__(self, folder):
        self.folder, self.read = folder, {}

    def corners(self, mesh, diagonal, position, orientation):
        """(T, 3, 3) corners in the world."""
        if (mesh, diagonal) not in self.read:
            points, triangles = read_off(os.path.join(self.folder, f"{mesh}.off"))
            self.read[mesh, diagonal] = placed(points, diagonal), triangles
        points, triangles = self.read[mesh, diagonal]
        return (points @ rotation(*orientation).T + position)[triangles]


def draw_overview(axes, world, touched, colours):
    for entry in world.entries:
        axes.plot(*(entry["position"] @ VIEW.T)[:, :2].T, ".", color=OTHERS, markersize=1.2, rasterized=True)
    for body in touched:
        axes.plot(*(VIEW @ world.place(body)[1])[:2], "o", color=colours[body], markersize=3)
    axes.plot(*(world.position @ VIEW.T)[:, :2].T, color=style.BLACK, linewidth=0.8)
    axes.set_aspect("equal")
    axes.set_axis_off()


def draw_contacts(axes, world, meshes, frame, colours):
    moving = meshes.corners(world.moving["mesh"], world.moving["diagonal"], world.position[frame], world.orientation[frame])
    corners, shades = [moving], [np.tile(MOVING, (len(moving), 1))]
    for body in sorted(set(world.bodies(frame))):
        entry, position, orientation = world.place(body)
        corners.append(meshes.corners(entry["mesh"], entry["diagonal"], position, orientation))
        shades.append(np.tile(FIXED, (len(corners[-1]), 1)))
    draw_triangles(axes, np.concatenate(corners), VIEW, np.concatenate(shades))
    for k in range(world.offset[frame], world.offset[frame + 1]):
        axes.plot(*(VIEW @ world.points[k])[:2], "o", color=colours[world.body[k]], markeredgecolor="k", markeredgewidth=0.5, markersize=4.5,
                  zorder=10)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_axis_off()


def draw_times(top, bottom, world, touched, colours):
    frames = len(world.offset) - 1
    lower = np.zeros(frames)
    for body in touched:
        count = np.array([np.count_nonzero(world.bodies(frame) == body) for frame in range(frames)])
        top.fill_between(world.time[:frames], lower, lower + count, color=colours[body], linewidth=0, step="mid")
        lower += count
    top.set_ylabel("LMDs, by instance")
    for (name, values), colour in zip(world.counters.items(), (style.BLUE, style.BLACK, style.ORANGE)):
        bottom.plot(world.time[:len(values)], values, color=colour, linewidth=0.8, label=name.replace("_", " "))
    if world.counters:
        bottom.legend(fontsize=6, frameon=False)
    bottom.set(ylabel="instances a frame", xlabel="time [s]")


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("result")
    parser.add_argument("--method", default="certified", help="label of the method whose LMDs are drawn")
    parser.add_argument("--meshes", default="meshes", help="folder of built meshes")
    parser.add_argument("--out", default="results/figures")
    arguments = parser.parse_args(argv)
    with open_h5(arguments.result) as file:
        world = World(file, arguments.method)
    touched = sorted(set(world.body))
    if not touched:
        raise ResultError(f"{arguments.result}: {arguments.method} found no LMD in any frame (remedy: another --method, or a path that comes nearer)")
    colours = dict(zip(touched, plt.get_cmap("turbo")(np.linspace(0.08, 0.92, len(touched)))))
    frame = world.frame_of_most()
    with plt.rc_context(style.STYLE):
        figure = plt.figure(figsize=(style.TWO_COLUMNS_IN, 3.3))
        draw_overview(figure.add_axes([0.0, 0.02, 0.31, 0.86]), world, touched, colours)
        draw_contacts(figure.add_axes([0.31, 0.02, 0.34, 0.86]), world, Meshes(arguments.meshes), frame, colours)
        top = figure.add_axes([0.72, 0.58, 0.27, 0.32])
        draw_times(top, figure.add_axes([0.72, 0.13, 0.27, 0.32], sharex=top), world, touched, colours)
        figure.text(0.01, 0.94, f"{world.count()} instances, {len(touched)} in contact", fontsize=7.5)
        figure.text(0.36, 0.94, f"{world.time[frame]:.3f} s: {len(world.bodies(frame))} LMDs, instances in contact: {len(set(world.bodies(frame)))}", fontsize=7.5)
        return style.leave(figure, arguments.out, "world")


if __name__ == "__main__":
    raise SystemExit(run_script(main))
