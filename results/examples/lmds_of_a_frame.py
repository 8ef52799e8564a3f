# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as result:
    for label, method in result["/methods"].items():
        frame = int(np.nanargmin(method["minimum_distance"][:]))
        begin, end = method["lmds/frame_offset"][frame:frame + 2]
        print(f"{label}, frame {frame}:")
        for distance, point in zip(method["lmds/distance"][begin:end], method["lmds/point_fixed"][begin:end]):
            print(f"  {1e3 * distance:.4f} mm at {np.round(point, 5)} m")
