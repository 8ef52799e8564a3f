// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lmdbench::testing {

/// Bytes of every dataset that must not depend on the speed of the machine.
inline std::map<std::string, std::vector<char>> deterministic_datasets(const std::filesystem::path& file) {
  struct Visit {
    std::map<std::string, std::vector<char>> datasets;
  } visit;
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  H5Ovisit2(
      id, H5_INDEX_NAME, H5_ITER_INC,
      [](hid_t object, const char* name, const H5O_info_t* info, void* data) -> herr_t {
        const std::string path(name);
        const bool is_time =
            path.ends_with("_time") || H5Aexists_by_name(object, name, "made_of_times", H5P_DEFAULT) > 0;
        if (info->type != H5O_TYPE_DATASET || is_time || path.rfind("provenance", 0) == 0) return 0;
        const hid_t dataset = H5Dopen2(object, name, H5P_DEFAULT);
        const hid_t type = H5Dget_type(dataset);
        std::vector<char> bytes;
        if (H5Tis_variable_str(type) <= 0) {  // other tests compare texts
          const hid_t space = H5Dget_space(dataset);
          bytes.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)) * H5Tget_size(type));
          H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
          H5Sclose(space);
        }
        H5Tclose(type);
        H5Dclose(dataset);
        static_cast<Visit*>(data)->datasets[path] = std::move(bytes);
        return 0;
      },
      &visit, H5O_INFO_BASIC);
  H5Fclose(id);
  return visit.datasets;
}

}  // namespace lmdbench::testing
