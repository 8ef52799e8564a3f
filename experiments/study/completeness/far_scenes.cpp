// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/mesh/surface.h>

#include <fmt/format.h>
#include <study/completeness/far_scenes.h>
#include <support/parts/placement.h>
#include <support/poses.h>
#include <support/random.h>

#include <array>
#include <cmath>
#include <map>

namespace lmdbench::completeness {
namespace {

using experiments::Random;
using parts::scaled_body;

struct Shape {
  const char* name;
  TriangleMesh (*make)();
};

/// Smooth, sharp, flat, thin, reflex, unequal and open shapes of about the size 1. They have few
/// triangles, because `exhaustive` is slow where all pairs are within the cutoff.
constexpr std::array<Shape, 9> SHAPES = {{
    {"blob", [] { return make_blob(0.5, 0.15, 1); }},
    {"torus", [] { return make_torus(0.35, 0.15, 6, 5); }},
    {"box",
     [] {
       return make_box({0.7, 0.5, 0.4});
     }},
    {"gridded box",
     [] {
       return make_box({0.7, 0.5, 0.4}, 2);
     }},
    {"needles", [] { return make_needles(0.3, 1.0, 6); }},
    {"l-block", [] { return make_l_block(0.7); }},
    {"unequal", [] { return make_unequal(0.5, 2, 1e3); }},
    {"caps", [] { return make_caps(0.4, 0.5, 6); }},
    {"patch", [] { return make_patch(0.8, 3, 0.1); }},
}};

double logarithmic(Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

const char* name_of(FarCarrier carrier) {
  constexpr std::array NAMES = {"pose far away", "both meshes far away", "moving mesh far from its frame"};
  return NAMES.at(static_cast<std::size_t>(carrier));
}

/// Any rotation, or one almost parallel to the axes, so that flat faces and edges face flat ones.
Eigen::Quaterniond random_rotation(bool parallel, Random& random) {
  if (!parallel) return random.rotation();
  const Eigen::AngleAxisd tilt(logarithmic(random, 1e-12, 1e-2), random.direction());
  return Eigen::Quaterniond(tilt).normalized();
}

/// A pose at the gap from the fixed body. Both are near the origin and of size 1.
Pose near_pose(const Body& moving, const Body& fixed, double gap, bool parallel, Random& random) {
  Pose pose;
  pose.rotation = random_rotation(parallel, random);
  for (Vec3 way = parallel ? Vec3::UnitZ() : random.direction();; way = random.direction()) {
    const double displacement =
        first_approach(moving, fixed, pose, way, gap, experiments::GAP_TOLERANCE).displacement;
    pose.translation = displacement * way;
    if (std::isfinite(displacement)) return pose;  // A line may pass through a hole.
  }
}

/// Unrelated poses, or a slow drift from one of them.
std::vector<Pose> near_poses(const Body& moving, const Body& fixed, double gap, bool parallel, bool drifts,
                             Random& random) {
  const double step = logarithmic(random, 1e-5, 1e-2);
  const Vec3 way = step * random.direction();
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(parallel ? 0.0 : step, random.direction()));
  return parts::poses_of(FAR_POSES_A_SCENE, drifts, way, turn,
                         [&] { return near_pose(moving, fixed, gap, parallel, random); });
}

}  // namespace

FarScene make_far_scene(std::uint64_t seed, std::size_t index) {
  // Seeds are spread so that no two scenes draw the same numbers.
  Random random(seed * 0x9E3779B97F4A7C15ULL + index);
  const auto pick = [&](std::size_t count) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
  };
  const Shape &moving = SHAPES[pick(SHAPES.size())], &fixed = SHAPES[pick(SHAPES.size())];
  const auto carrier = static_cast<FarCarrier>(pick(3));
  const bool drifts = random.uniform() < 0.5;
  const double size = logarithmic(random, SMALLEST_FAR_SIZE, LARGEST_FAR_SIZE);
  // Directions only matter beyond 1e-9 of the offset: many sizes of the smallest scenes.
  const double gap = logarithmic(random, 1e-4, 100.0), cutoff = gap * logarithmic(random, 1.01, 3.0);
  const bool parallel = random.uniform() < 0.4;
  const Vec3 offset = random.direction();

  FarScene result;
  result.label = fmt::format("far scene {} of seed {}: {} on {}, size {:.3g} of the offset, {}", index, seed,
                             moving.name, fixed.name, size, name_of(carrier));
  const std::shared_ptr<const Body> near_moving = scaled_body(moving.name, moving.make(), 1.0, Vec3::Zero());
  const std::shared_ptr<const Body> near_fixed = scaled_body(fixed.name, fixed.make(), 1.0, Vec3::Zero());
  result.poses = near_poses(*near_moving, *near_fixed, gap, parallel, drifts, random);

  const Vec3 offset_M = carrier == FarCarrier::POSE ? Vec3::Zero() : offset;
  const Vec3 offset_W = carrier == FarCarrier::MOVING_MESH ? Vec3::Zero() : offset;
  result.scene.moving = scaled_body(moving.name, moving.make(), size, offset_M);
  result.scene.fixed = {scaled_body(fixed.name, fixed.make(), size, offset_W)};
  result.diagonal = size * bounding_box_diagonal(near_fixed->surface().mesh);
  result.scene.cutoff = cutoff * size;
  for (Pose& pose : result.poses)
    pose.translation = size * pose.translation + (offset_W - pose.rotation * offset_M);
  return result;
}

std::vector<FarResult> judge_far_scenes(std::uint64_t seed, std::size_t poses, const Complain& complain) {
  std::map<int, FarResult> decades;
  for (std::size_t index = 0; index * FAR_POSES_A_SCENE < poses; ++index) {
    const FarScene far = make_far_scene(seed, index);
    const int decade = static_cast<int>(std::floor(std::log10(far.diagonal)));
    FarResult& result = decades[decade];
    result.decade = decade;
    judge_scene(far, complain, result.judgements);
  }
  std::vector<FarResult> results;
  for (auto& [decade, result] : decades) results.push_back(std::move(result));
  return results;
}

}  // namespace lmdbench::completeness
