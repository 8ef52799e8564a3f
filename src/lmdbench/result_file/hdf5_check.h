// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/hdf5_handle.h>

#include <filesystem>
#include <string>

namespace lmdbench {

/// Deflate shrinks nothing by more than this factor, so a dataset that claims more than it stores times this is
/// damaged; without the check a few wrong bytes would ask for all memory.
inline constexpr hsize_t LARGEST_DEFLATE_RATIO = 1032;

/// Lets a child process of limited time and memory (`Limit::IMPORT_SECONDS`, `Limit::IMPORT_BYTES`) read a whole
/// HDF5 file, every dataset and attribute, because HDF5 (1.10) crashes, loops or asks for all memory on some
/// damaged files. What it reads to the end there, this process may read, too. Costs as much as reading it once.
/// HDF5 is told to load no filter that a file may name.
/// @throws InputError when there is no such regular file, when the child ends before it has read it, and naming the
///         object for damage that HDF5 reports by itself; what is no HDF5 file at all is left to who opens it
void check_hdf5(const std::filesystem::path& file);

/// What a dataset takes from other files; empty where it is all in its own. Such files are not ours, and what they
/// name may be anything: a device, a FIFO, a file that is nobody's business.
std::string refers_elsewhere(const Hdf5Handle& dataset);

}  // namespace lmdbench
