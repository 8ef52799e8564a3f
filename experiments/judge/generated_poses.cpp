// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <judge/generated_poses.h>
#include <support/parts/parts_scenes.h>
#include <support/parts/rest_fits.h>
#include <support/random.h>

#include <cmath>

namespace lmdbench::exact {
namespace {

constexpr const char* AT_REST = "rest";

/// Powers of ten of moves: doubles are known to 1e-9 of their size, floats to some 1e-6.
constexpr double LEAST_MOVE = -6.0, LEAST_MOVE_OF_FLOATS = -3.0, LARGEST_MOVE = -2.0;

GeneratedPose moved_from(const Scene& scene, const Pose& drawn, double size, bool floats,
                         const std::string& text, experiments::Random& random) {
  const double share =
      std::pow(10.0, random.uniform(floats ? LEAST_MOVE_OF_FLOATS : LEAST_MOVE, LARGEST_MOVE));
  const Vec3 way = random.direction(), axis = random.direction();
  return {scene,
          {drawn.translation + share * size * way,
           (Eigen::Quaterniond(Eigen::AngleAxisd(share, axis)) * drawn.rotation).normalized()},
          fmt::format("{}, moved by {:.3g} of its size", text, share)};
}

}  // namespace

std::vector<std::string> generators() {
  std::vector<std::string> names;
  for (const auto& [name, generator] : parts::HARD_GENERATORS) names.push_back(name);
  names.emplace_back(AT_REST);
  return names;
}

std::vector<std::string> generated_kinds(std::string_view generator) {
  std::vector<std::string> names;
  if (generator == AT_REST) {
    for (const parts::RestFit& fit : parts::rest_fits()) names.emplace_back(fit.name);
  } else {
    for (const parts::PartsKind& kind : parts::parts_kinds(parts::HARD_GENERATORS.at(std::string(generator))))
      names.emplace_back(kind.name);
  }
  return names;
}

GeneratedPose make_generated_pose(std::string_view generator, std::string_view kind, std::uint64_t seed,
                                  std::size_t index) {
  experiments::Random random(seed * 1000003 + index);
  if (generator == AT_REST) {
    const parts::RestScene rest = parts::make_rest_scene(parts::rest_fit(kind), seed, index);
    return moved_from(rest.scene, rest.X_WM, rest.size, rest.single_precision, rest.text, random);
  }
  const parts::Coordinates coordinates = parts::ALL_COORDINATES[index % std::size(parts::ALL_COORDINATES)];
  const parts::PartsScene drawn =
      parts::make_parts_scene({kind, coordinates, seed, index, parts::PoseFamily::ANY});
  const std::size_t pose = random.index(drawn.poses.size());
  return moved_from(
      drawn.scene, drawn.poses[pose], drawn.diagonal, coordinates == parts::Coordinates::ROUNDED,
      fmt::format("{}, seed {}, scene {}, pose {}", name_of(coordinates), seed, index, pose), random);
}

}  // namespace lmdbench::exact
