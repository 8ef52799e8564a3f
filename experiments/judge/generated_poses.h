// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench::exact {

/// Names of the generators: parts::HARD_GENERATORS, and "rest" for the fits of rest_fits.h.
std::vector<std::string> generators();
std::vector<std::string> generated_kinds(std::string_view generator);

/// Two parts near a drawn pose, moved from it by a share of their size and turned by as many
/// radians: 1e-6 to 1e-2, or 1e-3 to 1e-2 where the vertices were rounded to floats. So faces are
/// parallel up to no tolerance, and the definition and exact arithmetic must agree.
struct GeneratedPose {
  Scene scene;  ///< With its cutoff.
  Pose X_WM;
  std::string text;  ///< The draws, for messages.
};

/// Depends on its arguments alone.
/// @throws UsageError for an unknown name
GeneratedPose make_generated_pose(std::string_view generator, std::string_view kind, std::uint64_t seed,
                                  std::size_t index);

}  // namespace lmdbench::exact
