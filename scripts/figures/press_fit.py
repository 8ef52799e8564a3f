#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""A press-fit, from the result of experiments/press-fit.json: the scene from above, cuts through pin and clip with the contacts and
the force on the pin, and the force along the insertion under every aggregation of the run, with contacts that are born and that die.

    python3 scripts/figures/press_fit.py results/press-fit.h5 [--out results/figures]

Exit codes: 0 done, 3 the result is of another scene or has no LMD lists."""

import argparse
import os

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import Result, ResultError, run_script
from mesh_drawing import FIXED, MOVING, read_off, rotation

import matplotlib.pyplot as plt
from matplotlib.patches import PathPatch
from matplotlib.path import Path

MM = 1e3
SAME = 3e-4  # contacts of two frames this near to each other are one [m]
EDGE = 0.95  # of the cutoff: LMDs beyond appear and vanish without force


def section(points, triangles, height):
    """The closed outlines, each (n, 2) in x and z, in which a closed mesh cuts the plane y = height; no vertex may lie in it."""
    above = points[:, 1] > height
    ends = {}  # of every cut edge: the edges where the cut continues in its two triangles
    for triangle in triangles[above[triangles].any(axis=1) & ~above[triangles].all(axis=1)]:
        one, other = (tuple(sorted(edge)) for edge in zip(triangle, np.roll(triangle, -1)) if above[edge[0]] != above[edge[1]])
        ends.setdefault(one, []).append(other)
        ends.setdefault(other, []).append(one)
    outlines = []
    while ends:
        outline = [next(iter(ends))]
        while (following := next((edge for edge in ends.pop(outline[-1]) if edge in ends), None)) is not None:
            outline.append(following)
        a, b = points[np.array(outline).T]
        outlines.append((a + ((height - a[:, 1]) / (b[:, 1] - a[:, 1]))[:, None] * (b - a))[:, [0, 2]])
    return outlines


class Clip:
    """How the clip's vertices stand at a time: as the experiment says, straight between one shape and the next."""

    def __init__(self, entry, folder):
        rest, self.triangles = read_off(os.path.join(folder, entry["mesh"]))
        deformation = entry["deformation"]
        names = [os.path.join(folder, name) for name in deformation["files"]]
        read = {name: read_off(name)[0] if name.endswith(".off") else np.loadtxt(name) for name in set(names)}
        self.shapes, self.interval = [entry["scale"] * read[name] for name in names], deformation["interval_s"]

    def at(self, time):
        step = min(time / self.interval, len(self.shapes) - 1.0)
        first = int(step)
        share = step - first
        return self.shapes[first] if share == 0.0 else (1.0 - share) * self.shapes[first] + share * self.shapes[first + 1]


class Track:
    """What one method's device did: height of the pin's tip over the clip's floor, force, and its contacts frame by frame."""

    def __init__(self, method):
        self.label, self.aggregation = method.label, method.aggregation
        self.position, self.orientation = method.read("path/position"), method.read("path/orientation")
        self.force = method.read("force")
        offset = method.read("lmds/frame_offset").astype(int)
        own = method.read("lmds/moving_body") == 0
        columns = (method.read("lmds/point_moving"), method.read("lmds/point_fixed"), method.read("lmds/distance")[:, None],
                   method.read("lmds/fixed_body")[:, None])
        rows = np.column_stack(columns)
        self.lmds = [rows[a:b][own[a:b]] for a, b in zip(offset, offset[1:])]

    def contacts(self, frame, body):
        return self.lmds[frame][self.lmds[frame][:, 7] == body]


def unmatched(points, others):
    """Those of the points that are left when the nearest of both pair off, one with one, as far as they are nearer than SAME."""
    apart = np.linalg.norm(points[:, None] - others[None], axis=2)
    free = np.full(len(points), True)
    for _ in range(min(apart.shape)):
        one, other = np.unravel_index(np.argmin(apart), apart.shape)
        if apart[one, other] > SAME:
            break
        free[one] = False
        apart[one, :] = apart[:, other] = np.inf
    return np.flatnonzero(free)


def events(track, body, belt, cutoff):
    """Frames in which a contact with the clip is born within the cutoff, and in which one has died there."""
    born, died, before = [], [], np.empty((0, 8))
    for frame in range(len(track.lmds)):
        found = track.contacts(frame, body)
        now, then = found[:, 3:6] - belt[frame], before[:, 3:6] - belt[max(0, frame - 1)]
        born += [frame] * int((found[unmatched(now, then), 6] < EDGE * cutoff).sum())
        died += [frame] * int((before[unmatched(then, now), 6] < EDGE * cutoff).sum())
        before = found
    return born, died


def fill(axes, outlines, colour):
    """A cut through a mesh."""
    path = Path.make_compound_path(*(Path(np.vstack([outline, outline[:1]]) * MM, closed=True) for outline in outlines))
    axes.add_patch(PathPatch(path, facecolor=colour, edgecolor="0.35", linewidth=0.5))


def draw_cut(axes, scene, track, frame, scale):
    """Pin and clip cut along the belt through the pin's axis, seen from the clip; contacts, and the force on the pin."""
    middle = track.position[frame]
    belt = scene.belt[frame]
    pin = scene.pin @ rotation(*track.orientation[frame]).T + middle - belt
    height = middle[1] + 1e-7  # not through a vertex
    fill(axes, section(scene.clip.at(scene.time[frame]), scene.clip.triangles, height), FIXED)
    fill(axes, section(pin, scene.pin_triangles, height), MOVING)
    for row in track.contacts(frame, scene.clip_body):
        ends = (np.array([row[0:3], row[3:6]]) - belt)[:, [0, 2]] * MM
        axes.plot(*ends.T, color=style.BLACK, linewidth=0.8, zorder=5)
        axes.plot(*ends.mean(axis=0), "o", color=style.TRUTH, markeredgecolor="k", markeredgewidth=0.4, markersize=4, zorder=6)
    force = track.force[frame][[0, 2]] * scale
    if np.linalg.norm(force) > 0.0:
        axes.annotate("", (middle - belt)[[0, 2]] * MM + [0.0, 15.5] + force, (middle - belt)[[0, 2]] * MM + [0.0, 15.5], zorder=7,
                      arrowprops={"arrowstyle": "-|>", "color": scene.colours[track.label], "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0})
    axes.set(xlim=(-8.3, 8.3), ylim=(-2.5, 27.5), aspect="equal", anchor="S")
    axes.axis("off")


class Scene:
    """The scene of a result of experiments/press-fit.json, and what every method's device did in it."""

    def __init__(self, result, folder):
        experiment = result.experiment
        entries = experiment.get("movers", [])
        self.methods = [method for method in result.methods.values() if method.has("lmds/moving_body") and method.has("path/position")]
        if not self.methods or not entries or "files" not in entries[0].get("deformation", {}):
            raise ResultError(f"{result.file}: no closed loop with LMD lists and a mover that deforms by files (remedy: run "
                              "experiments/press-fit.json)")
        self.file, self.time, self.cutoff = result.file, result.time, result.scene("cutoff_m")
        movers = result.h5["scene/mover_0"].attrs
        poses = result.read("/path/movers/position")
        self.belt, self.movers = poses[:, int(movers["first_mover"])], poses
        self.instances = result.read("/scene/fixed_0/position")
        self.clip_body = len(self.instances) + int(movers["first_mover"])
        self.clip = Clip(entries[0], folder)
        pin, self.pin_triangles = read_off(os.path.join(folder, experiment["moving"]["mesh"]))
        self.pin = experiment["moving"]["scale"] * pin
        self.tracks = [Track(method) for method in self.methods]
        self.colours = style.colours_of(self.methods)

    def insertion(self, track):
        """How far the pin's tip is below the height at which it meets the clip first [mm]; frames from the last one before on."""
        touched = [bool(len(track.contacts(frame, self.clip_body))) for frame in range(len(track.lmds))]
        if not any(touched):
            raise ResultError(f"{self.file}: {track.label}: the pin never comes near the clip (remedy: run all frames of experiments/press-fit.json)")
        first = max(0, touched.index(True) - 1)
        return first, (track.position[first, 2] - track.position[first:, 2]) * MM


def draw_overview(axes, scene, track, frame):
    """From above: magazine, belt, and the way of the pin."""
    axes.plot(*(scene.instances[:, :2] * MM).T, ".", color="0.75", markersize=0.9, rasterized=True)
    axes.plot(*(scene.movers[frame, 1:, :2] * MM).T, "s", color=FIXED, markeredgecolor="0.35", markeredgewidth=0.4, markersize=3.2)
    axes.plot(*(track.position[:, :2] * MM).T, color=style.BLACK, linewidth=0.8)
    axes.plot(*(track.position[frame, :2] * MM), "o", color=MOVING, markeredgecolor="k", markeredgewidth=0.5, markersize=3.2)
    axes.set_aspect("equal")
    axes.axis("off")


def draw_forces(axes, scene):
    """Upward force on the pin over its insertion; contacts with the clip that are born (up) and die (down) within the cutoff."""
    lowest = 0.0
    for track in scene.tracks:
        first, depth = scene.insertion(track)
        colour = scene.colours[track.label]
        axes.plot(depth, track.force[first:, 2], color=colour, label=f"{track.aggregation}: largest change a frame "
                  f"{np.linalg.norm(np.diff(track.force[first:], axis=0), axis=1).max():.2g} N")
        lowest = min(lowest, track.force[:, 2].min())
    for lane, track in enumerate(scene.tracks):
        first, depth = scene.insertion(track)
        for frames, mark in zip(events(track, scene.clip_body, scene.belt, scene.cutoff), "^v"):
            shown = depth[[frame - first for frame in frames if frame > first]]
            axes.plot(shown, np.full(len(shown), lowest - 0.45 - 0.4 * lane), mark, color=scene.colours[track.label], markersize=3.2,
                      markeredgewidth=0)
    axes.text(0.0, lowest - 0.45, "contact born ($\\blacktriangle$),\ndies ($\\blacktriangledown$)", fontsize=6, va="center")
    axes.axhline(0.0, color="0.5", linewidth=0.5)
    axes.set(xlabel="insertion [mm]", ylabel="force on the pin, upwards [N]")
    axes.legend(loc="upper left")


def instants(scene, track):
    """Frames to cut at: the strongest push back, the strongest pull in, and the end."""
    first, _ = scene.insertion(track)
    up = track.force[first:, 2]
    pulled = int(np.argmin(up))
    return first + int(np.argmax(up[:max(1, pulled)])), first + pulled, len(track.lmds) - 1


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("result")
    parser.add_argument("--experiments", default="experiments", help="folder that the experiment's mesh files are relative to")
    parser.add_argument("--out", default="results/figures")
    arguments = parser.parse_args(argv)
    scene = Scene(Result(arguments.result), arguments.experiments)
    track = next((track for track in scene.tracks if track.aggregation == "shared"), scene.tracks[0])
    frames = instants(scene, track)
    largest = max(np.linalg.norm(track.force[frame][[0, 2]]) for frame in frames)
    with plt.rc_context(style.STYLE):
        figure = plt.figure(figsize=(style.TWO_COLUMNS_IN, 3.6))
        draw_overview(figure.add_axes([0.01, 0.71, 0.25, 0.27]), scene, track, frames[0])
        figure.text(0.28, 0.9, f"From above: {len(scene.instances):,} pins in the magazine,\n{scene.movers.shape[1] - 1} parts on the belt, "
                    "the way of the pin (black).\nBelow: cuts through pin and clip, contacts,\nand the force on the pin", fontsize=6.5, va="top")
        for k, (frame, name) in enumerate(zip(frames, ("pushed back", "pulled in", "seated"))):
            draw_cut(figure.add_axes([0.19 * k, 0.05, 0.19, 0.64]), scene, track, frame, 6.0 / max(largest, 1e-9))
            figure.text(0.095 + 0.19 * k, 0.015, f"{name}, {scene.time[frame]:.2f} s", fontsize=6.5, ha="center")
        draw_forces(figure.add_axes([0.65, 0.115, 0.34, 0.865]), scene)
        return style.leave(figure, arguments.out, "press-fit")


if __name__ == "__main__":
    raise SystemExit(run_script(main))
