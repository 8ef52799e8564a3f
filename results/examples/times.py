# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as result:
    warm_up = int(result["/methods"].attrs["warm_up_repetitions"])
    for label, method in result["/methods"].items():
        # In a closed loop and under several profiles its own.
        in_contact = method.get("loop/in_contact", method.get("in_contact", result["/scene/in_contact"]))[:].astype(bool)
        frames = np.median(method["local_update_time"][warm_up:], axis=0)[in_contact]
        frames = frames[np.isfinite(frames)]  # what a plugin lost has no time
        print(f"{label}: no frame in contact has a time" if not frames.size else f"{label}: median {1e6 * np.median(frames):.3g} us, 99 % {1e6 * np.quantile(frames, 0.99):.3g} us")
