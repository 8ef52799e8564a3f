// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/world/mesh_pair.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace lmdbench {

/// Several meshes that move, and what stands. Objects are numbered: the movers first, then what stands.
struct MoverScene {
  std::vector<std::shared_ptr<const Body>> movers;
  std::vector<FixedBody> standing;
  double cutoff = 0.0;  ///< [m]

  std::size_t object_count() const { return movers.size() + standing.size(); }
  bool is_mover(std::size_t object) const { return object < movers.size(); }
  const std::shared_ptr<const Body>& body(std::size_t object) const {
    return is_mover(object) ? movers[object] : standing[object - movers.size()].body;
  }
  /// X_WB of an object, of a mover that in `poses`.
  const Pose& pose(std::size_t object, const std::vector<Pose>& poses) const {
    return is_mover(object) ? poses[object] : standing[object - movers.size()].X_WF;
  }
};

/// Two objects, of which the first one moves and has the lower number.
struct ObjectPair {
  std::uint32_t mover = 0, other = 0;

  /// `Lmd::fixed_body` of their LMDs: another number for each pair.
  std::int32_t number(std::size_t object_count) const {
    return static_cast<std::int32_t>(mover * object_count + other);
  }
  static ObjectPair of(std::int32_t number, std::size_t object_count) {
    const auto all = static_cast<std::size_t>(number);
    return {static_cast<std::uint32_t>(all / object_count), static_cast<std::uint32_t>(all % object_count)};
  }
};

/// Whether every pair of the scene has a number.
bool pairs_have_numbers(const MoverScene& scene);

/// Pairs of objects whose bounding spheres are within a reach of each other, nearest first.
class NearPairs {
 public:
  struct Pair {
    double at_least = 0.0;  ///< Bound of the distance [m].
    ObjectPair objects;
  };
  /// @param scene must outlive this
  explicit NearPairs(const MoverScene& scene);

  /// Looks at all pairs: truth shares no broad phase with what it judges.
  /// @param poses X_WM of each mover
  const std::vector<Pair>& within(double reach, const std::vector<Pose>& poses);

 private:
  const MoverScene& scene_;
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
/// @param poses X_WM of each mover, which the caller sets before he asks; the pose that is given to `search` and `track` says nothing
/// @param make  methods/registry.h: `method_maker`
/// @pre pairs_have_numbers(scene)
std::unique_ptr<Method> make_among_movers(const MoverScene& scene,
                                          std::shared_ptr<const std::vector<Pose>> poses,
                                          const MethodDescription& description, MeshPair::Make make);

/// The method with what a group of movers counts beside it: movers that left their slack; pairs whose bounds were placed or whose room was
/// used up; pairs whose meshes were searched.
MethodDescription among_movers(MethodDescription description);

}  // namespace lmdbench
