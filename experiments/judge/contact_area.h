// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <judge/cell_pairs.h>

#include <cstddef>
#include <span>

namespace lmdbench::exact {

/// Where triangles of two meshes lie in exactly parallel planes, face each other and are nearest over an area.
struct ContactArea {
  double area = 0.0;                                          ///< m^2
  Vec3 centroid_a = Vec3::Zero(), centroid_b = Vec3::Zero();  ///< On the planes of the two meshes.
  /// Pairs of triangles at a tilt of up to 1e-6 that is not 0: whether they share an area is left to tolerance.
  bool nearly = false;
};

/// Whether a pair is of triangles in exactly parallel planes with opposite normals, each on the outer side of the other.
bool exactly_facing(const CellPairs& pairs, std::size_t pair);

/// Sums over pairs of triangles; others are passed over. Every overlap is clipped in rational numbers; areas and moments
/// are rounded once before they are added.
ContactArea contact_area(const CellPairs& pairs, std::span<const std::size_t> which);

}  // namespace lmdbench::exact
