# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py

with h5py.File(sys.argv[1]) as sweep:
    points = sweep["/points"]
    for i in (points["on_front"][:] == 1).nonzero()[0]:
        problem, series, axes = (points[name][i].decode() for name in ("problem", "series", "axes"))
        error = points["force_error_rms_n"][i] / points["maximum_force_n"][i]
        print(f"{problem}: {series} {axes}: {1e3 * points['processor_share'][i]:.3g} ms/s, {100 * error:.3g} % of F_max")
