# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every recipe of results/examples runs on a result and prints what it says; README names them all."""

import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..")]

import h5py  # noqa: E402
import numpy as np  # noqa: E402

from synthetic import write_result  # noqa: E402
from test_sweep import ROWS, write_sweep  # noqa: E402

EXAMPLES = os.path.join(HERE, "..", "..", "..", "results", "examples")


def add_lmds(file):
    """Two LMDs in every frame, the nearer one 1 mm, in frame 7 half of that."""
    with h5py.File(file, "a") as h5:
        for method in h5["methods"].values():
            frames = method["force"].shape[0]
            distance = np.tile([0.001, 0.002], frames)
            distance[14] = 0.0005
            for name in ("minimum_distance", "lmds"):
                if name in method:
                    del method[name]
            method["minimum_distance"] = distance[::2]
            method["lmds/frame_offset"] = np.arange(0, 2 * frames + 1, 2)
            method["lmds/distance"] = distance
            method["lmds/point_fixed"] = np.zeros((2 * frames, 3))


def add_curves_and_inputs(file):
    """One closed curve of 3 mm in frame 0, two open ones of 1 mm in frame 5; a mesh file."""
    with h5py.File(file, "a") as h5:
        h5["polylines/frame"], h5["polylines/frame_offset"] = [0, 5], [0, 1, 3]
        h5["polylines/length"], h5["polylines/closed"] = [0.003, 0.001, 0.001], np.array([1, 0, 0], dtype="u1")
        h5["provenance"].attrs["git_commit"] = "0123abcd"
        for name, text in (("role", "mesh:a"), ("file", "a.off"), ("sha256", "feed")):
            h5[f"provenance/inputs/{name}"] = [text]
        for method in h5["methods"].values():
            method.attrs["result_hash"] = "beef"


class Examples(unittest.TestCase):
    EXPECTED = {"two_runs.py": "improved frames_late [1]: ", "polylines.py": "0.005 s: 2 curves, 2 mm, 0 closed",
                "provenance.py": "mesh:a: a.off, SHA-256 feed\n",
                "forces.py": "original: mean", "worst_frames.py": " N at ", "lmds_of_a_frame.py": "original, frame 7:\n  0.5000 mm",
                "times.py": "improved: median", "front.py": "hard: certified {}: 30 ms/s, 0 % of F_max"}

    def test_each_prints_its_answer(self):
        with tempfile.TemporaryDirectory() as folder:
            run, sweep = os.path.join(folder, "run.h5"), os.path.join(folder, "sweep.h5")
            write_result(run)
            add_lmds(run)
            add_curves_and_inputs(run)
            write_sweep(sweep, [{**row, "on_front": float(row["series"] == "certified")} for row in ROWS])
            for name, expected in self.EXPECTED.items():
                files = {"front.py": [sweep], "two_runs.py": [run, run]}.get(name, [run])
                outcome = subprocess.run([sys.executable, os.path.join(EXAMPLES, name), *files],
                                         capture_output=True, text=True, check=False)
                self.assertEqual(outcome.returncode, 0, outcome.stderr)
                self.assertIn(expected, outcome.stdout, name)

    def test_readme_names_every_recipe_and_each_is_short(self):
        with open(os.path.join(EXAMPLES, "README.md"), encoding="utf-8") as stream:
            readme = stream.read()
        recipes = sorted(name for name in os.listdir(EXAMPLES) if name.endswith(".py"))
        self.assertEqual(recipes, sorted(self.EXPECTED))
        for name in recipes:
            self.assertIn(f"`{name}`", readme)
            with open(os.path.join(EXAMPLES, name), encoding="utf-8") as stream:
                lines = [line for line in stream if line.strip() and not line.startswith(("#", "import"))]
            self.assertLessEqual(len(lines), 10, name)


if __name__ == "__main__":
    unittest.main()
