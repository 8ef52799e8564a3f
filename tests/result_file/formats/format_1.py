# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Puts a result of format 2 into the arrangement of format 1: format_1.py FORMAT-2.h5 FORMAT-1.h5"""

import sys

import h5py
import numpy as np

LATER_SCENE = ("starts_touching", "force_limit_n")
LATER_METHOD = ("about", "promise", "tracks_locally", "trackings_after_search", "method_order", "profile", "cutoff_m", "saturation_m",
                "maximum_force_n", "sharpness", "force_limit_n")

with h5py.File(sys.argv[1], "r") as new, h5py.File(sys.argv[2], "w") as old:
    for name, value in new.attrs.items():
        old.attrs[name] = value
    old.attrs["format_version"] = np.int64(1)
    for name in ("provenance", "path", "scene", "methods", "reference", "crosscheck"):
        if name in new:
            new.copy(name, old)
    for name in LATER_SCENE:
        old["scene"].attrs.pop(name, None)
    old["scene"].attrs["starts_in_contact"] = new["scene"].attrs["starts_touching"]
    in_contact = int(np.sum(new["scene/in_contact"]))
    del old["scene/in_contact"]
    for method in old["methods"].values():
        for name in LATER_METHOD:
            method.attrs.pop(name, None)
        method.attrs["frames_in_contact"] = np.int64(in_contact)
        del method["summary"]
        if "first_reduction_time" not in method:
            times = method["global_search_time"]
            for name in ("first_reduction_time", "second_tracking_time"):
                method[name] = np.full(times.shape, np.nan)
                method[name].attrs.update(times.attrs)
            method["kept_after_reduction"] = np.zeros(method["candidates"].shape, dtype=np.int64)
            method["kept_after_reduction"].attrs.update(method["candidates"].attrs)
