// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/lmd/well_formed.h>
#include <lmdbench/methods/registry.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>
#include <support/rounded.h>
#include <support/scenes.h>

#include <random>
#include <regex>
#include <set>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Registry, DescriptionsAreCompleteAndDistinct) {
  const std::regex name_form("[a-z][a-z0-9_-]*");
  std::set<std::string> names, summaries;
  for (const MethodDescription& method : method_descriptions()) {
    EXPECT_TRUE(std::regex_match(method.name, name_form)) << method.name;
    EXPECT_TRUE(names.insert(method.name).second) << method.name;
    EXPECT_TRUE(summaries.insert(method.summary).second) << method.summary;
    EXPECT_GT(method.summary.size(), 20U) << method.name;
    EXPECT_NE(method.summary.back(), '.') << method.name;
    EXPECT_TRUE(method.tracks_locally || method.trackings_after_search == 0) << method.name;
    for (const auto& [key, property] : method.options.items()) {
      EXPECT_TRUE(property.contains("default")) << method.name << " " << key;
      EXPECT_TRUE(property.contains("type") || property.contains("enum")) << method.name << " " << key;
      EXPECT_GT(property.value("description", "").size(), 10U) << method.name << " " << key;
      EXPECT_TRUE(key != "name" && key != "label" && key != "force_law")
          << method.name << ": taken by the experiment";
    }
    EXPECT_EQ(&method_description(method.name), &method);
    EXPECT_EQ(&method, &method_descriptions().at(method_order(method.name)));
  }
}

/// Rows of features leave collapsed triangles out. Here they come first, so that they are first of
/// equals.
TEST(Registry, SetsOfMeshesWithCollapsedTrianglesAreWellFormed) {
  std::mt19937_64 random(35);
  TriangleMesh box = make_box({1, 1, 1});
  for (const auto& [a, b] : build_surface(box).adjacency.edges)
    box.triangles.insert(box.triangles.begin(), {a, b, a});
  const Scene scene = testing::make_scene(box, box, 0.5);
  for (const MethodDescription& description : method_descriptions()) {
    const std::string name(description.name);
    const auto method = make_method(name, scene);
    std::size_t found = 0;
    for (int i = 0; i < 100; ++i) {
      Pose pose = testing::pose_of_seed(random());
      pose.translation = testing::random_direction(random) * (0.8 + 0.8 * testing::uniform(random));
      const LmdSet lmds = lmds_at(*method, pose);
      EXPECT_TRUE(is_well_formed(lmds, scene)) << name << ", " << i;
      found += lmds.size();
    }
    EXPECT_GT(found, 10U) << name;
  }
}

/// Each counter needs one name of its own, or it would be lost.
TEST(Registry, EveryCounterHasOneName) {
  for (const MethodDescription& method : method_descriptions()) {
    std::set<std::string> names;
    std::set<std::size_t> indices;
    for (const CounterDescription& counter : method.counters) {
      EXPECT_TRUE(names.insert(counter.name).second) << method.name << " " << counter.name;
      EXPECT_TRUE(indices.insert(counter.index).second) << method.name << " " << counter.name;
      EXPECT_LT(counter.index, method.counters.size()) << method.name << " " << counter.name;
      EXPECT_FALSE(counter.summary.empty()) << counter.name;
    }
    // The last three are a scene's (scene/scene_search.cpp).
    EXPECT_LE(method.counters.size(), WorkCounters::CAPACITY - 3) << method.name;
    EXPECT_EQ(method.global_counters().empty(), !method.tracks_locally) << method.name;
  }
}

/// A method counts what its description lists, in the listed parts.
TEST(Registry, MethodsCountWhatTheyDescribe) {
  // Grazing poses of curved meshes, and a box flush over a plate and in it.
  const Scene curved = testing::make_scene(make_blob(0.5, 0.1, 3), make_torus(0.5, 0.2, 32, 16), 0.1);
  const Scene flush = testing::make_scene(make_box({0.2, 0.2, 0.2}, 2), make_box({1.0, 1.0, 0.1}, 4), 0.1);
  std::mt19937_64 random(5);
  std::vector<Pose> grazing;
  for (int i = 0; i < 5; ++i) grazing.push_back(testing::grazing_pose(curved, 0.01, random));
  Pose over, inside;
  over.translation = {0.01, 0.02, 0.24};
  inside.translation = {0.01, 0.02, 0.149};
  for (const MethodDescription& description : method_descriptions()) {
    WorkCounters searched, tracked;
    const auto count = [&](const Scene& scene, const std::vector<Pose>& poses) {
      const auto method = make_method(description.name, scene);
      EXPECT_EQ(method->description().name, description.name);
      for (const Pose& pose : poses) {
        LmdSet lmds;
        method->search(pose, lmds, searched);
        if (description.tracks_locally) method->track(pose, lmds, tracked);
      }
    };
    count(curved, grazing);
    count(flush, {over, inside});
    for (const CounterDescription& counter : description.counters) {
      const std::string about = description.name + " " + counter.name;
      EXPECT_TRUE(searched.values[counter.index] == 0 || counter.counted_by != CountedBy::TRACKING) << about;
      EXPECT_TRUE(tracked.values[counter.index] == 0 || counter.counted_by != CountedBy::SEARCH) << about;
      EXPECT_GT(searched.values[counter.index] + tracked.values[counter.index], 0U)
          << about << " is never counted";
    }
    for (std::size_t i = description.counters.size(); i < WorkCounters::CAPACITY; ++i)
      EXPECT_EQ(searched.values[i] + tracked.values[i], 0U)
          << description.name << " counts value " << i << " without a name";
  }
}

TEST(Registry, UnknownNamesAndOptionsAreRefused) {
  const Scene scene = testing::make_scene(make_blob(0.5, 0.1, 2), make_blob(0.5, 0.1, 2), 0.1);
  EXPECT_THAT(testing::message_of<UsageError>([&] { make_method("improvd", scene); }),
              AllOf(HasSubstr("unknown method \"improvd\""), HasSubstr("did you mean \"improved\"?")));
  EXPECT_THAT(testing::message_of<UsageError>([&] { make_method("gjk", scene); }),
              HasSubstr("known methods: original, improved"));
  EXPECT_THAT(testing::message_of<UsageError>([&] {
                make_method("improved", scene, {{"visibilty", "off"}});
              }),
              AllOf(HasSubstr("options of improved: /visibilty"), HasSubstr("did you mean \"visibility\"?")));
  EXPECT_THAT(testing::message_of<UsageError>([&] {
                make_method("improved", scene, {{"visibility", "on"}});
              }),
              AllOf(HasSubstr("/visibility"), HasSubstr("vertex-normal")));
  EXPECT_THAT(testing::message_of<UsageError>([&] {
                make_method("original", scene, {{"g5_tolerance_deg", -1}});
              }),
              AllOf(HasSubstr("/g5_tolerance_deg"), HasSubstr("number >= 0")));
}

TEST(Registry, OptionsReachTheMethod) {
  const Scene scene = testing::make_scene(make_blob(0.5, 0.1, 3), make_torus(0.5, 0.2, 32, 16), 0.1);
  std::mt19937_64 random(7);
  const Pose pose = testing::grazing_pose(scene, 0.01, random);
  const auto work = [&](const std::string& name, const nlohmann::json& options) {
    const auto method = make_method(name, scene, options);
    LmdSet lmds;
    WorkCounters counters;
    for (int i = 0; i < 3; ++i) {
      method->search(pose, lmds, counters);
      method->track(pose, lmds, counters);
    }
    return counters;
  };
  const std::pair<std::string, nlohmann::json> choices[] = {
      {"original", {{"g5_tolerance_deg", 180}}},
      {"original", {{"line_cone", "two-sided"}}},
      {"original", {{"literal_g3", true}}},
      {"original", {{"feature_points", 3}}},
      {"original", {{"feature_points", 13}}},
      {"original", {{"feature_points", 25}}},
      {"original", {{"face_neighbourhood", "edge-neighbours"}}},
      {"original", {{"leaf_cones", "own"}}},
      {"original", {{"leaf_cones", "edge-neighbours"}}},
      {"original", {{"merge_duplicates", false}}},
      {"improved", {{"visibility", "orthogonal"}}},
      {"improved", {{"visibility", "off"}}},
      {"improved", {{"reduction", "loss-free"}}},
      {"improved", {{"tracking_order", "triangle-index"}}},
      {"improved", {{"literal_g3", true}}},
      {"improved", {{"leaf_cones", "own"}}},
      {"improved", {{"leaf_cones", "edge-neighbours"}}},
      {"certified", {{"frame_coherence", false}}},
  };
  for (const auto& [name, options] : choices)
    EXPECT_NE(work(name, options), work(name, {})) << name << " ignores " << options.dump();
}

TEST(Registry, HelpNamesEveryMethodAndOption) {
  const std::string help = methods_help();
  for (const MethodDescription& method : method_descriptions()) {
    EXPECT_THAT(help, HasSubstr(method.name + ": " + method.summary));
    for (const auto& option : method.options.items()) EXPECT_THAT(help, HasSubstr(option.key() + " = "));
  }
}

TEST(WithDefaults, MatchesPropertiesAndDefaults) {
  const nlohmann::json properties = {{"a", {{"type", "number"}}}};
  EXPECT_EQ(with_defaults(properties, {{"a", 3}})["a"]["default"], 3);
  EXPECT_THROW(with_defaults(properties, {{"a", 3}, {"b", 4}}), std::logic_error);
  EXPECT_THROW(with_defaults(properties, nlohmann::json::object()), std::logic_error);
}

TEST(Registry, RefusesTwoHubsByANamedLimit) {
  // A fan of so many triangles.
  const auto fan = [](int triangles) {
    TriangleMesh mesh{.vertices = {Vec3::Zero()}, .triangles = {}};
    for (int i = 0; i <= triangles; ++i) mesh.vertices.emplace_back(1.0, i * 1e-3, 0.0);
    for (int i = 0; i < triangles; ++i) mesh.triangles.push_back({0, i + 1, i + 2});
    return mesh;
  };
  const Scene scene = testing::make_scene(fan(1001), fan(1000), 0.1);
  for (const MethodDescription& method : method_descriptions())
    EXPECT_THAT(testing::message_of<InputError>([&] { make_method(method.name, scene); }),
                AllOf(HasSubstr("moving: vertex 0: is in 1001 triangles, and vertex 0 of fixed in 1000"),
                      HasSubstr("--limit vertex-pairs=")));
  EXPECT_NO_THROW(make_method("improved", testing::make_scene(fan(1000), fan(1000), 0.1)));
}

}  // namespace
}  // namespace lmdbench
