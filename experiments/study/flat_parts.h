// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace lmdbench::flat_parts {

struct PartsTimes {
  std::size_t paths = 20, passes = 3;
  std::uint64_t seed = 1;
  std::string scan = "bunny-16k";  ///< Mesh of the rows without flat faces.
  std::filesystem::path meshes = "meshes";
  std::string row;  ///< Part of the names of those that are timed.
  std::string json;
};

/// Times `certified` from scratch and coherently where machine parts lie on and in each other, and for comparison where a scan grazes itself, exact
/// and turned and rounded to floats, and prints a table. The report has a checksum of every row's sets, the same in two builds whose results are the same bits.
/// @return exit code: 1 where the two ways differ
int time_parts(const PartsTimes& choice, nlohmann::json report);

}  // namespace lmdbench::flat_parts
