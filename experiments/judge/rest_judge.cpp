// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <judge/distance_bracket.h>
#include <judge/exact_distance.h>
#include <judge/rest_judge.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lmdbench::exact {

struct WorldTriangle {
  Triangle corners;
  Eigen::AlignedBox3d box_D;  ///< In the design's frame, where triangles are parallel to the axes.
};

namespace {

/// Accepted error of numbers in an answer, relative to the largest coordinate.
constexpr double ROUNDING_SHARE = 128.0 * std::numeric_limits<double>::epsilon();
/// Sines: tilt of planes from where they were drawn, for meshes in double and in single precision.
constexpr double TILT = 1e-7, TILT_OF_FLOATS = 1e-4;
/// Distance of vertices from restored planes, in planar tolerances.
constexpr double TOLERANCES_OF_FLOATS = 8.0;
/// A point may be off its feature by so many tolerances: borders lean, planes are rounded.
constexpr double ON_FEATURE = 8.0;
/// Nearer to a border, over coordinates, either feature may be named (DEFINITION.md).
constexpr double NAMING = 2e-9;
/// Distances up to this many tolerances may belong to intersecting triangles.
constexpr double TOUCHING = 2.0;
/// Two conditions, each true up to rounding, hold together in directions up to so much farther off.
constexpr double BOTH_CONES = 4.0;

/// Distance of points from the centroid of their contact, over the size: borders of areas are off
/// by the parts' tolerances; a segment's ends by the largest gap.
constexpr double CENTROID = 1e-6, CENTROID_OF_FLOATS = 1e-3, CENTROID_OF_SEGMENT = 3e-3;

std::vector<WorldTriangle> world_triangles(const Surface& surface, const RigidTransform& X_WS,
                                           const RigidTransform& X_DW) {
  std::vector<WorldTriangle> result;
  for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i) {
    WorldTriangle t{X_WS.triangle(surface.mesh.triangle(static_cast<std::int32_t>(i))), {}};
    for (const Vec3& p : t.corners) t.box_D.extend(X_DW.point(p));
    result.push_back(t);
  }
  return result;
}

/// The corners of a feature as a triangle; edges and vertices repeat their last one.
Triangle corners_of(const Surface& surface, const FeatureId& feature, const RigidTransform& X_WS) {
  const FeatureCorners corners(surface, feature);
  Triangle result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = X_WS.point(
        surface.mesh
            .vertices[static_cast<std::size_t>(corners.view()[std::min(i, corners.view().size() - 1)])]);
  return result;
}

Vec3 normal_of(const Triangle& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

/// The part of triangle `a` that lies over `b` along u, as a convex polygon in a's plane.
std::vector<Vec3> part_over(const Triangle& a, const Triangle& b, const Vec3& u) {
  std::vector<Vec3> polygon(a.begin(), a.end());
  const double turn = (b[1] - b[0]).cross(b[2] - b[0]).dot(u) > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < 3 && !polygon.empty(); ++i) {
    const Vec3 inwards = turn * u.cross(b[(i + 1) % 3] - b[i]);
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      const double at_p = inwards.dot(p - b[i]), at_q = inwards.dot(q - b[i]);
      if (at_p >= 0.0) kept.push_back(p);
      if ((at_p >= 0.0) != (at_q >= 0.0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

std::string text_of(const Lmd& lmd) {
  const Vec3 &p = lmd.point_moving, &q = lmd.point_fixed, &u = lmd.direction;
  return fmt::format(
      "{}{} {}, {} {} at distance {:.6g}, {:.9g} {:.9g} {:.9g} to {:.9g} {:.9g} {:.9g}, direction "
      "{:.6g} {:.6g} {:.6g}",
      lmd.intersecting ? "intersecting " : "", to_string(lmd.feature_moving.kind), lmd.feature_moving.index,
      to_string(lmd.feature_fixed.kind), lmd.feature_fixed.index, lmd.distance, p.x(), p.y(), p.z(), q.x(),
      q.y(), q.z(), u.x(), u.y(), u.z());
}

std::string text_of(const parts::RestPlace& place, const RigidTransform& X_WD) {
  const Vec3 u = X_WD.direction(place.direction), at = X_WD.point(place.box.center());
  return fmt::format("{} at gap {:.6g} near {:.6g} {:.6g} {:.6g}, direction {:.6g} {:.6g} {:.6g}",
                     place.dimension == 2   ? "faces"
                     : place.dimension == 1 ? "edges"
                                            : "corners",
                     place.gap, at.x(), at.y(), at.z(), u.x(), u.y(), u.z());
}

}  // namespace

RestTruth::RestTruth(const parts::RestScene& scene)
    : scene_(scene), X_WM_(scene.X_WM), X_DW_(scene.X_WD.inverse()) {
  const TriangleMesh &moving = scene.scene.moving->surface().mesh,
                     &fixed = scene.scene.fixed[0]->surface().mesh;
  double largest = 0.0;
  for (const Vec3& p : moving.vertices)
    largest = std::max({largest, p.cwiseAbs().maxCoeff(), X_WM_.point(p).cwiseAbs().maxCoeff()});
  for (const Vec3& p : fixed.vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  rounding_ = ROUNDING_SHARE * largest;
  tolerance_ = rounding_ + TOLERANCES_OF_FLOATS * (moving.planar_tolerance + fixed.planar_tolerance);
  // A float mesh whose planes were not restored has no planar tolerance.
  if (scene.single_precision)
    tolerance_ = std::max(tolerance_, TOLERANCES_OF_FLOATS * std::numeric_limits<float>::epsilon() * largest);
  tilt_ = scene.single_precision ? TILT_OF_FLOATS : TILT;
  const auto triangles_moving = world_triangles(scene_.scene.moving->surface(), X_WM_, X_DW_);
  const auto triangles_fixed = world_triangles(scene_.scene.fixed[0]->surface(), RigidTransform(), X_DW_);
  find_nearest(triangles_moving, triangles_fixed);
  find_areas(triangles_moving, triangles_fixed);
}

void RestTruth::find_nearest(const std::vector<WorldTriangle>& moving,
                             const std::vector<WorldTriangle>& fixed) {
  long double low = std::numeric_limits<long double>::infinity(), high = low;
  for (const WorldTriangle& a : moving)
    for (const WorldTriangle& b : fixed) {
      if (static_cast<long double>(a.box_D.exteriorDistance(b.box_D) - rounding_) > high) continue;
      const testing::DistanceBracket bracket = testing::distance_bracket(a.corners, b.corners);
      low = std::min(low, bracket.low);
      high = std::min(high, bracket.high);
      intersecting_ = intersecting_ || (bracket.low <= 0.0L && testing::exactly_touch(a.corners, b.corners));
    }
  nearest_low_ = static_cast<double>(low);
  nearest_high_ = static_cast<double>(high);
}

void RestTruth::find_areas(const std::vector<WorldTriangle>& moving,
                           const std::vector<WorldTriangle>& fixed) {
  areas_.resize(scene_.places.size());
  for (std::size_t i = 0; i < areas_.size(); ++i) {
    const parts::RestPlace& place = scene_.places[i];
    if (place.dimension != 2) continue;
    const Vec3 u = RigidTransform(scene_.X_WD).direction(place.direction);
    const double reach = TOUCHING * (tolerance_ + place.gap);
    for (const WorldTriangle& a : moving) {
      if (!((normal_of(a.corners) - u).norm() <= tilt_)) continue;
      for (const WorldTriangle& b : fixed) {
        if (!((normal_of(b.corners) + u).norm() <= tilt_)) continue;
        if (std::abs(u.dot(b.corners[0] - a.corners[0]) - place.gap) > TOUCHING * tolerance_) continue;
        const std::vector<Vec3> polygon = part_over(a.corners, b.corners, u);
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
          const Vec3 middle = (polygon[0] + polygon[k] + polygon[k + 1]) / 3.0;
          if (place.box.exteriorDistance(X_DW_.point(middle)) > reach) continue;
          const double area = 0.5 * (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]).norm();
          areas_[i].size += area;
          areas_[i].moment += area * middle;
        }
      }
    }
  }
}

bool RestTruth::is_true(const Lmd& lmd, std::string& why) const {
  const Vec3 d = lmd.point_fixed - lmd.point_moving;
  if (!(std::abs(d.norm() - lmd.distance) <= rounding_)) why += " points are at another distance;";
  if (lmd.intersecting) {
    // It is the centroid of the shared points, which may lie in a hole of them.
    if (lmd.distance != 0.0) why += " intersecting at a distance;";
    if (lmd.direction.allFinite()) why += " intersecting with a direction;";
    if (!intersects(lmd)) why += " its triangles are apart;";
    return why.empty();
  }
  const Triangle on_moving = corners_of(scene_.scene.moving->surface(), lmd.feature_moving, X_WM_),
                 on_fixed = corners_of(scene_.scene.fixed[0]->surface(), lmd.feature_fixed, RigidTransform());
  const bool of_faces =
      lmd.feature_moving.kind == FeatureKind::FACE && lmd.feature_fixed.kind == FeatureKind::FACE;
  const auto off = [&](const Vec3& p, const Triangle& t) {
    // The middle of a ring is in its plane.
    return of_faces ? std::abs(normal_of(t).dot(p - t[0])) : testing::exact_distance(p, t);
  };
  const double off_moving = off(lmd.point_moving, on_moving), off_fixed = off(lmd.point_fixed, on_fixed);
  const double on_feature = ON_FEATURE * tolerance_ + NAMING * rounding_ / ROUNDING_SHARE;
  if (!(off_moving <= on_feature))
    why += fmt::format(" the moving point is {:.3g} off its feature;", off_moving);
  if (!(off_fixed <= on_feature))
    why += fmt::format(" the fixed point is {:.3g} off its feature;", off_fixed);
  if (of_faces) {
    const Vec3 m = normal_of(on_moving), n = normal_of(on_fixed);
    if (!((lmd.direction - m).norm() <= 2.0 * tilt_ && (lmd.direction + n).norm() <= 2.0 * tilt_))
      why += " the direction is not that of the planes;";
    if (!(std::abs(m.dot(d) - lmd.distance) <= tolerance_)) why += " the planes are at another distance;";
  } else if (lmd.distance > TOUCHING * tolerance_ &&
             !((lmd.direction - d / d.norm()).norm() <= BOTH_CONES * (tolerance_ / lmd.distance + tilt_))) {
    why += " the direction is not along the points;";
  }
  return why.empty();
}

bool RestTruth::is_at(const parts::RestPlace& place, const Lmd& lmd) const {
  if (std::abs(lmd.distance - place.gap) > TOUCHING * tolerance_) return false;
  const double reach = TOUCHING * (tolerance_ + place.gap);
  for (const Vec3& p : {lmd.point_moving, lmd.point_fixed})
    if (place.box.exteriorDistance(X_DW_.point(p)) > reach) return false;
  // The nearer two points are, the less exact is their direction.
  const bool of_planes = place.dimension == 2 && lmd.feature_moving.kind == FeatureKind::FACE &&
                         lmd.feature_fixed.kind == FeatureKind::FACE;
  const double known = of_planes ? 2.0 * tilt_ : 2.0 * tilt_ + BOTH_CONES * tolerance_ / lmd.distance;
  if (lmd.intersecting) return scene_.single_precision;  // Others only touch, and have a direction.
  return !(known < 1.0) || (X_DW_.direction(lmd.direction) - place.direction).norm() <= known;
}

bool RestTruth::intersects(const Lmd& lmd) const {
  const Surface &moving = scene_.scene.moving->surface(), &fixed = scene_.scene.fixed[0]->surface();
  for (const std::int32_t a : moving.incident_triangles(lmd.feature_moving))
    for (const std::int32_t b : fixed.incident_triangles(lmd.feature_fixed))
      if (testing::exactly_touch(X_WM_.triangle(moving.mesh.triangle(a)), fixed.mesh.triangle(b)))
        return true;
  return false;
}

std::optional<std::pair<Vec3, double>> RestTruth::centroid_of(std::size_t index, const Lmd& lmd) const {
  const parts::RestPlace& place = scene_.places[index];
  const bool of_faces =
      lmd.feature_moving.kind == FeatureKind::FACE && lmd.feature_fixed.kind == FeatureKind::FACE;
  // A pair of faces is an area's, whether or not the place must have an LMD.
  if (lmd.intersecting || (!of_faces && (scene_.single_precision || !place.demanded))) return std::nullopt;
  // Of areas that intersect in part only the rest has an LMD with a distance.
  if (intersecting_ && scene_.single_precision && place.gap <= TOUCHING * tolerance_) return std::nullopt;
  // Areas of another place in this one's box are not told apart.
  for (std::size_t i = 0; i < scene_.places.size(); ++i)
    if (i != index && scene_.places[i].dimension >= place.dimension &&
        (scene_.places[i].direction - place.direction).norm() <= tilt_ &&
        scene_.places[i].box.exteriorDistance(place.box) <= TOUCHING * (tolerance_ + place.gap))
      return std::nullopt;
  if (place.dimension == 2 && areas_[index].size > 0.0)
    return std::pair<Vec3, double>(areas_[index].moment / areas_[index].size,
                                   (scene_.single_precision ? CENTROID_OF_FLOATS : CENTROID) * scene_.size);
  if (place.dimension == 1 && !scene_.single_precision && place.gap > BOTH_CONES * tolerance_)
    return std::pair<Vec3, double>(RigidTransform(scene_.X_WD).point(place.box.center()),
                                   CENTROID_OF_SEGMENT * scene_.size);
  return std::nullopt;
}

RestVerdict RestTruth::judge(const LmdSet& lmds) const {
  RestVerdict verdict;
  const auto object = [&](RestFault fault, const std::string& what) {
    const auto kind = static_cast<std::size_t>(fault);
    ++verdict.faults[kind];
    verdict.objections += fmt::format("  {}: {}\n", REST_FAULT_NAMES[kind], what);
  };
  double least = std::numeric_limits<double>::infinity();
  for (const Lmd& lmd : lmds) least = std::min(least, lmd.distance);
  if (!(least >= nearest_low_ - tolerance_ && least <= nearest_high_ + tolerance_))
    object(RestFault::NEAREST, fmt::format("{:.6g} where the meshes are {:.6g} apart{}", least, nearest_high_,
                                           intersecting_ ? ", intersecting" : ""));
  // Single-precision meshes: gaps below the tolerance of both prove nothing, and of triangles that
  // intersect the definition demands contacts, but no number of them.
  const auto is_open = [&](double gap) { return scene_.single_precision && gap <= TOUCHING * tolerance_; };
  // If edges or corners touch up to rounding, adjacent faces may have LMDs each (DEFINITION.md).
  const auto is_loose = [&](const parts::RestPlace& place) {
    return place.dimension < 2 && place.gap <= BOTH_CONES * tolerance_;
  };
  // An LMD almost at touch has no known direction and may be at several places: it doubles none.
  std::vector<std::size_t> held(scene_.places.size(), 0), alone = held;
  for (const Lmd& lmd : lmds) {
    std::string why;
    if (!is_true(lmd, why)) object(RestFault::UNTRUE, text_of(lmd) + ":" + why);
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < held.size(); ++i)
      if (is_at(scene_.places[i], lmd)) places.push_back(i);
    for (const std::size_t i : places) ++held[i];
    if (places.size() == 1) {
      ++alone[places.front()];
      if (const auto centroid = centroid_of(places.front(), lmd)) {
        ++verdict.located;
        const double off = (lmd.point_moving - centroid->first).norm();
        if (!(off <= centroid->second))
          object(RestFault::MISPLACED, fmt::format("{}: {:.3g} from the centroid", text_of(lmd), off));
      }
    }
    if (places.empty() && !(intersecting_ && is_open(lmd.distance)))
      object(RestFault::UNEXPECTED, text_of(lmd));
  }
  for (std::size_t i = 0; i < lmds.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (lmds[i].intersecting == lmds[k].intersecting && lmds[i].feature_moving == lmds[k].feature_moving &&
          lmds[i].feature_fixed == lmds[k].feature_fixed)
        object(RestFault::DOUBLED, "a name twice: " + text_of(lmds[i]));
  verdict.places = held.size();
  for (std::size_t i = 0; i < held.size(); ++i) {
    const parts::RestPlace& place = scene_.places[i];
    if (is_open(place.gap)) continue;
    verdict.demanded += place.demanded;
    if (held[i] == 0 && place.demanded)
      object(RestFault::MISSING, text_of(place, RigidTransform(scene_.X_WD)));
    if (alone[i] > 1 && !is_loose(place))
      object(RestFault::DOUBLED,
             fmt::format("{} LMDs of ", alone[i]) + text_of(place, RigidTransform(scene_.X_WD)));
  }
  return verdict;
}

}  // namespace lmdbench::exact
