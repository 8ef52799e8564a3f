// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/geometry/extent.h>
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/triangle_sides.h>
#include <lmdbench/methods/certified/decide/touch.h>
#include <lmdbench/methods/certified/decide/touching_pairs.h>
#include <lmdbench/methods/certified/decide/triangle_contact_batch.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace lmdbench {

namespace {

/// With more pairs of corners the sides are not tried as separating axes: testing triangles is
/// cheaper (scripts/tuned_constants.py --only MOST_CORNER_PAIRS
/// experiments/extreme/peg-square.json).
constexpr std::size_t MOST_CORNER_PAIRS = 64;

/// So many corners of a hull are tried first: they often lie on both sides of a plane.
constexpr std::size_t FEW_CORNERS = 4;

/// Two triangles are clearly apart where a gap is wider than this many touches; they clearly do not
/// intersect where it is wider than this many roundings.
constexpr double MARGIN_IN_TOUCHES = 2.0, CLEAR_ROUNDINGS = 4.0;

/// Sine of the angle above which what a wall shares with the plane that it stands on is its edge,
/// to a few hundred roundings: less than the tolerance.
constexpr double LEAST_SINE_OF_WALL = 0.01;

/// The exact kernel measures crossings along less than this part of the triangles' longest side:
/// pieces weigh in a contact's middle by their lengths, so where all are short errors would count.
constexpr double LEAST_CROSSING_LENGTH = 1e-4;

using FeaturePair = std::pair<FeatureId, FeatureId>;

Vec3 face_normal(const ShapeSide& side, std::int32_t face) {
  return side.direction(side.surface.face_normals[static_cast<std::size_t>(face)]);
}

Segment segment_of(const ShapeSide& side, std::int32_t chain) {
  const auto& ends = side.shape.ends_of_chain(chain);
  return {side.vertex(ends[0]), side.vertex(ends[1])};
}

Vec3 from_end_to_end(const ShapeSide& side, std::int32_t chain) {
  const Segment segment = segment_of(side, chain);
  return segment[1] - segment[0];
}

bool is_on_chain(const ShapeSide& side, std::int32_t vertex, std::int32_t chain) {
  return std::ranges::any_of(side.surface.adjacency.vertex_triangles[vertex], [&](std::int32_t t) {
    return std::ranges::any_of(
        side.surface.adjacency.triangle_edges[static_cast<std::size_t>(t)], [&](std::int32_t e) {
          const auto& ends = side.surface.adjacency.edges[static_cast<std::size_t>(e)];
          return side.shape.chain_of(e) == chain && (ends[0] == vertex || ends[1] == vertex);
        });
  });
}

/// Gap between points and a plane, with the axis from the points towards it.
ClearGap gap_to(const Plane& plane, std::span<const Vec3> points) {
  Extent heights;
  for (const Vec3& p : points) heights.add(plane.height(p));
  return heights.least >= -heights.greatest ? ClearGap{heights.least, -plane.normal}
                                            : ClearGap{-heights.greatest, plane.normal};
}

/// The same for a region, by its hull: of a gear's thousands of corners some eighty.
ClearGap gap_to(const Plane& plane, const ShapeSide& side, const RegionShape& shape) {
  const Vec3& origin = shape.frame.origin;
  const double height = plane.height(side.is_moving ? side.X_WS.point(origin) : origin);
  const Vec2 rise(plane.normal.dot(side.direction(shape.frame.u)),
                  plane.normal.dot(side.direction(shape.frame.v)));
  // Nearly all regions lie on both sides, which a few corners tell.
  Extent of_few;
  for (std::size_t k = 0; k < FEW_CORNERS && !shape.hull.empty(); ++k)
    of_few.add(height + rise.dot(shape.hull[k * shape.hull.size() / FEW_CORNERS]));
  if (of_few.least < 0.0 && of_few.greatest > 0.0) return {};
  const Extent along = extent_along(shape.hull, rise);
  const double least = height + along.least, greatest = height + along.greatest;
  return least >= -greatest ? ClearGap{least, -plane.normal} : ClearGap{-greatest, plane.normal};
}

/// Largest gap between two regions along the products of two sides, which with their planes are all
/// separating axes. No wall's plane separates a box from a box that it stands over.
ClearGap gap_along_side_products(const ShapeSide& moving, std::int32_t region_moving,
                                 std::span<const Vec3> corners_moving, const ShapeSide& fixed,
                                 std::int32_t region_fixed, std::span<const Vec3> corners_fixed) {
  ClearGap widest;
  for (const std::int32_t s : moving.shape.regions.straight_edges_of_region[region_moving]) {
    const Vec3 u = from_end_to_end(moving, s);
    for (const std::int32_t t : fixed.shape.regions.straight_edges_of_region[region_fixed]) {
      const Vec3 product = u.cross(from_end_to_end(fixed, t));
      const double length = product.norm();
      if (!(length > 0.0)) continue;
      const Vec3 axis = product / length;
      const Extent of_moving = extent_along(corners_moving, axis),
                   of_fixed = extent_along(corners_fixed, axis);
      const double ahead = of_fixed.least - of_moving.greatest, behind = of_moving.least - of_fixed.greatest;
      if (ahead > widest.gap) widest = {ahead, axis};
      if (behind > widest.gap) widest = {behind, -axis};
    }
  }
  return widest;
}

void ask(const ShapeSide& of_corner, const FeatureId& corner, const FeatureId& feature,
         std::vector<FeaturePair>& asked) {
  asked.push_back(of_corner.is_moving ? FeaturePair(corner, feature) : FeaturePair(feature, corner));
}

/// Notes corners of a triangle within touch of another, each with the other's corners and chains.
void note_corners(const TouchingPairs::Frame& frame, const ShapeSide& of_corners, std::int32_t t_corners,
                  const ShapeSide& other, std::int32_t t_other, std::vector<FeaturePair>& asked) {
  const Triangle triangle = other.triangle(t_other);
  for (const std::int32_t v : of_corners.surface.mesh.triangles[static_cast<std::size_t>(t_corners)]) {
    if (!of_corners.shape.is_corner(v)) continue;
    const double squared = point_triangle_distance(of_corners.vertex(v), triangle).squared_distance;
    if (squared > frame.touch * frame.touch) continue;
    const FeatureId corner{FeatureKind::VERTEX, v};
    // Pairs of corners are asked for once, from the moving mesh.
    if (of_corners.is_moving)
      for (const std::int32_t w : other.surface.mesh.triangles[static_cast<std::size_t>(t_other)])
        ask(of_corners, corner, {FeatureKind::VERTEX, w}, asked);
    for (const std::int32_t e : other.surface.adjacency.triangle_edges[static_cast<std::size_t>(t_other)])
      if (const std::int32_t chain = other.shape.chain_of(e); chain >= 0)
        ask(of_corners, corner, {FeatureKind::EDGE, other.shape.lead_of_chain(chain)}, asked);
  }
}

/// The same for chains if they are parallel: the direction of their contacts is one between points,
/// too.
void note_if_parallel(const TouchingPairs::Frame& frame, std::int32_t of_moving, std::int32_t of_fixed,
                      std::vector<FeaturePair>& asked) {
  const ShapeSide &moving = frame.pair.moving, &fixed = frame.pair.fixed;
  const Vec3 u = from_end_to_end(moving, of_moving), v = from_end_to_end(fixed, of_fixed);
  if (u.cross(v).norm() > 2.0 * frame.pair.tolerance.largest_tilt * u.norm() * v.norm()) return;
  asked.emplace_back(FeatureId{FeatureKind::EDGE, moving.shape.lead_of_chain(of_moving)},
                     FeatureId{FeatureKind::EDGE, fixed.shape.lead_of_chain(of_fixed)});
}

void note_parallel_chains(const TouchingPairs::Frame& frame, std::int32_t t_moving, std::int32_t t_fixed,
                          std::vector<FeaturePair>& asked) {
  const ShapeSide &moving = frame.pair.moving, &fixed = frame.pair.fixed;
  for (const std::int32_t e : moving.surface.adjacency.triangle_edges[static_cast<std::size_t>(t_moving)])
    for (const std::int32_t f : fixed.surface.adjacency.triangle_edges[static_cast<std::size_t>(t_fixed)])
      if (const std::int32_t c = moving.shape.chain_of(e), d = fixed.shape.chain_of(f); c >= 0 && d >= 0)
        note_if_parallel(frame, c, d, asked);
}

void note_crossing(const TouchingPairs::Frame& frame, std::int32_t t_moving, std::int32_t t_fixed) {
  if (frame.crossing_pairs != nullptr) frame.crossing_pairs->push_back({frame.body, t_moving, t_fixed});
}

}  // namespace

/// Pairs of triangles that are decided together, in vectors.
struct TouchingPairs::Batch {
  static constexpr std::size_t SIZE = 64;
  struct Entry {
    std::int32_t moving, fixed;
    std::size_t place;  ///< In certificates_.
  };
  std::array<Triangle, SIZE> moving, fixed;
  std::array<Entry, SIZE> entries;
  std::size_t count = 0;

  bool is_full() const { return count == SIZE; }
  void push(const Triangle& of_moving, const Triangle& of_fixed, const Entry& entry) {
    moving[count] = of_moving;
    fixed[count] = of_fixed;
    entries[count++] = entry;
  }
};

std::span<const Certificate> TouchingPairs::decide(Frame& frame, std::span<const WidePair> pairs) {
  const ShapeSide &moving = frame.pair.moving, &fixed = frame.pair.fixed;
  const double margin = MARGIN_IN_TOUCHES * frame.touch;
  certificates_.assign(pairs.size(), Certificate{});
  Batch batch, not_crossing;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const FeatureId on_moving = pairs[k].a.feature_id(), on_fixed = pairs[k].b.feature_id();
    ++frame.pairs;
    if (moving.shape_of_lead(on_moving.index) != nullptr || fixed.shape_of_lead(on_fixed.index) != nullptr) {
      certificates_[k] = decide_regions(frame, pairs[k]);
      continue;
    }
    const Triangle t_moving = moving.triangle(on_moving.index), t_fixed = fixed.triangle(on_fixed.index);
    if (!frame.keeps && gap_along_normals(t_moving, face_normal(moving, on_moving.index), t_fixed,
                                          face_normal(fixed, on_fixed.index), margin)
                                .gap > margin)
      continue;
    batch.push(t_moving, t_fixed, {on_moving.index, on_fixed.index, k});
    if (batch.is_full()) decide_batch(frame, batch, not_crossing);
  }
  if (batch.count > 0) decide_batch(frame, batch, not_crossing);
  if (not_crossing.count > 0) decide_not_crossing(frame, not_crossing);
  // Each once: a vertex is a corner of all its triangles.
  std::ranges::sort(asked_);
  asked_.erase(std::unique(asked_.begin(), asked_.end()), asked_.end());
  for (const auto& [on_moving, on_fixed] : asked_)
    lmdbench::decide(frame.pair, on_moving, on_fixed, frame.contacts);
  asked_.clear();
  return certificates_;
}

void TouchingPairs::decide_batch(Frame& frame, Batch& batch, Batch& not_crossing) {
  std::array<ClearCrossing, Batch::SIZE> crossings;
  find_clear_crossings(std::span(batch.moving).first(batch.count), std::span(batch.fixed).first(batch.count),
                       std::span(crossings).first(batch.count));
  for (std::size_t k = 0; k < batch.count; ++k) {
    const Batch::Entry& entry = batch.entries[k];
    const double length = crossings[k].length;
    if (length > 0.0 && length * length > LEAST_CROSSING_LENGTH * LEAST_CROSSING_LENGTH *
                                              std::max(squared_longest_side(batch.moving[k]),
                                                       squared_longest_side(batch.fixed[k]))) {
      ++frame.triangle_distances;
      frame.intersections.push_back({{FeatureKind::FACE, entry.moving},
                                     {FeatureKind::FACE, entry.fixed},
                                     entry.moving,
                                     entry.fixed,
                                     frame.body,
                                     1,
                                     length,
                                     crossings[k].middle});
      note_crossing(frame, entry.moving, entry.fixed);
      continue;
    }
    not_crossing.push(batch.moving[k], batch.fixed[k], entry);
    if (not_crossing.is_full()) decide_not_crossing(frame, not_crossing);
  }
  batch.count = 0;
}

void TouchingPairs::decide_not_crossing(Frame& frame, Batch& batch) {
  const double margin = MARGIN_IN_TOUCHES * frame.touch;
  std::array<ClearGap, Batch::SIZE> gaps;
  find_clear_gaps(std::span(batch.moving).first(batch.count), std::span(batch.fixed).first(batch.count),
                  std::span(gaps).first(batch.count));
  for (std::size_t k = 0; k < batch.count; ++k) {
    const Batch::Entry& entry = batch.entries[k];
    certificates_[entry.place] = gaps[k].gap > margin ? Certificate{gaps[k].gap - margin, gaps[k].axis}
                                                      : decide_triangles(frame, entry.moving, entry.fixed);
  }
  batch.count = 0;
}

/// Compares two triangles exactly, and lists what they share.
TrianglePairDistance TouchingPairs::intersect(Frame& frame, std::int32_t t_moving, std::int32_t t_fixed) {
  TrianglePairDistance nearest =
      triangle_distance(frame.pair.moving.triangle(t_moving), frame.pair.fixed.triangle(t_fixed));
  ++frame.triangle_distances;
  if (nearest.intersecting) {
    note_crossing(frame, t_moving, t_fixed);
    frame.intersections.push_back(intersection_of(frame.pair, t_moving, t_fixed, frame.body, nearest));
  }
  return nearest;
}

/// Decides two triangles exactly.
Certificate TouchingPairs::decide_triangles(Frame& frame, std::int32_t t_moving, std::int32_t t_fixed) {
  const ShapeSide &moving = frame.pair.moving, &fixed = frame.pair.fixed;
  const TrianglePairDistance nearest = intersect(frame, t_moving, t_fixed);
  const double distance = std::sqrt(nearest.squared_distance);
  if (distance <= frame.touch) {
    note_corners(frame, moving, t_moving, fixed, t_fixed, asked_);
    note_corners(frame, fixed, t_fixed, moving, t_moving, asked_);
    note_parallel_chains(frame, t_moving, t_fixed, asked_);
    return {};
  }
  return {distance - MARGIN_IN_TOUCHES * frame.touch, (nearest.point_b - nearest.point_a) / distance};
}

/// One feature of a pair of faces and regions.
struct TouchingPairs::Half {
  const ShapeSide& side;
  std::int32_t lead, region;  ///< Region -1: a triangle without area.
  const RegionShape* shape;   ///< Of a region of several faces.
  std::vector<Vec3>& corners;

  Half(const ShapeSide& of_side, const FeatureId& face, std::vector<Vec3>& room)
      : side(of_side),
        lead(face.index),
        region(side.shape.region_of(lead)),
        shape(side.shape_of_lead(lead)),
        corners(room) {}

  /// Whether all of its corners and chains are on its border, each chain once.
  bool has_plain_border() const {
    return shape != nullptr && !shape->has_features_inside && shape->sides.size() == chains().size();
  }
  std::span<const std::int32_t> chains() const { return side.shape.regions.straight_edges_of_region[region]; }
  /// Calls visit(chain) for all chains of the border whose boxes are near a segment of the world,
  /// and some others. @pre has_plain_border()
  template <class Visit>
  void for_each_chain_near(const Vec3& from, const Vec3& to, double within, Visit&& visit) const {
    const auto flat = [&](const Vec3& p) { return shape->frame.flat(side.point_to_surface(p)); };
    shape->side_grid.for_each_near(flat(from), flat(to), within,
                                   [&](std::int32_t k) { visit(chains()[static_cast<std::size_t>(k)]); });
  }
  std::size_t corner_count() const { return shape != nullptr ? shape->corners.size() : 3; }
  void collect_corners() const {
    if (shape == nullptr) {
      const Triangle t = side.triangle(lead);
      corners.assign(t.begin(), t.end());
      return;
    }
    corners.clear();
    for (const std::int32_t v : shape->corners) corners.push_back(side.vertex(v));
  }
  /// From this one's plane to the other one.
  ClearGap gap_to_other(const Half& other) const {
    if (region < 0) return {};
    const Plane plane = side.plane(region);
    return other.shape != nullptr ? gap_to(plane, other.side, *other.shape)
                                  : gap_to(plane, other.side.triangle(other.lead));
  }
  Vec3 normal() const { return side.plane(region).normal; }
  /// Least height of its corners over another region's plane; of one that is more than `enough`
  /// below it, that of any such corner.
  double height_over(const Half& base, double enough) const {
    const Plane plane = base.side.plane(base.region);
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t v : shape->corners)
      if ((least = std::min(least, plane.height(side.vertex(v)))) < -enough) break;
    return least;
  }
  /// The faces that are near to points of the world.
  void find_faces_near(std::span<const Vec3> points, double within, std::vector<std::int32_t>& faces) const {
    if (shape == nullptr) return faces.assign(1, lead);
    Box2 box;
    for (const Vec3& p : points) box.add(shape->frame.flat(side.point_to_surface(p)));
    faces.clear();
    side.shape.for_each_face_near(region, box, within, [&](std::int32_t t) {
      faces.push_back(t);
      return true;
    });
  }
};

/// Decides a pair with a region of several faces: by gaps between outlines, then by what is near.
Certificate TouchingPairs::decide_regions(Frame& frame, const WidePair& pair) {
  const ShapeSide &moving = frame.pair.moving, &fixed = frame.pair.fixed;
  const Half m(moving, pair.a.feature_id(), points_moving_), f(fixed, pair.b.feature_id(), points_fixed_);
  const double margin = MARGIN_IN_TOUCHES * frame.touch;
  if (const ClearGap gap = f.gap_to_other(m); gap.gap > margin) return {gap.gap - margin, gap.axis};
  if (const ClearGap gap = m.gap_to_other(f); gap.gap > margin) return {gap.gap - margin, -gap.axis};
  if (m.corner_count() * f.corner_count() <= MOST_CORNER_PAIRS && m.region >= 0 && f.region >= 0) {
    m.collect_corners();
    f.collect_corners();
    if (const ClearGap gap = gap_along_side_products(moving, m.region, m.corners, fixed, f.region, f.corners);
        gap.gap > margin)
      return {gap.gap - margin, gap.axis};
  }
  decide_near_regions(frame, m, f);
  return {};
}

/// Where borders tell what is within touch, triangles are compared for what intersects alone, and
/// not at all where nothing can, or as long as a contact stands for what touches.
void TouchingPairs::decide_near_regions(Frame& frame, const Half& m, const Half& f) {
  if (!m.has_plain_border() || !f.has_plain_border()) return decide_triangles_of(frame, m, f, false);
  const double rounding = frame.pair.tolerance.rounding;
  const double of_m = m.height_over(f, rounding), of_f = f.height_over(m, rounding);
  const bool is_opposed = are_opposed(frame, m, f);
  if (!is_opposed &&
      (std::max(of_m, of_f) < -rounding || m.normal().cross(f.normal()).norm() < LEAST_SINE_OF_WALL))
    return decide_triangles_of(frame, m, f, false);
  note_along_borders(frame, m, f);
  if (std::max(of_m, of_f) > CLEAR_ROUNDINGS * rounding) return;
  std::optional<RestingRegions> resting;
  if (frame.crossing_pairs == nullptr)
    resting = is_opposed     ? find_rest(frame, m, f)
              : of_m >= of_f ? find_chain_at_rest(frame, m, f)
                             : find_chain_at_rest(frame, f, m);
  if (resting)
    frame.resting.push_back(*resting);
  else
    decide_triangles_of(frame, m, f, true);
}

/// Decides the triangles of the one with more corners near the other, against those of the other
/// near each of them.
/// @param is_noted  only what intersects is wanted
void TouchingPairs::decide_triangles_of(Frame& frame, const Half& m, const Half& f, bool is_noted) {
  const ShapeSide &moving = frame.pair.moving, &fixed = frame.pair.fixed;
  const double margin =
      is_noted ? CLEAR_ROUNDINGS * frame.pair.tolerance.rounding : MARGIN_IN_TOUCHES * frame.touch;
  const bool moving_is_large = m.corner_count() > f.corner_count();
  const Half &large = moving_is_large ? m : f, &small = moving_is_large ? f : m;
  small.collect_corners();
  large.find_faces_near(small.corners, margin, faces_of_large_);
  for (const std::int32_t t_large : faces_of_large_) {
    const Triangle t = large.side.triangle(t_large);
    // Of a gear's thousands of triangles few reach the plane of a tooth.
    if (small.region >= 0 && gap_to(small.side.plane(small.region), t).gap > margin) continue;
    small.find_faces_near(t, margin, faces_of_small_);
    for (const std::int32_t t_small : faces_of_small_) {
      ++frame.pairs;
      const std::int32_t t_moving = moving_is_large ? t_large : t_small;
      const std::int32_t t_fixed = moving_is_large ? t_small : t_large;
      if (clear_gap(moving.triangle(t_moving), face_normal(moving, t_moving), fixed.triangle(t_fixed),
                    face_normal(fixed, t_fixed), margin)
              .gap > 0.0)
        continue;
      if (is_noted)
        intersect(frame, t_moving, t_fixed);
      else
        decide_triangles(frame, t_moving, t_fixed);
    }
  }
}

/// Notes corners and chains within touch of each other, of regions that have all of theirs on their
/// borders. (Of regions whose triangles are compared for it this does not pay: the border of a
/// gear's face has thousands of chains.)
void TouchingPairs::note_along_borders(Frame& frame, const Half& a, const Half& b) {
  const double margin = MARGIN_IN_TOUCHES * frame.touch;
  const bool b_has_fewer = b.chains().size() < a.chains().size();
  const Half &few = b_has_fewer ? b : a, &many = b_has_fewer ? a : b;
  const auto note_ends = [&](const Half& of_corners, std::int32_t of_ends, const Half& of_chain,
                             std::int32_t chain) {
    const Segment segment = segment_of(of_chain.side, chain);
    for (const std::int32_t v : of_corners.side.shape.ends_of_chain(of_ends)) {
      const Vec3 p = of_corners.side.vertex(v);
      if (point_segment_distance(p, segment).squared_distance > margin * margin) continue;
      const FeatureId corner{FeatureKind::VERTEX, v};
      ask(of_corners.side, corner, {FeatureKind::EDGE, of_chain.side.shape.lead_of_chain(chain)}, asked_);
      // Pairs of corners are asked for once, from the moving mesh.
      if (of_corners.side.is_moving)
        for (const std::int32_t w : of_chain.side.shape.ends_of_chain(chain))
          ask(of_corners.side, corner, {FeatureKind::VERTEX, w}, asked_);
    }
  };
  for (const std::int32_t chain : few.chains()) {
    const Segment segment = segment_of(few.side, chain);
    ++frame.pairs;
    many.for_each_chain_near(segment[0], segment[1], margin, [&](std::int32_t other) {
      ++frame.pairs;
      note_ends(few, chain, many, other);
      note_ends(many, other, few, chain);
      note_if_parallel(frame, few.side.is_moving ? chain : other, few.side.is_moving ? other : chain, asked_);
    });
  }
}

/// Whether two regions face each other in parallel planes.
bool TouchingPairs::are_opposed(const Frame& frame, const Half& m, const Half& f) {
  const Vec3 of_moving = m.normal(), of_fixed = f.normal();
  return of_moving.dot(of_fixed) < 0.0 &&
         of_moving.cross(of_fixed).norm() <= 2.0 * frame.pair.tolerance.largest_tilt;
}

/// Two opposed regions whose triangles need not be compared, as they rest on each other.
std::optional<RestingRegions> TouchingPairs::find_rest(const Frame& frame, const Half& m, const Half& f) {
  const double rounding = frame.pair.tolerance.rounding;
  const Plane of_moving = m.side.plane(m.region), of_fixed = f.side.plane(f.region);
  const auto is_all_above = [&](const Half& half, const Plane& plane) {
    return std::ranges::all_of(half.side.shape.regions.region_triangles[half.region],
                               [&](std::int32_t t) { return is_above(half.side, t, plane, rounding); });
  };
  if (!is_all_above(m, of_fixed) && !is_all_above(f, of_moving)) return std::nullopt;
  std::vector<Vec2> outline;
  for (const std::int32_t v : m.shape->corners) outline.push_back(f.shape->frame.flat(m.side.vertex(v)));
  RestingRegions resting{
      m.region, f.region, {FeatureKind::FACE, m.region}, {FeatureKind::FACE, f.region}, {}};
  for (const Vec2& corner :
       ConvexPolygon(convex_hull(std::move(outline))).cut_by(ConvexPolygon(f.shape->hull)).corners)
    resting.shared_W.extend(f.shape->frame.lifted(corner));  // The fixed mesh's frame is the world.
  if (resting.shared_W.isEmpty()) return std::nullopt;       // They touch along a border at most.
  return resting;
}

/// The same for a wall whose only chain on the plane that it stands on is all that touches.
/// @pre the wall is at an angle to the plane and nowhere below it by more than rounding
std::optional<RestingRegions> TouchingPairs::find_chain_at_rest(const Frame& frame, const Half& wall,
                                                                const Half& base) {
  const double rounding = frame.pair.tolerance.rounding;
  const Plane plane = base.side.plane(base.region);
  std::int32_t touching = -1;
  for (const std::int32_t chain : wall.chains()) {
    const auto is_above = [&](const Vec3& p) { return plane.height(p) > 2.0 * rounding; };
    if (std::ranges::any_of(segment_of(wall.side, chain), is_above)) continue;
    if (touching >= 0) return std::nullopt;
    touching = chain;
  }
  if (touching < 0) return std::nullopt;
  // Of a triangle beside the chain, with no corner on it, no contact of the chain tells; nor of one
  // that leaves an end of the chain along the plane, which it may meet farther on.
  const Segment ends = segment_of(wall.side, touching);
  const Vec3 along = (ends[1] - ends[0]).normalized();
  const auto beyond_chain = [&](const Vec3& p) {
    return std::max(along.dot(ends[0] - p), along.dot(p - ends[1]));
  };
  const auto is_at_chain_alone = [&](std::int32_t v) {
    const Vec3 p = wall.side.vertex(v);
    const double height = plane.height(p);
    return height > CLEAR_ROUNDINGS * rounding ? height >= LEAST_SINE_OF_WALL * beyond_chain(p)
                                               : is_on_chain(wall.side, v, touching);
  };
  for (const std::int32_t t : wall.side.shape.regions.region_triangles[wall.region])
    if (!std::ranges::all_of(wall.side.surface.mesh.triangles[static_cast<std::size_t>(t)],
                             is_at_chain_alone))
      return std::nullopt;
  const auto flat = [&](const Vec3& p) { return base.shape->frame.flat(base.side.point_to_surface(p)); };
  const SegmentPart part = ConvexPolygon(base.shape->hull).part_of(flat(ends[0]), flat(ends[1]), rounding);
  if (!(part.begin < part.end)) return std::nullopt;
  const FeatureId chain{FeatureKind::EDGE, touching}, region{FeatureKind::FACE, base.region};
  RestingRegions resting = wall.side.is_moving ? RestingRegions{wall.region, base.region, chain, region, {}}
                                               : RestingRegions{base.region, wall.region, region, chain, {}};
  for (const double share : {part.begin, part.end})
    resting.shared_W.extend(Vec3(ends[0] + share * (ends[1] - ends[0])));
  return resting;
}

void TouchingPairs::compare(Frame& frame, const RestingRegions& regions) {
  const auto half = [](const ShapeSide& side, std::int32_t region, std::vector<Vec3>& room) {
    return Half(side, {FeatureKind::FACE, side.shape.regions.region_triangles[region].front()}, room);
  };
  decide_triangles_of(frame, half(frame.pair.moving, regions.moving, points_moving_),
                      half(frame.pair.fixed, regions.fixed, points_fixed_), true);
}

}  // namespace lmdbench
