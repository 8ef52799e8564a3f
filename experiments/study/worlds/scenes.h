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

/// A world with a path through it.
struct World {
  std::string name;
  Scene scene;
  std::vector<Pose> poses;
};

/// Movers with all their poses, among what stands.
struct Play {
  std::string name;
  std::vector<std::shared_ptr<const Body>> movers;
  std::vector<FixedBody> standing;
  std::vector<std::vector<Pose>> frames;  ///< One a mover.
};

/// Several movers of about 1 m on which completeness is judged: "movers" among instances, "movers nested" (in a hollow that moves),
/// "movers coincident" (each twice, and now and then where an instance stands) and "movers far" (a kilometre from the origin). Paths as
/// those of worlds, one a mover.
std::vector<Play> small_plays(std::size_t frames, std::uint64_t seed);

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
