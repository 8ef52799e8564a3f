// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <support/closed_solids.h>
#include <support/scenes.h>

#include <cstdlib>
#include <string>
#include <vector>

/// Critical pairs: their indices add up to the product of the solids' Euler characteristics, and the minima among them are the LMDs.
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

/// LMDBENCH_CRITICAL_POSES, or few.
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

bool same_bits(const LmdSet& a, const LmdSet& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const Lmd& x, const Lmd& y) {
           return x.distance == y.distance && x.point_moving == y.point_moving &&
                  x.point_fixed == y.point_fixed &&
                  (x.direction == y.direction || !x.direction.allFinite()) && same_feature_pair(x, y) &&
                  x.triangle_moving == y.triangle_moving && x.triangle_fixed == y.triangle_fixed;
         });
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
          CriticalSet critical;
          WorkCounters counters;
          method->find_critical(pose, critical, counters);
          EXPECT_EQ(sum_of_indices(critical), all[a].euler * all[b].euler)
              << name << ", " << all[a].name << " at " << all[b].name << ", pose " << k << "\n"
              << text(critical);
          LmdSet lmds;
          method->search(pose, lmds, counters);
          EXPECT_TRUE(same_bits(minima_of(critical), lmds))
              << name << ", " << all[a].name << ", " << all[b].name;
          for (const CriticalPair& pair : critical)
            EXPECT_TRUE(pair.has_index && (!pair.is_minimum || pair.index == 1)) << pair.index;
        }
      }
    }
}

}  // namespace
}  // namespace lmdbench
