// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <span>

/// Vectorised decisions about pairs of triangles that may touch, in the widest vectors of the
/// processor (the same bits on every processor). Each costs a tenth of triangle_distance, to which
/// the undecided pairs are left.
namespace lmdbench {

/// Segment of two triangles that clearly cross: by margins far above rounding, its middle inside
/// both. It is that of triangle_distance to 1e-12 of the largest coordinate.
struct ClearCrossing {
  Vec3 middle;
  double length = 0.0;  ///< metres; 0: the triangles do not cross clearly
};

/// Looks for clear crossings of a[i] and b[i] (certified/PROOF.md, lemma 11).
/// @pre a.size() == b.size() == results.size()
void find_clear_crossings(std::span<const Triangle> a, std::span<const Triangle> b,
                          std::span<ClearCrossing> results);

/// A lower bound of two triangles' distance: the gap along an axis.
struct ClearGap {
  double gap = 0.0;          ///< metres; 0: none was found
  Vec3 axis = Vec3::Zero();  ///< Unit vector from a towards b, along the gap.
};

/// Finds the largest gap of a[i] and b[i] along their normals and the products of two sides
/// (separating axes of convex bodies). The caller's margin covers roundings of the coordinates.
/// @pre a.size() == b.size() == results.size()
void find_clear_gaps(std::span<const Triangle> a, std::span<const Triangle> b, std::span<ClearGap> results);

}  // namespace lmdbench
