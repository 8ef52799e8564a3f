// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/decide.h>
#include <lmdbench/decision/overlap.h>
#include <lmdbench/decision/pair_conditions.h>
#include <lmdbench/decision/polar_condition.h>
#include <lmdbench/geometry/extent.h>
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace lmdbench {

namespace {

/// Error of a height over a plane, in roundings: one of the plane, one of the point.
constexpr double HEIGHT_ROUNDINGS = 2.0;
/// Distance from the border of a region beyond which its polygon alone decides, in roundings.
constexpr double CLEAR_ROUNDINGS = 2.0;
/// Largest part along a chain of the vector between clamped feet on crossing chains, in roundings.
constexpr double SIDEWAYS_ROUNDINGS = 4.0;
/// Error of the direction square to crossing chains, over rounding / (sine * length).
constexpr double CROSSING_ROUNDING = 1.0 / 16.0;
/// Largest slack for that error: hierarchies bound directions to 2e-6 (POLAR_SLACK). Chains with a
/// larger error have an extended contact, if any.
constexpr double LARGEST_CROSSING_SLACK = 1e-6;
/// Pseudo-normals that differ by less say not where two features face each other.
constexpr double LEAST_FACING = 1e-3;
/// Slack of the box or triangle round a region, in roundings; its own condition has less.
constexpr double BOUND_ROUNDINGS = 8.0;

/// Parameter of the point of a chain that is nearest to x.
double foot_on_line(const Line& line, const Vec3& x) {
  return std::clamp((x - line.ends[0]).dot(line.along) / (line.length * line.length), 0.0, 1.0);
}

/// Signed length from x along the direction n to a plane.
double height_to(const Plane& plane, const Vec3& n, const Vec3& x) {
  LMDBENCH_EXPECTS(std::abs(plane.normal.dot(n)) > 0.5,
                   "a direction that is not near to the normal: only parallel features are asked");
  return plane.normal.dot(plane.point - x) / plane.normal.dot(n);
}

/// Gives each condition a slack for rounding, and appends the contacts of pairs that satisfy all.
class Decision {
 public:
  Decision(const ShapePair& pair, const FeatureId& f, const FeatureId& g, ContactSet& found)
      : moving_(pair.moving), fixed_(pair.fixed), f_(f), g_(g), tolerance_(pair.tolerance), found_(found) {}

  // Conditions (pair_conditions.h).

  bool is_long(const Line& line) const { return line.length > 0.0; }
  bool has_area(const Plane& plane) const { return !plane.normal.isZero(0.0); }
  bool near(const ShapeSide& /*from*/, const Vec3& /*p*/, const Vec3& /*q*/, const Vec3& d) {
    distance_ = d.norm();
    return distance_ <= tolerance_.reach;
  }
  bool above(const ShapeSide& /*from*/, double height, const auto& /*gradient*/) const {
    return height > -tolerance_.rounding;
  }
  bool below_reach(const ShapeSide& /*from*/, double height, const auto& /*gradient*/) const {
    return height <= tolerance_.reach;
  }
  bool foot_on(const ShapeSide& /*from*/, const Vec3& /*p*/, const Line& line, double parameter) const {
    return line.beyond(parameter) <= tolerance_.rounding;
  }
  static double clamped(double parameter) { return std::clamp(parameter, 0.0, 1.0); }
  bool in_box(const ShapeSide& /*from*/, double inside, const auto& /*gradient*/) const {
    return inside >= -BOUND_ROUNDINGS * tolerance_.rounding;
  }
  bool in_triangle(const ShapeSide& /*from*/, double inside, const Vec3& side, const Vec3& /*opposite*/,
                   const auto& /*gradient*/) const {
    return inside >= -BOUND_ROUNDINGS * tolerance_.rounding * side.norm();
  }
  bool parallel(double sine) const { return sine <= tolerance_.largest_tilt; }
  bool crosses(const Line& a, const Line& b, const Vec3& /*product*/, double sine) {
    if (sine <= tolerance_.largest_tilt) parallel_chains(a, b);
    // Nearer to parallel than their directions are known.
    return sine * std::min(a.length, b.length) > tolerance_.rounding;
  }
  bool feet_on(const Crossing& x) {
    spare_ = tolerance_.rounding / x.sine;
    return x.a.beyond(x.s) <= spare_ && x.b.beyond(x.t) <= spare_;
  }
  std::optional<Vec3> perpendicular(const Crossing& x) {
    // Each foot alone is off by rounding / sine along its chain. So the second is the foot of the
    // first, which may be clamped, and then the first the foot of the second.
    q_ = x.b.at(foot_on_line(x.b, x.a.at(clamped(x.s))));
    p_ = x.a.at(foot_on_line(x.a, q_));
    const Vec3 d = q_ - p_;
    distance_ = d.norm();
    const double sideways =
        std::max(std::abs(d.dot(x.a.along)) / x.a.length, std::abs(d.dot(x.b.along)) / x.b.length);
    if (distance_ > tolerance_.reach || sideways > SIDEWAYS_ROUNDINGS * tolerance_.rounding)
      return std::nullopt;
    // d is known to rounding / length; the product also where chains touch, worse at small angles.
    const double shortest = std::min(x.a.length, x.b.length);
    const bool is_far = CROSSING_ROUNDING * distance_ > x.sine * shortest;
    Vec3 u = is_far ? Vec3(d / distance_) : Vec3(x.product / std::sqrt(x.squared_product));
    if (std::abs(d.dot(u)) <= tolerance_.rounding) {
      if (u.dot(facing()) < 0.0) u = -u;
    } else if (d.dot(u) < 0.0) {
      u = -u;
    }
    u_ = u;
    unknown_ = tolerance_.rounding / (is_far ? distance_ : x.sine * shortest / CROSSING_ROUNDING);
    return u;
  }

  /// For BetweenPoints and SquareToLine.
  bool in_cone(const ShapeSide& side, const FeatureId& /*lead*/, const Vec3& d, const auto& /*how*/) const {
    return is_touching(distance_) || admits(side, feature_of(side), d / distance_, between_points(distance_));
  }
  bool in_cone(const ShapeSide& side, const FeatureId& /*lead*/, const Vec3& u,
               const AlongNormal& /*how*/) const {
    return admits(side, feature_of(side), u, along_normal());
  }
  bool in_cone(const ShapeSide& side, const FeatureId& /*lead*/, const Vec3& u,
               const Crossing& /*how*/) const {
    return admits(side, feature_of(side), u,
                  {along_normal().length, std::min(LARGEST_CROSSING_SLACK, unknown_)});
  }

  // Pairs that satisfy all.

  void share_points(const Vec3& p, const Vec3& q, const Vec3& d) {
    if (const auto both = direction_between(d, distance_, tolerance_.rounding))
      add_points(p, q, both->u, distance_, both->error, fall_of(*both, distance_));
  }

  void share_foot(const ShapeSide& of_corner, const ShapeSide& of_chain, const Vec3& p, const Vec3& q,
                  const Line& line, double parameter) {
    const bool forward = of_corner.is_moving;
    const Vec3 d = q - p;
    if (!is_touching(distance_) &&
        end_leads_down(of_chain, line, parameter, tolerance_.rounding, -d / distance_, distance_))
      return;
    if (const auto both = direction_between(forward ? d : Vec3(-d), distance_, tolerance_.rounding))
      add_points(forward ? p : q, forward ? q : p, both->u, distance_, both->error,
                 fall_of(*both, distance_));
  }

  void share_height(const ShapeSide& of_corner, const Vec3& p, const ShapeSide& of_region, const Plane& plane,
                    double height) {
    const Vec3 q = p - height * plane.normal;
    if (!region_admits(of_region, of_region.point_to_surface(q), plane.normal, std::abs(height))) return;
    if (of_corner.is_moving)
      add_points(p, q, -plane.normal, height, 0.0, 0.0);
    else
      add_points(q, p, plane.normal, height, 0.0, 0.0);
  }

  void share_perpendicular(const Crossing& x) {
    if (!end_leads_down(moving_, x.a, x.s, spare_, u_, distance_) &&
        !end_leads_down(fixed_, x.b, x.t, spare_, -u_, distance_) &&
        direction_about(u_, std::min(1.0, unknown_)))
      add_points(p_, q_, u_, (q_ - p_).dot(u_), unknown_, unknown_);
  }

  void face_region(const ShapeSide& of_chain, const Line& line, const ShapeSide& of_region,
                   const Plane& plane, double slope) {
    // From the chain to the region, square to the chain.
    const Vec3 n = -(plane.normal - slope / line.length * line.along).normalized();
    const double h0 = height_to(plane, n, line.ends[0]), h1 = height_to(plane, n, line.at(1.0));
    if (!admits(of_chain, feature_of(of_chain), n, along_normal())) return;
    const Vec3 foot0 = of_region.point_to_surface(line.ends[0] + h0 * n),
               foot1 = of_region.point_to_surface(line.at(1.0) + h1 * n);
    for (const SegmentPart& part :
         parts_over_region(foot0, foot1, of_region, feature_of(of_region).index, tolerance_.rounding)) {
      const double begin = h0 + part.begin * (h1 - h0), end = h0 + part.end * (h1 - h0);
      if (std::abs(end - begin) > tolerance_.known || std::max(begin, end) < -tolerance_.rounding ||
          std::min(begin, end) > tolerance_.reach)
        continue;
      Contact& contact = add(1);
      contact.least_gap = std::min(begin, end);
      contact.measure = (part.end - part.begin) * line.length;
      const std::array<Vec3, 2> on_chain{line.at(part.begin), line.at(part.end)};
      const std::array<Vec3, 2> on_region{on_chain[0] + begin * n, on_chain[1] + end * n};
      const bool forward = of_chain.is_moving;
      contact.ends_moving = forward ? on_chain : on_region;
      contact.ends_fixed = forward ? on_region : on_chain;
      set_middle(contact, forward ? n : Vec3(-n));
    }
  }

  void face_each_other(const Plane& plane_m, const Plane& plane_f) {
    const Vec3 n = direction_of(plane_m.normal, plane_f.normal);
    const PlanarFrame frame = frame_of_overlap(moving_, f_.index, fixed_, g_.index, plane_f.point, n);
    const auto gap_at = [&](const Vec3& x) { return height_to(plane_f, n, x) - height_to(plane_m, n, x); };
    // The distance of nearly parallel planes at one place bounds it everywhere.
    const double spread = tolerance_.largest_tilt * 4.0 * tolerance_.coordinates;
    const double somewhere = gap_at(plane_f.point);
    if (somewhere < -tolerance_.rounding - spread || somewhere > tolerance_.reach + spread) return;
    const std::size_t first = found_.contacts.size();
    std::vector<OverlapPart> parts =
        overlap_of_regions(moving_, f_.index, fixed_, g_.index, frame, SLIVER * tolerance_.rounding);
    for (OverlapPart& part : parts) {
      Extent gaps;
      for (const ConvexPolygon& piece : part.pieces)
        for (const Vec2& corner : piece.corners) gaps.add(gap_at(frame.lifted(corner)));
      if (gaps.greatest - gaps.least > tolerance_.known || gaps.greatest < -tolerance_.rounding ||
          gaps.least > tolerance_.reach || is_thin(part))
        continue;
      Contact& contact = add(2);
      contact.least_gap = gaps.least;
      contact.measure = part.area;
      contact.direction = n;
      const Vec3 x = frame.lifted(part.centroid);
      const double on_moving = height_to(plane_m, n, x), on_fixed = height_to(plane_f, n, x);
      contact.point_moving = x + on_moving * n;
      contact.point_fixed = x + on_fixed * n;
      contact.distance = std::abs(on_fixed - on_moving);
      contact.first_piece = static_cast<std::uint32_t>(found_.pieces.size());
      contact.piece_count = static_cast<std::uint32_t>(part.pieces.size());
      contact.frame = static_cast<std::uint32_t>(found_.frames.size());
      found_.frames.push_back(frame);
      std::ranges::move(part.pieces, std::back_inserter(found_.pieces));
    }
    const auto polygons = std::span(found_.contacts).subspan(first);
    if (polygons.size() == 1 && parts.size() == 1) polygons.front().is_whole = true;
  }

 private:
  /// Overlaps of two polygons that are narrower than this part of a rounding are none.
  static constexpr double SLIVER = 0.125;

  const FeatureId& feature_of(const ShapeSide& side) const { return side.is_moving ? f_ : g_; }
  PolarSlack between_points(double distance) const {
    return {tolerance_.rounding, tolerance_.rounding / distance};
  }
  /// The vector between points says nothing of their direction: it may be zero.
  bool is_touching(double distance) const {
    return distance <= Contact::TOUCHING_SHARE * tolerance_.rounding;
  }

  /// Direction of a contact between points; next to touch it is the one that both features admit.
  /// @param d  known to `spare`; sums of pseudo-normals stand for it where the points touch
  std::optional<KnownDirection> direction_between(const Vec3& d, double distance, double spare,
                                                  double tilt = 0.0) const {
    if (!is_touching(distance)) return direction_about(d / distance, std::min(1.0, spare / distance), tilt);
    const Vec3 u = facing();
    return direction_about(u.isZero(LEAST_FACING) ? Vec3::UnitX() : Vec3(u.normalized()), 1.0, tilt);
  }
  /// Sum of the outer sides of two corners or chains, or of their pseudo-normals where neither has
  /// one.
  Vec3 facing() const {
    const Vec3 f = moving_.shape.outer_side(moving_.surface, f_),
               g = fixed_.shape.outer_side(fixed_.surface, g_);
    if (!f.isZero(0.0) || !g.isZero(0.0)) return moving_.direction(f) - fixed_.direction(g);
    return moving_.direction(moving_.surface.pseudo_normal(moving_.shape.lead_of(f_))) -
           fixed_.direction(fixed_.surface.pseudo_normal(fixed_.shape.lead_of(g_)));
  }
  std::optional<KnownDirection> direction_about(const Vec3& u, double error, double tilt = 0.0) const {
    // A smaller error moves nothing by more than the tolerance over the meshes.
    if (error * tolerance_.coordinates <= tolerance_.known) return KnownDirection{u, error};
    return common_direction(moving_, f_, fixed_, g_, u, error, tolerance_.rounding, tilt);
  }
  double fall_of(const KnownDirection& known, double distance) const {
    const double rounded = tolerance_.direction_error(distance);
    const bool is_told_by_cones = known.error < rounded && known.error <= 4.0 * tolerance_.largest_tilt;
    return known.is_strict || is_told_by_cones ? 0.0 : std::min(known.error, rounded);
  }
  PolarSlack along_normal() const { return {HEIGHT_ROUNDINGS * tolerance_.rounding, 0.0}; }

  /// Slack for a wing: it leads down beyond tilt and rounding. At a distance of rounding none does.
  /// @param spare  how far the foot may be from the wing's end [m]: so much beside an obtuse inner
  ///   corner the neighbouring face is no nearer
  PolarSlack way_down(double distance, double spare) const {
    const double rounded = (tolerance_.rounding + spare) / std::max(distance, tolerance_.rounding);
    return {tolerance_.known, tolerance_.largest_tilt + rounded};
  }

  /// Whether a point of a chain lies at an end where a wing leads down: a closed condition must not
  /// make the end of a slit a minimum.
  /// @param spare  distance within which a point is at the end [m]
  /// @param u_W  from the chain to the other mesh
  bool end_leads_down(const ShapeSide& side, const Line& line, double parameter, double spare,
                      const Vec3& u_W, double distance) const {
    const auto& ends = side.shape.ends_of_chain(feature_of(side).index);
    const auto does = [&](std::int32_t end) {
      return leads_down(side, {FeatureKind::VERTEX, end}, u_W, way_down(distance, spare));
    };
    return (parameter * line.length <= spare && does(ends[0])) ||
           ((1.0 - parameter) * line.length <= spare && does(ends[1]));
  }

  /// Whether a point of a region's plane is on it, and no chain or corner there leads down.
  bool region_admits(const ShapeSide& side, const Vec3& p_S, const Vec3& n_W, double distance) const {
    const std::int32_t region = feature_of(side).index;
    const double rounding = tolerance_.rounding;
    if (const RegionShape* shape = side.shape.shapes.of_region(region))
      if (const auto clear = shape->clearly_holds(shape->frame.flat(p_S), CLEAR_ROUNDINGS * rounding))
        return *clear;
    const PolarSlack slack = way_down(distance, rounding);
    bool holds = false;
    const bool some_lead_down = !for_each_face_at(side, region, p_S, rounding, [&](std::int32_t face) {
      holds = true;
      const auto& edges = side.surface.adjacency.triangle_edges[static_cast<std::size_t>(face)];
      const bool chain_does = std::ranges::any_of(edges, [&](std::int32_t e) {
        const std::int32_t chain = side.shape.chain_of(e);
        if (chain < 0) return false;
        const auto& ends = side.surface.adjacency.edges[static_cast<std::size_t>(e)];
        const Vec3 nearest =
            point_segment_distance(p_S, {side.vertex_S(ends[0]), side.vertex_S(ends[1])}).point;
        return (nearest - p_S).norm() <= rounding && leads_down(side, {FeatureKind::EDGE, chain}, n_W, slack);
      });
      const auto& corners = side.surface.mesh.triangles[static_cast<std::size_t>(face)];
      return !chain_does && std::ranges::none_of(corners, [&](std::int32_t v) {
        return side.shape.is_corner(v) && (side.vertex_S(v) - p_S).norm() <= rounding &&
               leads_down(side, {FeatureKind::VERTEX, v}, n_W, slack);
      });
    });
    return holds && !some_lead_down;
  }

  /// Direction of contact of two regions: the mean of their normals if both meshes were rounded or
  /// neither was; else the normal of the exact one.
  Vec3 direction_of(const Vec3& normal_moving, const Vec3& normal_fixed) const {
    const bool moving_is_rounded = moving_.surface.mesh.planar_tolerance > 0.0;
    if (moving_is_rounded == (fixed_.surface.mesh.planar_tolerance > 0.0))
      return (normal_moving - normal_fixed).normalized();
    return moving_is_rounded ? Vec3(-normal_fixed) : normal_moving;
  }

  /// Whether an overlap is nowhere wider than half the tolerance: then its borders have contacts.
  bool is_thin(const OverlapPart& part) const {
    const double width = 0.5 * tolerance_.known;
    std::vector<Vec2> corners;
    for (const ConvexPolygon& piece : part.pieces) {
      const Box2 box = piece.box();
      // A convex polygon is wider than its area over its diameter.
      if (piece.measure().area > width * (box.high - box.low).norm()) return false;
      corners.insert(corners.end(), piece.corners.begin(), piece.corners.end());
    }
    return width_of(convex_hull(std::move(corners))) <= width;
  }

  void parallel_chains(const Line& a, const Line& b) {
    const double sense = a.along.dot(b.along) > 0.0 ? 1.0 : -1.0;
    const Vec3 w = (a.along / a.length + sense / b.length * b.along).normalized();
    // Places along w, from the moving chain's first end.
    const double end_a = a.along.dot(w), begin_b = (b.ends[0] - a.ends[0]).dot(w),
                 end_b = begin_b + b.along.dot(w);
    const double begin = std::max(0.0, std::min(begin_b, end_b)),
                 end = std::min(end_a, std::max(begin_b, end_b));
    if (!(end - begin > tolerance_.rounding)) return;
    Contact contact;
    contact.dimension = 1;
    contact.moving = f_;
    contact.fixed = g_;
    const auto on_moving = [&](double s) { return a.at(s / end_a); };
    const auto on_fixed = [&](double s) { return b.at((s - begin_b) / (end_b - begin_b)); };
    contact.ends_moving = {on_moving(begin), on_moving(end)};
    contact.ends_fixed = {on_fixed(begin), on_fixed(end)};
    const Vec3 d0 = contact.ends_fixed[0] - contact.ends_moving[0],
               d1 = contact.ends_fixed[1] - contact.ends_moving[1];
    contact.change = (d1 - d0).norm();
    if (contact.change > tolerance_.known) return;
    const Vec3 between = 0.5 * (d0 + d1), d = between - between.dot(w) * w;
    const double distance = d.norm();
    if (distance > tolerance_.reach) return;
    if (!is_touching(distance)) {
      const Vec3 u = d / distance;
      const PolarSlack slack{tolerance_.rounding, tolerance_.largest_tilt + tolerance_.rounding / distance};
      if (!admits(moving_, f_, u, slack) || !admits(fixed_, g_, -u, slack)) return;
    }
    const auto both =
        direction_between(d, distance, tolerance_.rounding + contact.change, tolerance_.largest_tilt);
    if (!both) return;
    contact.least_gap = std::min({d0.norm(), d1.norm(), distance});
    contact.measure = end - begin;
    contact.direction_error = both->error;
    contact.fall = fall_of(*both, distance);
    set_middle(contact, both->u);
    found_.contacts.push_back(contact);
  }

  void set_middle(Contact& contact, const Vec3& u) {
    LMDBENCH_EXPECTS(is_unit(u), "a direction that was not normalised");
    LMDBENCH_EXPECTS(contact.measure >= 0.0, "ends of a segment in the wrong order");
    contact.point_moving = 0.5 * (contact.ends_moving[0] + contact.ends_moving[1]);
    contact.point_fixed = 0.5 * (contact.ends_fixed[0] + contact.ends_fixed[1]);
    contact.distance = (contact.point_fixed - contact.point_moving).norm();
    contact.direction = u;
  }

  Contact& add(int dimension) {
    Contact& contact = found_.contacts.emplace_back();
    contact.moving = f_;
    contact.fixed = g_;
    contact.dimension = dimension;
    return contact;
  }

  void add_points(const Vec3& p, const Vec3& q, const Vec3& u, double gap, double direction_error,
                  double fall) {
    LMDBENCH_EXPECTS(is_unit(u), "points at one place: their direction is asked for where there is none");
    LMDBENCH_EXPECTS(gap <= tolerance_.reach, "a condition that lets pairs beyond the cutoff through");
    Contact& contact = add(0);
    contact.point_moving = p;
    contact.point_fixed = q;
    contact.direction = u;
    contact.distance = (q - p).norm();
    contact.least_gap = gap;
    contact.direction_error = direction_error;
    contact.fall = fall;
  }

  const ShapeSide& moving_;
  const ShapeSide& fixed_;
  const FeatureId f_, g_;  ///< Of the shapes.
  const ContactTolerance& tolerance_;
  ContactSet& found_;
  // Set by conditions that were met.
  double distance_ = 0.0;
  double spare_ = 0.0, unknown_ = 0.0;  ///< Of chains that cross.
  Vec3 p_, q_, u_;                      ///< Likewise.
};

/// Of the fixed mesh.
const RigidTransform IDENTITY;

}  // namespace

ShapePair::ShapePair(const Surface& moving_surface, const ShapeComplex& moving_shape,
                     const Surface& fixed_surface, const ShapeComplex& fixed_shape,
                     const RigidTransform& X_WM, double cutoff)
    : moving{moving_surface, moving_shape, X_WM, true},
      fixed{fixed_surface, fixed_shape, IDENTITY, false},
      tolerance(
          ContactTolerance::of(moving_surface, moving_shape, fixed_surface, fixed_shape, X_WM, cutoff)) {}

void decide(const ShapePair& pair, const FeatureId& on_moving, const FeatureId& on_fixed, ContactSet& found) {
  LMDBENCH_EXPECTS(pair.moving.is_moving && !pair.fixed.is_moving, "sides the wrong way round");
  LMDBENCH_EXPECTS(on_moving.index >= 0 && on_fixed.index >= 0, "a pair of an empty lane");
  const FeatureId f = pair.moving.feature_of_lead(on_moving), g = pair.fixed.feature_of_lead(on_fixed);
  if (f.index < 0 || g.index < 0) return;
  Decision decision(pair, f, g, found);
  PairConditions(decision).ask(pair.moving, on_moving, pair.fixed, on_fixed);
}

}  // namespace lmdbench
