// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench::worlds {

/// A world with a path through it.
struct World {
  std::string name;
  Scene scene;
  std::vector<Pose> poses;
};

/// Worlds of small meshes on which completeness is judged, 30 to 120 instances each: "grid", "random" (meshes in each other), "pile",
/// "nested" (a mesh inside another one's hollow), "coincident" (each instance three times) and "far" (a kilometre from the origin). The
/// paths turn, tremble and rest, pass through meshes, and jump now and then. Diagonals are about 1 m.
std::vector<World> small_worlds(std::size_t frames, std::uint64_t seed);

/// `count` instances of the mesh on a grid, instance 0 in the middle and as the mesh is, the others turned; fewer are the inner ones of
/// more.
/// @param spacing in diagonals of the mesh's box
std::vector<FixedBody> crowd(const std::shared_ptr<const Body>& mesh, std::size_t count, double spacing,
                             std::uint64_t seed);

}  // namespace lmdbench::worlds
