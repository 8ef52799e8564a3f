# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the page of extreme scenes says where something was not measured."""

import gc

import h5py
import numpy as np

from cases import Scratch
import extreme
from synthetic import write_result


class Extreme(Scratch):
    def result(self, name, methods=("improved",), **options):
        file = write_result(self.path(f"{name}.h5"), name, frames=200, methods=methods, **options)
        with h5py.File(file, "a") as h5:
            for label in methods:
                group = h5[f"methods/{label}"]
                group["torque"], group["effective_stiffness"], group["minimum_distance"] = np.zeros((200, 3)), np.zeros(200), np.zeros(200)
                if not options.get("true_counts", np.ones(1)).any():
                    for key in ("recall", "recall_adjacent", "precision", "precision_adjacent", "force_error_maximum_n"):
                        group[f"summary/{key}"][...] = np.nan
        return file

    def test_standings_are_of_what_was_measured_in_any_order(self):
        files = [self.result("good"), self.result("apart", true_counts=np.zeros(200, dtype=int)), self.result("bad", ("original",))]
        said = [self.printed(extreme.main, *order) for order in (files, files[::-1])]
        for text in said:
            self.assertIn("| improved | 1 of 1 | 0 | 0 | 0 | 100.0 (good) | 0 (good) |", text)
            self.assertIn("| original | 0 of 1 | 1 | 1 | 0 | 90.0 (bad) | 1 (bad) |", text)
            self.assertIn("not judged: no true LMD in a probed frame", text)

    def test_no_value_is_missing_where_no_force_is_the_true_one(self):
        file = self.result("cut")
        with h5py.File(file, "a") as h5:
            h5["methods/improved/truth/force_error"][3] = np.nan
            h5["reference/contact_without_direction"][3] = 1
        self.assertIn("| improved | 1 of 1 |", self.printed(extreme.main, file))
        gc.collect()  # a result and its methods hold each other, and with them the file
        with h5py.File(file, "a") as h5:
            h5["methods/improved/truth/force_error"][2] = np.nan
        self.assertIn("1 values missing", self.printed(extreme.main, file))

    def test_the_missing_probe_is_named(self):
        file = self.result("blind", truth_stride=0)
        text = self.printed(extreme.main, file, "--check", code=1)
        self.assertIn("not judged: no truth probe", text)
        self.assertIn("| improved | 0 of 0 |", text)
        self.assertIn("broken: blind, improved: no probed frame: no truth probe (remedy: /probes/truth/stride_frames above 0)", text)
