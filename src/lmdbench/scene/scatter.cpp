// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/scene/scatter.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace lmdbench {

namespace {

/// How much steeper than 45 degrees a pile is.
constexpr double PILE_SLOPE = 1.2;

double uniform_in(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * uniform_number(random);
}

/// Uniform over rotations: a direction in 4D, by rejection; without sines the same on all machines.
Eigen::Quaterniond any_rotation(std::mt19937_64& random) {
  for (;;) {
    const double x = uniform_in(random, -1.0, 1.0), y = uniform_in(random, -1.0, 1.0);
    const double z = uniform_in(random, -1.0, 1.0), w = uniform_in(random, -1.0, 1.0);
    const double squared = x * x + y * y + z * z + w * w;
    if (squared > 0.01 && squared <= 1.0) return Eigen::Quaterniond(w, x, y, z).normalized();
  }
}

std::vector<Vec3> grid_places(const Scatter& rule, double step) {
  std::vector<Vec3> places;
  const auto at = [&](std::int64_t i, std::int64_t count) {
    return step * (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1));
  };
  for (std::int64_t z = 0; z < rule.counts[2]; ++z)
    for (std::int64_t y = 0; y < rule.counts[1]; ++y)
      for (std::int64_t x = 0; x < rule.counts[0]; ++x)
        places.emplace_back(at(x, rule.counts[0]), at(y, rule.counts[1]), at(z, rule.counts[2]));
  return places;
}

std::vector<Vec3> random_places(const Scatter& rule, double step, std::mt19937_64& random) {
  const double half = 0.5 * step * std::cbrt(static_cast<double>(rule.count));
  std::vector<Vec3> places;
  for (std::int64_t i = 0; i < rule.count; ++i) {
    const double x = uniform_in(random, -half, half), y = uniform_in(random, -half, half);
    places.emplace_back(x, y, uniform_in(random, -half, half));
  }
  return places;
}

/// The sites of the packing whose cone is the lowest.
std::vector<Vec3> pile_places(const Scatter& rule, double step) {
  const double row = step * std::sqrt(3.0) / 2.0, layer = step * std::sqrt(2.0 / 3.0);
  const auto radius = static_cast<std::int64_t>(2.0 * std::cbrt(static_cast<double>(rule.count))) + 2;
  std::vector<Vec3> places;
  for (std::int64_t k = 0; k <= radius; ++k)
    for (std::int64_t j = -radius; j <= radius; ++j)
      for (std::int64_t i = -radius; i <= radius; ++i) {
        const auto shift = static_cast<double>(k % 3);
        places.emplace_back(
            step * (static_cast<double>(i) + 0.5 * static_cast<double>(((j % 2) + 2) % 2) + 0.5 * shift),
            row * (static_cast<double>(j) + shift / 3.0), layer * static_cast<double>(k));
      }
  std::stable_sort(places.begin(), places.end(), [](const Vec3& a, const Vec3& b) {
    return std::hypot(a.x(), a.y()) + a.z() / PILE_SLOPE < std::hypot(b.x(), b.y()) + b.z() / PILE_SLOPE;
  });
  places.resize(static_cast<std::size_t>(rule.count));
  return places;
}

}  // namespace

std::vector<Pose> scatter(const Scatter& rule, const MeshBounds& bounds) {
  const double step = rule.spacing * 2.0 * bounds.half_sides.norm();
  std::mt19937_64 random(rule.seed);
  const std::vector<Vec3> places = rule.rule == Scatter::Rule::GRID     ? grid_places(rule, step)
                                   : rule.rule == Scatter::Rule::RANDOM ? random_places(rule, step, random)
                                                                        : pile_places(rule, step);
  std::vector<Pose> poses;
  poses.reserve(places.size());
  for (const Vec3& place : places) {
    Pose pose;
    if (rule.turned) pose.rotation = any_rotation(random);
    pose.translation = place - pose.rotation * bounds.centre;
    poses.push_back(pose);
  }
  return poses;
}

std::size_t count_coincident(std::span<const Pose> poses) {
  const auto key = [](const Pose& p) {
    return std::array<double, 7>{p.translation.x(), p.translation.y(), p.translation.z(), p.rotation.x(),
                                 p.rotation.y(),    p.rotation.z(),    p.rotation.w()};
  };
  std::vector<std::array<double, 7>> keys;
  keys.reserve(poses.size());
  for (const Pose& pose : poses) keys.push_back(key(pose));
  std::sort(keys.begin(), keys.end());
  return static_cast<std::size_t>(keys.end() - std::unique(keys.begin(), keys.end()));
}

}  // namespace lmdbench
