// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench::worlds {

/// A world and a path through it.
struct World {
  std::string name;
  Scene scene;
  std::vector<Pose> poses;
};

/// Movers, with all their poses, among standing instances.
struct Play {
  std::string name;
  std::vector<std::shared_ptr<const Body>> movers;
  std::vector<FixedBody> standing;
  std::vector<std::vector<Pose>> frames;  ///< One per mover.
};

/// Movers of about 1 m for tests of completeness: "movers" among instances, "movers nested" (in a
/// moving hollow), "movers coincident" (each twice, sometimes at an instance's place), "movers far"
/// (1 km from the origin). Each has a path like those of worlds.
std::vector<Play> small_plays(std::size_t frames, std::uint64_t seed);

/// Worlds of 30 to 120 small instances for tests of completeness: "grid", "random" (meshes in each
/// other), "pile", "nested" (in the hollow of another), "coincident" (each three times), "far" (1
/// km off the origin). Paths turn, tremble, rest, pass meshes and jump. Diagonals are about 1 m.
std::vector<World> small_worlds(std::size_t frames, std::uint64_t seed);

/// `count` instances of the mesh on a grid, the innermost ones: instance 0 in the middle and
/// unturned, the others turned.
/// @param spacing in diagonals of the mesh's box
std::vector<FixedBody> crowd(const std::shared_ptr<const Body>& mesh, std::size_t count, double spacing,
                             std::uint64_t seed);

}  // namespace lmdbench::worlds
