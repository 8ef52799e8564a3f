#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The curves in which two meshes intersect, from a result with /polylines: the fixed mesh with the curves of some frames,
their length over the frames, and what finding them takes. The mesh is drawn from the built OFF file that the result names."""

import argparse
import json
import os

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import ResultError, open_h5, run_script, text
from mesh_drawing import prepared, read_off, rotation
from tables import counted

import matplotlib.pyplot as plt
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

LIGHT = np.array([0.4, 0.7, 0.6]) / np.linalg.norm([0.4, 0.7, 0.6])


class Lines:
    """The polylines of a result, frame by frame."""

    def __init__(self, group):
        self.frames = group["frame"][:]
        self.seconds = group["trace_time"][:]
        self._frame_offset = group["frame_offset"][:]
        self._point_offset = group["point_offset"][:]
        self._points = group["point"][:]
        self._closed = group["closed"][:]
        self._length = group["length"][:]

    def of(self, i):
        """Polylines of entry i of `frames`, closed ones with their first point again at the end."""
        lines = []
        for k in range(self._frame_offset[i], self._frame_offset[i + 1]):
            points = self._points[self._point_offset[k] : self._point_offset[k + 1]]
            lines.append(np.vstack([points, points[:1]]) if self._closed[k] else points)
        return lines

    def length(self, i):
        return self._length[self._frame_offset[i] : self._frame_offset[i + 1]].sum()


def draw_mesh(axes, points, faces):
    # Display axes: the meshes' y is up.
    corners = points[faces][:, :, [2, 0, 1]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    shade = 0.62 + 0.36 * np.clip(normals @ LIGHT[[2, 0, 1]], 0, 1)
    axes.add_collection3d(Poly3DCollection(corners, facecolors=np.repeat(shade[:, None], 3, axis=1), rasterized=True))
    low, high = corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low, zoom=1.1)
    axes.set_axis_off()


def fixed_body(file, experiment):
    """The mesh that is drawn; curves of others would hang in the air."""
    fixed = experiment.get("fixed", [])
    if len(fixed) != 1 or experiment.get("movers") or {"instances", "deformation"} & fixed[0].keys():
        raise ResultError(f"{file}: /provenance/experiment: drawn are the curves on one fixed, rigid mesh alone (remedy: a run of one, such as "
                          "experiments/bunny-cut.json)")
    return fixed[0]


def whole_number(word):
    number = int(word)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{word} is below 1")
    return number


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("result")
    parser.add_argument("--meshes", default="meshes", help="folder of built meshes")
    parser.add_argument("--out", default="results/figures")
    parser.add_argument("--curves", type=whole_number, default=6, metavar="N", help="frames whose curves are drawn")
    arguments = parser.parse_args(argv)
    with open_h5(arguments.result) as file:
        # Each method has its own in a closed loop and under several profiles.
        own = [method["polylines"] for method in file["methods"].values() if "polylines" in method]
        if not own and "polylines" not in file:
            raise ResultError(f"{arguments.result}: no /polylines (remedy: --set /record/polylines/stride_frames=5)")
        lines = Lines(own[0] if own else file["polylines"])
        body = fixed_body(arguments.result, json.loads(text(file["provenance/experiment"][0])))
        path_time = file["path/time"][:]
        validity = json.loads(file["scene/fixed_0"].attrs["validity"])
    points, faces = read_off(os.path.join(arguments.meshes, f"{body['mesh']}.off"))
    pose = {"translation_m": [0.0, 0.0, 0.0], "rotation_xyzw": [0.0, 0.0, 0.0, 1.0], **body.get("pose", {})}
    points = prepared(points, body) @ rotation(*pose["rotation_xyzw"]).T + pose["translation_m"]
    cutting = [i for i in range(len(lines.frames)) if lines.of(i)]
    if not cutting:
        raise ResultError(f"{arguments.result}: the meshes intersect in no recorded frame (remedy: a run in which they do, such as experiments/bunny-cut.json)")

    with plt.rc_context(style.STYLE):
        figure = plt.figure(figsize=(style.TWO_COLUMNS_IN, 3.3))
        left = figure.add_axes([0.0, 0.0, 0.55, 0.93], projection="3d", computed_zorder=False)
        left.view_init(elev=42, azim=35)
        draw_mesh(left, points, faces)
        chosen = [cutting[k] for k in np.unique(np.linspace(0, len(cutting) - 1, arguments.curves).round().astype(int))]
        colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.9, len(chosen)))
        for i, colour in zip(chosen, colours):
            left.add_collection3d(Line3DCollection([line[:, [2, 0, 1]] for line in lines.of(i)], colors=[colour],
                                                   linewidths=1.3, zorder=10))
        figure.text(0.02, 0.95, f"{style.shortened(body['mesh'])}, {validity['triangles']} triangles: "
                    f"curves of {counted(len(chosen), 'frame')}", fontsize=8)
        times = path_time[lines.frames]
        top = figure.add_axes([0.64, 0.6, 0.34, 0.32])
        top.plot(times, [1e3 * lines.length(i) for i in range(len(times))], color=style.BLUE)
        for i, colour in zip(chosen, colours):
            top.plot(times[i], 1e3 * lines.length(i), "o", color=colour, markersize=3.5)
        top.set_ylabel("length of the curves [mm]")
        bottom = figure.add_axes([0.64, 0.14, 0.34, 0.32], sharex=top)
        bottom.plot(times, 1e6 * lines.seconds, ".", color=style.BLACK, markersize=2.5)
        bottom.set_ylim(0, 1.6e6 * np.quantile(lines.seconds, 0.95))  # above: another program ran
        bottom.set(ylabel="walk and chaining [us]", xlabel="time [s]")
        return style.leave(figure, arguments.out, "polylines")


if __name__ == "__main__":
    raise SystemExit(run_script(main))
