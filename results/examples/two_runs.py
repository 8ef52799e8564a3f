# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py

files = [h5py.File(name) for name in sys.argv[1:3]]
for label in [label for label in files[0]["/methods"] if label in files[1]["/methods"]]:
    for number, unit in (("recall", "1"), ("force_error_rms_n", "N"), ("frame_time_median_s", "s"), ("frame_time_p99_s", "s"), ("frames_late", "1")):
        left, right = (file[f"/methods/{label}/summary/{number}"][0] for file in files)
        print(f"{label} {number} [{unit}]: {left:.4g} | {right:.4g}")
