// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/body.h>

#include <cstdint>
#include <span>

namespace lmdbench {

/// Two triangles that somebody calls the nearest ones of a scene.
struct NamedTriangles {
  const Body& moving;
  const Body& fixed;
  Pose X_FM;
  std::int32_t triangle_moving = -1;  ///< -1: none named.
  std::int32_t triangle_fixed = -1;
};

/// Whether a set that is to be complete contradicts the distance of the triangles named, which the exact kernel says: it has an LMD
/// nearer than all of them, or none as near as two that face each other on their outer sides. (The nearest pair of closed meshes is an
/// LMD unless one lies inside the other: DEFINITION.md.) Granted is what contacts that are one LMD may differ by (ContactTolerance),
/// and `tolerance_relative`.
/// @param nearest of the set [m]; NaN for an empty one
/// @param cutoff  of the set [m]
bool contradicts_nearest(double nearest, std::span<const NamedTriangles> named, double cutoff,
                         double tolerance_relative);

}  // namespace lmdbench
