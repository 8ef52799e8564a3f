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

/// A mesh that stands in the world. Several of a scene may share one `Body`, at poses of their own:
/// such *instances* have their index among the fixed meshes as `Lmd::fixed_body`.
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

/// The moving bodies and the fixed ones. Its objects are numbered, movers first. Methods work on
/// pairs (`is_pair`), scene/scene_search.h on scenes.
struct Scene {
  std::shared_ptr<const Body> moving;
  std::vector<FixedBody> fixed;
  double cutoff = 0.0;  ///< Distance beyond which a pair exerts no force [m]; G1's limit.
  /// Where several bodies move: all, `moving` at place `held`, in an order that the scene alone
  /// decides: of a pair the earlier one is the moving mesh. Else empty.
  std::vector<std::shared_ptr<const Body>> movers = {};
  std::size_t held = 0;
  /// X_WM of each at present; that of `moving` comes with the search instead.
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

  /// Whether some fixed mesh is not in the world frame: then its pose is composed
  /// (scene/mesh_pair.h) and readers place its vertices.
  bool is_world() const {
    return std::any_of(fixed.begin(), fixed.end(), [](const FixedBody& body) { return body.is_placed(); });
  }
  /// Whether methods can work on it: one body moves, and one stands where its vertices are.
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

  /// `Lmd::fixed_body` of their LMDs: one a pair; of one moving mesh the fixed body's index.
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
