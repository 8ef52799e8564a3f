// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/child_process.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/result_file/hdf5_handle.h>
#include <lmdbench/result_file/own_result.h>
#include <lmdbench/result_file/provenance.h>

#include <cstddef>
#include <span>
#include <string_view>

namespace lmdbench {

namespace {

bool has_our_format(const std::filesystem::path& file) {
  silence_hdf5();
  const Hdf5Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
  if (!opened.valid()) return false;
  if (H5Aexists(opened.get(), "format") <= 0) return false;
  const Hdf5Handle attribute(H5Aopen(opened.get(), "format", H5P_DEFAULT), &H5Aclose);
  if (!attribute.valid()) return false;
  const Hdf5Handle stored(H5Aget_type(attribute.get()), &H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), &H5Sclose);
  if (!stored.valid() || !space.valid() || H5Tis_variable_str(stored.get()) <= 0 ||
      H5Sget_simple_extent_npoints(space.get()) != 1)
    return false;
  char* text = nullptr;
  if (H5Aread(attribute.get(), stored.get(), static_cast<void*>(&text)) < 0 || text == nullptr) return false;
  const bool ours = std::string_view(text) == RESULT_FORMAT;
  H5free_memory(text);
  return ours;
}

}  // namespace

bool is_own_result(const std::filesystem::path& file) {
  // Our files begin so; HDF5 would search the whole of any other file for it.
  if (!file_begins_with(file, "\x89HDF\r\n\x1a\n")) return false;
  // HDF5 may crash on files that only look like it (hdf5_check.h).
  const ChildLimits limits{limit_of(Limit::IMPORT_SECONDS), limit_of(Limit::IMPORT_BYTES)};
  ChildProcess child(
      [&](const ChildProcess::Send& send) {
        const std::byte ours{has_our_format(file)};
        send(std::span(&ours, 1));
      },
      limits);
  std::byte ours{0};
  return child.receive(std::span(&ours, 1)) && ours == std::byte{1};
}

}  // namespace lmdbench
