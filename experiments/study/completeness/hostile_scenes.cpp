// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/mesh/surface.h>

#include <fmt/format.h>
#include <study/completeness/hostile_meshes.h>
#include <study/completeness/hostile_scenes.h>
#include <study/completeness/laid_poses.h>
#include <support/parts/chances.h>
#include <support/parts/placement.h>
#include <support/poses.h>
#include <support/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lmdbench::completeness {
namespace {

using experiments::Random;
using parts::chance;
using parts::power_of_ten;

/// No turn, a tiny one, quarter turns or any turn, so that flat faces and edges face flat ones.
Eigen::Quaterniond some_rotation(Random& random) {
  const double kind = random.uniform();
  if (kind < 0.25) return Eigen::Quaterniond::Identity();
  if (kind < 0.45)
    return Eigen::Quaterniond(Eigen::AngleAxisd(power_of_ten(-16.0, -1.0, random), random.direction()));
  if (kind < 0.65) {
    const auto quarters = [&](const Vec3& axis) {
      return Eigen::AngleAxisd(0.5 * std::numbers::pi * static_cast<double>(random.index(4)), axis);
    };
    return Eigen::Quaterniond(quarters(Vec3::UnitX()) * quarters(Vec3::UnitZ())).normalized();
  }
  return random.rotation();
}

Vec3 some_direction(Random& random) {
  const Vec3 axis = Vec3::Unit(static_cast<Eigen::Index>(random.index(3)));
  if (chance(0.4, random)) return chance(0.5, random) ? axis : Vec3(-axis);
  return random.direction();
}

/// Two meshes near their frames' origins; draws a pose of one relative to the other.
class Start {
 public:
  /// @param size  of the moving mesh, the smaller one [m]
  Start(const TriangleMesh& moving, const TriangleMesh& fixed, double size, double cutoff)
      : moving_("moving", build_surface(moving)),
        fixed_("fixed", build_surface(fixed)),
        size_(size),
        cutoff_(cutoff) {}

  double size() const { return size_; }

  Pose operator()(Random& random) const {
    Pose pose;
    pose.rotation = some_rotation(random);
    const double kind = random.uniform();
    if (kind < 0.15) {  // Both at the same place.
      pose.translation = chance(0.4, random)
                             ? Vec3::Zero()
                             : Vec3(size_ * power_of_ten(-16.0, -1.0, random) * some_direction(random));
      return pose;
    }
    if (kind < 0.25) {  // Anywhere.
      for (double& x : pose.translation) x = random.uniform(-1.0, 1.0);
      return pose;
    }
    const double gap =
        cutoff_ * (chance(0.5, random) ? 1.0 - random.uniform() : power_of_ten(-13.0, 0.0, random));
    for (int trial = 0; trial < 20; ++trial) {
      const Vec3 way = some_direction(random);
      const double displacement =
          first_approach(moving_, fixed_, pose, way, gap, experiments::GAP_TOLERANCE).displacement;
      if (!std::isfinite(displacement)) continue;  // The line misses the fixed mesh.
      pose.translation = displacement * way;
      if (chance(0.2, random)) pose.translation -= cutoff_ * power_of_ten(-9.0, 1.0, random) * way;
      break;
    }
    return pose;
  }

 private:
  Body moving_, fixed_;
  double size_, cutoff_;
};

Pose turned(Pose pose, double angle, const Vec3& axis) {
  if (angle != 0.0)
    pose.rotation = (Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)) * pose.rotation).normalized();
  return pose;
}

/// Appends `count` frames of one motion, which starts at the last pose if there is one.
void append_frames(Motion motion, std::size_t count, const Start& start, Random& random,
                   std::vector<Pose>& poses) {
  const double turn = power_of_ten(-9.0, -1.5, random), spin = chance(0.5, random) ? 0.0 : turn;
  const double tremor = power_of_ten(-17.0, -2.0, random), step = start.size() * turn;
  const Vec3 way = some_direction(random), axis = random.direction();
  const std::size_t between_jumps = 2 + random.index(20);
  const bool comes_back = chance(0.5, random);
  const Pose first = poses.empty() ? start(random) : poses.back();
  for (std::size_t i = 0; i < count; ++i) {
    Pose next = poses.empty() ? first : poses.back();
    switch (motion) {
      case Motion::NONE:
      case Motion::LAID:
        next = start(random);
        break;
      case Motion::WALK:
        next.translation += step * random.uniform() * random.direction();
        next = turned(next, spin * random.uniform(), random.direction());
        break;
      case Motion::TREMBLE:
        next = turned(first, spin == 0.0 ? 0.0 : tremor * random.uniform(), random.direction());
        next.translation += start.size() * tremor * random.uniform() * random.direction();
        break;
      case Motion::JUMPS:
        if (i % between_jumps == between_jumps - 1) {
          next = start(random);
          break;
        }
        if (i > 0 && i % between_jumps == 0 && comes_back && poses.size() > 1) next = poses[poses.size() - 2];
        [[fallthrough]];
      case Motion::SLIDE:
      case Motion::MIXED:
        next = turned(next, spin, axis);
        next.translation += step * way;
        break;
      case Motion::THROUGH:
        next = turned(next, 0.1 * spin, axis);
        next.translation = first.translation + 3.0 * start.size() * std::sqrt(turn) *
                                                   std::sin(0.2 * static_cast<double>(i)) * way;
        break;
    }
    poses.push_back(next);
  }
}

std::size_t poses_a_scene(Motion motion) {
  return is_without_motion(motion) ? HOSTILE_POSES_A_SCENE : HOSTILE_FRAMES_A_SCENE;
}

std::vector<Pose> motion_of(Motion motion, const Start& start, Random& random) {
  std::vector<Pose> poses;
  if (motion != Motion::MIXED) {
    append_frames(motion, poses_a_scene(motion), start, random, poses);
    return poses;
  }
  while (poses.size() < HOSTILE_FRAMES_A_SCENE) {
    const std::size_t count = std::min(5 + random.index(20), HOSTILE_FRAMES_A_SCENE - poses.size());
    const std::size_t which = random.index(6);
    if (which == 0 && !poses.empty())
      poses.insert(poses.end(), count, Pose(poses.back()));  // Standing still.
    else
      append_frames(ALL_MOTIONS[std::max<std::size_t>(which, 1)], count, start, random, poses);
  }
  return poses;
}

std::vector<Pose> laid_poses(const TriangleMesh& moving, const TriangleMesh& fixed, bool is_copy,
                             Random& random) {
  std::vector<Pose> poses;
  while (poses.size() < HOSTILE_POSES_A_SCENE)
    poses.push_back(is_copy && chance(0.5, random) ? laid_on_itself(moving, random)
                                                   : laid_pose(moving, fixed, random));
  return poses;
}

/// Spread so that no two scenes draw the same numbers. Those of the first seven motions are what
/// found poses were found by.
std::uint64_t seed_of(Motion motion, std::uint64_t seed, std::size_t index) {
  constexpr std::uint64_t FIRST = 7;
  const std::uint64_t which = static_cast<std::uint64_t>(motion);
  const std::uint64_t spread = (seed * FIRST + which % FIRST) * 0x9E3779B97F4A7C15ULL + index;
  return which < FIRST ? spread : ~spread;
}

}  // namespace

const char* name_of(Motion motion) {
  constexpr std::array NAMES = {"none", "walk", "slide", "tremble", "jumps", "through", "mixed", "laid"};
  return NAMES.at(static_cast<std::size_t>(motion));
}

GeneratedScene make_hostile_scene(Motion motion, std::uint64_t seed, std::size_t index) {
  Random random(seed_of(motion, seed, index));
  const HostileMesh fixed = make_hostile_mesh(random);
  const bool is_copy = chance(0.2, random);
  HostileMesh moving = is_copy ? fixed : make_hostile_mesh(random);
  const double ratio = chance(0.8, random) ? 1.0 : power_of_ten(-6.0, 0.0, random);
  for (Vec3& p : moving.mesh.vertices) p *= ratio;
  moving.mesh.planar_tolerance *= ratio;
  const double cutoff = ratio * power_of_ten(-3.0, -0.3, random);
  const std::vector<Pose> poses =
      motion == Motion::LAID ? laid_poses(moving.mesh, fixed.mesh, is_copy, random)
                             : motion_of(motion, Start(moving.mesh, fixed.mesh, ratio, cutoff), random);

  const double size = chance(0.7, random) ? 1.0 : power_of_ten(-9.0, 9.0, random);
  const auto offset = [&] {
    return chance(0.7, random) ? Vec3::Zero()
                               : Vec3(size * power_of_ten(-1.0, 7.0, random) * random.direction());
  };
  const Vec3 offset_M = offset(), offset_W = offset();
  GeneratedScene result;
  result.label =
      fmt::format("scene {} of seed {}, motion {}: {} on {}, sizes {:.3g} and {:.3g}, {:.3g} and {:.3g} away",
                  index, seed, name_of(motion), is_copy ? "copy" : moving.history, fixed.history,
                  ratio * size, size, offset_M.norm(), offset_W.norm());
  result.scene = {parts::scaled_body("moving", moving.mesh, size, offset_M),
                  {parts::scaled_body("fixed", fixed.mesh, size, offset_W)},
                  cutoff * size};
  result.scale = size + offset_M.norm() + offset_W.norm();
  for (const Pose& pose : poses)
    result.poses.push_back({size * pose.translation + (offset_W - pose.rotation * offset_M), pose.rotation});
  return result;
}

std::vector<Judgement> judge_hostile_scenes(Motion motion, std::uint64_t seed, std::size_t poses,
                                            const Complain& complain) {
  std::vector<Judgement> judgements;
  for (std::size_t index = 0; index * poses_a_scene(motion) < poses; ++index)
    judge_scene(make_hostile_scene(motion, seed, index), complain, judgements);
  return judgements;
}

}  // namespace lmdbench::completeness
