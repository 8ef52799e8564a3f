# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as result:
    for label, method in result["/methods"].items():
        if "lmds" not in method or "minimum_distance" not in method:
            sys.exit(f"{label}: holds no LMD lists (remedy: run with --set /record/lmds=true)")
        near = np.nan_to_num(method["minimum_distance"][:], nan=np.inf)  # without an LMD there is no distance
        frame = int(np.argmin(near))
        begin, end = method["lmds/frame_offset"][frame:frame + 2]
        print(f"{label}, frame {frame}:" if np.isfinite(near[frame]) else f"{label}: no LMD in any frame")
        for distance, point in zip(method["lmds/distance"][begin:end], method["lmds/point_fixed"][begin:end]):
            print(f"  {1e3 * distance:.4f} mm at {np.round(point, 5)} m")
