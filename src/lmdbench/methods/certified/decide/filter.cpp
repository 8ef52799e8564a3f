// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/pair_conditions.h>
#include <lmdbench/methods/certified/decide/filter.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace lmdbench {

namespace {

/// Sine of the angle below which lines count as parallel. Beyond it the feet of the common
/// perpendicular are exact to about 2e-16 / 1e-4 of the edges, well within the margin.
constexpr double PARALLEL_SINE = 1e-4;
/// The same for a chain or region and a region; half is above the definition's largest tilt, 5e-5.
constexpr double PARALLEL_BAND = 2.0 * PARALLEL_SINE;

/// (pi / 3) of the turn of a common perpendicular, rounded up.
constexpr double TURN_FACTOR = 1.05;
/// Certificates hold up to this turn of two edges, as a share of the sine between them: the common
/// perpendicular then turns by no more than SPREAD.
constexpr double LARGEST_TURN = 0.05;
constexpr double SPREAD = TURN_FACTOR * LARGEST_TURN;

/// Asks the conditions of a pair until one fails by its margin, and makes the certificate of that.
class Rejection {
 public:
  Rejection(const PairFilter& filter, double lever_arm)
      : filter_(filter),
        rounding_(2.0 *
                  std::max(filter.pair.tolerance.rounding, CONTACT_ROUNDING / RELATIVE_TOUCH * filter.touch)),
        lever_arm_(lever_arm) {}

  PairAnswer answer;

  // Conditions (pair_conditions.h).

  bool is_long(const Line& line) const { return line.length > filter_.tiny; }
  bool has_area(const Plane& plane) {
    return !plane.normal.isZero(0.0) || reject(Certificate::turned(std::numeric_limits<double>::infinity()));
  }
  /// Next to touch the direction between points is rounding: the definition is asked.
  bool near(const ShapeSide& from, const Vec3& /*p*/, const Vec3& /*q*/, const Vec3& d) {
    const double squared = d.squaredNorm();
    if (squared < 0.25 * filter_.touch * filter_.touch) return false;
    return within_reach(squared, d, from.sign());
  }
  bool above(const ShapeSide& /*from*/, double height, const auto& gradient) {
    return height >= -filter_.touch || fails_by(-height, gradient());
  }
  bool below_reach(const ShapeSide& /*from*/, double height, const auto& gradient) {
    return height <= filter_.reach + rounding_ || fails_by(height - filter_.reach, -gradient());
  }
  bool foot_on(const ShapeSide& from, const Vec3& /*p*/, const Line& line, double parameter) {
    const double beyond = line.beyond(parameter);
    if (beyond <= std::max(filter_.margin * line.length, rounding_)) return true;
    const double inwards = parameter < 0.0 ? from.sign() : -from.sign();
    return fails_by(beyond, inwards / line.length * line.along);
  }
  static double clamped(double parameter) { return parameter; }
  bool in_box(const ShapeSide& /*from*/, double inside, const auto& gradient) {
    return inside >= -2.0 * filter_.touch || fails_by(-inside, gradient());
  }
  bool in_triangle(const ShapeSide& /*from*/, double inside, const Vec3& side, const Vec3& opposite,
                   const auto& gradient) {
    const double squared_side = side.squaredNorm();
    if (squared_side <= filter_.tiny * filter_.tiny) return false;
    const double width =
        std::max(filter_.margin * filter_.margin * opposite.squaredNorm(), rounding_ * rounding_);
    if (inside >= -std::sqrt(squared_side * width)) return true;
    const double length = std::sqrt(squared_side);
    return fails_by(-inside / length, gradient() / length);
  }
  bool parallel(double sine) {
    return sine <= PARALLEL_BAND || reject(Certificate::turned(sine - 0.5 * PARALLEL_BAND));
  }
  /// Nearly parallel lines are rejected only where they are beyond reach of each other everywhere.
  bool crosses(const Line& a, const Line& b, const Vec3& /*product*/, double sine) {
    if (sine > PARALLEL_SINE) return true;
    const Line& longer = a.length >= b.length ? a : b;
    const Vec3 r = b.ends[0] - a.ends[0], along = longer.along / longer.length;
    const double reach = filter_.reach + PARALLEL_BAND * (a.length + b.length);
    if ((r - r.dot(along) * along).squaredNorm() > reach * reach) reject({});
    return false;
  }
  bool feet_on(const Crossing& x) {
    const double beyond_a = x.a.beyond(x.s), beyond_b = x.b.beyond(x.t), spare = rounding_ / x.sine;
    if (beyond_a <= std::max(filter_.margin * x.a.length, spare) &&
        beyond_b <= std::max(filter_.margin * x.b.length, spare))
      return true;
    // The end beyond the other line's plane through the common perpendicular, and how fast that
    // plane can turn (lemma 19). Inwards: along the line whose foot is beyond, square to the other.
    const bool is_a = beyond_a > beyond_b;
    const Line &left = is_a ? x.a : x.b, &other = is_a ? x.b : x.a;
    const double inwards = ((is_a ? x.s : x.t) < 0.0) == is_a ? -1.0 : 1.0;
    const Vec3 gradient =
        inwards / (left.length * x.sine) *
        (left.along - left.along.dot(other.along) / (other.length * other.length) * other.along);
    const double beyond = std::max(beyond_a, beyond_b);
    // Every point of the edge must stay on its side: the farthest one gives the lever arm.
    const double arm = beyond + between(x).norm() + std::max(x.a.length, x.b.length);
    return reject({beyond * x.sine - 2.0 * filter_.touch, gradient, SPREAD,
                   (1.0 + SPREAD) * lever_arm_ + TURN_FACTOR * arm / x.sine, LARGEST_TURN * x.sine});
  }
  std::optional<Vec3> perpendicular(const Crossing& x) {
    const Vec3 d = between(x);
    const double squared = d.squaredNorm();
    // Next to touch the direction is known from the lines alone.
    if (squared < filter_.touch * filter_.touch || !within_reach(squared, d, 1.0)) return std::nullopt;
    return d;
  }

  bool in_cone(const ShapeSide& side, const FeatureId& lead, const Vec3& d, const BetweenPoints& /*how*/) {
    return for_each_away(side, lead, d, [&](double component, double length, const Vec3& wing) {
      // The definition admits rounding (1 + |d| / |w|), and |d| within reach (PROOF.md, lemma 2).
      return fails_by(component - rounding_ * filter_.reach / length,
                      side.sign() / length * side.direction(wing));
    });
  }
  bool in_cone(const ShapeSide& side, const FeatureId& lead, const Vec3& d, const SquareToLine& how) {
    if (in_cone(side, lead, d, BetweenPoints{how.point, how.point})) return true;
    const Vec3& u = how.line.along;
    Vec3& gradient = answer.certificate.gradient;
    gradient -= gradient.dot(u) / (how.line.length * how.line.length) * u;
    return false;
  }
  bool in_cone(const ShapeSide& side, const FeatureId& lead, const Vec3& d, const AlongNormal& /*how*/) {
    return for_each_away(side, lead, d, [&](double component, double /*length*/, const Vec3& /*wing*/) {
      return reject(Certificate::turned(component - filter_.margin));
    });
  }
  /// d turns smoothly as long as the lines do not pass through each other.
  bool in_cone(const ShapeSide& side, const FeatureId& lead, const Vec3& d, const Crossing& x) {
    return for_each_away(side, lead, d, [&](double component, double /*length*/, const Vec3& /*wing*/) {
      const double distance = d.norm();
      return reject(
          {(1.0 - SPREAD) * distance - 2.0 * filter_.touch, side.sign() / distance * d, SPREAD,
           (1.0 + SPREAD) * lever_arm_,
           std::min(x.sine / TURN_FACTOR * (component / distance - filter_.margin), LARGEST_TURN * x.sine)});
    });
  }

  // The definition is asked for what passes.

  static void share_points(const auto&...) {}
  static void share_foot(const auto&...) {}
  static void share_height(const auto&...) {}
  static void share_perpendicular(const auto&...) {}
  static void face_region(const auto&...) {}
  static void face_each_other(const auto&...) {}

 private:
  bool reject(const Certificate& certificate) {
    LMDBENCH_ENSURES(certificate.gradient.squaredNorm() <= 1.0 + 1e-9 && certificate.spread >= 0.0 &&
                         certificate.lever_arm >= 0.0,
                     "a condition whose gradient was not divided by the length it is of");
    answer = {PairVerdict::NO_LMD, certificate};
    return false;
  }
  /// @param length  that must fall to 2 touch (rounding and tolerances) before anything changes; it
  ///   loses `gradient` times the displacement
  bool fails_by(double length, const Vec3& gradient) {
    return reject({length - 2.0 * filter_.touch, gradient, 0.0, lever_arm_});
  }
  /// @param sign  -1 where d leads to the moving mesh
  bool within_reach(double squared_distance, const Vec3& d, double sign) {
    const double above = filter_.reach + rounding_;
    if (squared_distance <= above * above) return true;
    const double distance = std::sqrt(squared_distance);
    return fails_by(distance - filter_.reach, sign / distance * d);
  }
  /// From the moving mesh to the fixed one.
  static Vec3 between(const Crossing& x) {
    return x.b.ends[0] - x.a.ends[0] + x.t * x.b.along - x.s * x.a.along;
  }
  /// Calls away(d . w / |w|, |w|, w) for the first wing w with d . w above the margin.
  template <class Away>
  bool for_each_away(const ShapeSide& side, const FeatureId& lead, const Vec3& d, Away&& away) {
    const Vec3 d_S = side.direction_to_surface(d);
    const double squared_d = d_S.squaredNorm();
    const FeatureId feature =
        lead.kind == FeatureKind::EDGE ? FeatureId{lead.kind, side.shape.chain_of(lead.index)} : lead;
    return side.shape.for_each_wing(side.surface, feature, [&](const Vec3& wing) {
      const double along = d_S.dot(wing);
      if (along <= 0.0) return true;
      const double squared_length = wing.squaredNorm();
      if (squared_length <= filter_.tiny * filter_.tiny ||
          along * along <= filter_.margin * filter_.margin * squared_d * squared_length)
        return true;
      const double length = std::sqrt(squared_length);
      return away(along / length, length, wing);
    });
  }

  const PairFilter& filter_;
  double rounding_;  ///< Of lengths, with a margin [m].
  double lever_arm_;
};

}  // namespace

PairAnswer PairFilter::operator()(const FeatureId& on_moving, const FeatureId& on_fixed,
                                  double lever_arm) const {
  Rejection rejection(*this, lever_arm);
  PairConditions(rejection).ask(pair.moving, on_moving, pair.fixed, on_fixed);
  return rejection.answer;
}

}  // namespace lmdbench
