# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as result:
    in_contact = result["/scene/in_contact"][:].astype(bool)
    for label, method in result["/methods"].items():
        force = np.linalg.norm(method["force"][:], axis=1)[in_contact]
        print(f"{label}: mean {force.mean():.3g} N, largest {force.max():.3g} N, felt in {100 * np.mean(force > 0):.1f} % of contact")
