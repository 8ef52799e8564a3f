// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <judge/cell_pairs.h>

#include <cstddef>
#include <span>

namespace lmdbench::exact {

/// Where triangles of two meshes lie in parallel planes, face each other and share nearest areas.
struct ContactArea {
  double area = 0.0;                                          ///< m^2
  Vec3 centroid_a = Vec3::Zero(), centroid_b = Vec3::Zero();  ///< On the planes of the two meshes.
  /// Some triangles are tilted by up to 1e-6, but not 0: tolerance decides if they share an area.
  bool nearly = false;
};

/// Whether two triangles lie in exactly parallel planes, each on the other's outer side.
bool exactly_facing(const CellPairs& pairs, std::size_t pair);

/// Sum over the pairs of triangles among `which`. Every overlap is clipped in rational numbers;
/// areas and moments are rounded once before they are added.
ContactArea contact_area(const CellPairs& pairs, std::span<const std::size_t> which);

}  // namespace lmdbench::exact
