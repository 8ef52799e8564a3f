// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/plateau.h>
#include <lmdbench/methods/certified/flat/flat_contacts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace lmdbench {

namespace {

/// What rounding grants the first-order test of a direction, times the coordinates over its length: 8 epsilon on either
/// mesh, between which the direction may share a tilt, with room.
constexpr double ROUNDED_TILT = 20.0 * std::numeric_limits<double>::epsilon();
/// Contacts are one set of minimisers to the definition only where they differ by less than this, relative to the
/// coordinates, in their heights and gaps (minimiser_set.h and plateau.cpp grant 1e-9, and PARALLEL_TILT of a distance in
/// the plane, which is up to 3.5 coordinates), and by the planar tolerance.
constexpr double ONE_SET = 1.2e-8;
/// How far, relative to the coordinates, a minimum that a triangle pair found may be from the contact that it
/// is a part of.
constexpr double TOUCHING = 1e-9;
/// Sine between an edge and a border that it stays beside, to TOUCHING, for longer than 1e-2 of the coordinates.
constexpr double ALMOST_ALONG = 1e-7;
/// Relative difference of the distances of a contact and of a minimum that is a part of it.
constexpr double SAME_DISTANCE = 1e-6;

double along(const Plane& plane, const Vec3& n, const Vec3& x) {
  return plane.normal.dot(plane.point - x) / plane.normal.dot(n);
}

/// Whether all of b is farther than the tolerance outside some side of a.
bool side_separates(const ConvexPolygon& a, const ConvexPolygon& b, double tolerance) {
  for (std::size_t k = 0; k < a.corners.size(); ++k) {
    const Vec2 side = a.corners[(k + 1) % a.corners.size()] - a.corners[k];
    const double limit = -tolerance * side.norm();
    if (std::all_of(b.corners.begin(), b.corners.end(),
                    [&](const Vec2& x) { return cross(side, x - a.corners[k]) < limit; }))
      return true;
  }
  return false;
}

bool touch(const ConvexPolygon& a, const ConvexPolygon& b, double tolerance) {
  return !side_separates(a, b, tolerance) && !side_separates(b, a, tolerance);
}

bool is_inside(const ConvexPolygon& polygon, const Vec2& x, double tolerance) {
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    const Vec2 side = polygon.corners[(k + 1) % polygon.corners.size()] - polygon.corners[k];
    if (cross(side, x - polygon.corners[k]) < -tolerance * side.norm()) return false;
  }
  return true;
}

bool has_inward_edge(const FlatSide& side, std::int32_t region) {
  return side.mesh.region_has_inward_edge[static_cast<std::size_t>(region)];
}

bool is_segment(const FlatContacts::Contact& contact) {
  return contact.flat_moving.kind == FeatureKind::EDGE || contact.flat_fixed.kind == FeatureKind::EDGE;
}

}  // namespace

void FlatContacts::start(std::int32_t body, double cutoff, double touch, double coordinates, double tolerance,
                         const ParallelRule& rule) {
  body_ = body;
  cutoff_ = cutoff;
  touch_ = touch;
  coordinates_ = coordinates;
  tolerance_ = tolerance;
  rule_ = rule;
  in_doubt_ = false;
  contacts_.clear();
  unsure_.clear();
  left_.clear();
  pieces_.clear();
  frames_.clear();
}

FlatVerdict FlatContacts::judge(const Extent& distances, double tilt) {
  // Faces that are in touch or cross have no direction: their triangles tell.
  if (distances.greatest < 0.0) return FlatVerdict::NONE;
  const bool is_parallel = rule_.is_parallel(tilt, distances.greatest - distances.least);
  if (rule_.is_exact && !is_parallel && tilt > acceptable_tilt(distances.least)) return FlatVerdict::NONE;
  if (distances.least <= 2.0 * touch_)
    return rule_.is_exact && distances.greatest > 4.0 * touch_ ? doubt() : FlatVerdict::UNSURE;
  if (is_parallel) return FlatVerdict::FOUND;
  return rule_.is_exact || tilt <= PARALLEL_TILT ? doubt() : FlatVerdict::NONE;
}

double FlatContacts::acceptable_tilt(double distance) const {
  return PARALLEL_TILT + ROUNDED_TILT * coordinates_ / std::max(distance, touch_);
}

double FlatContacts::largest_tilt() const {
  return rule_.is_exact ? std::max(rule_.largest_tilt, acceptable_tilt(touch_)) : rule_.largest_tilt;
}

std::span<const ConvexPolygon> FlatContacts::pieces_of(const Contact& contact) const {
  return std::span(pieces_).subspan(contact.first, contact.count);
}

bool FlatContacts::do_touch(std::size_t one, std::size_t other, double gap) const {
  const Contact &a = contacts_[one], &b = contacts_[other];
  if (is_segment(a) && is_segment(b))
    return segment_distance({a.end0, a.end1}, {b.end0, b.end1}).squared_distance <= gap * gap;
  if (is_segment(b)) return do_touch(other, one, gap);
  const PlanarFrame& frame = frames_[other];
  const auto touches_other = [&](const ConvexPolygon& own) {
    return std::ranges::any_of(pieces_of(b),
                               [&](const ConvexPolygon& piece) { return touch(own, piece, gap); });
  };
  if (is_segment(a)) return touches_other(ConvexPolygon({frame.flat(a.end0), frame.flat(a.end1)}));
  return std::ranges::any_of(pieces_of(a), [&](ConvexPolygon own) {
    for (Vec2& corner : own.corners) corner = frame.flat(frames_[one].lifted(corner));
    return touches_other(own);
  });
}

bool FlatContacts::are_one_set(std::size_t one, std::size_t other) const {
  const Contact &a = contacts_[one], &b = contacts_[other];
  // The parts of one pair of flat features are known to be apart.
  if (a.flat_moving == b.flat_moving && a.flat_fixed == b.flat_fixed) return false;
  const double gap = tolerance_ + ONE_SET * coordinates_;
  const Vec3 difference = a.lmd.distance * a.lmd.direction - b.lmd.distance * b.lmd.direction;
  return difference.norm() <= PARALLEL_TILT * std::max(a.lmd.distance, b.lmd.distance) + gap &&
         do_touch(one, other, gap);
}

bool FlatContacts::leave_touching_contacts() {
  const std::size_t known = left_.size();
  std::vector<bool> touches(contacts_.size(), false);
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!(touches[i] && touches[j]) && are_one_set(i, j)) touches[i] = touches[j] = true;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (touches[i] && !is_left(contacts_[i].flat_moving, contacts_[i].flat_fixed))
      left_.push_back({contacts_[i].flat_moving, contacts_[i].flat_fixed});
  return left_.size() > known && forget_contacts();
}

bool FlatContacts::leave_contacts_beside(const FlatSide& moving, const FlatSide& fixed,
                                         std::span<const LocalMinimum> minima) {
  const std::size_t known = left_.size();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    const bool has_neighbour = std::ranges::any_of(minima, [&](const LocalMinimum& minimum) {
      const Lmd& lmd = minimum.lmd;
      // A piece with a size is known by its middle alone: at the same height it may touch the contact anywhere. So may a point with a
      // face in the plane of contact that turns away.
      return !lmd.intersecting && is_level_with(contact, lmd.point_moving, lmd.point_fixed) &&
             (minimum.dimension > 0 || is_at(i, lmd.point_moving, lmd.point_fixed) ||
              has_face_away(moving, lmd.feature_moving, contact.lmd.direction) ||
              has_face_away(fixed, lmd.feature_fixed, -contact.lmd.direction)) &&
             !(moving.mesh.is_on(moving.surface, lmd.feature_moving, contact.flat_moving) &&
               fixed.mesh.is_on(fixed.surface, lmd.feature_fixed, contact.flat_fixed));
    });
    if (has_neighbour && !is_left(contact.flat_moving, contact.flat_fixed))
      left_.push_back({contact.flat_moving, contact.flat_fixed});
  }
  return left_.size() > known && forget_contacts();
}

bool FlatContacts::forget_contacts() {
  contacts_.clear();
  pieces_.clear();
  frames_.clear();
  unsure_ = left_;
  return true;
}

void FlatContacts::collect_pieces(const FlatSide& side, std::int32_t region, const PlanarFrame& frame_W,
                                  std::vector<ConvexPolygon>& pieces) const {
  pieces.clear();
  const RegionShape* shape = side.mesh.shapes.of_region(region);
  if (shape == nullptr) {
    pieces.emplace_back(frame_W,
                        side.X_WS.triangle(side.surface.mesh.triangle(side.mesh.lead_of_region(region))));
    return;
  }
  const Vec2 origin = frame_W.flat(side.X_WS.point(shape->frame.origin));
  const Vec3 u = side.X_WS.direction(shape->frame.u), v = side.X_WS.direction(shape->frame.v);
  Eigen::Matrix2d turn;
  turn << frame_W.u.dot(u), frame_W.u.dot(v), frame_W.v.dot(u), frame_W.v.dot(v);
  for (const ConvexPolygon& own : shape->pieces) {
    ConvexPolygon& piece = pieces.emplace_back();
    piece.corners.reserve(own.corners.size());
    for (const Vec2& x : own.corners) piece.corners.push_back(origin + turn * x);
    if (turn.determinant() < 0.0) std::reverse(piece.corners.begin(), piece.corners.end());
  }
}

FlatVerdict FlatContacts::add_faces(const FlatSide& moving, std::int32_t region_moving, const FlatSide& fixed,
                                    std::int32_t region_fixed) {
  if (is_left({FeatureKind::FACE, region_moving}, {FeatureKind::FACE, region_fixed}))
    return FlatVerdict::UNSURE;
  const Plane plane_m = moving.plane(region_moving), plane_f = fixed.plane(region_fixed);
  const double tilt = (plane_m.normal + plane_f.normal).norm();
  if (tilt > largest_tilt()) return FlatVerdict::NONE;
  const Vec3 n = contact_direction(plane_m.normal, plane_f.normal, moving.surface, fixed.surface);
  const PlanarFrame frame(plane_f.point, n);
  collect_pieces(moving, region_moving, frame, of_moving_);
  collect_pieces(fixed, region_fixed, frame, of_fixed_);
  overlaps_.clear();
  Extent distances;
  for (const ConvexPolygon& a : of_moving_) {
    for (const ConvexPolygon& b : of_fixed_) {
      if (!touch(a, b, 0.0)) continue;
      ConvexPolygon overlap = a.cut_by(b);
      if (rule_.is_speck(overlap, overlap.measure().area)) continue;
      for (const Vec2& corner : overlap.corners) {
        const Vec3 x = frame.lifted(corner);
        distances.add(along(plane_f, n, x) - along(plane_m, n, x));
      }
      overlaps_.push_back(std::move(overlap));
    }
  }
  if (overlaps_.empty() || distances.least > cutoff_) return FlatVerdict::NONE;
  const FlatVerdict verdict = judge(distances, tilt);
  if (verdict == FlatVerdict::NONE) return verdict;
  if (verdict == FlatVerdict::UNSURE || has_inward_edge(moving, region_moving) ||
      has_inward_edge(fixed, region_fixed))
    return unsure({FeatureKind::FACE, region_moving}, {FeatureKind::FACE, region_fixed});

  group_.resize(overlaps_.size());
  std::iota(group_.begin(), group_.end(), std::size_t{0});
  for (std::size_t i = 0; i < overlaps_.size(); ++i)
    for (std::size_t j = i + 1; j < overlaps_.size(); ++j)
      if (group_[i] != group_[j] && touch(overlaps_[i], overlaps_[j], TOUCHING * coordinates_)) {
        // Copies: std::replace takes references, and the labels change while it runs.
        const std::size_t from = std::max(group_[i], group_[j]), to = std::min(group_[i], group_[j]);
        std::replace(group_.begin(), group_.end(), from, to);
      }
  for (std::size_t g = 0; g < overlaps_.size(); ++g) {
    if (group_[g] != g) continue;
    Contact contact;
    contact.flat_moving = {FeatureKind::FACE, region_moving};
    contact.flat_fixed = {FeatureKind::FACE, region_fixed};
    contact.first = pieces_.size();
    double area = 0.0;
    Vec2 centroid = Vec2::Zero();
    for (std::size_t i = g; i < overlaps_.size(); ++i) {
      if (group_[i] != g) continue;
      const AreaAndCentroid piece = overlaps_[i].measure();
      area += piece.area;
      centroid += piece.area * piece.centroid;
      pieces_.push_back(overlaps_[i]);
    }
    contact.count = pieces_.size() - contact.first;
    const Vec3 x = frame.lifted(centroid / area);
    contact.lmd.point_moving = x + along(plane_m, n, x) * n;
    contact.lmd.point_fixed = x + along(plane_f, n, x) * n;
    frames_.resize(contacts_.size(), frame);
    frames_.push_back(frame);
    add(moving, fixed, contact);
  }
  return FlatVerdict::FOUND;
}

FlatVerdict FlatContacts::add_edge_face(const FlatSide& of_edge, std::int32_t straight,
                                        const FlatSide& of_face, std::int32_t region) {
  const FeatureId edge{FeatureKind::EDGE, straight}, face{FeatureKind::FACE, region};
  const FeatureId& flat_moving = of_edge.is_moving ? edge : face;
  const FeatureId& flat_fixed = of_edge.is_moving ? face : edge;
  if (is_left(flat_moving, flat_fixed)) return FlatVerdict::UNSURE;
  const auto& ends = of_edge.mesh.regions->straight_edges[static_cast<std::size_t>(straight)].ends;
  const Vec3 x0 = of_edge.vertex(ends[0]), u = of_edge.vertex(ends[1]) - x0;
  const double length = u.norm();
  const Plane plane = of_face.plane(region);
  const double tilt = std::abs(u.dot(plane.normal)) / length;
  if (!(tilt <= largest_tilt())) return FlatVerdict::NONE;
  const Vec3 n = -(plane.normal - u.dot(plane.normal) / (length * length) * u).normalized();
  const PlanarFrame frame(plane.point, n);
  collect_pieces(of_face, region, frame, of_fixed_);
  const double width = rule_.least_width;
  struct Change {
    double place;
    int covers;  ///< 2 at the begin of what lies inside a piece, 1 along a side: inside the region where two pieces share the
        ///< side. Negative at the end.
  };
  std::vector<Change> changes;
  const Vec2 flat0 = frame.flat(x0), flat1 = frame.flat(x0 + u);
  for (const ConvexPolygon& piece : of_fixed_) {
    const SegmentPart part = piece.part_of(flat0, flat1);
    if (!((part.end - part.begin) * length > width)) continue;
    const Vec2 middle = flat0 + 0.5 * (part.begin + part.end) * (flat1 - flat0);
    const int covers = is_inside(piece, middle, -width) ? 2 : 1;
    changes.push_back({part.begin, covers});
    changes.push_back({part.end, -covers});
  }
  std::sort(changes.begin(), changes.end(),
            [](const Change& a, const Change& b) { return a.place < b.place; });
  std::vector<SegmentPart> parts;
  const double gap = TOUCHING * coordinates_;
  int covers = 0;
  for (std::size_t i = 0; i + 1 < changes.size(); ++i) {
    covers += changes[i].covers;
    const double begin = changes[i].place, end = changes[i + 1].place;
    if (covers < 2 || (end - begin) * length <= gap) continue;
    if (!parts.empty() && (begin - parts.back().end) * length <= gap)
      parts.back().end = end;
    else
      parts.push_back({begin, end});
  }
  const FeatureId lead{FeatureKind::EDGE, of_edge.mesh.lead_of_straight(straight)};
  Extent distances;
  for (const SegmentPart& part : parts) {
    distances.add(along(plane, n, x0 + part.begin * u));
    distances.add(along(plane, n, x0 + part.end * u));
  }
  if (parts.empty() || distances.least > cutoff_) return FlatVerdict::NONE;
  const FlatVerdict verdict = judge(distances, tilt);
  if (verdict == FlatVerdict::NONE) return verdict;
  if (verdict == FlatVerdict::FOUND && rule_.is_exact && follows_border_aslant(of_face, region, x0, u, n))
    return doubt();
  const FeatureId lead_face{FeatureKind::FACE, of_face.mesh.lead_of_region(region)};
  if (verdict == FlatVerdict::UNSURE || has_other_beside(of_edge, straight, n) ||
      has_inward_edge(of_face, region) ||
      (of_edge.is_moving ? is_on_unsure(of_edge, lead, of_face, lead_face)
                         : is_on_unsure(of_face, lead_face, of_edge, lead)))
    return unsure(flat_moving, flat_fixed);
  for (const SegmentPart& part : parts) {
    const Vec3 middle = x0 + 0.5 * (part.begin + part.end) * u;
    const auto foot_of = [&](const Vec3& x) { return Vec3(x + along(plane, n, x) * n); };
    const Vec3 foot = foot_of(middle);
    if (!in_outward_polar_cone(of_edge.surface, of_edge.X_WS, lead, middle, foot - middle))
      return unsure(flat_moving, flat_fixed);
    Contact contact;
    contact.flat_moving = flat_moving;
    contact.flat_fixed = flat_fixed;
    contact.lmd.point_moving = of_edge.is_moving ? middle : foot;
    contact.lmd.point_fixed = of_edge.is_moving ? foot : middle;
    const Vec3 begin = x0 + part.begin * u, end = x0 + part.end * u;
    contact.end0 = of_edge.is_moving ? foot_of(begin) : begin;
    contact.end1 = of_edge.is_moving ? foot_of(end) : end;
    add(of_edge.is_moving ? of_edge : of_face, of_edge.is_moving ? of_face : of_edge, contact);
  }
  return FlatVerdict::FOUND;
}

/// Whether a face round a feature lies in the plane of a contact and turns away. All faces of an edge: there may be more than two.
/// @param n  from the feature to the other mesh
bool FlatContacts::has_face_away(const FlatSide& side, const FeatureId& feature, const Vec3& n) const {
  return std::ranges::any_of(side.surface.incident_triangles(feature), [&](std::int32_t face) {
    const std::int32_t region = side.mesh.regions->region_of_triangle[static_cast<std::size_t>(face)];
    return region >= 0 && (side.plane(region).normal + n).norm() <= largest_tilt();
  });
}

/// Whether a face beside a straight edge lies in the plane of its contact and turns away, as on the border of a sheet, or an edge at
/// its end does: what is over those is of one set with what is over the edge, although no contact of theirs. Of a triangle
/// without area other edges may lie on the edge, with faces of their own.
/// @param n  from the edge to the other mesh
bool FlatContacts::has_other_beside(const FlatSide& side, std::int32_t straight, const Vec3& n) const {
  if (side.mesh.straight_has_sliver[static_cast<std::size_t>(straight)]) return true;
  return has_face_away(side, {FeatureKind::EDGE, side.mesh.lead_of_straight(straight)}, n) ||
         side.mesh.straight_has_inward_edge(side.surface, straight, side.X_WS.rotation.transpose() * n,
                                            tolerance_ + ONE_SET * coordinates_);
}

/// Whether somewhere along a straight edge over a region the region's border is beside it, to TOUCHING, and at so small an angle
/// that what is over the border and what is over the region are of one set.
/// @param x0, u  first end, and from there to the other
/// @param n  square to the edge
bool FlatContacts::follows_border_aslant(const FlatSide& of_face, std::int32_t region, const Vec3& x0,
                                         const Vec3& u, const Vec3& n) const {
  const double length = u.norm();
  const Vec3 along_edge = u / length, aside = n.cross(along_edge);
  for (const std::int32_t straight : of_face.mesh.regions->straight_edges_of_region[region]) {
    const auto& ends = of_face.mesh.regions->straight_edges[static_cast<std::size_t>(straight)].ends;
    const Vec3 begin = of_face.vertex(ends[0]) - x0, border = of_face.vertex(ends[1]) - x0 - begin;
    const double run = border.dot(along_edge), slope = border.dot(aside) / run;
    if (!(std::abs(slope) <= ALMOST_ALONG)) continue;
    const double place = begin.dot(along_edge);
    const double from = std::max(0.0, std::min(place, place + run));
    const double to = std::min(length, std::max(place, place + run));
    if (!(to > from)) continue;
    const double off_from = begin.dot(aside) + slope * (from - place);
    const double off_to = begin.dot(aside) + slope * (to - place);
    const bool crosses = off_from * off_to < 0.0;
    const double nearest = crosses ? 0.0 : std::min(std::abs(off_from), std::abs(off_to));
    if (nearest <= TOUCHING * coordinates_ && std::abs(off_to - off_from) > rule_.allowance) return true;
  }
  return false;
}

FlatVerdict FlatContacts::add_edges(const FlatSide& moving, std::int32_t straight_moving,
                                    const FlatSide& fixed, std::int32_t straight_fixed) {
  if (is_left({FeatureKind::EDGE, straight_moving}, {FeatureKind::EDGE, straight_fixed}))
    return FlatVerdict::UNSURE;
  const auto& ends_m = moving.mesh.regions->straight_edges[static_cast<std::size_t>(straight_moving)].ends;
  const auto& ends_f = fixed.mesh.regions->straight_edges[static_cast<std::size_t>(straight_fixed)].ends;
  const Vec3 a0 = moving.vertex(ends_m[0]), u = moving.vertex(ends_m[1]) - a0;
  const Vec3 b0 = fixed.vertex(ends_f[0]), v = fixed.vertex(ends_f[1]) - b0;
  const double length_u = u.norm(), length_v = v.norm();
  const double tilt = u.cross(v).norm() / (length_u * length_v);
  if (!(tilt <= largest_tilt())) return FlatVerdict::NONE;
  if (rule_.is_exact && tilt > rule_.largest_tilt &&
      tilt > acceptable_tilt(std::sqrt(segment_distance({a0, a0 + u}, {b0, b0 + v}).squared_distance)))
    return FlatVerdict::NONE;
  const double sense = u.dot(v) > 0.0 ? 1.0 : -1.0;
  const Vec3 w = (u / length_u + sense / length_v * v).normalized();
  const double end_a = u.dot(w), begin_b = (b0 - a0).dot(w), end_b = begin_b + v.dot(w);
  const double begin = std::max(0.0, std::min(begin_b, end_b));
  const double end = std::min(end_a, std::max(begin_b, end_b));
  // Where they face each other in a point or less, their ends answer.
  if (!(end - begin > rule_.least_width)) return FlatVerdict::UNSURE;
  if (rule_.drifts_sideways(u, v)) return doubt();
  const auto on_moving = [&](double s) { return Vec3(a0 + s / end_a * u); };
  const auto on_fixed = [&](double s) { return Vec3(b0 + (s - begin_b) / (end_b - begin_b) * v); };
  const double middle = 0.5 * (begin + end);
  const Vec3 p = on_moving(middle), d = on_fixed(middle) - p;
  Extent distances;
  for (const double s : {begin, middle, end}) distances.add((on_fixed(s) - on_moving(s)).norm());
  if (distances.least > cutoff_) return FlatVerdict::NONE;
  const FlatVerdict verdict = judge(distances, tilt);
  if (verdict == FlatVerdict::NONE) return verdict;
  const FeatureId lead_m{FeatureKind::EDGE, moving.mesh.lead_of_straight(straight_moving)};
  const FeatureId lead_f{FeatureKind::EDGE, fixed.mesh.lead_of_straight(straight_fixed)};
  if (verdict == FlatVerdict::UNSURE || is_on_unsure(moving, lead_m, fixed, lead_f))
    return FlatVerdict::UNSURE;
  const Vec3 across_m = d - d.dot(u) / (length_u * length_u) * u;
  const Vec3 across_f = d - d.dot(v) / (length_v * length_v) * v;
  if (!in_outward_polar_cone(moving.surface, moving.X_WS, lead_m, p, across_m) ||
      !in_outward_polar_cone(fixed.surface, fixed.X_WS, lead_f, p + d, -across_f))
    return FlatVerdict::UNSURE;
  if (has_other_beside(moving, straight_moving, d.normalized()) ||
      has_other_beside(fixed, straight_fixed, -d.normalized()))
    return unsure({FeatureKind::EDGE, straight_moving}, {FeatureKind::EDGE, straight_fixed});
  Contact contact;
  contact.flat_moving = {FeatureKind::EDGE, straight_moving};
  contact.flat_fixed = {FeatureKind::EDGE, straight_fixed};
  contact.lmd.point_moving = p;
  contact.lmd.point_fixed = p + d;
  contact.end0 = on_fixed(begin);
  contact.end1 = on_fixed(end);
  add(moving, fixed, contact);
  return FlatVerdict::FOUND;
}

void FlatContacts::add(const FlatSide& moving, const FlatSide& fixed, Contact contact) {
  Lmd& lmd = contact.lmd;
  const Vec3 d = lmd.point_fixed - lmd.point_moving;
  lmd.distance = d.norm();
  if (lmd.distance > cutoff_) return;
  lmd.direction = d / lmd.distance;
  lmd.fixed_body = body_;
  const auto name = [](const FlatSide& side, const FeatureId& flat, const Vec3& p_W, FeatureId& feature,
                       std::int32_t& triangle) {
    const Vec3 p_S = side.X_WS.rotation.transpose() * (p_W - side.X_WS.translation);
    if (flat.kind == FeatureKind::FACE) {
      triangle = side.mesh.face_at(side.surface, flat.index, p_S);
      feature = {FeatureKind::FACE, triangle};
    } else {
      feature = {FeatureKind::EDGE, side.mesh.regions->edge_at(side.surface, flat.index, p_S)};
      triangle = side.surface.adjacency.edge_triangles[feature.index].front();
    }
  };
  name(moving, contact.flat_moving, lmd.point_moving, lmd.feature_moving, lmd.triangle_moving);
  name(fixed, contact.flat_fixed, lmd.point_fixed, lmd.feature_fixed, lmd.triangle_fixed);
  // Two edges of faces that are in contact are part of that.
  if (contains(moving, lmd.feature_moving, fixed, lmd.feature_fixed, lmd.point_moving, lmd.point_fixed))
    return;
  contacts_.push_back(contact);
}

bool FlatContacts::is_on_unsure(const FlatSide& moving, const FeatureId& on_moving, const FlatSide& fixed,
                                const FeatureId& on_fixed) const {
  return std::any_of(unsure_.begin(), unsure_.end(), [&](const auto& pair) {
    return moving.mesh.is_on(moving.surface, on_moving, pair.first) &&
           fixed.mesh.is_on(fixed.surface, on_fixed, pair.second);
  });
}

const FlatContacts::Contact* FlatContacts::contact_of(const FlatSide& moving, const FeatureId& on_moving,
                                                      const FlatSide& fixed, const FeatureId& on_fixed,
                                                      std::size_t from) const {
  for (std::size_t i = from; i < contacts_.size(); ++i)
    if (moving.mesh.is_on(moving.surface, on_moving, contacts_[i].flat_moving) &&
        fixed.mesh.is_on(fixed.surface, on_fixed, contacts_[i].flat_fixed))
      return &contacts_[i];
  return nullptr;
}

bool FlatContacts::is_level_with(const Contact& contact, const Vec3& p_W, const Vec3& q_W) const {
  const double distance = contact.lmd.distance, reach = TOUCHING * coordinates_ + tolerance_;
  return (q_W - p_W - distance * contact.lmd.direction).norm() <=
         SAME_DISTANCE * distance + reach + PARALLEL_TILT * (q_W - contact.lmd.point_fixed).norm();
}

bool FlatContacts::is_at(std::size_t i, const Vec3& p_W, const Vec3& q_W) const {
  const Contact& contact = contacts_[i];
  const double reach = TOUCHING * coordinates_ + tolerance_;
  if (!is_level_with(contact, p_W, q_W)) return false;
  if (contact.count == 0) {
    const Vec3 along_segment = contact.end1 - contact.end0;
    const double t =
        std::clamp((q_W - contact.end0).dot(along_segment) / along_segment.squaredNorm(), 0.0, 1.0);
    return (contact.end0 + t * along_segment - q_W).norm() <= reach;
  }
  const Vec2 x = frames_[i].flat(q_W);
  return std::ranges::any_of(pieces_of(contact),
                             [&](const ConvexPolygon& piece) { return is_inside(piece, x, reach); });
}

bool FlatContacts::contains(const FlatSide& moving, const FeatureId& on_moving, const FlatSide& fixed,
                            const FeatureId& on_fixed, const Vec3& p_W, const Vec3& q_W) const {
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (is_at(i, p_W, q_W) && moving.mesh.is_on(moving.surface, on_moving, contacts_[i].flat_moving) &&
        fixed.mesh.is_on(fixed.surface, on_fixed, contacts_[i].flat_fixed))
      return true;
  return false;
}

}  // namespace lmdbench
