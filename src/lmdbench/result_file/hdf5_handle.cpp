// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result_file/hdf5_handle.h>

namespace lmdbench {

namespace {

constexpr std::size_t CONVERSION_BYTES = std::size_t{1} << 16;

/// Invalid, which reading and writing refuse, where there is no memory for it.
Hdf5Handle transfer() {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_XFER), &H5Pclose);
  if (H5Pset_buffer(properties.get(), CONVERSION_BYTES, nullptr, nullptr) < 0) properties.close();
  return properties;
}

herr_t keep_description(unsigned /*position*/, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

}  // namespace

herr_t read_values(const Hdf5Handle& dataset, hid_t memory_type, void* values) {
  return H5Dread(dataset.get(), memory_type, H5S_ALL, H5S_ALL, transfer().get(), values);
}

herr_t write_values(const Hdf5Handle& dataset, hid_t memory_type, const void* values) {
  return H5Dwrite(dataset.get(), memory_type, H5S_ALL, H5S_ALL, transfer().get(), values);
}

void silence_hdf5() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

std::string last_hdf5_error() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, &keep_description, &text);
  // The file driver buries the system's message in a dump of its arguments: "..., error
  // message = 'No space ...', ..."
  constexpr std::string_view SYSTEM_MESSAGE = "error message = '";
  if (const std::size_t start = text.find(SYSTEM_MESSAGE); start != std::string::npos) {
    const std::size_t first = start + SYSTEM_MESSAGE.size();
    return text.substr(first, text.find('\'', first) - first);
  }
  return text.empty() ? "HDF5 gives no reason" : text;
}

}  // namespace lmdbench
