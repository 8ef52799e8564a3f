# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as result:
    time = result["/path/time"][:]
    for label, method in result["/methods"].items():
        frame, error = method["truth/frame"][:].astype(int), method["truth/force_error"][:]
        worst = np.argsort(-np.nan_to_num(error))[:3]
        print(f"{label}: " + ", ".join(f"{error[i]:.3g} N at {time[frame[i]]:.3f} s" for i in worst))
