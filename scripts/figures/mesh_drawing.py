# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes, spheres and cones as flat pictures: parallel projection, painter's algorithm. A view is (3, 3): rows right, up,
towards the reader."""

import numpy as np

import figure_style  # noqa: F401  (first: it chooses the backend)
from lmdbench_results import ResultError, in_short

from matplotlib.collections import PolyCollection
from matplotlib.patches import Circle, PathPatch
from matplotlib.path import Path

LIGHT = np.array([0.35, 0.45, 0.82])
MOVING, FIXED = np.array([0.68, 0.80, 0.92]), np.array([0.94, 0.86, 0.70])
PLAIN = np.array([0.88, 0.88, 0.88])
# Side by side patches of one level: pale, so that drawings over them stand out.
PATCHES = np.array([[0.65, 0.81, 0.89], [0.99, 0.80, 0.60], [0.70, 0.87, 0.64], [0.92, 0.70, 0.78], [0.99, 0.95, 0.62], [0.79, 0.74, 0.86]])
RIM = np.linspace(0.0, 2.0 * np.pi, 73)


def read_off(file):
    """(V, 3) vertices and (T, 3) triangles of an OFF file."""
    try:
        with open(file, encoding="ascii") as stream:
            words = [word for line in stream for word in line.split("#")[0].split()]
        vertices, triangles = int(words[1]), int(words[2])
        points = np.array(words[4:4 + 3 * vertices], dtype=float).reshape(vertices, 3)
        return points, np.array(words[4 + 3 * vertices:], dtype=int).reshape(triangles, 4)[:, 1:]
    except OSError as error:
        raise ResultError(f"{error} (remedy: lmdbench mesh build)")
    except (ValueError, IndexError) as error:
        raise ResultError(f"{file}: is no OFF file of triangles: {in_short(error)} (remedy: lmdbench mesh build, or such a file)")


def placed(points, diagonal):
    """Centre of the bounding box at the origin, its diagonal as long as the experiment says."""
    return prepared(points, {"diagonal_m": diagonal})


def prepared(points, body):
    """Of a mesh what its entry of the experiment makes of it, in its own frame."""
    low, high = points.min(axis=0), points.max(axis=0)
    scale = body["diagonal_m"] / np.linalg.norm(high - low) if "diagonal_m" in body else body.get("scale", 1.0)
    return (points - (0.5 * (low + high) if body.get("centre", "diagonal_m" in body) else 0.0)) * scale


def rotation(x, y, z, w):
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def unit(vector):
    return vector / np.linalg.norm(vector)


def view_towards(direction):
    """Looks square at a direction, which runs to the right."""
    right = unit(direction)
    up = np.array([0.0, 1.0, 0.0]) - right[1] * right
    up = unit(up) if np.linalg.norm(up) > 1e-6 else np.array([0.0, 0.0, 1.0])
    return np.array([right, up, np.cross(right, up)])


def view_onto(normal, tilt_deg=0.0):
    """Looks down on a surface whose normal comes towards the reader, tilted away by an angle: at 90 it points up."""
    towards = unit(normal)
    right = np.cross([0.0, 1.0, 0.0], towards)
    right = unit(right) if np.linalg.norm(right) > 1e-6 else np.array([1.0, 0.0, 0.0])
    up = np.cross(towards, right)
    c, s = np.cos(np.radians(tilt_deg)), np.sin(np.radians(tilt_deg))
    return np.array([right, c * up + s * towards, c * towards - s * up])


def draw_triangles(axes, corners, view, colours, edge="none", width=0.15, zorder=1, rasterized=True, behind=False):
    """(n, 3, 3) corners, farthest first; those that face away are left out unless `behind`."""
    seen = corners @ view.T
    normals = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
    length = np.linalg.norm(normals, axis=1)
    shown = (length > 0) & ((normals[:, 2] > 0) | behind)
    shade = 0.45 + 0.55 * np.clip(np.abs(normals[shown] / length[shown, None]) @ LIGHT, 0, 1)
    filled = np.clip(np.broadcast_to(colours, (len(corners), 3))[shown] * shade[:, None], 0, 1)
    order = np.argsort(seen[shown][:, :, 2].mean(axis=1), kind="stable")
    axes.add_collection(PolyCollection(seen[shown][order][:, :, :2], facecolors=filled[order], edgecolors=edge, linewidths=width,
                                       rasterized=rasterized, zorder=zorder))


def draw_sphere(axes, centre, radius, view, colour, **options):
    """The outline of a sphere, which in parallel projection is a circle."""
    axes.add_patch(Circle((view @ centre)[:2], radius, fill=False, edgecolor=colour, **options))


def cone_rim(apex, axis, half_angle, length):
    """(73, 3) points at a slant length from the apex."""
    side = unit(np.cross(axis, [1.0, 0.0, 0.0] if abs(axis[0]) < 0.9 else [0.0, 1.0, 0.0]))
    other = np.cross(axis, side)
    return apex + length * (np.cos(half_angle) * axis + np.sin(half_angle) * (np.outer(np.cos(RIM), side) + np.outer(np.sin(RIM), other)))


def draw_cone(axes, apex, axis, half_angle, length, view, colour, zorder=4):
    """A cone of directions, narrower than all of them."""
    rim = cone_rim(apex, axis, half_angle, length) @ view.T
    tip = view @ apex
    sides = np.stack([np.broadcast_to(tip, (len(rim) - 1, 3)), rim[:-1], rim[1:]], axis=1)[:, :, :2]
    # One path of equally oriented triangles: filled as their union, without seams.
    a, b = sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0]
    turned = a[:, 0] * b[:, 1] < a[:, 1] * b[:, 0]
    sides[turned] = sides[turned][:, ::-1]
    path = Path.make_compound_path(*(Path(np.vstack([side, side[:1]]), closed=True) for side in sides))
    axes.add_patch(PathPatch(path, facecolor=colour, edgecolor="none", alpha=0.22, zorder=zorder))
    axes.plot(rim[:, 0], rim[:, 1], color=colour, lw=0.7, zorder=zorder + 0.1)
    end = view @ (apex + length * axis)
    axes.plot([tip[0], end[0]], [tip[1], end[1]], color=colour, lw=1.1, zorder=zorder + 0.2)


def frame(axes, low, high, margin=0.06):
    """Limits round a box, equal scales, no axes."""
    middle, half = 0.5 * (low + high), (0.5 + margin) * np.max(high - low)
    axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half), aspect="equal")
    axes.axis("off")
