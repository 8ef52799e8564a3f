// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/motion/tum_file.h>

#include <fmt/format.h>
#include <study/completeness/rounded_plates.h>
#include <support/parts/placement.h>
#include <support/random.h>
#include <support/timing.h>

#include <algorithm>
#include <numbers>

namespace lmdbench::completeness {
namespace {

using experiments::Random;

/// [m]
constexpr double THICKNESS = 0.1, PLATE_GAP = 1e-3, PLATE_CUTOFF = 0.02;
const Vec3 MOVING_SIZE(1.0, 1.0, THICKNESS), FIXED_SIZE(1.3, 0.9, THICKNESS);

ConvexPolygon rectangle(const Vec3& size) {
  const double x = 0.5 * size.x(), y = 0.5 * size.y();
  return ConvexPolygon({{-x, -y}, {x, -y}, {x, y}, {-x, y}});
}

/// The overlap of the two rectangles in the frame of the design.
ConvexPolygon designed_overlap(const Pose& X_DA) {
  ConvexPolygon moving = rectangle(MOVING_SIZE);
  for (Vec2& corner : moving.corners)
    corner = (X_DA.rotation * Vec3(corner.x(), corner.y(), 0.0) + X_DA.translation).head<2>();
  return moving.cut_by(rectangle(FIXED_SIZE));
}

double diameter_of(const ConvexPolygon& polygon) {
  double result = 0.0;
  for (const Vec2& a : polygon.corners)
    for (const Vec2& b : polygon.corners) result = std::max(result, (a - b).norm());
  return result;
}

}  // namespace

RoundedPlates judge_rounded_plates(int cells, std::uint64_t seed, std::size_t poses,
                                   const Complain& complain) {
  /// Poses a pair of meshes: few, for many different roundings; meshes take long to make.
  constexpr std::size_t POSES_A_PAIR = 10;
  Random random(seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(cells));
  RoundedPlates result;
  Pose X_WD, X_MA;
  Scene scene;
  for (std::size_t i = 0; i < poses; ++i) {
    if (i % POSES_A_PAIR == 0) {
      X_WD = parts::random_placement(0.5, random);
      X_MA = parts::random_placement(0.5, random);
      scene = {parts::placed_body("moving", make_box(MOVING_SIZE, {cells, cells, 1}), X_MA, true),
               {parts::placed_body("fixed", make_box(FIXED_SIZE, {cells, cells, 1}), X_WD, true)},
               PLATE_CUTOFF};
      result.triangles = scene.moving->surface().mesh.triangles.size();
    }
    Pose X_DA;
    X_DA.rotation = Eigen::AngleAxisd(2.0 * std::numbers::pi * random.uniform(), Vec3::UnitZ());
    X_DA.translation = Vec3(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), THICKNESS + PLATE_GAP);
    const Pose X_WM = X_WD * X_DA * X_MA.inverse();
    LmdSet set;
    WorkCounters counters;
    const auto method = make_method("certified", scene);
    const double begin = experiments::thread_seconds();
    method->search(X_WM, set, counters);
    result.seconds.push_back(experiments::thread_seconds() - begin);
    ++result.poses;
    const auto wrong = [&](const std::string& what) {
      complain(fmt::format("rounded plates of {} triangles, pose {} of seed {}: {}\n{}", result.triangles, i,
                           seed, what, tum_text({{static_cast<double>(i), X_WM}})));
    };
    if (set.size() != 1) {
      wrong(fmt::format("{} LMDs", set.size()));
      continue;
    }
    ++result.one_lmd;
    const ConvexPolygon overlap = designed_overlap(X_DA);
    const Vec2 centroid = overlap.measure().centroid;
    const Vec3 point_W = X_WD.rotation * Vec3(centroid.x(), centroid.y(), 0.5 * THICKNESS) + X_WD.translation;
    const double point = (set[0].point_fixed - point_W).norm() / diameter_of(overlap);
    const double direction = (set[0].direction + X_WD.rotation * Vec3::UnitZ()).norm();
    result.worst_point = std::max(result.worst_point, point);
    result.worst_direction = std::max(result.worst_direction, direction);
    // Written so that NaN is wrong.
    if (!(point <= ROUNDED_POINT_SHARE && direction <= ROUNDED_DIRECTION_RAD))
      wrong(fmt::format("point off by {:.2g} of the overlap, direction by {:.2g} rad", point, direction));
  }
  return result;
}

}  // namespace lmdbench::completeness
