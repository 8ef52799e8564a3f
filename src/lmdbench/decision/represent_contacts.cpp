// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/represent_contacts.h>
#include <lmdbench/geometry/extent.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace lmdbench {

namespace {

/// Relative difference within which two pieces are equally near to a centroid: rounding must not
/// choose the name of a symmetric contact.
constexpr double EQUALLY_NEAR = 1e-9;

Contact middle_of_polygons(const ContactPointers& pieces) {
  Contact whole = *pieces.front();
  if (pieces.size() == 1) return whole;
  double total = 0.0;
  whole.point_moving = whole.point_fixed = whole.direction = Vec3::Zero();
  whole.distance = 0.0;
  for (const Contact* piece : pieces) {
    total += piece->measure;
    whole.point_moving += piece->measure * piece->point_moving;
    whole.point_fixed += piece->measure * piece->point_fixed;
    whole.direction += piece->measure * piece->direction;
    // Pieces may cross by the tolerance.
    const double sign = (piece->point_fixed - piece->point_moving).dot(piece->direction);
    whole.distance += piece->measure * std::copysign(piece->distance, sign);
  }
  whole.point_moving /= total;
  whole.point_fixed /= total;
  whole.distance = std::abs(whole.distance / total);
  whole.direction.normalize();
  return whole;
}

/// An order of places that depends neither on the pose nor on the cut into triangles: by
/// coordinates in the moving mesh's frame that differ by more than the tolerance.
bool lies_before(const ShapePair& pair, const Contact& a, const Contact& b) {
  const Vec3 p = pair.moving.point_to_surface(a.point_moving),
             q = pair.moving.point_to_surface(b.point_moving);
  for (int k = 0; k < 3; ++k)
    if (std::abs(p[k] - q[k]) > pair.tolerance.known) return p[k] < q[k];
  return false;
}

/// The longest. Borders over each other, and faces behind them, have equal lengths up to rounding:
/// of these the first by kind, then by place, whatever rounding or the cut into triangles.
const Contact& longest_segment(const ShapePair& pair, const ContactPointers& pieces) {
  const double length =
      (*std::ranges::max_element(pieces, {}, &Contact::measure))->measure - pair.tolerance.known;
  const auto kinds = [](const Contact& c) { return std::pair(c.moving.kind, c.fixed.kind); };
  const Contact* longest = nullptr;
  for (const Contact* piece : pieces)
    if (piece->measure >= length &&
        (longest == nullptr || kinds(*piece) < kinds(*longest) ||
         (kinds(*piece) == kinds(*longest) && lies_before(pair, *piece, *longest))))
      longest = piece;
  return *longest;
}

/// The centroid of segments on one line, parts that overlap counted once. Nothing if they lie on
/// several lines or it lies on none of them.
std::optional<Contact> middle_of_segments(const ShapePair& pair, const ContactPointers& pieces) {
  const Contact& longest = longest_segment(pair, pieces);
  if (pieces.size() == 1) return longest;
  const Vec3 origin = longest.ends_fixed[0], along = (longest.ends_fixed[1] - origin).normalized();
  std::vector<std::pair<double, double>> parts;
  for (const Contact* piece : pieces) {
    Extent part;
    for (const Vec3& end : piece->ends_fixed) {
      const double place = along.dot(end - origin);
      if ((origin + place * along - end).norm() > pair.tolerance.known) return std::nullopt;
      part.add(place);
    }
    parts.emplace_back(part.least, part.greatest);
  }
  std::ranges::sort(parts);
  double covered = 0.0, moment = 0.0, reached = parts.front().first;
  for (const auto& [begin, end] : parts) {
    const double from = std::max(begin, reached);
    if (end <= from) continue;
    covered += end - from;
    moment += 0.5 * (end + from) * (end - from);
    reached = end;
  }
  const double middle = moment / covered;
  if (std::ranges::none_of(parts, [&](const auto& part) {
        return part.first - pair.tolerance.known <= middle && middle <= part.second + pair.tolerance.known;
      }))
    return std::nullopt;
  Contact whole = longest;
  const double share = middle / longest.measure;
  whole.point_fixed = origin + middle * along;
  whole.point_moving = longest.ends_moving[0] + share * (longest.ends_moving[1] - longest.ends_moving[0]);
  whole.distance = (whole.point_fixed - whole.point_moving).norm();
  return whole;
}

/// The nearest. Of several at one distance one between features of the highest kind, where the
/// minimum stays if the tilt grows; then the first by place; in one place the first by name.
const Contact* nearest_contact(const ShapePair& pair, ContactPlaces& places, ContactPointers& contacts) {
  const double least =
      (*std::ranges::min_element(contacts, {}, [](const Contact* c) { return c->distance; }))->distance;
  std::erase_if(contacts,
                [&](const Contact* contact) { return contact->distance > least + pair.tolerance.rounding; });
  const auto kinds = [](const Contact* contact) {
    return static_cast<int>(contact->moving.kind) + static_cast<int>(contact->fixed.kind);
  };
  const Contact* place = contacts.front();
  for (const Contact* contact : contacts)
    if (kinds(contact) > kinds(place) ||
        (kinds(contact) == kinds(place) && lies_before(pair, *contact, *place)))
      place = contact;
  std::erase_if(contacts, [&](const Contact* contact) {
    return contact->dimension == 0 && !places.meet(*contact, *place);
  });
  return *std::ranges::min_element(
      contacts, {}, [](const Contact* contact) { return std::pair(contact->moving, contact->fixed); });
}

/// The contact whose place is nearest to the middle; of those equally near the first by name.
const Contact* nearest_to(const ShapePair& pair, const ContactPlaces& places, const Contact& middle,
                          const ContactPointers& contacts) {
  const Contact* namesake = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Contact* contact : contacts) {
    const double apart = (places.nearest_place(*contact, middle.point_fixed) - middle.point_fixed).norm();
    const double spare = EQUALLY_NEAR * nearest + pair.tolerance.rounding;
    if (namesake != nullptr && !(apart < nearest - spare) &&
        !(apart <= nearest + spare && name_of(*contact) < name_of(*namesake)))
      continue;
    nearest = namesake == nullptr ? apart : std::min(apart, nearest);
    namesake = contact;
  }
  return namesake;
}

/// The face, edge or vertex that names a point of a feature, and a triangle with it.
std::pair<FeatureId, std::int32_t> name_at(const ShapeSide& side, const FeatureId& feature, const Vec3& p_W) {
  if (feature.kind == FeatureKind::VERTEX)
    return {feature, side.surface.adjacency.vertex_triangles[feature.index].front()};
  const Vec3 p_S = side.point_to_surface(p_W);
  if (feature.kind == FeatureKind::FACE) {
    const std::int32_t face = side.shape.face_at(side.surface, feature.index, p_S);
    return {{FeatureKind::FACE, face}, face};
  }
  const std::int32_t edge = side.shape.regions.edge_at(side.surface, feature.index, p_S);
  return {{FeatureKind::EDGE, edge}, side.surface.adjacency.edge_triangles[edge].front()};
}

}  // namespace

Representative represent_contacts(const ShapePair& pair, ContactPlaces& places,
                                  const ContactPointers& contacts) {
  LMDBENCH_EXPECTS(!contacts.empty(), "a set of contacts without a minimum");
  const double highest = contacts.front()->distance + pair.tolerance.known + pair.tolerance.rounding;
  int dimension = 0;
  for (const Contact* contact : contacts)
    if (contact->distance <= highest) dimension = std::max(dimension, contact->dimension);
  ContactPointers pieces(contacts.get_allocator()), points(contacts.get_allocator());
  for (const Contact* contact : contacts) {
    if (contact->distance > highest) continue;
    if (contact->dimension == dimension) pieces.push_back(contact);
    if (contact->dimension == 0) points.push_back(contact);
  }
  Representative result;
  if (dimension == 2) result.middle = middle_of_polygons(pieces);
  if (dimension == 1) result.middle = middle_of_segments(pair, pieces);
  result.namesake = result.middle ? nearest_to(pair, places, *result.middle, pieces)
                                  : nearest_contact(pair, places, points.empty() ? pieces : points);
  // Edges along each other touch in a direction that only a face beside them knows.
  const auto knows = [&](const Contact& c) { return c.knows_direction(pair.tolerance.rounding); };
  const Contact& best = **std::ranges::min_element(contacts, {}, &Contact::direction_error);
  if (!knows(result.contact()) && knows(best)) {
    result.middle = result.contact();
    result.middle->direction = best.direction;
  }
  return result;
}

Lmd make_lmd(const ShapePair& pair, const ContactPlaces& places, const Contact& contact,
             const Contact& namesake, std::int32_t fixed_body) {
  Lmd lmd;
  lmd.distance = contact.distance;
  lmd.point_moving = contact.point_moving;
  lmd.point_fixed = contact.point_fixed;
  lmd.direction = contact.direction;
  lmd.fixed_body = fixed_body;
  const Vec3 q = places.nearest_place(namesake, contact.point_fixed);
  const Vec3 p = contact.point_moving + (q - contact.point_fixed);
  std::tie(lmd.feature_moving, lmd.triangle_moving) = name_at(pair.moving, namesake.moving, p);
  std::tie(lmd.feature_fixed, lmd.triangle_fixed) = name_at(pair.fixed, namesake.fixed, q);
  return lmd;
}

}  // namespace lmdbench
