// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Two triangles that intersect, and the set of points that they share: its centroid, dimension and measure (a
/// point, a segment of that length, a polygon of that area). Short, because in deep contact there are thousands.
struct Intersection {
  FeatureId on_moving, on_fixed;  ///< That carry the centroid.
  std::int32_t triangle_moving, triangle_fixed;
  std::int32_t fixed_body;
  std::int32_t dimension;
  double measure;
  Vec3 point;  ///< world
};

/// Appends one LMD of distance 0 for each contact: pairs of triangles that intersect are of one contact where
/// their features share corners on both meshes (DEFINITION.md). It is represented by the centroid of what the
/// triangles share, of the highest dimension among them, on the features of the piece that lies nearest to
/// that. The result depends on the set alone, not on its order, which is lost; the work is that of sorting it.
/// @param intersections of several with equal features the one that shares most counts
void append_contacts(const Scene& scene, std::vector<Intersection>& intersections, LmdSet& lmds);

/// Appends what intersects (append_contacts), as minima of index 1, and sorts the whole.
void finish_critical(const Scene& scene, std::vector<Intersection>& intersections, CriticalSet& set);

}  // namespace lmdbench
