// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/body.h>

#include <cstdint>
#include <span>

namespace lmdbench {

/// Two triangles that a search names as the nearest ones of a scene.
struct NamedTriangles {
  const Body& moving;
  const Body& fixed;
  Pose X_FM;
  std::int32_t triangle_moving = -1;  ///< -1: none named.
  std::int32_t triangle_fixed = -1;
};

/// Whether a set that should be complete contradicts the exact distance of the named triangles: it
/// has an LMD nearer than all of them, or none as near as two that face each other on their outer
/// sides. (The nearest pair of closed meshes is an LMD unless one is inside the other:
/// DEFINITION.md.) Within ContactTolerance, as for contacts in one LMD, and `tolerance_relative`.
/// @param nearest of the set [m]; NaN for an empty one
/// @param cutoff  of the set [m]
bool contradicts_nearest(double nearest, std::span<const NamedTriangles> named, double cutoff,
                         double tolerance_relative);

}  // namespace lmdbench
