// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/metrics/summary.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/prepare/new_experiment.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/run/run.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/files.h>
#include <support/scratch_directory.h>
#include <support/source_directory.h>

namespace lmdbench {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::ScratchDirectory;

Experiment two_meshes(const std::string& moving, const std::string& fixed,
                      std::vector<Override> overrides = {}) {
  overrides.push_back("/mesh_folder=" LMDBENCH_SOURCE_DIR "/meshes");
  return parse_experiment(fmt::format(R"({{"moving": {}, "fixed": [{}]}})", moving, fixed),
                          "/data/my scene.json", overrides);
}

std::vector<std::string> keys(const std::vector<DefaultNote>& notes) {
  std::vector<std::string> result;
  for (const DefaultNote& note : notes) result.push_back(note.key);
  return result;
}

TEST(Defaults, TwoMeshesAreAnExperiment) {
  const Experiment experiment =
      two_meshes(R"({"mesh": "cube", "diagonal_m": 0.1})", R"({"mesh": "sphere", "diagonal_m": 0.2})");
  EXPECT_EQ(experiment.name, "my-scene");
  EXPECT_EQ(experiment.methods.size(), 4u);
  for (const MethodChoice& method : experiment.methods) {
    EXPECT_FALSE(method_description(method.name).brute_force);
    EXPECT_EQ(method.force_law, ForceLaw::EXPONENTIAL);
  }
  EXPECT_EQ(experiment.profiles[0].maximum_force_n, 1.75);  // continuous force of a PHANTOM Desktop
  const PreparedRun prepared = prepare(experiment);
  EXPECT_DOUBLE_EQ(prepared.scene().cutoff, 0.002) << "2 % of the smaller diagonal";
  EXPECT_EQ(prepared.times.size(), 2001u);
  EXPECT_THAT(keys(prepared.defaults),
              ::testing::UnorderedElementsAre("/name", "/methods", "/force/maximum_force_n",
                                              "/force/cutoff_m", "/path/file"));
}

TEST(Defaults, WhatTheFileSaysIsNoDefault) {
  const Experiment experiment = two_meshes(
      R"({"mesh": "cube"})", R"({"mesh": "sphere"})",
      {"/name=x", R"(/methods=[{"name":"certified"}])", R"(/force={"cutoff_m": 0.5, "maximum_force_n": 2})",
       "/frames=10", "/path/file=" LMDBENCH_SOURCE_DIR "/paths/shapes.tum"});
  const PreparedRun prepared = prepare(experiment);
  EXPECT_TRUE(prepared.defaults.empty());
  EXPECT_EQ(prepared.scene().cutoff, 0.5);
  EXPECT_FALSE(prepared.made_path.has_value());
}

TEST(Defaults, DenseMeshesGetACutoffOfTenEdges) {
  std::vector<DefaultNote> notes;
  // Small balls that are far apart: ten edges are less than 2 % of the diagonal.
  const TriangleMesh ball = make_sphere(1e-4, 2);
  const TriangleMesh balls = merged(ball, translated(ball, Vec3(0.1, 0.0, 0.0)));
  const auto body = std::make_shared<const Body>("balls", build_surface(balls));
  const double cutoff = default_cutoff({body, {body}, 0.0}, notes);
  EXPECT_NEAR(cutoff, 10.0 * mean_edge_length(balls), 0.01 * cutoff);
  EXPECT_EQ(notes.front().key, "/force/cutoff_m");
  EXPECT_THAT(notes.front().from, HasSubstr("mean edges of the coarser mesh"));
}

TEST(Defaults, TheyAreInTheSummaryAndTheScene) {
  const Experiment experiment =
      two_meshes(R"({"mesh": "cube", "diagonal_m": 0.1})", R"({"mesh": "cube", "diagonal_m": 0.1})",
                 {"/driver/repetitions=1", R"(/methods=[{"name":"certified"}])"});
  const RunResult result = run_experiment(experiment);
  const RunSummary summary = summarise(experiment, result);
  EXPECT_THAT(keys(summary.defaults), Contains("/path/file"));
  EXPECT_THAT(summary_text(summary), HasSubstr("default: /force/cutoff_m is 0.002 m (2 % of the smaller"));
  EXPECT_GT(summary.frames_in_contact, 500);
  EXPECT_EQ(summary.methods.front().frames_touching, 0.0);
  EXPECT_EQ(summary.methods.front().recall, 1.0);
}

/// ASCII STL and OBJ of a box with the given sides.
const char* const BOX_OFF =
    "OFF\n8 12 0\n0 0 0\n40 0 0\n40 60 0\n0 60 0\n0 0 20\n40 0 20\n40 60 20\n0 60 20\n"
    "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n"
    "3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n";

TEST(NewExperiment, RunsGrazesAndNeitherPenetratesNorMisses) {
  const ScratchDirectory scratch;
  const std::string box = scratch.write("data/box mm.off", BOX_OFF);
  const NewExperiment made =
      new_experiment(box, "sphere", scratch / "new/one", LMDBENCH_SOURCE_DIR "/meshes");
  EXPECT_EQ(made.name, "box-mm-sphere");
  write_new_experiment(made);
  const auto json = nlohmann::json::parse(testing::read_text(made.experiment_file));
  EXPECT_EQ(json["moving"]["scale"], 0.001) << "74.8 units are no metres";
  EXPECT_FALSE(json["fixed"][0].contains("scale"));
  const Experiment experiment = load_experiment(made.experiment_file, {"/driver/repetitions=1"});
  EXPECT_TRUE(experiment.defaults.empty()) << "everything is written down";
  const RunResult result = run_experiment(experiment);
  EXPECT_NEAR(result.prepared.meshes.front().report.diagonal, 0.0748, 1e-4);
  const RunSummary summary = summarise(experiment, result);
  EXPECT_GT(summary.frames_in_contact, 500);
  EXPECT_LT(summary.frames_in_contact, summary.frames);
  for (const MethodSummary& method : summary.methods) EXPECT_EQ(method.frames_touching, 0.0);
  EXPECT_EQ(tum_text(read_tum(made.path_file)).substr(0, 20),
            tum_text(parse_tum(made.path_text, "p")).substr(0, 20));
}

TEST(NewExperiment, NeverReplacesAFile) {
  const ScratchDirectory scratch;
  const NewExperiment made = new_experiment("cube", "cube", scratch.path(), LMDBENCH_SOURCE_DIR "/meshes");
  scratch.write("cube-cube.path.json", "mine");
  EXPECT_THROW(write_new_experiment(made), UsageError);
  EXPECT_EQ(testing::read_text(made.specification_file), "mine");
  EXPECT_FALSE(std::filesystem::exists(made.experiment_file));
}

}  // namespace
}  // namespace lmdbench
