// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/covered_contacts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace lmdbench {

namespace {

/// Tolerances by which a covered contact lies inside the other face: none on its border is as near.
constexpr double MARGIN_IN_TOLERANCES = 2.0;

/// Fewer contacts a polygon are joined as fast (`lmdbench-study flat --parts --row peg`).
constexpr std::size_t LEAST_CONTACTS_A_COVER = 8;

/// A polygon with the two regions that share it.
struct Cover {
  std::array<std::int32_t, 2> regions;
  Contact* polygon;
};

std::vector<Cover> covers_among(const ContactTolerance& tolerance, std::vector<Contact>& contacts) {
  std::vector<Contact*> polygons;
  for (Contact& contact : contacts)
    if (contact.dimension == 2) polygons.push_back(&contact);
  std::ranges::sort(polygons, {}, &Contact::distance);
  std::vector<Cover> covers;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    Contact& polygon = *polygons[i];
    const auto is_apart = [&](const Contact& other) {
      return std::abs(other.distance - polygon.distance) > covered_spread(tolerance, polygon);
    };
    // Next to touch directions between points are worse than the tolerance.
    if (polygon.is_whole && polygon.least_gap > tolerance.rounding &&
        tolerance.widest_tie(polygon.least_gap) <= 10.0 * tolerance.known &&
        (i == 0 || is_apart(*polygons[i - 1])) && (i + 1 == polygons.size() || is_apart(*polygons[i + 1])))
      covers.push_back({{polygon.moving.index, polygon.fixed.index}, &polygon});
  }
  std::ranges::sort(covers, {}, &Cover::regions);
  return covers;
}

/// Whether the place of a contact is inside a region of one of the meshes by more than a margin.
bool is_inside(const Contact& contact, const ShapeSide& side, std::int32_t region, double margin) {
  const RegionShape* shape = side.shape.shapes.of_region(region);
  if (shape == nullptr) return false;
  const auto flat = [&](const Vec3& p_W) { return shape->frame.flat(side.point_to_surface(p_W)); };
  if (contact.dimension == 0)
    return shape->clearly_holds(flat(side.is_moving ? contact.point_moving : contact.point_fixed), margin)
        .value_or(false);
  const auto& ends = side.is_moving ? contact.ends_moving : contact.ends_fixed;
  return shape->clearly_holds_segment(flat(ends[0]), flat(ends[1]), margin);
}

}  // namespace

double covered_spread(const ContactTolerance& tolerance, const Contact& polygon) {
  return 2.0 * tolerance.widest_tie(polygon.least_gap);
}

std::vector<Contact> take_covered(const ShapePair& pair, std::vector<Contact>& contacts) {
  std::vector<Contact> taken;
  const std::vector<Cover> covers = covers_among(pair.tolerance, contacts);
  if (covers.empty() || contacts.size() < LEAST_CONTACTS_A_COVER * covers.size()) return taken;
  std::vector<std::int32_t> carriers;
  /// The polygon that covers a contact.
  const auto cover_of = [&](const Contact& contact) -> Contact* {
    const bool moving_is_face = contact.moving.kind == FeatureKind::FACE;
    if (contact.dimension == 2 || moving_is_face == (contact.fixed.kind == FeatureKind::FACE)) return nullptr;
    const ShapeSide &of_border = moving_is_face ? pair.fixed : pair.moving,
                    &of_face = moving_is_face ? pair.moving : pair.fixed;
    const std::int32_t face = (moving_is_face ? contact.moving : contact.fixed).index;
    carriers.clear();
    of_border.shape.append_carriers(of_border.surface, moving_is_face ? contact.fixed : contact.moving,
                                    carriers);
    for (const std::int32_t own : carriers) {
      const std::array regions{moving_is_face ? face : own, moving_is_face ? own : face};
      const auto cover = std::ranges::lower_bound(covers, regions, {}, &Cover::regions);
      if (cover == covers.end() || cover->regions != regions) continue;
      return is_inside(contact, of_face, face, MARGIN_IN_TOLERANCES * pair.tolerance.known) ? cover->polygon
                                                                                            : nullptr;
    }
    return nullptr;
  };
  // Contacts move only after all were asked: `covers` points to polygons.
  std::vector<bool> is_covered;
  is_covered.reserve(contacts.size());
  for (const Contact& contact : contacts) {
    Contact* polygon = cover_of(contact);
    is_covered.push_back(polygon != nullptr);
    if (polygon == nullptr) continue;
    polygon->covers = true;
    polygon->covers_point = polygon->covers_point || contact.dimension == 0;
    taken.push_back(contact);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (!is_covered[i]) contacts[kept++] = contacts[i];
  contacts.resize(kept);
  return taken;
}

}  // namespace lmdbench
