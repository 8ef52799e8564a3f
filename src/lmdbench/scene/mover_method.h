// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/scene/mesh_pair.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace lmdbench {

/// Whether every pair of the scene has a number.
bool pairs_have_numbers(const Scene& scene);

/// Pairs of objects whose bounding spheres are within a reach of each other, nearest first.
class NearPairs {
 public:
  struct Pair {
    double at_least = 0.0;  ///< Bound of the distance [m].
    ObjectPair objects;
  };
  /// @param scene must outlive this
  explicit NearPairs(const Scene& scene) : scene_(scene) {}

  /// Looks at all pairs: truth shares no broad phase with what it judges.
  const std::vector<Pair>& within(double reach, const Pose& X_WM);

 private:
  const Scene& scene_;
  std::vector<Vec3> centres_;
  std::vector<double> radii_, rounding_;
  std::vector<Pair> pairs_;
};

/// A method whose set is that of all pairs of objects: `MoverGroup` says which may be within reach, and what `make` makes of two meshes is
/// asked in the frame of the second. Methods that look at all pairs of triangles (`brute_force`) are truth: they are asked for every pair
/// whose spheres are within reach. A nearest pair is one a mover: an LMD stays that is nearest for one of its movers.
///
/// LMDs are of a pair of objects: `fixed_body` is `ObjectPair::number`, `point_moving` on the pair's mover. Tracking follows them pair by
/// pair.
/// @param make  methods/registry.h: `method_maker`
/// @pre scene.several_move() and pairs_have_numbers(scene)
std::unique_ptr<Method> make_among_movers(const Scene& scene, const MethodDescription& description,
                                          MeshPair::Make make);

/// The method with what a group of movers counts beside it: movers that left their slack; pairs whose bounds were placed or whose room was
/// used up; pairs whose meshes were searched.
MethodDescription among_movers(MethodDescription description);

}  // namespace lmdbench
