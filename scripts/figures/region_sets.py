# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Regions of the claims on what is found: K10 to K12; their rules stand in claim_rules.py."""

import math
import os

import numpy as np

from lmdbench_results import median, quantile, text
from polylines import Lines
from mesh_drawing import placed, read_off, rotation
from region_rules import FAILS, HOLDS, mean_edges, mesh, tolerance, usable
from tables import shown

DENSE = ("bunny-hard",)
UNEVEN = ("extreme-unequal", "extreme-needles")
OPEN_MESHES = ("extreme-holes", "extreme-fins")


def is_fresh(point):
    return point.experiment["driver"]["search_latency_frames"] == 0


COLUMNS = {
    "scene": lambda point: point.scene,
    "meshes": mesh,
    "cutoff [mean edges]": lambda point: mean_edges(point) if "bunny" in mesh(point) else "-",
    "series": lambda point: point.series,
    "sets": lambda point: "fresh" if is_fresh(point) else "aged",
    "G5 [deg]": lambda point: f"{tolerance(point):.0f}" if tolerance(point) is not None else "-",
    "missed, same features [%]": lambda point: shown(100 * (1 - point.number("recall"))),
    "missed, neighbours count [%]": lambda point: shown(100 * (1 - point.number("recall_adjacent"))),
    "precision [%]": lambda point: shown(100 * point.number("precision")),
    "force error, RMS [% of F_max]": lambda point: shown(100 * point.force_error),
}


def columns_of(point):
    return {name: column(point) for name, column in COLUMNS.items()}


def k10(found, *sweeps):
    for point in (point for sweep in sweeps for point in usable(sweep.points) if point.scene in DENSE + UNEVEN):
        missed, dense, cell, row = 1 - point.number("recall_adjacent"), point.scene in DENSE, "", columns_of(point)
        kind = "dense" if dense else "large or unequal triangles"
        name = f"{kind}, {mesh(point)} | {row['sets']} sets, G5 {row['G5 [deg]']} deg" if point.series == "original" and math.isfinite(missed) else None
        if name is not None:
            cell = HOLDS if (missed <= 0.05 if dense else missed >= 0.10) else FAILS
        found.add({**row, "K10": cell}, name, cell)


def k11(found, *sweeps):
    for point in (point for sweep in sweeps for point in sweep.points):
        if not point.series.startswith("improved") or point.scene in DENSE:
            continue
        if point.failure:
            row = {**dict.fromkeys(COLUMNS, "-"), "scene": point.scene, "series": point.series, "force error, RMS [% of F_max]": point.failure}
            found.add({**row, "K11": FAILS}, f"{point.scene} | {point.series}", FAILS)
            continue
        cell, kind = "", "open meshes" if point.scene in OPEN_MESHES else "closed meshes"
        if is_fresh(point):
            cell = HOLDS if point.number("recall") >= 0.95 and point.number("precision") >= 0.95 else FAILS
        found.add({**columns_of(point), "K11": cell}, f"{kind}, {point.scene} | {point.series}" if is_fresh(point) else None, cell)


def distance_to_triangles(point, corners):
    """Least distance of a point from triangles (T, 3, 3)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    area = np.einsum("ij,ij->i", normal, normal)
    best = np.full(len(corners), np.inf)
    for p, q in ((a, b), (b, c), (c, a)):
        along = np.clip(np.einsum("ij,ij->i", point - p, q - p) / np.maximum(np.einsum("ij,ij->i", q - p, q - p), 1e-300), 0, 1)
        best = np.minimum(best, np.linalg.norm(p + along[:, None] * (q - p) - point, axis=1))
    flat = np.abs(np.einsum("ij,ij->i", point - a, normal)) / np.sqrt(np.maximum(area, 1e-300))
    inside = np.ones(len(corners), dtype=bool)
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= np.einsum("ij,ij->i", np.cross(q - p, point - p), normal) >= 0
    return float(np.min(np.where(inside & (area > 0), np.minimum(flat, best), best)))


def rotated_back(quaternion, vector):
    """By the inverse of a unit quaternion x, y, z, w."""
    return vector @ rotation(*quaternion)


def body(result, name, meshes):
    scene = result.h5[f"scene/{name}"].attrs
    mesh_name = text(scene["mesh"])
    points, faces = read_off(os.path.join(meshes, f"{mesh_name}.off"))
    points = placed(points, scene["diagonal_m"])
    return mesh_name, points[faces], float(scene["diagonal_m"])


def k12(found, *results, meshes="meshes"):
    """Of runs of `improved` with /polylines on closed meshes."""
    for result in results:
        curves(found, result, meshes)


def curves(found, result, meshes):
    lines = Lines(result.h5["polylines"])
    fixed_name, fixed, diagonal = body(result, "fixed_0", meshes)
    moving_name, moving, _ = body(result, "moving", meshes)
    cutting = [i for i in range(len(lines.frames)) if lines.of(i)]
    position, orientation = result.read("/path/position"), result.read("/path/orientation")
    closed, times = result.read("/polylines/closed"), result.read("/polylines/trace_time")
    # A segment of a curve is a pair of triangles that cross.
    crossing = np.array([sum(len(line) - 1 for line in lines.of(i)) for i in cutting])
    search = result.method("improved")
    candidates = dict(zip(search.read("global_frame").astype(int), search.read("candidates").astype(int)))
    known = np.array([candidates[lines.frames[i]] for i in cutting])
    worst, looked = 0.0, 0
    for i in cutting[:: max(1, len(cutting) // 8)]:
        frame = lines.frames[i]
        for point in (point for line in lines.of(i) for point in line):
            looked += 1
            in_moving = rotated_back(orientation[frame], point - position[frame])
            worst = max(worst, distance_to_triangles(point, fixed), distance_to_triangles(in_moving, moving))
    share = float(np.mean(closed)) if len(closed) else math.nan
    off = worst / diagonal
    name = f"{moving_name} into {fixed_name}"
    cell = HOLDS if len(cutting) and share == 1.0 and off <= 1e-9 and np.array_equal(known, crossing) else FAILS
    found.add({"scene": name, "frames that intersect": len(cutting), "pairs that cross": int(crossing.sum()), "found by the search": int(known.sum()),
               "frames with all": int(np.sum(known == crossing)), "curves": len(closed), "closed [%]": shown(100 * share), "points checked": looked,
               "largest distance from a surface [diagonals]": f"{off:.1e}", "tracing, median [us]": shown(1e6 * median(times)),
               "99 %": shown(1e6 * quantile(times, 0.99)), "largest": shown(1e6 * float(np.max(times))), "K12": cell}, name, cell)
