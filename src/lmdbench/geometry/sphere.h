// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <span>

namespace lmdbench {

struct Sphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
};

/// Smallest sphere around the points up to rounding: never too small, and larger than the optimum
/// by less than SPHERE_SHRINK_TOLERANCE of the radius unless the pivots run out (see sphere.cpp).
/// Deterministic; the order of the points matters only through rounding.
/// @param points #P by 3, finite; the sphere of no points is a point at the origin
Sphere bounding_sphere(std::span<const Vec3> points);

}  // namespace lmdbench
