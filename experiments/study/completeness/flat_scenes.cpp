// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/shape/flatten.h>
#include <lmdbench/snch/minimum_distance.h>

#include <fmt/format.h>
#include <study/completeness/flat_scenes.h>
#include <support/random.h>

#include <array>
#include <cmath>
#include <numbers>

namespace lmdbench::completeness {
namespace {

using experiments::Random;

/// Gap and cutoff [m]; the shapes are about 1 m large.
constexpr double GAP = 1e-3, CUTOFF = 0.02;

TriangleMesh frame() {
  return make_sleeve(polygon_outline(4, 0.5), polygon_outline(4, 0.3), {.height = 0.2, .around = 24});
}

TriangleMesh holed_plate() {
  return make_sleeve(polygon_outline(4, 0.6), circle_outline(0.25),
                     {.height = 0.1, .around = 32, .rings = 3});
}

TriangleMesh gear() {
  const Outline teeth = gear_outline(10, 0.1, 0.002);
  return make_sleeve(teeth, circle_outline(0.2, teeth), {.height = 0.2, .around = 80});
}

struct Pair {
  const char* name;
  TriangleMesh (*moving)();
  TriangleMesh (*fixed)();
};

const std::array<Pair, 9> PAIRS = {{
    {"plate on plate",
     [] {
       return make_box({1.0, 1.0, 0.1}, {4, 4, 1});
     },
     [] {
       return make_box({1.3, 0.9, 0.1}, {3, 4, 1});
     }},
    {"box on box",
     [] {
       return make_box({0.7, 0.5, 0.4}, 3);
     },
     [] {
       return make_box({0.6, 0.6, 0.5}, 2);
     }},
    {"box on its copy",
     [] {
       return make_box({0.5, 0.5, 0.5}, 2);
     },
     [] {
       return make_box({0.5, 0.5, 0.5}, 2);
     }},
    {"plate with a hole on a plate", holed_plate,
     [] {
       return make_box({1.0, 1.0, 0.1}, {3, 3, 1});
     }},
    {"box over a hole",
     [] {
       return make_box({0.8, 0.2, 0.3}, 2);
     },
     holed_plate},
    {"frame on frame", frame, frame},
    {"L-block on L-block", [] { return make_l_block(1.0); }, [] { return make_l_block(1.3); }},
    {"two boxes on a gear",
     [] {
       return make_two_boxes({0.3, 0.4, 0.3}, 0.15);
     },
     gear},
    {"wedge on a plate with a hole", [] { return make_wedge(0.3, 0.8, 0.3); }, holed_plate},
}};

/// A mesh as its file holds it, and the turn that brings it back.
struct File {
  std::shared_ptr<const Body> body;
  Pose X_FD;  ///< From the frame of the design to that of the file.
};

File file_of(const char* name, TriangleMesh mesh, FlatCoordinates coordinates, Random& random) {
  File file;
  if (coordinates != FlatCoordinates::AS_MADE) {
    file.X_FD.rotation = random.rotation();
    for (double& x : file.X_FD.translation) x = random.uniform(-0.5, 0.5);
    const RigidTransform X(file.X_FD);
    for (Vec3& vertex : mesh.vertices) vertex = X.point(vertex);
  }
  if (coordinates == FlatCoordinates::FLOATS) {
    mesh = turned_to_floats(std::move(mesh), Eigen::Quaterniond::Identity());
    flatten(mesh);
  }
  file.body = std::make_shared<const Body>(name, build_surface(std::move(mesh)));
  return file;
}

/// A side of the moving mesh faces down, and lies over the fixed one somewhere: in a third of the poses along the axes.
Pose side_on_top(const Body& moving, const Body& fixed, Random& random) {
  const auto pick = [&](int count) { return std::floor(random.uniform() * count); };
  constexpr double QUARTER = 0.5 * std::numbers::pi;
  Pose pose;
  const double spin = random.uniform() < 1.0 / 3.0 ? QUARTER * pick(4) : 4.0 * QUARTER * random.uniform();
  pose.rotation = Eigen::AngleAxisd(spin, Vec3::UnitZ()) *
                  Eigen::AngleAxisd(QUARTER * pick(4), Vec3::UnitX()) *
                  Eigen::AngleAxisd(QUARTER * pick(2), Vec3::UnitY());
  pose.translation = Vec3(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 3.0);
  // Distance is 1-Lipschitz in translation: a few steps of what is left come near enough.
  for (int step = 0; step < 6; ++step)
    pose.translation.z() -= nearest_pair(moving.surface(), moving.prepared<Hierarchy>(), fixed.surface(),
                                         fixed.prepared<Hierarchy>(), pose)
                                .distance -
                            GAP;
  return pose;
}

}  // namespace

const char* name_of(FlatCoordinates coordinates) {
  switch (coordinates) {
    case FlatCoordinates::AS_MADE:
      return "as made";
    case FlatCoordinates::TURNED:
      return "turned";
    case FlatCoordinates::FLOATS:
      break;
  }
  return "floats";
}

std::vector<std::string> flat_pairs() {
  std::vector<std::string> names;
  for (const Pair& pair : PAIRS) names.emplace_back(pair.name);
  return names;
}

FlatScene make_flat_scene(std::size_t pair, FlatCoordinates coordinates, std::uint64_t seed,
                          std::size_t index) {
  const Pair& shapes = PAIRS.at(pair);
  // Far from each other, so that no two scenes draw the same numbers.
  Random random((seed * PAIRS.size() + pair) * 0x9E3779B97F4A7C15ULL + index);
  // Laid out between the designs; the files come after, so that all coordinates have the same poses.
  const Body moving("moving", build_surface(shapes.moving()));
  const Body fixed("fixed", build_surface(shapes.fixed()));
  const bool slides = random.uniform() < 0.5;
  const Vec3 way(random.uniform(-2e-3, 2e-3), random.uniform(-2e-3, 2e-3), 0.0);
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(random.uniform() < 0.5 ? 0.0 : random.uniform(-5e-3, 5e-3), Vec3::UnitZ()));
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < FLAT_POSES_A_SCENE; ++i) {
    if (!slides || poses.empty()) {
      poses.push_back(side_on_top(moving, fixed, random));
      continue;
    }
    Pose next = poses.back();
    next.translation += way;
    next.rotation = (turn * next.rotation).normalized();
    poses.push_back(next);
  }

  FlatScene result;
  result.label =
      fmt::format("flat scene {} of seed {}: {}, {}", index, seed, shapes.name, name_of(coordinates));
  const File moving_file = file_of("moving", shapes.moving(), coordinates, random);
  const File fixed_file = file_of("fixed", shapes.fixed(), coordinates, random);
  result.scene = {moving_file.body, {fixed_file.body}, CUTOFF};
  result.diagonal = bounding_box_diagonal(fixed.surface().mesh);
  for (const Pose& X_DA : poses) result.poses.push_back(fixed_file.X_FD * X_DA * moving_file.X_FD.inverse());
  return result;
}

std::vector<FlatResult> judge_flat_scenes(std::uint64_t seed, std::size_t poses, const Complain& complain) {
  std::vector<FlatResult> results;
  for (std::size_t pair = 0; pair < PAIRS.size(); ++pair) {
    for (const FlatCoordinates coordinates :
         {FlatCoordinates::AS_MADE, FlatCoordinates::TURNED, FlatCoordinates::FLOATS}) {
      FlatResult& result = results.emplace_back();
      result.pair = PAIRS[pair].name;
      result.coordinates = coordinates;
      result.judgements.resize(variants().size());
      for (std::size_t index = 0; index * FLAT_POSES_A_SCENE < poses; ++index) {
        const FlatScene flat = make_flat_scene(pair, coordinates, seed, index);
        const std::vector<CutoffResult> judged =
            judge_poses(flat.scene, flat.diagonal, {CUTOFF / flat.diagonal}, flat.poses,
                        [&](const std::string& what) { complain(flat.label + ", " + what); });
        for (std::size_t v = 0; v < variants().size(); ++v)
          result.judgements[v] += judged.front().judgements[v];
      }
    }
  }
  return results;
}

}  // namespace lmdbench::completeness
