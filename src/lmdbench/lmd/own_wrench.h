// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>

#include <cstddef>
#include <optional>

namespace lmdbench {

/// Force and torque on a mesh that a method has of its own, in the world.
struct OwnWrench {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 torque = Vec3::Zero();  ///< [N m]
  Vec3 about = Vec3::Zero();   ///< The point that the torque is about.

  Vec3 torque_about(const Vec3& point) const { return torque + (about - point).cross(force); }
};

/// Further base of a `Method` that may have a force of its own, in place of a law, or passes on
/// another method's.
class HasOwnWrench {
 public:
  virtual ~HasOwnWrench() = default;
  /// Force of the last search; unset where there is none.
  /// @param mover  the moving mesh that feels it, in the order of `Scene::movers`; 0 of one
  virtual std::optional<OwnWrench> own_wrench(std::size_t mover) const = 0;
};

/// Unset for methods without.
inline std::optional<OwnWrench> own_wrench_of(const Method& method, std::size_t mover = 0) {
  const auto* own = dynamic_cast<const HasOwnWrench*>(&method);
  return own != nullptr ? own->own_wrench(mover) : std::nullopt;
}

}  // namespace lmdbench
