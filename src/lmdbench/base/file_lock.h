// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lmdbench {

/// Locks a whole file against other processes, of other machines too where the file system says so. Released when the open
/// file is closed, however its process ends. An open-file-description lock, because HDF5 takes a `flock` of its own on the
/// same file.
/// @param descriptor open for writing
/// @return false when another process holds the lock. A file system without locks counts as locked: work goes on without.
bool lock_whole_file(int descriptor);

}  // namespace lmdbench
