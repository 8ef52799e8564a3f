# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py

with h5py.File(sys.argv[1]) as result:
    time = result["/path/time"][:]
    # In a closed loop and under several profiles each method has its own.
    of_methods = {label: method["polylines"] for label, method in result["/methods"].items() if "polylines" in method}
    for label, cut in of_methods.items() or [("all methods", result["/polylines"])]:
        print(label)
        for i, frame in enumerate(cut["frame"][:]):
            begin, end = cut["frame_offset"][i:i + 2]
            length, closed = cut["length"][begin:end], cut["closed"][begin:end]
            print(f"{time[frame]:.3f} s: {end - begin} curves, {1e3 * length.sum():.4g} mm, {closed.sum()} closed")
