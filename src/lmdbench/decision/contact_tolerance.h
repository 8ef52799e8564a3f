// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/shape/shape_complex.h>

#include <algorithm>
#include <limits>

namespace lmdbench {

/// The two lengths by which the definition of an LMD holds in floating-point numbers
/// (DEFINITION.md), for two meshes at a pose.
struct ContactTolerance {
  /// How exactly both meshes are known [m]: sum of their planar tolerances, each at least
  /// LEAST_TOLERANCE of its largest coordinate. Says whether contacts are extended, and are one.
  double known = 0.0;
  /// Rounding of points and heights [m]: conditions are closed by so much. It is no tolerance.
  double rounding = 0.0;
  double coordinates = 0.0;   ///< C, bound of the coordinates of both meshes in the world [m].
  double largest_tilt = 0.0;  ///< Sine of the largest angle that `known` explains.
  double reach = 0.0;         ///< Largest distance of contacts: the cutoff and 2 `known` [m].
  double cutoff = 0.0;        ///< [m]

  static ContactTolerance of(const Surface& moving, const ShapeComplex& moving_shape, const Surface& fixed,
                             const ShapeComplex& fixed_shape, const RigidTransform& X_WM, double cutoff);
  template <class Body>
  requires requires(const Body& body) { body.surface(); }
  static ContactTolerance of(const Body& moving, const Body& fixed, const RigidTransform& X_WM,
                             double cutoff) {
    return of(moving.surface(), moving.template prepared<ShapeComplex>(), fixed.surface(),
              fixed.template prepared<ShapeComplex>(), X_WM, cutoff);
  }

  /// Sine of the angle by which rounding turns a direction between two points.
  double direction_error(double distance) const { return rounding / std::max(distance, rounding); }

  /// The most by which a contact may be farther than one of the same LMD (ContactPlaces::granted).
  double widest_tie(double distance) const {
    return 3.0 * known + rounding + direction_error(distance) * LONGEST_WAY * coordinates;
  }

 private:
  /// Longest way between two contacts, on both meshes together, in C: 2 sqrt(3) on each.
  static constexpr double LONGEST_WAY = 7.0;
};

/// Least tolerance of a mesh, relative to its largest coordinate: enough for exact parts that were
/// turned and placed by a few operations in double precision, far below the length of an edge.
inline constexpr double LEAST_TOLERANCE = 1e-9;
/// Rounding, relative to the coordinates: flat regions of both meshes are flat to it (FLATNESS).
inline constexpr double CONTACT_ROUNDING = 128.0 * std::numeric_limits<double>::epsilon();
/// largest_tilt over known / coordinates: nothing is parallel over less than 1/50 of those.
inline constexpr double TILT_PER_TOLERANCE = 50.0;
/// Beyond this sine nothing is parallel, whatever the tolerance.
inline constexpr double LARGEST_PARALLEL_TILT = 5e-5;

}  // namespace lmdbench
