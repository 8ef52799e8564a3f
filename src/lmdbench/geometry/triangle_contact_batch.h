// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <span>

/// What vectors say at once about pairs of triangles that may touch, several at a time in the widest vectors that
/// the processor has (the same bits on every processor). What neither of the two decides is left to
/// triangle_distance; each costs a tenth of that.
namespace lmdbench {

/// The segment that two triangles share which clearly cross: by margins far above rounding, with the segment's
/// middle inside both.
struct ClearCrossing {
  Vec3 middle;
  double length = 0.0;  ///< metres; 0: the triangles do not cross clearly
};

/// Looks for clear crossings of a[i] and b[i] (certified/PROOF.md, lemma 11); a segment is triangle_distance's to 1e-12 of the largest coordinate.
/// @pre a.size() == b.size() == results.size()
void find_clear_crossings(std::span<const Triangle> a, std::span<const Triangle> b,
                          std::span<ClearCrossing> results);

/// A lower bound of two triangles' distance: the gap along an axis.
struct ClearGap {
  double gap = 0.0;          ///< metres; 0: none was found
  Vec3 axis = Vec3::Zero();  ///< Unit vector from a towards b along which the gap is.
};

/// Finds the largest gap between a[i] and b[i] along their normals and the products of two sides (the separating
/// axes of two convex bodies); off by some roundings of the coordinates, which the caller's margin must cover.
/// @pre a.size() == b.size() == results.size()
void find_clear_gaps(std::span<const Triangle> a, std::span<const Triangle> b, std::span<ClearGap> results);

}  // namespace lmdbench
