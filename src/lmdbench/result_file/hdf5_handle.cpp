// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result_file/hdf5_handle.h>

namespace lmdbench {

namespace {

herr_t keep_description(unsigned /*position*/, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

}  // namespace

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
