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
  std::string row;  ///< Only rows whose names contain this are timed.
  std::string json;
};

/// Times `certified` from scratch and coherently where machine parts lie on and in each other, or a
/// scan grazes itself; exact, turned, and as floats. The report has a checksum of each row's sets.
/// @return exit code: 1 where the two ways differ
int time_parts(const PartsTimes& choice, nlohmann::json report);

}  // namespace lmdbench::flat_parts
