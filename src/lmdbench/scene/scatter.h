// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/scene/mesh_bounds.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// A rule that puts instances of a mesh into the world, about the origin; equal on all machines.
struct Scatter {
  enum class Rule : std::uint8_t {
    GRID,    ///< `counts` along x, y and z.
    RANDOM,  ///< `count` anywhere in a cube; they may intersect.
    PILE     ///< `count` on the closest packing of spheres, from the floor z = 0 up, as a cone.
  };
  Rule rule = Rule::GRID;
  std::array<std::int64_t, 3> counts{1, 1, 1};
  std::int64_t count = 1;
  /// Distance of neighbours, in diagonals of the mesh's box; RANDOM: mean, one in each such cube.
  double spacing = 1.5;
  bool turned = true;  ///< Each at its own orientation, uniform over all; else as the mesh is.
  std::uint64_t seed = 1;
};

/// Poses X_WF; the middle of the mesh's box comes to each place.
std::vector<Pose> scatter(const Scatter& rule, const MeshBounds& bounds);

/// How many poses equal an earlier one bit by bit: instances of one mesh there coincide.
std::size_t count_coincident(std::span<const Pose> poses);

}  // namespace lmdbench
