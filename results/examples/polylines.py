# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py

with h5py.File(sys.argv[1]) as result:
    # In a closed loop and under several profiles each method has its own.
    of_methods = {label: method["polylines"] for label, method in result["/methods"].items() if "polylines" in method}
    common = [("all methods", result["/polylines"])] if "polylines" in result else []
    for label, cut in [*of_methods.items()] or common or sys.exit("no curves (remedy: run with --set /record/polylines/stride_frames=5)"):
        print(label)
        for i, frame in enumerate(cut["frame"][:]):
            begin, end = cut["frame_offset"][i:i + 2]
            length, closed = cut["length"][begin:end], cut["closed"][begin:end]
            print(f"{result['/path/time'][frame]:.3f} s: {end - begin} curves, {1e3 * length.sum():.4g} mm, {closed.sum()} closed")
