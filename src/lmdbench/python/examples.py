# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples of the Python module, cell by cell (`# %%`, as Jupyter and editors read them). Needs no files."""

# %% Two boxes from arrays
import os
import subprocess
import tempfile

import lmdbench
import numpy as np

corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
sides = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                  [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
box = lmdbench.Mesh(corners, sides)
print("findings:", box.findings or "none")

# %% Poses: one box stands on its corner over the other and comes down
angle = np.arctan(np.sqrt(2))
axis = np.array([1.0, -1.0, 0.0]) / np.sqrt(2)
cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
poses = np.tile(np.eye(4), (50, 1, 1))
poses[:, :3, :3] = turn
poses[:, :3, 3] = np.array([0.6, 0.3, 1.0]) - turn @ corners[np.argmin((corners @ turn.T)[:, 2])]
poses[:, 2, 3] += np.linspace(0.1, 0.01, 50)

# %% All LMD sets in one call; each is a structured array
sets = lmdbench.query(box, box, poses, cutoff=0.05)
last = sets[-1]
print("LMDs of the last pose:", last.size, "at", last["distance"], "m")
kinds = [(lmdbench.FeatureKind(lmd["feature_moving"]["kind"]).name, lmdbench.FeatureKind(lmd["feature_fixed"]["kind"]).name)
         for lmd in last]
print("features:", kinds)
assert kinds == [("VERTEX", "FACE")] and np.isclose(last["distance"][0], 0.01)
assert np.array_equal(sets.counts, poses[:, 2, 3] - poses[-1, 2, 3] + 0.01 <= 0.05)

# %% Forces
pushes = lmdbench.forces(sets, cutoff=0.05, maximum_force=3.0, law="linear")
print("force of the last pose:", pushes.force[-1], "N")
assert np.allclose(pushes.force[-1], [0.0, 0.0, 3.0 * 0.8])

# %% Another method against the truth
true_sets = lmdbench.truth(box, box, poses, cutoff=0.05)
for method in lmdbench.method_names():
    found = lmdbench.query(box, box, poses, cutoff=0.05, method=method)
    agreement = lmdbench.agreement(true_sets, found)
    print(f"{method}: recall {agreement.recall:.2f}, precision {agreement.precision:.2f}, "
          f"median {np.median(found.seconds) * 1e6:.0f} us")
assert lmdbench.agreement(true_sets, sets).recall == 1.0

# %% Errors say what to do
try:
    lmdbench.query(box, box, poses, cutoff=0.05, method="certifed")
except lmdbench.UsageError as error:
    print("error:", error)

# %% Results of the program as pandas frames
program = os.environ.get("LMDBENCH_PROGRAM", "lmdbench")
experiment = os.environ.get("LMDBENCH_EXPERIMENT", "/usr/share/lmdbench/experiments/shapes.json")
with tempfile.TemporaryDirectory() as folder:
    result_file = os.path.join(folder, "shapes.h5")
    subprocess.run([program, "--quiet", "run", experiment, "--out", result_file, "--set", "/frames=60"], check=True,
                   stdout=subprocess.DEVNULL)
    result = lmdbench.open_result(result_file)
    frames = result.frames("improved")
    print(frames[["time", "force_x", "lmd_count", "minimum_distance"]].tail(3))
    print(result.summary()[["recall", "lmd_count_median"]])
    assert frames.attrs["units"]["force_x"] == "N" and len(frames) == 60
