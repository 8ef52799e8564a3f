# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as result:
    for label, method in result["/methods"].items():
        # In a closed loop and under several profiles its own.
        in_contact = method.get("loop/in_contact", method.get("in_contact", result["/scene/in_contact"]))[:].astype(bool)
        force = np.linalg.norm(method["force"][:], axis=1)[in_contact]
        force = force[np.isfinite(force)]  # a force that is no number is a failure of the method
        print(f"{label}: no force in contact" if not force.size else f"{label}: mean {force.mean():.3g} N, largest {force.max():.3g} N, felt in {100 * np.mean(force > 0):.1f} % of contact")
