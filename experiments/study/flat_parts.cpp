// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/shape/flatten.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/flat_parts.h>
#include <study/scaling/slide.h>
#include <support/bodies.h>
#include <support/parts/machine_parts.h>
#include <support/poses.h>
#include <support/program.h>
#include <support/random.h>
#include <support/timing.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>

namespace lmdbench::flat_parts {
namespace {

using experiments::Random;
using experiments::trembling_poses;

constexpr double TAU = 2.0 * std::numbers::pi;
/// Share of the moving mesh's diagonal, for designs without a cutoff of their own.
constexpr double CUTOFF = 0.005;
/// Step of a frame, as a share of the same diagonal.
constexpr double STEP = scaling::SLIDE_DIAGONALS_PER_FRAME;
constexpr std::size_t FRAMES = 21;
/// Frames of a trembling motion: the method recognises it only after some frames.
constexpr std::size_t TREMBLING_FRAMES = 121;

/// Pose of the moving mesh after a number of frames.
using Motion = std::function<Pose(double frame)>;

struct Design {
  TriangleMesh moving, fixed;
  std::function<Motion(Random&)> draw;
  double cutoff = CUTOFF;
  std::size_t frames = FRAMES;
};

Eigen::Quaterniond about_z(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
}

Vec3 level(double angle) {
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// Slides and turns at a gap of 0.1 % over the top of the other, within `reach` of its middle.
Design laid_on(TriangleMesh moving, TriangleMesh fixed, double reach) {
  const double diagonal = bounding_box_diagonal(moving);
  Eigen::AlignedBox3d box_moving, box_fixed;
  for (const Vec3& p : moving.vertices) box_moving.extend(p);
  for (const Vec3& p : fixed.vertices) box_fixed.extend(p);
  const double height = box_fixed.max().z() - box_moving.min().z() + 0.001 * diagonal;
  return {std::move(moving), std::move(fixed), [=](Random& random) -> Motion {
            const Vec3 begin(random.uniform(-reach, reach), random.uniform(-reach, reach), height);
            const Vec3 step = STEP * diagonal * level(random.uniform(0.0, TAU));
            const double angle = random.uniform(0.0, TAU);
            return [=](double frame) {
              return Pose{begin + frame * step, about_z(angle + frame * scaling::TURN_RAD_PER_FRAME)};
            };
          }};
}

/// A peg nearer to one side, sliding along the axis; half without turn and tilt: parallel walls.
Design peg_in_bore(int segments) {
  constexpr double RADIUS = 0.25;
  TriangleMesh peg =
      make_sleeve(circle_outline(RADIUS - parts::CLEARANCE), nullptr, {.height = 1.0, .around = segments});
  TriangleMesh bore =
      make_sleeve(circle_outline(2.0 * RADIUS), circle_outline(RADIUS), {.height = 0.5, .around = segments});
  const double diagonal = bounding_box_diagonal(peg);
  return {std::move(peg), std::move(bore), [=](Random& random) -> Motion {
            const double angle = random.uniform(0.0, TAU);
            const Vec3 begin = parts::CLEARANCE * random.uniform(0.5, 0.95) * level(angle) +
                               Vec3(0.0, 0.0, random.uniform(-0.1, 0.1));
            const bool is_level = random.uniform() < 0.5;
            const double tilt = is_level ? 0.0 : std::pow(10.0, random.uniform(-7.0, -4.0)),
                         turn = is_level ? 0.0 : scaling::TURN_RAD_PER_FRAME;
            const Eigen::Quaterniond tilted(Eigen::AngleAxisd(tilt, level(angle + 1.0)));
            return [=](double frame) {
              return Pose{begin + frame * STEP * diagonal * Vec3::UnitZ(), about_z(frame * turn) * tilted};
            };
          }};
}

TriangleMesh gear(int teeth) {
  const Outline outline = gear_outline(teeth, 1.0 / teeth, 0.04 / teeth);
  return make_sleeve(outline, circle_outline(0.2, outline), {.height = 0.2, .around = 8 * teeth});
}

/// One gear rolls round the other, on one flank or between both.
Design gears_in_mesh(int teeth) {
  TriangleMesh mesh = gear(teeth);
  const double step = STEP * bounding_box_diagonal(mesh);
  return {mesh, mesh, [=](Random& random) -> Motion {
            const double begin = random.uniform(0.0, TAU), play = random.uniform(-0.03, 0.03) / teeth,
                         lift = random.uniform(-0.15, 0.15);
            return [=](double frame) {
              const double angle = begin + frame * step;
              return Pose{level(angle) + lift * Vec3::UnitZ(),
                          about_z(2.0 * angle + std::numbers::pi / teeth + play)};
            };
          }};
}

/// The pair of the extreme scene, screwed in, off the axis by a part of the play.
Design bolt_in_nut() {
  constexpr double PITCH = 0.2, PLAY = 0.015;
  TriangleMesh bolt = make_sleeve(thread_outline(0.5, 0.1, PITCH), nullptr,
                                  {.height = 1.6, .around = 60, .layers = 128, .rings = 8});
  TriangleMesh nut = make_sleeve(polygon_outline(6, 0.9), thread_outline(0.5 + PLAY, 0.1, PITCH),
                                 {.height = 0.6, .around = 66, .layers = 48, .rings = 8});
  return {std::move(bolt), std::move(nut),
          [=](Random& random) -> Motion {
            const Vec3 begin = 0.4 * PLAY * random.uniform() * level(random.uniform(0.0, TAU));
            const double angle = random.uniform(0.0, TAU);
            return [=](double frame) {
              const double turn = angle + frame * scaling::TURN_RAD_PER_FRAME;
              return Pose{begin + PITCH * turn / TAU * Vec3::UnitZ(), about_z(turn)};
            };
          },
          0.004};
}

/// Steps of a trembling hand, in a new direction each: a ninth of a slide's, or all of it.
constexpr double TREMBLE = STEP / 9.0, TREMBLE_RAD = 5e-5;
constexpr double WALK = STEP, WALK_RAD = 3e-4;

Motion trembling(const Pose& begin, double step, double turn, Random& random) {
  const auto poses = trembling_poses(begin, step, turn, TREMBLING_FRAMES, random);
  return [poses](double frame) { return poses[static_cast<std::size_t>(frame)]; };
}

enum class Crates { HILL_ON_HILL, NESTED, TREMBLING };

/// Two wavy sheets of 20,000 triangles, 3 mm apart at a size of one metre: one upside down, crest
/// to crest; or nested, farther apart than the cutoff, sliding or trembling.
Design egg_crates(Crates how) {
  constexpr int CELLS = 100, CELLS_A_WAVE = 25;
  constexpr double HEIGHT = 0.02, GAP = 0.003, WAY = 0.0025;
  const bool is_nested = how != Crates::HILL_ON_HILL, trembles = how == Crates::TREMBLING;
  TriangleMesh lower = make_patch(1.0, CELLS, 0.0);
  for (std::size_t v = 0; v < lower.vertices.size(); ++v) {
    const int i = static_cast<int>(v) / (CELLS + 1), j = static_cast<int>(v) % (CELLS + 1);
    lower.vertices[v].z() = HEIGHT * circle_point(i, CELLS_A_WAVE)[0] * circle_point(j, CELLS_A_WAVE)[0];
  }
  TriangleMesh upper = lower;
  for (auto& corners : upper.triangles) std::swap(corners[1], corners[2]);
  if (!is_nested)
    for (Vec3& p : upper.vertices) p.z() = 2.0 * HEIGHT - p.z();
  const double diagonal = bounding_box_diagonal(upper);
  return {std::move(upper), std::move(lower),
          [=](Random& random) -> Motion {
            const Vec3 way = level(random.uniform(0.0, TAU));
            const Pose begin{-WAY * way + GAP * Vec3::UnitZ(), Eigen::Quaterniond::Identity()};
            if (trembles) return trembling(begin, TREMBLE * diagonal, TREMBLE_RAD, random);
            return [=](double frame) {
              return Pose{begin.translation + frame * STEP * diagonal * way, begin.rotation};
            };
          },
          is_nested ? 0.5 * GAP / diagonal : CUTOFF, trembles ? TREMBLING_FRAMES : FRAMES};
}

/// A scan that grazes itself, held in a hand.
/// @param step  diagonals a frame
/// @param turn  radians a frame
Design scan_in_hand(const PartsTimes& choice, double step, double turn) {
  const std::shared_ptr<const Body> scan = experiments::load_body(choice.scan, choice.meshes, 1.0);
  const TriangleMesh& mesh = scan->surface().mesh;
  return {mesh, mesh,
          [=](Random& random) {
            const auto seed = static_cast<std::uint64_t>(random.index(1000000));
            const Pose begin = experiments::grazing_poses(*scan, *scan, 0.3 * CUTOFF, 1, seed).front();
            return trembling(begin, step, turn, random);
          },
          CUTOFF, TREMBLING_FRAMES};
}

/// One above the other with aligned outlines, nearer by a step in each frame.
Design stacked(TriangleMesh moving, TriangleMesh fixed, double gap, const Pose& turn) {
  Eigen::AlignedBox3d box_moving, box_fixed;
  for (const Vec3& p : moving.vertices) box_moving.extend(turn.rotation * p);
  for (const Vec3& p : fixed.vertices) box_fixed.extend(p);
  const double height = box_fixed.max().z() - box_moving.min().z();
  return {std::move(moving), std::move(fixed), [=](Random& random) -> Motion {
            const double highest = gap * random.uniform(1.0, 2.0);
            return [=](double frame) {
              return Pose{(height + highest * (1.0 - frame / FRAMES)) * Vec3::UnitZ(), turn.rotation};
            };
          }};
}

/// A grid of crossings, each of one tooth of either comb.
Design crossed_combs(int teeth) {
  const TriangleMesh comb = parts::make_comb(teeth, 0.5 / teeth);
  return stacked(comb, comb, 0.001, {Vec3::Zero(), about_z(0.5 * std::numbers::pi)});
}

Design gear_over_its_hole(int teeth) {
  const Outline outline = gear_outline(teeth, 1.0 / teeth, 0.04 / teeth);
  const SleeveChoice choice{.height = 0.2, .around = 8 * teeth};
  return stacked(make_sleeve(outline, nullptr, choice),
                 make_sleeve(circle_outline(0.75, outline), outline, choice), 0.0001, {});
}

Design disc_on_its_copy(int corners) {
  const TriangleMesh disc = make_sleeve(circle_outline(0.5), nullptr, {.height = 0.2, .around = corners});
  return stacked(disc, disc, 0.0, {});
}

/// A pleated fan round one vertex; a tetrahedron slides over it, corner first.
Design tetrahedron_on_hub(int triangles) {
  TriangleMesh hub, tetrahedron;
  hub.vertices.emplace_back(0.0, 0.0, 0.25);
  for (int i = 0; i < triangles; ++i) {
    const auto [x, y] = circle_point(i, triangles);
    hub.vertices.emplace_back(0.5 * x, 0.5 * y, i % 2 == 0 ? 0.0 : 0.25 / triangles);
    hub.triangles.push_back({0, i + 1, (i + 1) % triangles + 1});
  }
  tetrahedron.vertices = {{0.0, 0.0, 0.0}, {0.2, 0.0, 0.3}, {-0.1, 0.2, 0.3}, {-0.1, -0.2, 0.3}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  const double step = STEP * bounding_box_diagonal(tetrahedron);
  return {std::move(tetrahedron), std::move(hub), [=](Random& random) -> Motion {
            const Vec3 way = level(random.uniform(0.0, TAU));
            return [=](double frame) {
              return Pose{(frame - 0.5 * FRAMES) * step * way + 0.2505 * Vec3::UnitZ(),
                          Eigen::Quaterniond::Identity()};
            };
          }};
}

/// A block over `covered` x `covered` of `count` x `count` holes: rows fix the number or the share.
Design block_on_sheet(int count, int covered) {
  constexpr double SIDE = 0.25, HOLE = 0.09375, THICKNESS = 0.0625;
  const double side = SIDE * covered;
  return laid_on(make_box({side, side, side}), parts::make_perforated_sheet(count, SIDE, HOLE, THICKNESS),
                 0.2 * SIDE * (count - covered));
}

struct Row {
  std::string name;
  std::function<Design()> design;
};

std::vector<Row> rows(const PartsTimes& choice) {
  return {
      {"box on a box",
       [] {
         return laid_on(make_box({1, 0.8, 0.6}), make_box({1, 0.8, 0.6}), 0.4);
       }},
      {"peg of 64 in its bore", [] { return peg_in_bore(64); }},
      {"peg of 128 in its bore", [] { return peg_in_bore(128); }},
      {"peg of 256 in its bore", [] { return peg_in_bore(256); }},
      {"gears of 40 teeth, meshing", [] { return gears_in_mesh(40); }},
      {"gears of 40 teeth, one on the other", [] { return laid_on(gear(40), gear(40), 0.1); }},
      {"bolt in nut", bolt_in_nut},
      {"combs of 8 teeth, crossed", [] { return crossed_combs(8); }},
      {"combs of 16 teeth, crossed", [] { return crossed_combs(16); }},
      {"combs of 24 teeth, crossed", [] { return crossed_combs(24); }},
      {"combs of 32 teeth, crossed", [] { return crossed_combs(32); }},
      {"gear of 40 teeth over the hole of its outline", [] { return gear_over_its_hole(40); }},
      {"disc of 128 corners at rest on its copy", [] { return disc_on_its_copy(128); }},
      {"disc of 512 corners at rest on its copy", [] { return disc_on_its_copy(512); }},
      {"tetrahedron on a hub of 1000 triangles", [] { return tetrahedron_on_hub(1000); }},
      {"tetrahedron on a hub of 10000 triangles", [] { return tetrahedron_on_hub(10000); }},
      {"tetrahedron on a hub of 30000 triangles", [] { return tetrahedron_on_hub(30000); }},
      {"tetrahedron on a hub of 100000 triangles", [] { return tetrahedron_on_hub(100000); }},
      {"egg crates, hill on hill", [] { return egg_crates(Crates::HILL_ON_HILL); }},
      {"egg crates, nested beyond the cutoff", [] { return egg_crates(Crates::NESTED); }},
      {"the same, trembling", [] { return egg_crates(Crates::TREMBLING); }},
      {"block over 4 x 4 of 18 x 18 holes", [] { return block_on_sheet(18, 4); }},
      {"block over 4 x 4 of 36 x 36 holes", [] { return block_on_sheet(36, 4); }},
      {"block over 4 x 4 of 71 x 71 holes", [] { return block_on_sheet(71, 4); }},
      {"block over 9 x 9 of 18 x 18 holes", [] { return block_on_sheet(18, 9); }},
      {"block over 18 x 18 of 36 x 36 holes", [] { return block_on_sheet(36, 18); }},
      {choice.scan + ", trembling", [&choice] { return scan_in_hand(choice, TREMBLE, TREMBLE_RAD); }},
      {choice.scan + ", random walk", [&choice] { return scan_in_hand(choice, WALK, WALK_RAD); }},
  };
}

/// Results of one of the two ways: of every frame the least of the passes.
struct Way {
  std::unique_ptr<Method> method;
  LmdSet lmds;
  std::vector<double> seconds;
};

std::uint64_t mixed(std::uint64_t sum, const LmdSet& lmds) {
  const auto mix = [&](double x) { sum = (sum ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001B3U; };
  for (const Lmd& lmd : lmds) {
    mix(lmd.distance);
    for (int k = 0; k < 3; ++k) {
      mix(lmd.point_moving[k]);
      mix(lmd.point_fixed[k]);
    }
    mix(lmd.feature_moving.index);
    mix(lmd.feature_fixed.index);
  }
  return sum;
}

std::string columns(const std::vector<double>& seconds) {
  return fmt::format("{:.1f} | {:.1f} | {:.1f} | {}", 1e6 * median(seconds), 1e6 * quantile(seconds, P99),
                     1e6 * *std::max_element(seconds.begin(), seconds.end()),
                     std::count_if(seconds.begin(), seconds.end(), [](double s) { return s > 1e-3; }));
}

/// @return false where the sets of the two ways differ in some frame
bool measure(const Row& row, bool floats, const PartsTimes& choice, nlohmann::json& report) {
  Design design = row.design();
  Random random(choice.seed);
  const double cutoff = design.cutoff * bounding_box_diagonal(design.moving);
  Pose turn_moving, turn_fixed;
  const auto body = [&](TriangleMesh& mesh, Pose& turn) {
    if (floats) {
      turn.rotation = random.rotation();
      mesh = turned_to_floats(std::move(mesh), turn.rotation);
      flatten(mesh);
    }
    return std::make_shared<const Body>(row.name, build_surface(std::move(mesh)));
  };
  const std::shared_ptr<const Body> moving = body(design.moving, turn_moving);
  const Scene scene{moving, {body(design.fixed, turn_fixed)}, cutoff};
  std::vector<Pose> poses;
  for (std::size_t path = 0; path < choice.paths; ++path) {
    const Motion motion = design.draw(random);
    for (std::size_t frame = 0; frame < design.frames; ++frame) {
      const Pose pose = motion(static_cast<double>(frame));
      poses.push_back(floats ? turn_fixed * pose * turn_moving.inverse() : pose);
    }
  }
  std::array<Way, 2> ways;
  ways[0].method = make_method("certified", scene, {{"frame_coherence", false}});
  ways[1].method = make_method("certified", scene);
  std::vector<double> counts(poses.size());
  std::uint64_t checksum = 0xCBF29CE484222325U;
  std::size_t differ = 0;
  for (Way& way : ways) way.seconds.assign(poses.size(), std::numeric_limits<double>::infinity());
  for (std::size_t pass = 0; pass < choice.passes; ++pass)
    for (std::size_t i = 0; i < poses.size(); ++i) {
      for (Way& way : ways) {
        WorkCounters ignored;
        const double begin = experiments::thread_seconds();
        way.method->search(poses[i], way.lmds, ignored);
        way.seconds[i] = std::min(way.seconds[i], experiments::thread_seconds() - begin);
      }
      if (pass > 0) continue;
      counts[i] = static_cast<double>(ways[0].lmds.size());
      checksum = mixed(checksum, ways[0].lmds);
      if (mixed(0, ways[0].lmds) != mixed(0, ways[1].lmds)) ++differ;
    }
  // The first frame of a path reuses nothing of the path before.
  std::vector<double> coherent;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (i % design.frames != 0) coherent.push_back(ways[1].seconds[i]);
  fmt::print("| {} | {} | {} + {} | {:g} | {} | {} |\n", row.name, floats ? "floats" : "exact",
             scene.moving->surface().mesh.triangles.size(), scene.fixed[0]->surface().mesh.triangles.size(),
             median(counts), columns(ways[0].seconds), columns(coherent));
  std::fflush(stdout);
  if (differ > 0) fmt::print(stderr, "wrong: {}: {} sets are others coherently\n", row.name, differ);
  report["rows"].push_back({{"name", row.name},
                            {"floats", floats},
                            {"from_scratch_s", ways[0].seconds},
                            {"coherent_s", coherent},
                            {"checksum", fmt::format("{:016x}", checksum)}});
  return differ == 0;
}

}  // namespace

int time_parts(const PartsTimes& choice, nlohmann::json report) {
  fmt::print(
      "Cutoff {:g} % of the moving mesh's diagonal (bolt: 0.4; nested crates: half the gap); {} paths of {} "
      "frames (trembling: {}), seed {}; of every frame the least "
      "of {} "
      "runs, processor time of one thread [us]\n\n",
      100.0 * CUTOFF, choice.paths, FRAMES, TREMBLING_FRAMES, choice.seed, choice.passes);
  fmt::print(
      "| parts | coordinates | triangles | LMDs | from scratch: median | p99 | largest | above 1 ms | "
      "coherent: median | p99 | largest | above 1 ms |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  bool agree = true;
  for (const Row& row : rows(choice)) {
    if (row.name.find(choice.row) == std::string_view::npos) continue;
    for (const bool floats : {false, true}) agree = measure(row, floats, choice, report) && agree;
  }
  experiments::write_report(choice.json, report);
  return agree ? 0 : 1;
}

}  // namespace lmdbench::flat_parts
