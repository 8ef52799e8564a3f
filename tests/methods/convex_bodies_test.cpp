// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/contact_tolerance.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/shape/flatten.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <support/convex_bodies.h>
#include <support/lmd_text.h>
#include <support/rounded.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>

/// Two convex bodies that are apart have exactly one LMD at every pose, at their distance.
namespace lmdbench {
namespace {

using testing::ConvexBody;
using testing::text;
using testing::uniform;

/// LMDBENCH_CONVEX_SCENES, or a few.
int scene_count() {
  const char* const wanted = std::getenv("LMDBENCH_CONVEX_SCENES");
  return wanted != nullptr ? std::atoi(wanted) : 150;
}
std::uint64_t first_seed() {
  const char* const wanted = std::getenv("LMDBENCH_CONVEX_SEED");
  return wanted != nullptr ? static_cast<std::uint64_t>(std::atoll(wanted)) : 0;
}

/// LMDs of both exact methods, which are alike.
std::size_t lmds_at(const Scene& scene, const Pose& pose) {
  LmdSet truth, found;
  WorkCounters counters;
  make_method("exhaustive", scene)->search(pose, truth, counters);
  make_method("certified", scene)->search(pose, found, counters);
  EXPECT_EQ(truth.size(), found.size());
  return truth.size();
}

/// A square with two sides: normals of its edges and corners cancel, but for rounding.
TEST(ConvexBodies, SheetsWithTwoSidesHaveOneLmd) {
  const TriangleMesh square{{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}},
                            {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}}};
  std::mt19937_64 random(31);
  for (int k = 0; k < 40; ++k) {
    const Pose whole = testing::pose_of_seed(random());
    const Scene scene = testing::make_scene(make_box({0.1, 0.1, 0.1}), testing::placed(square, whole), 1.5);
    for (int i = 0; i < 5; ++i) {
      Pose beside = testing::pose_of_seed(random());
      beside.translation = Vec3(0.8 + 0.2 * uniform(random), uniform(random) - 0.2, 0.1 * uniform(random));
      EXPECT_EQ(lmds_at(scene, whole * beside), 1U) << k << ", " << i;
    }
  }
}

/// Thinner than the tolerance of its planes: the walls are needles of noise, and both sides would
/// be put into one plane with them.
TEST(ConvexBodies, ThinPlatesOfSinglePrecisionKeepTheirRim) {
  std::mt19937_64 random(33);
  for (const double thickness : {1e-8, 3e-8, 1e-7, 2e-7, 4e-7, 1e-6}) {
    for (int k = 0; k < 20; ++k) {
      const Pose whole = testing::pose_of_seed(random());
      TriangleMesh mesh = testing::rounded_to_floats(testing::placed(make_box({1, 1, thickness}), whole));
      flatten(mesh);
      const Scene scene = testing::make_scene(make_box({0.1, 0.1, 0.1}), std::move(mesh), 1.5);
      for (int i = 0; i < 5; ++i) {
        Pose beside = testing::pose_of_seed(random());
        beside.translation = Vec3(0.8 + 0.2 * uniform(random), uniform(random) - 0.2, 0.1 * uniform(random));
        // Rounding leaves walls that are not convex: LMDs beside each other.
        const double apart = nearest_pair(*scene.moving, scene.fixed_body(), whole * beside).distance;
        for (const char* method : {"exhaustive", "certified"}) {
          const LmdSet lmds = lmds_at(*make_method(method, scene), whole * beside);
          ASSERT_FALSE(lmds.empty()) << method << ", " << thickness << ", " << k << ", " << i;
          EXPECT_NEAR(minimum_distance(lmds), apart, 1e-9)
              << method << ", " << thickness << ", " << k << ", " << i;
          EXPECT_LT(lmds.back().distance, apart + 1e-6)
              << method << ", " << thickness << ", " << k << ", " << i;
        }
      }
    }
  }
}

/// Triangles with two corners at one vertex, on every edge.
TEST(ConvexBodies, WithCollapsedTrianglesHaveOneLmd) {
  std::mt19937_64 random(34);
  TriangleMesh box = make_box({1, 1, 1});
  for (const auto& [a, b] : build_surface(box).adjacency.edges) box.triangles.push_back({a, b, a});
  const Scene scene = testing::make_scene(make_box({0.1, 0.1, 0.1}), std::move(box), 2.0);
  for (int i = 0; i < 100; ++i) {
    Pose beside = testing::pose_of_seed(random());
    beside.translation = testing::random_direction(random) * (1.0 + 0.2 * uniform(random));
    EXPECT_EQ(lmds_at(scene, beside), 1U) << i;
  }
}

/// The diagonal of a face meets a corner of one side alone; a needle closes the gap.
TriangleMesh with_needle(TriangleMesh mesh, double share) {
  const auto corners = mesh.triangles.front();
  const Surface surface = build_surface(mesh);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t x = corners[k], y = corners[(k + 1) % 3], z = corners[(k + 2) % 3];
    const auto beside = surface.adjacency.edge_triangles[surface.adjacency.triangle_edges[0][k]];
    const std::int32_t other = beside[0] == 0 ? beside[1] : beside[0];
    if (surface.face_normals[0].dot(surface.face_normals[static_cast<std::size_t>(other)]) < 0.9) continue;
    const auto m = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.push_back((1.0 - share) * mesh.vertices[static_cast<std::size_t>(x)] +
                            share * mesh.vertices[static_cast<std::size_t>(y)]);
    mesh.triangles[0] = {x, m, z};
    mesh.triangles.push_back({m, y, z});
    mesh.triangles.push_back({x, y, m});
  }
  return mesh;
}

/// Rounding turns some of the needles over.
TEST(ConvexBodies, WithNeedlesOfSinglePrecisionHaveOneLmd) {
  std::mt19937_64 random(32);
  int flipped = 0;
  for (int k = 0; k < 60; ++k) {
    TriangleMesh box = with_needle(make_box({1, 1, 1}), 0.2 + 0.6 * uniform(random));
    const Pose whole = testing::pose_of_seed(random());
    TriangleMesh mesh = testing::rounded_to_floats(testing::placed(std::move(box), whole));
    flipped += flatten(mesh).flipped_triangles == 1 ? 1 : 0;
    const Scene scene = testing::make_scene(make_box({0.1, 0.1, 0.1}), std::move(mesh), 2.0);
    for (int i = 0; i < 5; ++i) {
      Pose beside = testing::pose_of_seed(random());
      beside.translation = testing::random_direction(random) * (1.0 + 0.2 * uniform(random));
      EXPECT_EQ(lmds_at(scene, whole * beside), 1U) << k << ", " << i;
    }
  }
  EXPECT_GT(flipped, 50);
}

TEST(ConvexBodies, HaveOneLmdAtEveryPose) {
  int asked = 0, touching = 0;
  for (int s = 0; s < scene_count(); ++s) {
    const std::uint64_t seed = first_seed() + static_cast<std::uint64_t>(s);
    std::mt19937_64 random(seed);
    const ConvexBody moving = testing::random_convex_body(random),
                     fixed = testing::random_convex_body(random);
    const bool is_turned = random() % 2 == 0;
    const Pose whole = is_turned ? testing::pose_of_seed(random()) : Pose{};
    TriangleMesh mesh_fixed = fixed.mesh(random() % 2 == 0);
    if (is_turned) mesh_fixed = testing::placed(std::move(mesh_fixed), whole);
    const Scene scene = testing::make_scene(moving.mesh(random() % 2 == 0), std::move(mesh_fixed), 0.6);
    const Body &a = *scene.moving, &b = *scene.fixed[0];
    const auto truth = make_method("exhaustive", scene), certified = make_method("certified", scene);
    for (int k = 0; k < 20; ++k) {
      Pose pose = testing::flush_pose(moving, fixed, random);
      if (is_turned) pose = whole * pose;
      const double apart = nearest_pair(a, b, pose).distance;
      const ContactTolerance tolerance = ContactTolerance::of(a, b, RigidTransform(pose), scene.cutoff);
      if (!(apart > 4.0 * tolerance.rounding)) {
        ++touching;
        continue;
      }
      ++asked;
      for (const auto& method : {truth.get(), certified.get()}) {
        const LmdSet lmds = lmds_at(*method, pose);
        const bool right = lmds.size() == 1 && lmds[0].distance >= apart - 4.0 * tolerance.rounding &&
                           lmds[0].distance <= apart + tolerance.widest_tie(apart);
        EXPECT_TRUE(right) << method->description().name << ", scene " << seed << " pose " << k << ", apart "
                           << fmt::format("{:.17g}", apart) << "\n"
                           << text(pose) << "\n"
                           << text(lmds);
      }
    }
  }
  EXPECT_GT(asked, 5 * touching);
}

/// Rounding lets a corner's short chains slope inwards, and those that nearly are one line.
TEST(ConvexBodies, ATipOverAFaceBesideACornerHasOneLmd) {
  struct Beside {
    std::vector<Vec3> outline;
    Vec3 place;
  };
  std::vector<Beside> cases;
  for (const double side : {1e-2, 1e-3, 1e-4})
    for (const double bend : {3e-7, 2e-6, 1e-5, 1e-3})
      // The first corner's neighbour is cut off as one triangle, which gives it no side inside.
      cases.push_back({{{-side, 0, 0},
                        {0, -0.5 * side * bend, 0},
                        {side, 0, 0},
                        {0.5, 0.3, 0},
                        {0.5, 1, 0},
                        {-0.5, 1, 0},
                        {-0.5, 0.3, 0}},
                       {0, 0.5 * side, 0}});
  for (const double side : {1e-8, 1e-9, 1e-10, 1e-11})
    cases.push_back(
        {{{-0.5, 0, 0}, {0, 0, 0}, {side, side, 0}, {side, 0.5, 0}, {-0.5, 0.5, 0}}, {-1e-5, 5e-5, 0}});
  const TriangleMesh tip{{{0, 0, 0}, {0.1, 0, 0.1}, {-0.05, 0.08, 0.1}, {-0.05, -0.08, 0.1}},
                         {{1, 2, 3}, {0, 2, 1}, {0, 3, 2}, {0, 1, 3}}};
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const bool is_turned : {false, true}) {
      const Pose whole = is_turned ? testing::pose_of_seed(i) : Pose{};
      TriangleMesh block = translated(testing::make_frustum(cases[i].outline, 0.5, 1.0, Vec3::Zero()).mesh(),
                                      Vec3(0, 0, -0.5));
      const Scene scene = testing::make_scene(tip, testing::placed(std::move(block), whole), 1.0);
      Pose pose;
      pose.translation = cases[i].place + Vec3(0, 0, 0.5);
      for (const char* const method : {"exhaustive", "certified"}) {
        const LmdSet lmds = lmds_at(*make_method(method, scene), whole * pose);
        EXPECT_EQ(lmds.size(), 1u) << method << ", case " << i << text(lmds);
      }
    }
}

/// A face is cut at a vertex beside a corner, whose place rounding takes off the face's plane.
TEST(ConvexBodies, ACutBesideACornerLeavesItsCone) {
  for (const double beside : {1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10})
    for (const double off : {0.0, 1e-16, 1e-15, 1e-14}) {
      TriangleMesh prism =
          testing::make_frustum(testing::regular_polygon(8, 1.0, 0.0), 1.0, 1.0, Vec3::Zero()).mesh();
      std::erase_if(prism.triangles, [](const auto& t) { return std::ranges::max(t) < 8; });
      const auto middle = static_cast<std::int32_t>(prism.vertices.size());
      prism.vertices.emplace_back(1.0 - beside, 0.0, -off);
      for (std::int32_t k = 0; k < 8; ++k) prism.triangles.push_back({middle, (k + 1) % 8, k});
      const Scene scene =
          testing::make_scene(std::move(prism), translated(make_box({6, 6, 1}), Vec3(0, 0, -0.5)), 0.5);
      const auto truth = make_method("exhaustive", scene), certified = make_method("certified", scene);
      for (const double gap : {1e-3, 1e-8})
        for (const double tilt : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-3}) {
          Pose pose{Vec3::Zero(), Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vec3::UnitY()))};
          pose.translation.z() = gap - (pose.rotation * Vec3::UnitX()).z();
          for (const auto& method : {truth.get(), certified.get()}) {
            const LmdSet lmds = lmds_at(*method, pose);
            EXPECT_EQ(lmds.size(), 1u) << method->description().name << ", " << beside << " beside, " << off
                                       << " off, gap " << gap << ", tilt " << tilt;
          }
        }
    }
}

/// A convex top with heights f(x) + g(y) over the knots of a grid (place, height), walls down from
/// it; turned over on demand.
TriangleMesh cap_over(const std::vector<Vec2>& f, const std::vector<Vec2>& g, bool is_upside_down) {
  const auto at = [&](std::size_t i, std::size_t k) { return static_cast<std::int32_t>(i * g.size() + k); };
  TriangleMesh mesh;
  for (const Vec2& x : f)
    for (const Vec2& y : g) mesh.vertices.emplace_back(x.x(), y.x(), x.y() + y.y());
  for (std::size_t i = 0; i + 1 < f.size(); ++i)
    for (std::size_t k = 0; k + 1 < g.size(); ++k) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  std::vector<std::int32_t> border;
  for (std::size_t i = 0; i + 1 < f.size(); ++i) border.push_back(at(i, 0));
  for (std::size_t k = 0; k + 1 < g.size(); ++k) border.push_back(at(f.size() - 1, k));
  for (std::size_t i = f.size() - 1; i > 0; --i) border.push_back(at(i, g.size() - 1));
  for (std::size_t k = g.size() - 1; k > 0; --k) border.push_back(at(0, k));
  const auto base = static_cast<std::int32_t>(mesh.vertices.size());
  const auto n = static_cast<std::int32_t>(border.size());
  for (const std::int32_t v : border) {
    const Vec3 x = mesh.vertices[static_cast<std::size_t>(v)];
    mesh.vertices.emplace_back(x.x(), x.y(), -0.5);
  }
  for (std::int32_t k = 0; k < n; ++k) {
    const std::int32_t next = (k + 1) % n, top = border[static_cast<std::size_t>(k)],
                       next_top = border[static_cast<std::size_t>(next)];
    mesh.triangles.push_back({base + k, base + next, next_top});
    mesh.triangles.push_back({base + k, next_top, top});
    if (k > 0 && k + 1 < n) mesh.triangles.push_back({base, base + next, base + k});
  }
  if (is_upside_down) {
    for (Vec3& x : mesh.vertices) x.z() = -x.z();
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

/// With slopes from 3e-9 to 1e-3.
TriangleMesh shallow_cap(std::mt19937_64& random, bool is_upside_down) {
  const auto knots_and_heights = [&] {
    const std::size_t count = 2 + random() % 3;
    std::vector<double> knots{-0.5}, slopes;
    for (std::size_t k = 1; k < count; ++k) {
      knots.push_back(-0.5 + (static_cast<double>(k) - 0.4 * uniform(random)) / static_cast<double>(count));
      slopes.push_back(std::pow(10.0, -8.5 + 5.5 * uniform(random)) * (random() % 2 == 0 ? 1.0 : -1.0));
    }
    knots.back() = 0.5;
    if (random() % 3 == 0) slopes.front() = 0.0;
    std::ranges::sort(slopes, std::greater());
    std::vector<Vec2> result{{knots[0], 0.0}};
    for (std::size_t k = 1; k < count; ++k)
      result.emplace_back(knots[k], result.back().y() + slopes[k - 1] * (knots[k] - knots[k - 1]));
    return result;
  };
  const std::vector<Vec2> f = knots_and_heights(), g = knots_and_heights();
  return cap_over(f, g, is_upside_down);
}

/// Two of 35,000 such poses: a corner whose direction is square to an edge only up to the tilt, and
/// edges that cross at 1.5e-9 rad, had an LMD of their own.
TEST(ConvexBodies, CapsWhoseFarEdgesNearlyFaceEachOtherHaveOneLmd) {
  struct Found {
    std::vector<Vec2> f_moving, g_moving, f_fixed, g_fixed;
    Pose pose;
  };
  const double third = 1.0 / 6.0;
  const Found all[] = {
      {{{-0.5, -6.121224846706902e-05}, {-third, 0}, {third, 0}, {0.5, -8.427876903865458e-07}},
       {{-0.5, -3.011259295561113e-4}, {0, 0}, {0.5, 0}},
       {{-0.5, -3.814476234064164e-06}, {0.5, 0}},
       {{-0.5, -2.2788713089457586e-09}, {0.015567137007523768, 0}, {0.5, 0}},
       {Vec3(0, 0, -8.301842757928168e-07),
        Eigen::Quaterniond(0.9999999999999756, -1.4371292576417738e-09, -1.1627211685799405e-09,
                           2.2038021396164876e-07)}},
      {{{-0.5, 0}, {0.5, 0}},
       {{-0.5, -2.714411613168471e-07},
        {-0.2891577479408528, -1.3716768815918484e-09},
        {-0.07043941430409006, 0},
        {0.5, 0}},
       {{-0.5, 0}, {0, 0}, {0.5, -9.097524334938418e-07}},
       {{-0.5, 0}, {0.5, -1.731544912941726e-08}},
       {Vec3(0, 0, -4.085874509389409e-09), Eigen::Quaterniond(1, 0, 0, 1.450538887084125e-09)}}};
  for (const Found& found : all) {
    const Scene scene = testing::make_scene(cap_over(found.f_moving, found.g_moving, true),
                                            cap_over(found.f_fixed, found.g_fixed, false), 0.1);
    for (const char* const method : {"exhaustive", "certified"}) {
      const LmdSet lmds = lmds_at(*make_method(method, scene), found.pose);
      EXPECT_EQ(lmds.size(), 1u) << method << text(lmds);
    }
  }
}

/// Nearly flush: far corners and edges have directions within rounding / distance of both cones.
TEST(ConvexBodies, NearlyFlushCapsHaveOneLmd) {
  int asked = 0;
  for (int s = 0; s < scene_count() / 3; ++s) {
    const std::uint64_t seed = first_seed() + static_cast<std::uint64_t>(s);
    std::mt19937_64 random(seed);
    const Scene scene = testing::make_scene(shallow_cap(random, true), shallow_cap(random, false), 0.1);
    const auto truth = make_method("exhaustive", scene), certified = make_method("certified", scene);
    for (int k = 0; k < 20; ++k) {
      const double yaw = k % 3 == 0   ? 0.5 * std::numbers::pi * static_cast<double>(random() % 4)
                         : k % 3 == 1 ? std::pow(10.0, -9.0 + 6.0 * uniform(random))
                                      : 6.0 * uniform(random);
      const Vec3 axis = Vec3(uniform(random) - 0.5, uniform(random) - 0.5, 0.0).normalized();
      const double tilt = random() % 3 == 0 ? 0.0 : std::pow(10.0, -9.5 + 6.5 * uniform(random));
      Pose pose{Vec3(0.0, 0.0, 3e-3),
                Eigen::Quaterniond(Eigen::AngleAxisd(tilt, axis)) * Eigen::AngleAxisd(yaw, Vec3::UnitZ())};
      if (random() % 2 == 0) pose.translation += Vec3(uniform(random), uniform(random), 0.0) * 0.3;
      const LmdSet far = lmds_at(*truth, pose);
      ASSERT_EQ(far.size(), 1u) << "scene " << seed << " pose " << k;
      const double gap = std::pow(10.0, -13.0 + 8.0 * uniform(random));
      pose.translation.z() -= far[0].point_moving.z() - far[0].point_fixed.z() - gap;
      const LmdSet lmds = lmds_at(*truth, pose);
      if (!lmds.empty() && lmds.front().distance == 0.0) continue;
      ++asked;
      EXPECT_EQ(lmds.size(), 1u) << "scene " << seed << " pose " << k << "\n"
                                 << text(pose) << "\n"
                                 << text(lmds);
      EXPECT_EQ(text(lmds_at(*certified, pose)), text(lmds)) << "scene " << seed << " pose " << k;
    }
  }
  EXPECT_GT(asked, 17 * scene_count() / 3);
}

}  // namespace
}  // namespace lmdbench
