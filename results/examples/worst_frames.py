# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as result:
    for label, method in result["/methods"].items():
        if "truth/frame" not in method or not method["truth/frame"].size:
            sys.exit(f"{label}: no frame was probed (remedy: run with --set /probes/truth/stride_frames=10, over more frames than a search takes)")
        # In a closed loop and under several profiles a method has truth of its own.
        in_contact = method.get("loop/in_contact", method.get("in_contact", result["/scene/in_contact"]))[:].astype(bool)
        known = method.get("reference", result.get("/reference"))["contact_without_direction"][:] == 0  # else no force is the true one
        frame, error = method["truth/frame"][:].astype(int), method["truth/force_error"][:]
        worst = sorted(np.flatnonzero(in_contact[frame] & known & np.isfinite(error)), key=lambda i: -error[i])[:3]
        print(f"{label}: " + (", ".join(f"{error[i]:.3g} N at {result['/path/time'][frame[i]]:.3f} s" for i in worst) or "no probed frame in contact has a true force"))
