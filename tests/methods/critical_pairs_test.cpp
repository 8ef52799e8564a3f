// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/critical/merges.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <support/closed_solids.h>
#include <support/convex_bodies.h>
#include <support/same_lmds.h>
#include <support/scenes.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <vector>

/// Indices of critical pairs add up to the product of Euler characteristics; minima are the LMDs.
namespace lmdbench {
namespace {

struct Solid {
  const char* name;
  TriangleMesh mesh;
  int euler;  ///< Of the solid: components less tunnels plus cavities.
};

std::vector<Solid> solids() {
  return {{"blob", make_blob(1.0, 0.25, 2), 1},
          {"torus", make_torus(1.0, 0.4, 14, 9), 0},
          {"needles", make_needles(1.0, 2.0, 20), 1},
          {"L block", make_l_block(1.0), 1},
          {"plate with two holes", scaled(testing::make_plate_with_holes(2), 0.3), -1},
          {"two blobs",
           merged(translated(make_blob(0.6, 0.15, 1), {1.0, 0.0, 0.0}),
                  translated(make_blob(0.6, 0.2, 1), {-0.9, 0.2, 0.1})),
           2},
          {"torus and box", merged(make_torus(1.0, 0.3, 10, 7), make_box({0.3, 0.4, 0.5}, 2)), 1}};
}

/// LMDBENCH_CRITICAL_POSES, or a few.
int pose_count() {
  const char* const wanted = std::getenv("LMDBENCH_CRITICAL_POSES");
  return wanted != nullptr ? std::atoi(wanted) : 10;
}

std::vector<std::string> methods_with_critical_pairs() {
  std::vector<std::string> names;
  for (const MethodDescription& description : method_descriptions())
    if (description.finds_critical_pairs) names.push_back(description.name);
  return names;
}

std::string text(const CriticalSet& set) {
  std::string result;
  for (const auto& [pair, index, is_minimum, has_index, is_basin] : set)
    result += fmt::format("{:.17g} {} {} {} - {} {}\n", pair.distance, is_minimum ? "minimum" : "saddle",
                          index, to_string(pair.feature_moving.kind), pair.feature_moving.index,
                          to_string(pair.feature_fixed.kind));
  return result;
}

TEST(CriticalPairs, IndicesAddUpToTheEulerCharacteristics) {
  const auto all = solids();
  ASSERT_FALSE(methods_with_critical_pairs().empty());
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b) {
      const Scene scene = testing::make_scene(all[a].mesh, all[b].mesh, 1e3);
      for (const std::string& name : methods_with_critical_pairs()) {
        const auto method = make_method(name, scene);
        std::mt19937_64 random(a * 16 + b);
        for (int k = 0; k < pose_count(); ++k) {
          const Pose pose =
              testing::grazing_pose(scene, std::pow(10.0, -4.0 * testing::uniform(random)), random);
          const CriticalSet critical = critical_at(*method, pose);
          EXPECT_EQ(sum_of_indices(critical), all[a].euler * all[b].euler)
              << name << ", " << all[a].name << " at " << all[b].name << ", pose " << k << "\n"
              << text(critical);
          testing::expect_same_lmds(minima_of(critical), lmds_at(*method, pose),
                                    name + ", " + all[a].name + ", " + all[b].name);
          for (const CriticalPair& pair : critical)
            EXPECT_TRUE(pair.has_index && (!pair.is_minimum || pair.index == 1)) << pair.index;
        }
      }
    }
}

TEST(CriticalPairs, OfConvexBodiesOnEachOtherAreTheOneLmd) {
  int asked = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    std::mt19937_64 random(seed);
    const testing::ConvexBody moving = testing::random_convex_body(random),
                              fixed = testing::random_convex_body(random);
    const Scene scene =
        testing::make_scene(moving.mesh(random() % 2 == 0), fixed.mesh(random() % 2 == 0), 1e3);
    for (const std::string& name : methods_with_critical_pairs()) {
      const auto method = make_method(name, scene);
      std::mt19937_64 poses(seed);
      for (int k = 0; k < 10; ++k) {
        const Pose pose = testing::flush_pose(moving, fixed, poses);
        const CriticalSet critical = critical_at(*method, pose);
        // Nearer meshes may intersect at the slight turn in which indices are taken.
        if (critical.empty() || critical.front().pair.distance < 1e-7) continue;
        ++asked;
        EXPECT_TRUE(critical.size() == 1 && critical.front().index == 1 && critical.front().is_basin)
            << name << ", scene " << seed << " pose " << k << "\n"
            << text(critical);
      }
    }
  }
  EXPECT_GT(asked, 300);
}

/// A regular octahedron, its corners at `radius` on the axes.
TriangleMesh octahedron(double radius) {
  TriangleMesh mesh;
  mesh.vertices = {radius * Vec3::UnitX(),  -radius * Vec3::UnitX(), radius * Vec3::UnitY(),
                   -radius * Vec3::UnitY(), radius * Vec3::UnitZ(),  -radius * Vec3::UnitZ()};
  mesh.triangles = {{0, 2, 4}, {0, 5, 2}, {0, 4, 3}, {0, 3, 5}, {1, 4, 2}, {1, 2, 5}, {1, 3, 4}, {1, 5, 3}};
  return mesh;
}

/// Their direction is rounding: no bound may speak for it, and the minimum has its index.
TEST(CriticalPairs, OfCornersNextToTouchAreOneLmd) {
  const Scene scene = testing::make_scene(octahedron(0.5), octahedron(0.5), 0.05);
  for (const std::string& name : methods_with_critical_pairs()) {
    const auto method = make_method(name, scene);
    for (const double gap : {3e-9, 8e-9, 1.5e-8, 3e-8, 1e-6})
      for (const double aside : {0.0, 0.1, -0.3}) {
        Pose pose = testing::moved(aside * gap, 0.0, 1.0 + gap);
        pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
        const CriticalSet critical = critical_at(*method, pose);
        ASSERT_EQ(critical.size(), 1u) << name << ", gap " << gap << "\n" << text(critical);
        EXPECT_TRUE(critical[0].is_minimum && critical[0].index == 1) << name << "\n" << text(critical);
      }
  }
}

/// Blocks over each other's edges, with a vertex where the moving mesh has its origin: nothing may
/// stand still when indices are taken.
TEST(CriticalPairs, OfAlignedBlocksAddUpWhereverTheOriginIs) {
  const TriangleMesh block = make_l_block(1.0);
  std::mt19937_64 random(7);
  for (int k = 0; k < 60; ++k) {
    const Vec3 origin = block.vertices[random() % block.vertices.size()],
               other = block.vertices[random() % block.vertices.size()];
    const Scene scene = testing::make_scene(translated(block, -origin), translated(block, -other), 1e3);
    Pose pose;
    pose.rotation =
        Eigen::AngleAxisd(0.5 * std::numbers::pi * static_cast<double>(random() % 4), Vec3::UnitZ());
    const auto halves = [&] { return 0.5 * static_cast<double>(random() % 5) - 1.0; };
    pose.translation = Vec3(halves(), halves(), 3.0 + halves());
    for (const std::string& name : methods_with_critical_pairs()) {
      const CriticalSet critical = critical_at(*make_method(name, scene), pose);
      EXPECT_EQ(sum_of_indices(critical), 1) << name << ", pose " << k << "\n" << text(critical);
    }
  }
}

TEST(CriticalPairs, BordersHaveNoIndex) {
  const Scene scene = testing::make_scene(make_sphere(0.2, 1), make_patch(1.0, 4, 0.1), 1.0);
  for (const std::string& name : methods_with_critical_pairs()) {
    const auto method = make_method(name, scene);
    for (const Pose& pose :
         {testing::moved(0.9, 0.05, 0.0), testing::moved(0.7, 0.7, 0.1), testing::moved(0.0, 0.0, 0.5)}) {
      const CriticalSet critical = critical_at(*method, pose);
      testing::expect_same_lmds(minima_of(critical), lmds_at(*method, pose));
      ASSERT_FALSE(critical.empty());
      for (const CriticalPair& pair : critical) {
        const bool on_border = scene.fixed[0]->surface().is_boundary(pair.pair.feature_fixed);
        EXPECT_EQ(pair.has_index, !on_border) << name;
        EXPECT_TRUE(pair.is_minimum || pair.has_index);
      }
    }
  }
}

TEST(CriticalPairs, OfASphereInACavityOfABoxAddUp) {
  // The block has a cavity: its solid's characteristic is 2. The inner mesh faces the cavity alone.
  TriangleMesh cavity = make_sphere(1.0, 1);
  for (auto& t : cavity.triangles) std::swap(t[1], t[2]);
  const Scene scene =
      testing::make_scene(make_blob(0.3, 0.1, 1), merged(cavity, make_box(Vec3::Constant(4.0), 1)), 1e3);
  for (const std::string& name : methods_with_critical_pairs()) {
    const auto method = make_method(name, scene);
    std::mt19937_64 random(3);
    for (int k = 0; k < 20; ++k) {
      Pose pose{0.3 * testing::uniform(random) * testing::random_direction(random),
                testing::random_rotation(random)};
      const CriticalSet critical = critical_at(*method, pose);
      EXPECT_EQ(sum_of_indices(critical), 2) << name << "\n" << text(critical);
    }
  }
}

/// Where a minimum and its saddle are one to the tolerance, an LMD is there already, but no basin:
/// else a force that is shared among basins jumps for so long.
TEST(CriticalPairs, OfALmdThatIsJustBornAreNoBasin) {
  const Scene scene = testing::make_scene(make_blob(1.0, 0.25, 3), make_torus(1.2, 0.45, 32, 16), 0.3);
  int newborn = 0;
  for (const std::string& name : methods_with_critical_pairs()) {
    const auto method = make_method(name, scene);
    const auto at = [&](double x) {
      const Eigen::AngleAxisd turn(0.5 + x, Vec3(0.3, 0.5, 0.8).normalized());
      return critical_at(*method,
                         {Vec3(0.3 + 0.4 * x, 0.1 - 0.2 * x, 1.5 - 0.1 * x), Eigen::Quaterniond(turn)});
    };
    const auto minima = [](const CriticalSet& set) {
      return std::ranges::count_if(set, [](const CriticalPair& c) { return c.is_minimum; });
    };
    constexpr int STEPS = 60;
    for (int step = 0; step < STEPS; ++step) {
      double low = static_cast<double>(step) / STEPS, high = static_cast<double>(step + 1) / STEPS;
      const auto few = minima(at(low));
      if (minima(at(high)) == few) continue;
      while (high - low > 1e-13) {
        const double middle = 0.5 * (low + high);
        (minima(at(middle)) == few ? low : high) = middle;
      }
      for (const double x : {low, high})
        for (const CriticalPair& c : at(x)) {
          if (c.index > 0 || !c.is_minimum) continue;
          ++newborn;
          EXPECT_FALSE(c.is_basin) << name << " at " << x << "\n" << text(at(x));
        }
    }
  }
  EXPECT_GT(newborn, 4);
}

TEST(Merges, JoinTheMinimaRoundARing) {
  // A ball over the hole of a facetted ring: minima and saddles alternate round it.
  for (const int cells : {5, 8, 13}) {
    const Scene scene = testing::make_scene(make_blob(0.3, 0.05, 2), make_torus(1.0, 0.3, cells, 8), 1e3);
    const auto method = make_method("certified", scene);
    MergeFinder finder(scene);
    std::mt19937_64 random(11);
    for (int k = 0; k < 20; ++k) {
      const Pose pose{Vec3(0.02, 0.01, 0.5) + 0.05 * testing::random_direction(random),
                      testing::random_rotation(random)};
      const CriticalSet critical = critical_at(*method, pose);
      std::vector<Merge> merges;
      finder.find(pose, critical, merges);
      std::vector<std::size_t> group(critical.size());
      std::iota(group.begin(), group.end(), std::size_t{0});
      double level = 0.0;
      for (const Merge& merge : merges) {
        const double at = critical[merge.saddle].pair.distance;
        EXPECT_GE(at, level) << "by level";
        level = at;
        for (const std::size_t minimum : {merge.first, merge.second}) {
          EXPECT_TRUE(critical[minimum].is_basin);
          EXPECT_LE(critical[minimum].pair.distance, at);
        }
        const std::size_t from = group[merge.second], to = group[merge.first];
        std::ranges::replace(group, from, to);
      }
      std::set<std::size_t> components;
      int minima = 0;
      for (std::size_t i = 0; i < critical.size(); ++i)
        if (critical[i].is_basin && critical[i].pair.distance < 0.9) {
          ++minima;
          components.insert(group[i]);
        }
      EXPECT_GE(minima, 2);
      EXPECT_EQ(components.size(), 1u) << cells << " cells, pose " << k << "\n" << text(critical);
    }
  }
}

TEST(Merges, GiveUpWhereMeshesMeet) {
  // Where meshes meet, all pairs are at distance 0: nothing descends, a search would visit all.
  const Scene scene = testing::make_scene(make_blob(1.0, 0.25, 3), make_torus(1.0, 0.4, 24, 16), 1.0);
  const auto method = make_method("certified", scene);
  std::mt19937_64 random(5);
  std::uint64_t most = 0;
  for (int k = 0; k < 3; ++k) {
    const Pose pose{Vec3(1.0 + 0.1 * k, 0.1, 0.6), testing::random_rotation(random)};
    const CriticalSet critical = critical_at(*method, pose);
    std::vector<Merge> merges;
    MergeFinder finder(scene);
    ASSERT_TRUE(critical.front().pair.intersecting);
    finder.find(pose, critical, merges);
    most = std::max(most, finder.triangle_distances());
  }
  EXPECT_GT(most, 0u);
  EXPECT_LT(most, 3000u);
}

}  // namespace
}  // namespace lmdbench
