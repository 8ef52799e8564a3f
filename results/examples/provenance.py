# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
import sys

import h5py

with h5py.File(sys.argv[1]) as result:
    made = result["/provenance"]
    print(f"commit {made.attrs['git_commit']}, processor {made['machine'].attrs['processor']}")
    for role, file, digest in zip(*(made[f"inputs/{name}"].asstr()[:] for name in ("role", "file", "sha256"))):
        print(f"{role}: {file}, SHA-256 {digest}")
    for label, method in result["/methods"].items():
        print(f"{label}: result hash {method.attrs['result_hash']}")
