# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as result:
    time, in_contact = result["/path/time"][:], result["/scene/in_contact"][:].astype(bool)
    apart = result["/reference/minimum_distance"][:] > 0  # touching triangles have no direction, so no force is the true one
    for label, method in result["/methods"].items():
        frame, error = method["truth/frame"][:].astype(int), method["truth/force_error"][:]
        worst = np.argsort(-np.where(in_contact[frame] & apart, np.nan_to_num(error), 0.0))[:3]
        print(f"{label}: " + ", ".join(f"{error[i]:.3g} N at {time[frame[i]]:.3f} s" for i in worst))
