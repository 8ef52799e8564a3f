// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/body.h>

#include <algorithm>
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

/// What a method works on: one moving body and the fixed ones.
struct Scene {
  std::shared_ptr<const Body> moving;
  std::vector<FixedBody> fixed;
  double cutoff = 0.0;  ///< Distance beyond which a pair exerts no force [m]; G1's limit.

  /// Whether some fixed mesh is not in the world frame: then poses are composed for each of them (world/world_method.h), and
  /// whoever reads vertices has to place them.
  bool is_world() const {
    return std::any_of(fixed.begin(), fixed.end(), [](const FixedBody& body) { return body.is_placed(); });
  }
};

}  // namespace lmdbench
