# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as result:
    time = result["/path/time"][:]
    for label, method in result["/methods"].items():
        # In a closed loop and under several profiles a method has truth of its own.
        in_contact = method.get("loop/in_contact", method.get("in_contact", result["/scene/in_contact"]))[:].astype(bool)
        truth = method.get("reference", result.get("/reference"))
        known = truth["contact_without_direction"][:] == 0  # triangles that intersect have no direction, so no force is the true one
        frame, error = method["truth/frame"][:].astype(int), method["truth/force_error"][:]
        worst = sorted(np.flatnonzero(in_contact[frame] & known & np.isfinite(error)), key=lambda i: -error[i])[:3]
        print(f"{label}: " + ", ".join(f"{error[i]:.3g} N at {time[frame[i]]:.3f} s" for i in worst))
