// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/drop_intersecting.h>
#include <lmdbench/geometry/extent.h>
#include <lmdbench/geometry/triangle_sides.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace lmdbench {

bool is_above(const ShapeSide& side, std::int32_t triangle, const Plane& plane, double rounding) {
  return std::ranges::all_of(side.triangle(triangle),
                             [&](const Vec3& p) { return plane.height(p) >= -2.0 * rounding; });
}

namespace {

/// Of so few contacts the places are asked before features are collected.
constexpr std::size_t FEW_CONTACTS = 128;

/// Sine of the angle of two edges times the shorter one over the longest of the triangles: a plane
/// along shorter or flatter ones is off by more than a quarter of the rounding at the others' ends.
constexpr double LEAST_EDGE_PRODUCT = 1.0 / 32.0;

/// Bound of the distance of points that two triangles share from their centroid (of a polygon).
double crossing_reach(const ShapePair& pair, const Intersection& crossing) {
  const Triangle t = pair.fixed.surface.mesh.triangle(crossing.triangle_fixed);
  return std::max((t[1] - t[0]).norm(), (t[2] - t[0]).norm());
}

/// Planes that pierce each other by two roundings cross so far from the deepest point.
double crossing_shift(const ShapePair& pair, const Intersection& crossing) {
  const auto normal = [](const ShapeSide& side, std::int32_t triangle) {
    return side.direction(side.surface.face_normals[static_cast<std::size_t>(triangle)]);
  };
  const double sine =
      normal(pair.moving, crossing.triangle_moving).cross(normal(pair.fixed, crossing.triangle_fixed)).norm();
  return 2.0 * pair.tolerance.rounding / std::max(sine, pair.tolerance.largest_tilt);
}

/// Whether one triangle is above the plane of the other.
bool is_one_above(const ShapePair& pair, const Intersection& crossing) {
  const auto is_above_other = [&](const ShapeSide& side, std::int32_t triangle, const ShapeSide& other,
                                  std::int32_t base) {
    const std::int32_t region = other.shape.region_of(base);
    return region >= 0 && is_above(side, triangle, other.plane(region), pair.tolerance.rounding);
  };
  return is_above_other(pair.moving, crossing.triangle_moving, pair.fixed, crossing.triangle_fixed) ||
         is_above_other(pair.fixed, crossing.triangle_fixed, pair.moving, crossing.triangle_moving);
}

/// Whether a plane along an edge of each is between two triangles. Not asked of edges whose product
/// rounding turns, as contacts tell of these.
bool edges_are_between(const ShapePair& pair, const Intersection& crossing) {
  const Triangle a = pair.moving.triangle(crossing.triangle_moving),
                 b = pair.fixed.triangle(crossing.triangle_fixed);
  const double longest = std::max(longest_side(a), longest_side(b));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3 u = a[(i + 1) % 3] - a[i], v = b[(j + 1) % 3] - b[j], product = u.cross(v);
      if (product.norm() < LEAST_EDGE_PRODUCT * longest * std::max(u.norm(), v.norm())) continue;
      const Vec3 axis = product.normalized();
      const Extent of_a = extent_along(a, axis), of_b = extent_along(b, axis);
      if (std::min(of_a.greatest - of_b.least, of_b.greatest - of_a.least) <= 2.0 * pair.tolerance.rounding)
        return true;
    }
  return false;
}

/// Whether the plane of a contact is between two triangles: edges that cross and corners that touch
/// are above no plane of the other's. Of a contact of faces that pierce each other there is none.
bool is_between(const ShapePair& pair, const Contact& contact, const Intersection& crossing) {
  const double rounding = pair.tolerance.rounding;
  return (contact.point_fixed - contact.point_moving).dot(contact.direction) >= -2.0 * rounding &&
         is_above(pair.moving, crossing.triangle_moving, {contact.point_moving, -contact.direction},
                  rounding) &&
         is_above(pair.fixed, crossing.triangle_fixed, {contact.point_fixed, contact.direction}, rounding);
}

}  // namespace

TouchingContacts::TouchingContacts(const ShapePair& pair, const ContactPlaces& places,
                                   std::span<const Contact> contacts)
    : pair_(pair) {
  for (const Contact& contact : contacts)
    if (contact.least_gap <= pair.tolerance.rounding)
      entries_.push_back(
          {{contact.moving, contact.fixed}, places.box_of(contact, pair.tolerance.known), &contact});
  std::ranges::sort(entries_, {}, &Entry::features);
}

std::array<const TouchingContacts::Features*, 3> TouchingContacts::star_of(const ShapeSide& side,
                                                                           std::int32_t triangle,
                                                                           FeaturesAt& known) {
  std::array<const Features*, 3> star{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const std::int32_t v = side.surface.mesh.triangles[static_cast<std::size_t>(triangle)][corner];
    const auto [place, is_new] = known.try_emplace(v);
    Features& features = place->second;
    star[corner] = &features;
    if (!is_new) continue;
    features.push_back({FeatureKind::VERTEX, v});
    for (const std::int32_t t : side.surface.adjacency.vertex_triangles[v]) {
      if (const std::int32_t region = side.shape.region_of(t); region >= 0)
        features.push_back({FeatureKind::FACE, region});
      for (const std::int32_t e : side.surface.adjacency.triangle_edges[static_cast<std::size_t>(t)]) {
        const auto& ends = side.surface.adjacency.edges[static_cast<std::size_t>(e)];
        const std::int32_t chain = side.shape.chain_of(e);
        if (chain >= 0 && (ends[0] == v || ends[1] == v)) features.push_back({FeatureKind::EDGE, chain});
      }
    }
    std::ranges::sort(features, std::greater());
    features.erase(std::unique(features.begin(), features.end()), features.end());
  }
  return star;
}

std::span<const TouchingContacts::Entry> TouchingContacts::entries_of(std::span<const Entry> entries,
                                                                      FeatureId FeaturePair::*side,
                                                                      const FeatureId& feature) {
  const auto of_side = [&](const Entry& e) { return e.features.*side; };
  return {std::ranges::lower_bound(entries, feature, {}, of_side),
          std::ranges::upper_bound(entries, feature, {}, of_side)};
}

bool TouchingContacts::hold(const RestingRegions& resting) const {
  const auto with_regions = [](const ShapeSide& side, const FeatureId& feature) {
    Features features{feature};
    std::vector<std::int32_t> regions;
    if (feature.kind == FeatureKind::EDGE) side.shape.append_carriers(side.surface, feature, regions);
    for (const std::int32_t region : regions) features.push_back({FeatureKind::FACE, region});
    return features;
  };
  const Features of_fixed = with_regions(pair_.fixed, resting.on_fixed);
  for (const FeatureId& f : with_regions(pair_.moving, resting.on_moving)) {
    const std::span<const Entry> of_moving = entries_of(entries_, &FeaturePair::first, f);
    for (const FeatureId& g : of_fixed)
      for (const Entry& entry : entries_of(of_moving, &FeaturePair::second, g))
        if (entry.box_W.contains(resting.shared_W)) return true;
  }
  return false;
}

bool TouchingContacts::for_each_at(const Intersection& crossing,
                                   const std::function<bool(const Contact&)>& visit) {
  const double half_extent = crossing.dimension == 1   ? 0.5 * crossing.measure
                             : crossing.dimension == 2 ? crossing_reach(pair_, crossing)
                                                       : 0.0;
  const Vec3 margin = Vec3::Constant(half_extent + crossing_shift(pair_, crossing));
  const auto is_far = [&](const Entry& entry) {
    return !Eigen::AlignedBox3d(entry.box_W.min() - margin, entry.box_W.max() + margin)
                .contains(crossing.point);
  };
  if (entries_.size() <= FEW_CONTACTS && std::ranges::all_of(entries_, is_far)) return true;
  const auto of_moving = star_of(pair_.moving, crossing.triangle_moving, at_moving_);
  const auto of_fixed = star_of(pair_.fixed, crossing.triangle_fixed, at_fixed_);
  const auto size_of = [](const auto& star) {
    return std::accumulate(star.begin(), star.end(), std::size_t{0},
                           [](std::size_t sum, const Features* features) { return sum + features->size(); });
  };
  // At vertices of many triangles it is cheaper to ask every contact.
  if (size_of(of_moving) * size_of(of_fixed) > entries_.size()) {
    const auto holds = [](const auto& star, const FeatureId& feature) {
      return std::ranges::any_of(star, [&](const Features* features) {
        return std::ranges::binary_search(*features, feature, std::greater());
      });
    };
    return std::ranges::all_of(entries_, [&](const Entry& entry) {
      return is_far(entry) || !holds(of_moving, entry.features.first) ||
             !holds(of_fixed, entry.features.second) || visit(*entry.contact);
    });
  }
  for (const Features* features_moving : of_moving)
    for (const FeatureId& f : *features_moving) {
      const std::span<const Entry> entries = entries_of(entries_, &FeaturePair::first, f);
      if (entries.empty()) continue;  // Of most features.
      for (const Features* features_fixed : of_fixed)
        for (const FeatureId& g : *features_fixed)
          for (const Entry& entry : entries_of(entries, &FeaturePair::second, g))
            if (!is_far(entry) && !visit(*entry.contact)) return false;
    }
  return true;
}

std::vector<Intersection> take_touching(const ShapePair& pair, std::int32_t fixed_body,
                                        TouchingContacts& near, std::vector<Intersection>& intersections) {
  std::vector<Intersection> taken;
  if (near.empty()) return taken;
  std::erase_if(intersections, [&](const Intersection& crossing) {
    if (crossing.fixed_body != fixed_body) return false;
    std::optional<bool> are_apart;
    const bool touches = !near.for_each_at(crossing, [&](const Contact& contact) {
      if (!are_apart) are_apart = is_one_above(pair, crossing) || edges_are_between(pair, crossing);
      return !*are_apart && !is_between(pair, contact, crossing);
    });
    if (touches) taken.push_back(crossing);
    return touches;
  });
  return taken;
}

void drop_intersecting(const ShapePair& pair, std::int32_t fixed_body, const ContactPlaces& places,
                       std::span<const Intersection> intersections, std::vector<Contact>& contacts) {
  if (intersections.empty()) return;
  TouchingContacts near(pair, places, contacts);
  std::vector<bool> intersects(contacts.size());
  for (const Intersection& crossing : intersections) {
    if (crossing.fixed_body != fixed_body) continue;
    near.for_each_at(crossing, [&](const Contact& contact) {
      intersects[static_cast<std::size_t>(&contact - contacts.data())] = true;
      return true;
    });
  }
  std::size_t i = 0;
  std::erase_if(contacts, [&](const Contact&) { return intersects[i++]; });
}

}  // namespace lmdbench
