# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every recipe of results/examples runs on a result and prints what it says; README names them all."""

import sys

import h5py
import numpy as np

from cases import ROOT, Scratch, call, text_of
from synthetic import write_result
from test_sweep import ROWS, write_sweep

EXAMPLES = ROOT / "results" / "examples"


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


class Examples(Scratch):
    EXPECTED = {"two_runs.py": "improved frames_late [1]: ", "polylines.py": "0.005 s: 2 curves, 2 mm, 0 closed",
                "provenance.py": "mesh:a: a.off, SHA-256 feed\n",
                "forces.py": "original: mean", "worst_frames.py": " N at ", "lmds_of_a_frame.py": "original, frame 7:\n  0.5000 mm",
                "times.py": "improved: median", "front.py": "hard: certified {}: 30 ms/s, 0 % of F_max"}

    def test_each_prints_its_answer(self):
        run, sweep = self.path("run.h5"), self.path("sweep.h5")
        write_result(run)
        add_lmds(run)
        add_curves_and_inputs(run)
        write_sweep(sweep, [{**row, "on_front": float(row["series"] == "certified")} for row in ROWS])
        for name, expected in self.EXPECTED.items():
            outcome = call(sys.executable, EXAMPLES / name, *{"front.py": [sweep], "two_runs.py": [run, run]}.get(name, [run]))
            self.assertEqual(outcome.returncode, 0, outcome.stderr)
            self.assertIn(expected, outcome.stdout, name)

    def test_what_is_not_there_is_said_and_none_is_not_a_number(self):
        run = self.path("run.h5")
        write_result(run)
        add_lmds(run)
        with h5py.File(run, "a") as h5:
            h5["scene/in_contact"][...] = 0
            h5["methods/original/minimum_distance"][...] = np.nan
            h5["methods/original/lmds/frame_offset"][...] = 0
        said = {"forces.py": "original: no force in contact", "times.py": "improved: no frame in contact has a time",
                "lmds_of_a_frame.py": "original: no LMD in any frame\n", "worst_frames.py": "original: no probed frame in contact"}
        for name, expected in said.items():
            outcome = call(sys.executable, EXAMPLES / name, run)
            self.assertEqual((outcome.returncode, outcome.stderr), (0, ""), name)
            self.assertIn(expected, outcome.stdout, name)
        with h5py.File(run, "a") as h5:
            h5["scene/in_contact"][...] = 1
            h5["methods/improved/force"][3] = h5["methods/improved/local_update_time"][2, 5] = np.nan
            del h5["methods/original/truth"]
        for name in ("forces.py", "times.py"):
            self.assertNotIn("nan", call(sys.executable, EXAMPLES / name, run).stdout, name)
        outcome = call(sys.executable, EXAMPLES / "worst_frames.py", run)
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("original: no frame was probed (remedy", outcome.stderr)

    def test_what_a_run_did_not_keep_is_said_with_the_remedy(self):
        run = write_result(self.path("run.h5"))
        with h5py.File(run, "a") as h5:
            del h5["methods/improved/truth/frame"]
            h5["methods/improved/truth/frame"] = np.empty(0, dtype=int)
        for name, words in (("lmds_of_a_frame.py", "record/lmds"), ("polylines.py", "record/polylines"), ("worst_frames.py", "over more frames than a search takes")):
            outcome = call(sys.executable, EXAMPLES / name, run)
            self.assertEqual(outcome.returncode, 1)
            self.assertNotIn("Traceback", outcome.stderr)
            self.assertRegex(outcome.stderr, f"remedy: run with .*{words}")

    def test_frames_without_a_true_force_are_not_said_to_be_out_of_contact(self):
        run = write_result(self.path("run.h5"))
        with h5py.File(run, "a") as h5:
            h5["reference/contact_without_direction"][...] = 1
        self.assertIn("improved: no probed frame in contact has a true force", call(sys.executable, EXAMPLES / "worst_frames.py", run).stdout)

    def test_readme_names_every_recipe_and_each_is_short(self):
        readme = text_of(EXAMPLES, "README.md")
        recipes = sorted(file.name for file in EXAMPLES.glob("*.py"))
        self.assertEqual(recipes, sorted(self.EXPECTED))
        for name in recipes:
            self.assertIn(f"`{name}`", readme)
            lines = [line for line in text_of(EXAMPLES, name).splitlines() if line.strip() and not line.startswith(("#", "import"))]
            self.assertLessEqual(len(lines), 10, name)
