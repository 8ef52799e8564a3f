// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/decide.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Two triangles that intersect, and the points that they share: centroid, dimension and measure (a
/// point, a segment of that length, a polygon of that area). Short: deep contact has thousands.
struct Intersection {
  FeatureId on_moving, on_fixed;  ///< That carry the centroid.
  std::int32_t triangle_moving, triangle_fixed;
  std::int32_t fixed_body;
  std::int32_t dimension;
  double measure;
  Vec3 point;  ///< world
};

/// What two triangles share.
/// @param nearest  of the two triangles, which intersect
Intersection intersection_of(const ShapePair& pair, std::int32_t triangle_moving, std::int32_t triangle_fixed,
                             std::int32_t fixed_body, const TrianglePairDistance& nearest);

/// Appends one LMD of distance 0 for each contact: pairs of triangles that intersect are of one
/// contact where their features share corners on both meshes (DEFINITION.md). The centroid of what
/// they share represents it, of the highest dimension among them, on the features of the nearest
/// piece. The result depends on the set alone; its order is lost. The work is that of sorting it.
/// @param intersections  of several with equal features the one that shares most counts
void append_contacts(const Scene& scene, std::vector<Intersection>& intersections, LmdSet& lmds);

/// Appends the intersections (append_contacts) as minima of index 1, and sorts the whole.
void finish_critical(const Scene& scene, std::vector<Intersection>& intersections, CriticalSet& set);

}  // namespace lmdbench
