// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/scene/mesh_bounds.h>
#include <lmdbench/scene/scatter.h>

#include <study/worlds/scenes.h>
#include <support/random.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace lmdbench::worlds {
namespace {

/// A mesh of the given diagonal, centred on its box.
std::shared_ptr<const Body> body(const std::string& name, TriangleMesh mesh, double diagonal) {
  const double scale = diagonal / bounding_box_diagonal(mesh);
  const Vec3 centre = bounding_box_centre(mesh);
  for (Vec3& vertex : mesh.vertices) vertex = scale * (vertex - centre);
  return std::make_shared<const Body>(name, build_surface(std::move(mesh)));
}

void add(Scene& scene, const std::shared_ptr<const Body>& mesh, const std::vector<Pose>& poses) {
  for (const Pose& pose : poses) scene.fixed.emplace_back(mesh, pose);
}

/// 100 frames each: straight with a turn, or trembling, then at rest; jumps before every fourth.
std::vector<Pose> path_about(const Vec3& middle, double size, std::size_t frames,
                             experiments::Random& random) {
  constexpr std::size_t STRETCH = 100;
  std::vector<Pose> poses;
  Pose pose;
  Vec3 direction = random.direction(), axis = random.direction();
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const std::size_t stretch = frame / STRETCH;
    if (frame % STRETCH == 0) {
      direction = random.direction();
      axis = random.direction();
      if (stretch % 4 == 3) {
        pose.translation = 0.5 * size * random.uniform() * random.direction();
        pose.rotation = random.rotation();
      }
    }
    const double step = stretch % 3 == 2 ? (frame % STRETCH < 50 ? 1e-4 * random.uniform(-1.0, 1.0) : 0.0)
                                         : 0.002 + 0.01 * static_cast<double>(stretch % 2);
    pose.translation += step * direction;
    if (pose.translation.norm() > 0.5 * size) direction = -pose.translation.normalized();
    if (step != 0.0) {
      const Vec3 half = 0.5 * step * axis;
      pose.rotation =
          (Eigen::Quaterniond(1.0, half.x(), half.y(), half.z()).normalized() * pose.rotation).normalized();
    }
    poses.push_back(pose);
    poses.back().translation += middle;
  }
  return poses;
}

}  // namespace

std::vector<World> small_worlds(std::size_t frames, std::uint64_t seed) {
  const auto moving = body("blob", make_blob(1.0, 0.3, 2), 1.0);
  const auto torus = body("torus", make_torus(1.0, 0.4, 14, 8), 1.2);
  const auto box = body("box", make_box({1.0, 0.8, 0.6}, 2), 0.9);
  const auto shell = body("unequal", make_unequal(1.0, 5, 30.0), 1.0);
  const auto hollow = body("hollow", make_sphere(1.0, 2), 6.0);
  experiments::Random random(seed);
  using Rule = Scatter::Rule;
  const auto& bounds = torus->prepared<MeshBounds>();
  std::vector<World> worlds;
  const auto start = [&](const std::string& name) -> Scene& {
    worlds.push_back({name, {moving, {}, 0.0}, {}});
    return worlds.back().scene;
  };
  const auto walk = [&](double size, const Vec3& middle = Vec3::Zero()) {
    worlds.back().poses = path_about(middle, size, frames, random);
  };

  Scene& grid = start("grid");
  add(grid, torus, scatter({.counts = {4, 4, 4}, .spacing = 1.1}, bounds));
  walk(5.0);

  Scene& mixed = start("random");
  add(mixed, torus, scatter({.rule = Rule::RANDOM, .count = 40, .spacing = 0.8, .seed = 2}, bounds));
  add(mixed, box, scatter({.rule = Rule::RANDOM, .count = 40, .spacing = 1.0, .seed = 3}, bounds));
  add(mixed, shell, scatter({.rule = Rule::RANDOM, .count = 40, .spacing = 1.0, .seed = 4}, bounds));
  walk(4.0);

  Scene& pile = start("pile");
  add(pile, box, scatter({.rule = Rule::PILE, .count = 80, .spacing = 0.9}, box->prepared<MeshBounds>()));
  walk(3.0, Vec3(0.0, 0.0, 1.5));

  // A grid in inverted hollows; the moving mesh is inside one, sometimes beyond its wall.
  Scene& nested = start("nested");
  TriangleMesh inwards = hollow->surface().mesh;
  for (auto& corners : inwards.triangles) std::swap(corners[1], corners[2]);
  add(nested, body("wall", std::move(inwards), 6.0),
      scatter({.counts = {2, 1, 1}, .spacing = 0.9, .turned = false}, hollow->prepared<MeshBounds>()));
  add(nested, hollow, {Pose{}});
  add(nested, torus, scatter({.counts = {4, 3, 3}, .spacing = 0.9}, bounds));
  walk(6.0);

  Scene& coincident = start("coincident");
  for (int copy = 0; copy < 3; ++copy)
    add(coincident, torus, scatter({.rule = Rule::RANDOM, .count = 30, .spacing = 0.6, .seed = 5}, bounds));
  walk(3.5);

  Scene& far = start("far");
  const Vec3 away(700.0, -500.0, 600.0);
  for (const auto& mesh : {torus, box, shell})
    for (Pose pose : scatter({.rule = Rule::RANDOM, .count = 30, .spacing = 0.9, .seed = 6}, bounds)) {
      pose.translation += away;
      far.fixed.emplace_back(mesh, pose);
    }
  walk(4.0, away);
  return worlds;
}

std::vector<Play> small_plays(std::size_t frames, std::uint64_t seed) {
  const auto blob = body("blob", make_blob(1.0, 0.3, 2), 1.0),
             torus = body("torus", make_torus(1.0, 0.4, 14, 8), 1.2),
             box = body("box", make_box({1.0, 0.8, 0.6}, 2), 0.9),
             shell = body("unequal", make_unequal(1.0, 5, 30.0), 1.0),
             hull = body("hull", make_sphere(1.0, 2), 5.2);
  TriangleMesh inwards = hull->surface().mesh;
  for (auto& corners : inwards.triangles) std::swap(corners[1], corners[2]);
  const auto wall = body("wall", std::move(inwards), 5.0);
  experiments::Random random(seed + 7);
  const auto& bounds = torus->prepared<MeshBounds>();
  std::vector<Play> plays;
  const auto start = [&](const std::string& name) -> Play& {
    plays.push_back({name, {}, {}, std::vector<std::vector<Pose>>(frames)});
    return plays.back();
  };
  const auto add_mover = [&](Play& play, const std::shared_ptr<const Body>& mesh,
                             const std::vector<Pose>& path) {
    play.movers.push_back(mesh);
    for (std::size_t frame = 0; frame < frames; ++frame) play.frames[frame].push_back(path[frame]);
  };
  const std::vector<std::shared_ptr<const Body>> kinds{blob, torus, box, shell};

  for (const bool is_far : {false, true}) {
    Play& play = start(is_far ? "movers far" : "movers");
    const Vec3 away = is_far ? Vec3(700.0, -500.0, 600.0) : Vec3(Vec3::Zero());
    for (std::size_t i = 0; i < 10; ++i) add_mover(play, kinds[i % 4], path_about(away, 3.5, frames, random));
    for (const auto& mesh : {torus, box})
      for (Pose pose :
           scatter({.rule = Scatter::Rule::RANDOM, .count = 10, .spacing = 1.4, .seed = 8}, bounds)) {
        pose.translation += away;
        play.standing.emplace_back(mesh, pose);
      }
  }

  Play& nested = start("movers nested");
  const std::vector<Pose> of_hollow = path_about(Vec3::Zero(), 1.0, frames, random);
  for (const auto& mesh : {wall, hull}) add_mover(nested, mesh, of_hollow);
  for (std::size_t i = 0; i < 6; ++i)
    add_mover(nested, kinds[i % 4], path_about(Vec3::Zero(), 3.0, frames, random));
  for (const Pose& pose : scatter({.counts = {2, 2, 2}, .spacing = 1.5}, bounds))
    nested.standing.emplace_back(torus, pose);

  Play& coincident = start("movers coincident");
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<Pose> path = path_about(Vec3::Zero(), 2.5, frames, random);
    for (int copy = 0; copy < 2; ++copy) add_mover(coincident, kinds[i], path);
    coincident.standing.emplace_back(kinds[i], path[frames / 2]);
  }
  return plays;
}

std::vector<FixedBody> crowd(const std::shared_ptr<const Body>& mesh, std::size_t count, double spacing,
                             std::uint64_t seed) {
  std::vector<FixedBody> fixed;
  if (count == 0) return fixed;
  const auto& bounds = mesh->prepared<MeshBounds>();
  const double step = spacing * 2.0 * bounds.half_sides.norm();
  // Cells of a cube large enough for all, by their distance from the middle one.
  const auto half = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(count)))) / 2 + 2;
  std::vector<Eigen::Vector3i> cells;
  for (int z = -half; z <= half; ++z)
    for (int y = -half; y <= half; ++y)
      for (int x = -half; x <= half; ++x) cells.emplace_back(x, y, z);
  std::stable_sort(cells.begin(), cells.end(), [](const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
    return a.cwiseAbs().maxCoeff() < b.cwiseAbs().maxCoeff();
  });
  experiments::Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    Pose pose;
    if (i > 0) {
      pose.rotation = random.rotation();
      pose.translation = step * cells[i].cast<double>() - pose.rotation * bounds.centre;
    }
    fixed.emplace_back(mesh, pose);
  }
  return fixed;
}

}  // namespace lmdbench::worlds
