// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/drop_intersecting.h>

#include <algorithm>

namespace lmdbench {

namespace {

/// Whether a triangle has a corner on a feature.
bool is_in_star(const ShapeSide& side, const FeatureId& feature, std::int32_t triangle) {
  const auto& corners = side.surface.mesh.triangles[static_cast<std::size_t>(triangle)];
  return std::ranges::any_of(corners, [&](std::int32_t v) {
    if (feature.kind == FeatureKind::VERTEX) return v == feature.index;
    return std::ranges::any_of(side.surface.adjacency.vertex_triangles[v], [&](std::int32_t t) {
      if (feature.kind == FeatureKind::FACE) return side.shape.region_of(t) == feature.index;
      return std::ranges::any_of(
          side.surface.adjacency.triangle_edges[static_cast<std::size_t>(t)], [&](std::int32_t e) {
            const auto& ends = side.surface.adjacency.edges[static_cast<std::size_t>(e)];
            return (ends[0] == v || ends[1] == v) && side.shape.chain_of(e) == feature.index;
          });
    });
  });
}

/// How far what two triangles share reaches from its centroid: a polygon's measure is an area and says little.
double crossing_reach(const ShapePair& pair, const Intersection& crossing) {
  const Triangle t = pair.fixed.surface.mesh.triangle(crossing.triangle_fixed);
  return std::max((t[1] - t[0]).norm(), (t[2] - t[0]).norm());
}

/// Whether what two triangles share comes to the place of a contact.
bool is_over(const ShapePair& pair, const ContactPlaces& places, const Contact& contact,
             const Intersection& crossing) {
  const double reach = pair.tolerance.known + (crossing.dimension == 1   ? 0.5 * crossing.measure
                                               : crossing.dimension == 2 ? crossing_reach(pair, crossing)
                                                                         : 0.0);
  return places.box_of(contact, reach).contains(crossing.point);
}

}  // namespace

void drop_intersecting(const ShapePair& pair, std::int32_t fixed_body, const ContactPlaces& places,
                       std::span<const Intersection> intersections, std::vector<Contact>& contacts) {
  if (intersections.empty()) return;
  std::erase_if(contacts, [&](const Contact& contact) {
    if (contact.least_gap > pair.tolerance.rounding) return false;
    return std::ranges::any_of(intersections, [&](const Intersection& crossing) {
      return crossing.fixed_body == fixed_body && is_over(pair, places, contact, crossing) &&
             is_in_star(pair.moving, contact.moving, crossing.triangle_moving) &&
             is_in_star(pair.fixed, contact.fixed, crossing.triangle_fixed);
    });
  });
}

}  // namespace lmdbench
