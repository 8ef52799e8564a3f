#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a call from Python costs beside the searches that it asks for: 1,000 poses of a recorded path in one call, the time of the
call over the sum of the times of its searches, as C++ took them. Argument: the folder that holds the module, the mesh, the path."""

import sys
import time

sys.path.insert(0, sys.argv[1])

import lmdbench  # noqa: E402
import numpy as np  # noqa: E402

CALLS, POSES, FIRST_POSE = 15, 1000, 500
CUTOFF_DIAGONALS = 0.02


def main():
    mesh = lmdbench.Mesh(sys.argv[2])
    vertices = np.array(mesh.vertices)
    diagonal = np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0))
    mesh = lmdbench.Mesh((vertices - (vertices.max(axis=0) + vertices.min(axis=0)) / 2) / diagonal * 0.15, np.array(mesh.triangles))
    poses = lmdbench.read_tum(sys.argv[3])[1][FIRST_POSE:FIRST_POSE + POSES]
    assert len(poses) == POSES
    search = lmdbench.Search(mesh, mesh, CUTOFF_DIAGONALS * 0.15)
    ratios, milliseconds, lmds = [], [], 0
    for _ in range(CALLS):
        begin = time.perf_counter()
        sets = search(poses)
        lmds = sum(part.size for part in sets)  # so every set is an array in use
        took = time.perf_counter() - begin
        ratios.append(took / sets.seconds.sum())
        milliseconds.append(1e3 * took)
    low, median, high = np.quantile(ratios, [0.25, 0.5, 0.75])
    print(f"{POSES} poses, {lmds} LMDs, {CALLS} calls of {np.median(milliseconds):.1f} ms: call / searches {median:.4f} "
          f"(quartiles {low:.4f}, {high:.4f})")


if __name__ == "__main__":
    main()
