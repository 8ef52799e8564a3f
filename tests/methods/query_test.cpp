// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/query.h>
#include <lmdbench/methods/registry.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/scenes.h>

namespace lmdbench {
namespace {

Scene spheres() {
  return testing::make_scene(make_sphere(0.5, 3), make_sphere(0.5, 3), 0.05);
}

Pose at_gap(double gap) {
  return {Vec3(1.0 + gap, 0.0, 0.0)};
}

TEST(Query, JsonHasTheContractsKeys) {
  const auto method = make_method("exhaustive", spheres());
  const auto json = nlohmann::json::parse(query_json(query(*method, at_gap(0.04), 0.05, 1.5)));
  EXPECT_EQ(json["time"], 1.5);
  EXPECT_EQ(json["method"], "exhaustive");
  EXPECT_NEAR(json["minimum_distance"].get<double>(), 0.04, 1e-9);
  ASSERT_EQ(json["lmds"].size(), 1u);
  const auto& lmd = json["lmds"][0];
  EXPECT_NEAR(lmd["distance"].get<double>(), 0.04, 1e-9);
  EXPECT_NEAR(lmd["point_moving"][0].get<double>(), 0.54, 1e-9) << "world coordinates";
  EXPECT_NEAR(lmd["point_fixed"][0].get<double>(), 0.5, 1e-9);
  EXPECT_EQ(lmd["feature_moving"]["kind"], "vertex");
  EXPECT_TRUE(lmd["feature_fixed"]["index"].is_number_integer());
  EXPECT_TRUE(json["counters"].is_object());
  EXPECT_GT(json["counters"]["feature_pairs"].get<int>(), 0);
  EXPECT_GE(json["seconds"].get<double>(), 0.0);
  EXPECT_EQ(json.size(), 6u);
  EXPECT_EQ(query_json(query(*method, at_gap(0.04), 0.05)).find('\n'), std::string::npos) << "one line";
}

TEST(Query, CriticalPairsHaveAnIndexAndSayWhichAreMinima) {
  const Scene scene = testing::make_scene(make_torus(0.5, 0.2, 32, 16), make_torus(0.5, 0.2, 32, 16), 0.5);
  const auto method = make_method("certified", scene);
  std::mt19937_64 random(3);
  std::size_t saddles = 0;
  for (int i = 0; i < 10; ++i) {
    const Pose pose = testing::grazing_pose(scene, 0.01, random);
    const QueryAnswer answer = query_critical(*method, pose);
    const auto json = nlohmann::json::parse(query_json(answer));
    std::size_t minima = 0;
    for (const auto& entry : json["lmds"]) {
      ASSERT_TRUE(entry.contains("index"));
      minima += entry["minimum"].get<bool>() ? 1 : 0;
    }
    EXPECT_EQ(minima, query(*method, pose, scene.cutoff).lmds.size());
    const bool has_saddle = json["lmds"].size() > minima;
    EXPECT_EQ(query_text(answer).find("saddle") != std::string::npos, has_saddle);
    saddles += has_saddle ? 1 : 0;
  }
  EXPECT_GT(saddles, 0u);
}

TEST(Query, EmptySetHasNullDistance) {
  const auto method = make_method("exhaustive", spheres());
  const auto json = nlohmann::json::parse(query_json(query(*method, at_gap(0.06), 0.05)));
  EXPECT_TRUE(json["minimum_distance"].is_null());
  EXPECT_TRUE(json["lmds"].is_array());
  EXPECT_TRUE(json["lmds"].empty());
}

TEST(Query, ImprovedReducesItsCandidates) {
  const Scene scene = spheres();
  const auto improved = make_method("improved", scene);
  const LmdSet candidates = lmds_at(*improved, at_gap(0.01));
  const QueryAnswer answer = query(*improved, at_gap(0.01), 0.05);
  EXPECT_LT(answer.lmds.size(), candidates.size());
  const auto steps = std::find_if(answer.counters.begin(), answer.counters.end(),
                                  [](const auto& counter) { return counter.first == "tracking_steps"; });
  ASSERT_NE(steps, answer.counters.end());
  EXPECT_GT(steps->second, 0u);
  EXPECT_NEAR(answer.lmds.front().distance, 0.01, 1e-9);
}

TEST(Query, EveryMethodSortsByDistance) {
  const Scene scene = testing::make_scene(make_blob(0.5, 0.1, 3), make_torus(0.5, 0.2, 32, 16), 0.1);
  std::mt19937_64 random(3);
  const Pose pose = testing::grazing_pose(scene, 0.01, random);
  for (const std::string& name : method_names()) {
    const auto method = make_method(name, scene);
    const QueryAnswer answer = query(*method, pose, scene.cutoff);
    ASSERT_FALSE(answer.lmds.empty()) << name;
    for (std::size_t i = 1; i < answer.lmds.size(); ++i)
      EXPECT_LE(answer.lmds[i - 1].distance, answer.lmds[i].distance) << name;
    EXPECT_LE(answer.lmds.back().distance, scene.cutoff) << name;
  }
}

}  // namespace
}  // namespace lmdbench
