// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/squared_distance_3.h>
#include <judge/exact_distance.h>
#include <judge/exact_scene.h>
#include <judge/exact_scene_body.h>
#include <judge/exact_scene_condition.h>
#include <judge/feature_boxes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace lmdbench::exact {
namespace {

using testing::exact_distance;
using testing::feature_boxes;
using testing::FeatureBox;
using testing::for_each_near;

using Exactly = LmdCondition<CGAL::Gmpq>;
/// Rounds upward while a protector lives; all other arithmetic must wait.
using Interval = CGAL::Interval_nt_advanced;
using Roughly = LmdCondition<Interval>;

Vec3 rounded(const Exactly::Point& p) {
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

Exactly::Point exact(const Vec3& p) {
  return {CGAL::Gmpq(p[0]), CGAL::Gmpq(p[1]), CGAL::Gmpq(p[2])};
}

/// Roundings that the coordinates of a point carry in double precision.
double coordinate_rounding(const Vec3& p, const Vec3& q) {
  return ROUNDINGS * std::numeric_limits<double>::epsilon() *
         std::max(p.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff());
}

/// The triangles of a body that hold a point. They are more than its feature's where the mesh
/// touches itself, as triangles without area do.
class TrianglesThroughPoint {
 public:
  explicit TrianglesThroughPoint(const WorldBody& body)
      : body_(body), boxes_(feature_boxes(body.surface(), body.vertices_W(), FeatureKind::FACE)) {}

  /// Whether one of them has a point nearer to p + d, to first order.
  bool come_nearer(const Exactly::Point& p, const Exactly::Vector& d) const {
    const Vec3 place = rounded(p);
    const double slack = coordinate_rounding(place, place);
    const Exactly::Kernel::Triangle_3 at_p(p, p, p);
    return std::any_of(boxes_.begin(), boxes_.end(), [&](const FeatureBox& entry) {
      if (entry.box.exteriorDistance(place) > slack) return false;
      const Triangle t = body_.triangle(entry.index);
      const std::array corners{exact(t[0]), exact(t[1]), exact(t[2])};
      if (CGAL::squared_distance(at_p, Exactly::Kernel::Triangle_3(corners[0], corners[1], corners[2])) != 0)
        return false;
      return std::any_of(corners.begin(), corners.end(),
                         [&](const auto& corner) { return d * (corner - p) > 0; });
    });
  }

 private:
  const WorldBody& body_;
  std::vector<FeatureBox> boxes_;
};

/// Collects the exact LMDs of the moving body and one fixed body.
class Search {
 public:
  Search(const WorldBody& moving, const WorldBody& fixed, std::int32_t body, double cutoff,
         std::vector<ExactLmd>& result)
      : moving_(moving),
        fixed_(fixed),
        body_(body),
        cutoff_(cutoff),
        exactly_(moving, fixed, cutoff),
        roughly_(moving, fixed, cutoff),
        through_moving_(moving),
        through_fixed_(fixed),
        result_(result) {}

  void run() {
    using enum FeatureKind;
    for (const auto& [a, b] : {std::pair(VERTEX, VERTEX), std::pair(VERTEX, EDGE), std::pair(EDGE, VERTEX),
                               std::pair(VERTEX, FACE), std::pair(FACE, VERTEX), std::pair(EDGE, EDGE)}) {
      for_each_near(feature_boxes(moving_.surface(), moving_.vertices_W(), a),
                    feature_boxes(fixed_.surface(), fixed_.vertices_W(), b), cutoff_,
                    [&, kind_a = a, kind_b = b](std::int32_t i, std::int32_t j) {
                      if (possible({kind_a, i}, {kind_b, j})) judge({kind_a, i}, {kind_b, j});
                    });
    }
  }

 private:
  /// False only where interval arithmetic proves that the pair is no LMD.
  bool possible(const FeatureId& on_moving, const FeatureId& on_fixed) const {
    const Interval::Protector rounding_upward;
    try {
      return roughly_(on_moving, on_fixed).has_value();
    } catch (const CGAL::Uncertain_conversion_exception&) {
      return true;
    }
  }

  void judge(const FeatureId& on_moving, const FeatureId& on_fixed) {
    const std::optional<Exactly::Pair> pair = exactly_(on_moving, on_fixed);
    if (!pair) return;
    const Exactly::Vector d = pair->q - pair->p;
    ExactLmd lmd{on_moving, on_fixed, body_, 0.0, rounded(pair->p), rounded(pair->q), true};
    const Vec3 direction{CGAL::to_double(d.x()), CGAL::to_double(d.y()), CGAL::to_double(d.z())};
    if (!on_outer_side(moving_, on_moving, direction, lmd.certain)) return;
    if (!on_outer_side(fixed_, on_fixed, -direction, lmd.certain)) return;
    if (through_moving_.come_nearer(pair->p, d) || through_fixed_.come_nearer(pair->q, -d)) return;
    lmd.distance = std::sqrt(CGAL::to_double(d.squared_length()));
    const double rounding = coordinate_rounding(lmd.point_moving, lmd.point_fixed);
    if (lmd.distance <= rounding || cutoff_ - lmd.distance <= rounding) lmd.certain = false;
    if (moving_.on_flat_triangle(on_moving) || fixed_.on_flat_triangle(on_fixed)) lmd.certain = false;
    result_.push_back(lmd);
  }

  static bool on_outer_side(const WorldBody& body, const FeatureId& feature, const Vec3& d_W, bool& certain) {
    if (feature.kind != FeatureKind::VERTEX || !body.has_side(feature)) return true;
    return body.on_outer_side_of_vertex(feature.index, d_W, certain);
  }

  const WorldBody& moving_;
  const WorldBody& fixed_;
  std::int32_t body_;
  double cutoff_;
  Exactly exactly_;
  Roughly roughly_;
  TrianglesThroughPoint through_moving_, through_fixed_;
  std::vector<ExactLmd>& result_;
};

/// Whether intervals prove that a normal or a cross product of edges separates the triangles.
bool surely_apart(const Triangle& a, const Triangle& b) {
  using Kernel = CGAL::Simple_cartesian<Interval>;
  using Vector = Kernel::Vector_3;
  const Interval::Protector rounding_upward;
  const auto corners = [](const Triangle& t) {
    const auto vector = [](const Vec3& p) { return Vector(p[0], p[1], p[2]); };
    return std::array{vector(t[0]), vector(t[1]), vector(t[2])};
  };
  const auto sides = [](const std::array<Vector, 3>& t) {
    return std::array{t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  };
  const auto on_a = corners(a), on_b = corners(b);
  const auto separates = [&](const Vector& axis) {
    double low[2], high[2];
    for (int side = 0; side < 2; ++side) {
      const auto& corner = side == 0 ? on_a : on_b;
      const std::array along{corner[0] * axis, corner[1] * axis, corner[2] * axis};
      low[side] = std::min({along[0].inf(), along[1].inf(), along[2].inf()});
      high[side] = std::max({along[0].sup(), along[1].sup(), along[2].sup()});
    }
    return high[0] < low[1] || high[1] < low[0];
  };
  const auto sides_a = sides(on_a), sides_b = sides(on_b);
  if (separates(CGAL::cross_product(sides_a[0], sides_a[1]))) return true;
  if (separates(CGAL::cross_product(sides_b[0], sides_b[1]))) return true;
  for (const Vector& u : sides_a)
    for (const Vector& v : sides_b)
      if (separates(CGAL::cross_product(u, v))) return true;
  return false;
}

}  // namespace

std::vector<ExactLmd> exact_lmds(const Scene& scene, const Pose& X_WM) {
  const WorldBody moving(scene.moving->surface(), RigidTransform(X_WM));
  std::vector<ExactLmd> result;
  for (std::size_t i = 0; i < scene.fixed.size(); ++i) {
    const WorldBody fixed(scene.fixed[i]->surface(), RigidTransform());
    Search(moving, fixed, static_cast<std::int32_t>(i), scene.cutoff, result).run();
  }
  return result;
}

bool exactly_touching(const Scene& scene, const Pose& X_WM) {
  const WorldBody moving(scene.moving->surface(), RigidTransform(X_WM));
  const auto boxes = feature_boxes(moving.surface(), moving.vertices_W(), FeatureKind::FACE);
  bool touching = false;
  for (const auto& body : scene.fixed) {
    const Surface& fixed = body->surface();
    for_each_near(boxes, feature_boxes(fixed, fixed.mesh.vertices, FeatureKind::FACE), 0.0,
                  [&](std::int32_t i, std::int32_t j) {
                    if (touching) return;
                    const Triangle a = moving.triangle(i), b = fixed.mesh.triangle(j);
                    touching = !surely_apart(a, b) && exact_distance(a, b) == 0.0;
                  });
  }
  return touching;
}

}  // namespace lmdbench::exact
