# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The 3D view's data: from the folder that `lmdbench report` leaves for each result the meshes as they stand in the scene
(moving.off, fixed_0.off, ...), of those that deform their vertices in each frame (moving.shapes), and lmds.jsonl, the exact LMD sets of some frames; from the result itself the methods' own sets
where the run recorded them, forces and intersection polylines. Coordinates of meshes become 16-bit integers over the mesh's
box, a thousandth of a pixel; everything else is single precision, so it is told from the middle of the moving mesh in its first frame (`origin`),
and of meshes that move from their own middle: a scene may be anywhere."""

import json
import os

import numpy as np

from jumps import turned
from mesh_drawing import read_off
from page_data import encoded as packed

LEVELS = 65535
SAME_SHARE = 1e-6  # of its radius: places far from the origin are rounded


def mesh_json(places, triangles, count):
    """Places of the vertices: those of the mesh, or of one frame after the other."""
    low, high = places.min(axis=0), places.max(axis=0)
    size = np.where(high > low, high - low, 1.0)
    return {"low": low.tolist(), "size": size.tolist(), "count": count,
            "vertices": packed(np.round((places - low) / size * LEVELS), "<u2"),
            "triangles": packed(triangles, "<u4" if count > LEVELS else "<u2"), "wide": count > LEVELS}


def sets_json(sets, origin):
    """A set a frame, each (n, 7): point on the moving mesh, point on the fixed mesh, distance."""
    rows = [np.reshape(np.asarray(found, dtype=float), (-1, 7)) - [*origin, *origin, 0.0] for found in sets]
    return {"offset": np.concatenate([[0], np.cumsum([len(found) for found in rows])]).tolist(), "rows": packed(np.concatenate(rows))}


def recorded_sets(method, frames, origin):
    """The method's own LMDs at the frames, or None where the run did not record them."""
    if not method.has("lmds/frame_offset"):
        return None
    offset = method.read("lmds/frame_offset").astype(int)
    rows = np.column_stack([method.read("lmds/point_moving"), method.read("lmds/point_fixed"), method.read("lmds/distance")])
    return sets_json([rows[offset[frame]:offset[frame + 1]] for frame in frames], origin)


def polylines_json(result, group, frames, origin):
    """Curves a frame: a list of (closed, points); None where the run did not record them."""
    if not result.has(f"{group}/frame"):
        return None
    recorded = {int(frame): i for i, frame in enumerate(result.read(f"{group}/frame"))}
    lines, ends = result.read(f"{group}/frame_offset").astype(int), result.read(f"{group}/point_offset").astype(int)
    closed, points = result.read(f"{group}/closed"), result.read(f"{group}/point")
    return [[[int(closed[line]), packed(points[ends[line]:ends[line + 1]] - origin)] for line in range(lines[recorded[frame]], lines[recorded[frame] + 1])]
            if frame in recorded else [] for frame in frames]


def poses_json(position, orientation, middle, origin):
    """Of a mesh with this middle."""
    return {"position": packed(position + turned(middle, orientation) - origin), "orientation": packed(orientation)}


def movers_json(result, frames, middles, origin):
    """What moves beside the moving mesh: the role of its mesh, and where it is at the frames."""
    if not result.has("/path/movers/position"):
        return []
    position, orientation = (result.read(f"/path/movers/{name}")[frames] for name in ("position", "orientation"))
    entries = [group.attrs for role, group in sorted(result.h5["/scene"].items(), key=lambda item: (len(item[0]), item[0])) if role.startswith("mover_")]
    return [{"role": f"mover_{entry}", **poses_json(position[:, mover], orientation[:, mover], middles[f"mover_{entry}"], origin)}
            for entry, attributes in enumerate(entries)
            for mover in range(attributes["first_mover"], attributes["first_mover"] + attributes["movers"])]


def track_json(result, label, entries, middles, origin):
    """What one slider steps through: the shared path, or in a closed loop the poses of one method's device."""
    frames = [entry["frame"] for entry in entries]
    group = f"/methods/{label}" if label else ""
    methods = [result.methods[label]] if label else list(result.methods.values())
    # Several profiles on one path share the curves at equal poses.
    curves = next((name for name in (f"{group}/polylines", *(f"/methods/{method.label}/polylines" for method in methods)) if result.has(name)), "/polylines")
    own = {method.label: recorded_sets(method, frames, origin) for method in methods}
    return {"label": label, "frames": frames, "time": packed(result.time[frames], "<f8"),
            **poses_json(*(result.read(f"{group}/path/{name}")[frames] for name in ("position", "orientation")), middles["moving"], origin),
            "exact": sets_json([[[*lmd["point_moving"], *lmd["point_fixed"], lmd["distance"]] for lmd in entry["lmds"]] for entry in entries], origin),
            "movers": movers_json(result, frames, middles, origin),
            "own": {name: sets for name, sets in own.items() if sets}, "polylines": polylines_json(result, curves, frames, origin),
            "forces": {method.label: packed(method.read("force")[frames]) for method in methods}}


def upright(result):
    """Which way is up, and from where one looks when nothing else says it: drawn parts, which come as files, stand on z, scans on y."""
    part = any(sign in result.text_attribute("/scene/moving", "mesh", "") for sign in "/.")
    return {"up": [0, 0, 1], "front": [0, -1, 0]} if part else {"up": [0, 1, 0], "front": [0, 0, 1]}


def body_of(folder, role):
    """Places of its vertices (if it deforms of one frame after the other), its triangles, and how many vertices it has."""
    vertices, triangles = read_off(os.path.join(folder, role + ".off"))
    shapes = os.path.join(folder, role + ".shapes")
    return np.fromfile(shapes, "<f4").reshape(-1, 3).astype(float) if os.path.exists(shapes) else vertices, triangles, len(vertices)


def middle_of(places):
    return 0.5 * (places.min(axis=0) + places.max(axis=0))


def is_same(body, other):
    """Whether two are one mesh, which may stand at several places: its vertices are as far from their centroid."""
    (places, triangles, count), (others, their, their_count) = body, other
    if count != their_count or not np.array_equal(triangles, their):
        return False
    way, others_way = (np.linalg.norm(points[:count] - points[:count].mean(axis=0), axis=1) for points in (places, others))
    return np.allclose(way, others_way, rtol=0.0, atol=SAME_SHARE * way.max())


def meshes_json(bodies, middles, origin):
    """Bodies of one mesh share its triangles."""
    meshes, kinds = [], []
    for role, body in bodies.items():
        places, triangles, count = body
        meshes.append({"role": role, **mesh_json(places - (origin if role.startswith("fixed_") else middles[role]), triangles, count)})
        twin = next((kind for kind in kinds if is_same(body, bodies[kind])), None)
        if twin:
            meshes[-1].update(triangles=None, triangles_of=twin)
        else:
            kinds.append(role)
    return meshes


def scene(result, folder):
    """The 3D view of a result, or what is missing for it: {"problem": text}."""
    if not folder:
        return {"name": result.name, "problem": "No view: the page was made without the program, which finds the meshes."}
    problem = os.path.join(folder, "problem.txt")
    if os.path.exists(problem):
        with open(problem, encoding="utf-8") as stream:
            return {"name": result.name, "problem": stream.read().strip()}
    tracks = {}
    with open(os.path.join(folder, "lmds.jsonl"), encoding="utf-8") as stream:
        for entry in (json.loads(line) for line in stream if line.strip()):
            tracks.setdefault(entry.get("track", ""), []).append(entry)
    bodies = {role: body_of(folder, role) for role in sorted(name[:-4] for name in os.listdir(folder) if name.endswith(".off"))}
    middles = {role: middle_of(places) for role, (places, _, _) in bodies.items()}
    label, entries = next(iter(tracks.items()))
    first = entries[0]["frame"]
    group = f"/methods/{label}/path" if label else "/path"
    origin = (result.read(f"{group}/position")[first] + turned(middles["moving"], result.read(f"{group}/orientation")[[first]]))[0]
    return {"name": result.name, **upright(result), "origin": origin.tolist(), "meshes": meshes_json(bodies, middles, origin),
            "tracks": [track_json(result, *track, middles, origin) for track in tracks.items()]}
