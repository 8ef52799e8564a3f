# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The 3D view's data, from the folder that `lmdbench report` leaves for each result: the meshes as they stand in the
scene (moving.off, fixed_0.off, ...) and lmds.jsonl, the exact LMD sets of some frames as `lmdbench query --json` prints
them, each with its frame. Coordinates become 16-bit integers over the mesh's box: a thousandth of a pixel."""

import base64
import json
import os

import numpy as np

LEVELS = 65535


def read_off(file):
    """(vertices (n,3), triangles (m,3)) of an OFF file that the program wrote."""
    with open(file, encoding="ascii") as stream:
        words = stream.read().split()
    vertex_count, triangle_count = int(words[1]), int(words[2])
    start = 4
    end = start + 3 * vertex_count
    vertices = np.array(words[start:end], dtype=float).reshape(-1, 3)
    faces = np.array(words[end:end + 4 * triangle_count], dtype=np.int64).reshape(-1, 4)
    return vertices, faces[:, 1:]


def packed(values, kind):
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")


def mesh_json(vertices, triangles):
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    size = np.where(high > low, high - low, 1.0)
    return {"low": low.tolist(), "size": size.tolist(),
            "vertices": packed(np.round((vertices - low) / size * LEVELS), "<u2"),
            "triangles": packed(triangles, "<u4" if len(vertices) > LEVELS else "<u2"), "wide": len(vertices) > LEVELS}


def frame_json(line, result):
    """One frame of the slider: pose, LMDs and each method's force at that frame."""
    entry = json.loads(line)
    frame = entry["frame"]
    return {"frame": frame, "time": float(result.time[frame]),
            "position": result.read("/path/position")[frame].tolist(),
            "orientation": result.read("/path/orientation")[frame].tolist(),
            "lmds": [[*lmd["point_moving"], *lmd["point_fixed"], lmd["distance"]] for lmd in entry["lmds"]],
            "forces": {method.label: method.read("force")[frame].tolist() for method in result.methods.values()}}


def rounded(value):
    """Six significant digits: a micrometre in a metre, and half the size of the page."""
    if isinstance(value, float):
        return float(f"{value:.6g}")
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, list):
        return [rounded(item) for item in value]
    return value


def scene(result, folder):
    """The 3D view of a result, or what is missing for it: {"problem": text}."""
    if not folder:
        return {"name": result.name, "problem": "No view: the page was made without the program, which finds the meshes."}
    problem = os.path.join(folder, "problem.txt")
    if os.path.exists(problem):
        with open(problem, encoding="utf-8") as stream:
            return {"name": result.name, "problem": stream.read().strip()}
    meshes, same = [], {}
    for role in sorted(name[:-4] for name in os.listdir(folder) if name.endswith(".off")):
        vertices, triangles = read_off(os.path.join(folder, role + ".off"))
        meshes.append({"role": role, **mesh_json(vertices, triangles)})
        # Two bodies of one mesh share what they have in common.
        twin = same.setdefault(meshes[-1]["triangles"], role)
        if twin != role:
            meshes[-1]["triangles"] = None
            meshes[-1]["triangles_of"] = twin
    with open(os.path.join(folder, "lmds.jsonl"), encoding="utf-8") as stream:
        frames = [frame_json(line, result) for line in stream if line.strip()]
    return rounded({"name": result.name, "meshes": meshes, "frames": frames,
                    "cutoff": result.scene("cutoff_m"), "maximum_force": result.maximum_force(),
                    "methods": list(result.methods)})
