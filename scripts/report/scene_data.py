# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The 3D view's data: from the folder that `lmdbench report` leaves for each result the meshes as they stand in the scene
(moving.off, fixed_0.off, ...), of those that deform their vertices in each frame (moving.shapes), and lmds.jsonl, the exact LMD sets of some frames; from the result itself the methods' own sets
where the run recorded them, forces and intersection polylines. Coordinates of meshes become 16-bit integers over the mesh's
box, a thousandth of a pixel; everything else is single precision."""

import json
import os

import numpy as np

from mesh_drawing import read_off
from page_data import encoded as packed

LEVELS = 65535


def mesh_json(vertices, triangles, shapes=None):
    """Vertices are those of the mesh, or of one frame after the other."""
    places = vertices if shapes is None else shapes
    low, high = places.min(axis=0), places.max(axis=0)
    size = np.where(high > low, high - low, 1.0)
    return {"low": low.tolist(), "size": size.tolist(), "count": len(vertices),
            "vertices": packed(np.round((places - low) / size * LEVELS), "<u2"),
            "triangles": packed(triangles, "<u4" if len(vertices) > LEVELS else "<u2"), "wide": len(vertices) > LEVELS}


def sets_json(sets):
    """A set a frame, each (n, 7): point on the moving mesh, point on the fixed mesh, distance."""
    rows = [np.reshape(np.asarray(found, dtype=float), (-1, 7)) for found in sets]
    return {"offset": np.concatenate([[0], np.cumsum([len(found) for found in rows])]).tolist(), "rows": packed(np.concatenate(rows))}


def recorded_sets(method, frames):
    """The method's own LMDs at the frames, or None where the run did not record them."""
    if not method.has("lmds/frame_offset"):
        return None
    offset = method.read("lmds/frame_offset").astype(int)
    rows = np.column_stack([method.read("lmds/point_moving"), method.read("lmds/point_fixed"), method.read("lmds/distance")])
    return sets_json([rows[offset[frame]:offset[frame + 1]] for frame in frames])


def polylines_json(result, group, frames):
    """Curves a frame: a list of (closed, points); None where the run did not record them."""
    if not result.has(f"{group}/frame"):
        return None
    recorded = {int(frame): i for i, frame in enumerate(result.read(f"{group}/frame"))}
    lines, ends = result.read(f"{group}/frame_offset").astype(int), result.read(f"{group}/point_offset").astype(int)
    closed, points = result.read(f"{group}/closed"), result.read(f"{group}/point")
    return [[[int(closed[line]), packed(points[ends[line]:ends[line + 1]])] for line in range(lines[recorded[frame]], lines[recorded[frame] + 1])]
            if frame in recorded else [] for frame in frames]


def movers_json(result, frames):
    """What moves beside the moving mesh: the role of its mesh, and where it is at the frames."""
    if not result.has("/path/movers/position"):
        return []
    position, orientation = (result.read(f"/path/movers/{name}")[frames] for name in ("position", "orientation"))
    entries = [group.attrs for role, group in sorted(result.h5["/scene"].items(), key=lambda item: (len(item[0]), item[0])) if role.startswith("mover_")]
    return [{"role": f"mover_{entry}", "position": packed(position[:, mover]), "orientation": packed(orientation[:, mover])}
            for entry, attributes in enumerate(entries)
            for mover in range(attributes["first_mover"], attributes["first_mover"] + attributes["movers"])]


def track_json(result, label, entries):
    """What one slider steps through: the shared path, or in a closed loop the poses of one method's device."""
    frames = [entry["frame"] for entry in entries]
    group = f"/methods/{label}" if label else ""
    methods = [result.methods[label]] if label else list(result.methods.values())
    # Several profiles on one path share the curves at equal poses.
    curves = next((name for name in (f"{group}/polylines", *(f"/methods/{method.label}/polylines" for method in methods)) if result.has(name)), "/polylines")
    own = {method.label: recorded_sets(method, frames) for method in methods}
    return {"label": label, "frames": frames, "time": packed(result.time[frames]),
            "position": packed(result.read(f"{group}/path/position")[frames]), "orientation": packed(result.read(f"{group}/path/orientation")[frames]),
            "exact": sets_json([[[*lmd["point_moving"], *lmd["point_fixed"], lmd["distance"]] for lmd in entry["lmds"]] for entry in entries]),
            "movers": movers_json(result, frames),
            "own": {name: sets for name, sets in own.items() if sets}, "polylines": polylines_json(result, curves, frames),
            "forces": {method.label: packed(method.read("force")[frames]) for method in methods}}


def upright(result):
    """Which way is up, and from where one looks when nothing else says it: drawn parts, which come as files, stand on z, scans on y."""
    part = any(sign in result.text_attribute("/scene/moving", "mesh", "") for sign in "/.")
    return {"up": [0, 0, 1], "front": [0, -1, 0]} if part else {"up": [0, 1, 0], "front": [0, 0, 1]}


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
        shapes = os.path.join(folder, role + ".shapes")
        places = np.fromfile(shapes, "<f4").reshape(-1, 3).astype(float) if os.path.exists(shapes) else None
        meshes.append({"role": role, **mesh_json(vertices, triangles, places)})
        # Two bodies of one mesh share its data.
        twin = same.setdefault(meshes[-1]["triangles"], role)
        if twin != role:
            meshes[-1]["triangles"] = None
            meshes[-1]["triangles_of"] = twin
    tracks = {}
    with open(os.path.join(folder, "lmds.jsonl"), encoding="utf-8") as stream:
        for entry in (json.loads(line) for line in stream if line.strip()):
            tracks.setdefault(entry.get("track", ""), []).append(entry)
    return {"name": result.name, **upright(result), "meshes": meshes, "tracks": [track_json(result, *track) for track in tracks.items()],
            "maximum_force": max(method.constant("maximum_force_n") for method in result.methods.values())}
