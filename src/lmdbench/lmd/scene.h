// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/body.h>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace lmdbench {

/// A mesh that stands in the world. Many of one scene may share one `Body`, each at a pose of its own: such copies are *instances*, and
/// their index among the scene's fixed meshes is `Lmd::fixed_body`.
struct FixedBody {
  std::shared_ptr<const Body> body;
  Pose X_WF;  ///< The identity where the vertices are already in the world frame.

  /// A body that stands where it is.
  // NOLINTNEXTLINE(google-explicit-constructor): scenes are written as lists of bodies
  FixedBody(std::shared_ptr<const Body> mesh) : body(std::move(mesh)) {}
  FixedBody(std::shared_ptr<const Body> mesh, const Pose& pose) : body(std::move(mesh)), X_WF(pose) {}

  const Body* operator->() const { return body.get(); }
  const Body& operator*() const { return *body; }
  /// Whether the mesh has a frame of its own.
  bool is_placed() const {
    return !X_WF.translation.isZero(0.0) || X_WF.rotation.coeffs() != Eigen::Quaterniond::Identity().coeffs();
  }
};

/// Bodies in which LMDs are looked for: one moving body and the fixed ones, and what else moves. Its objects are numbered: what moves first,
/// then what stands. Methods work on pairs (`is_pair`); scene/scene_search.h makes of them methods over a scene.
struct Scene {
  std::shared_ptr<const Body> moving;
  std::vector<FixedBody> fixed;
  double cutoff = 0.0;  ///< Distance beyond which a pair exerts no force [m]; G1's limit.
  /// Where several bodies move: all of them, `moving` at its place `held` among them, in an order that the scene alone decides: of a pair
  /// the earlier one takes the moving mesh's part. Else empty.
  std::vector<std::shared_ptr<const Body>> movers = {};
  std::size_t held = 0;
  /// X_WM of each of them at present, but for that of `moving`, which is what a question is asked with.
  std::shared_ptr<const std::vector<Pose>> mover_poses = nullptr;

  bool several_move() const { return !movers.empty(); }
  std::size_t mover_count() const { return movers.empty() ? 1 : movers.size(); }
  std::size_t object_count() const { return mover_count() + fixed.size(); }
  bool is_mover(std::size_t object) const { return object < mover_count(); }
  const std::shared_ptr<const Body>& body(std::size_t object) const {
    if (!is_mover(object)) return fixed[object - mover_count()].body;
    return object == held ? moving : movers[object];
  }
  /// X_WB of an object.
  const Pose& pose(std::size_t object, const Pose& X_WM) const {
    if (!is_mover(object)) return fixed[object - mover_count()].X_WF;
    return object == held ? X_WM : (*mover_poses)[object];
  }

  /// Whether some fixed mesh is not in the world frame: then poses are composed for each of them (scene/mesh_pair.h), and
  /// whoever reads vertices has to place them.
  bool is_world() const {
    return std::any_of(fixed.begin(), fixed.end(), [](const FixedBody& body) { return body.is_placed(); });
  }
  /// Whether it is what methods work on: two bodies, of which one moves and the other is where its vertices are.
  bool is_pair() const { return !several_move() && fixed.size() == 1 && !is_world(); }
  /// Of a pair.
  const Body& fixed_body() const {
    LMDBENCH_EXPECTS(is_pair(), "several bodies for a method of two: scene/scene_search.h takes them apart");
    return *fixed.front().body;
  }
};

/// Two objects of a scene, of which the first one moves and has the lower number.
struct ObjectPair {
  std::uint32_t mover = 0, other = 0;
  auto operator<=>(const ObjectPair&) const = default;

  /// `Lmd::fixed_body` of their LMDs: another number for each pair; where one mesh moves, which of the fixed ones.
  std::int32_t number(const Scene& scene) const {
    return static_cast<std::int32_t>(scene.several_move() ? mover * scene.object_count() + other : other - 1);
  }
  static ObjectPair of(std::int32_t number, const Scene& scene) {
    if (!scene.several_move()) return {0, static_cast<std::uint32_t>(number) + 1};
    const auto all = static_cast<std::size_t>(number);
    return {static_cast<std::uint32_t>(all / scene.object_count()),
            static_cast<std::uint32_t>(all % scene.object_count())};
  }
  /// Whether every pair has one.
  static bool have_numbers(const Scene& scene) {
    return scene.object_count() <=
           static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / scene.mover_count();
  }
  /// The two alone, to be looked at in the frame of the second.
  Scene scene_of(const Scene& scene) const { return {scene.body(mover), {scene.body(other)}, scene.cutoff}; }
};

}  // namespace lmdbench
