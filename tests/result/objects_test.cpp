// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/result/result_scene.h>
#include <lmdbench/result/run_to_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <result/deterministic_datasets.h>
#include <support/committed.h>
#include <support/message_of.h>
#include <support/scratch_directory.h>

#include <fstream>
#include <string>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using testing::deterministic_datasets;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::ScratchDirectory;
using testing::SHAPES_FILE;

using Json = nlohmann::json;

const char* const SLAB = R"({"mesh":"torus","diagonal_m":0.15})";
const char* const DENT =
    R"({"mesh":"small-blob","diagonal_m":0.1,"deformation":{"generator":"breathe","amplitude":0.02,"period_s":0.02}})";
const char* const SWAYING_BALLS =
    R"({"mesh":"small-blob","diagonal_m":0.04,"pose":{"translation_m":[0.013,0.009,0.09]},)"
    R"("instances":{"rule":"grid","counts":[2,1,1],"spacing_diagonals":0.7}})";
const char* const STANDING =
    R"({"mesh":"ball","diagonal_m":0.02,"instances":{"rule":"grid","counts":[2,2,1],"spacing_diagonals":4}})";

/// The same scene under `moving`, `fixed`, `movers`, and under `objects`, moving ones first.
Experiment scene(bool as_objects, bool deforms) {
  const std::string file(SHAPES_FILE);
  std::ifstream text(file);
  Json json = Json::parse(text);
  for (const char* key : {"moving", "fixed", "path", "methods", "probes"}) json.erase(key);
  Json held = Json::parse(deforms ? DENT : R"({"mesh":"small-blob","diagonal_m":0.1})"),
       balls = Json::parse(SWAYING_BALLS);
  const Json slab = Json::parse(SLAB), standing = Json::parse(STANDING);
  const Json sway{{"way_diagonals", 0.3}, {"period_s", 0.05}};
  if (as_objects) {
    held["motion"] = {{"path", "../paths/shapes.tum"}};
    held["name"] = "probe";
    balls["motion"] = {{"sway", sway}};
    json["objects"] = Json::array({held, balls, slab, standing});
  } else {
    json["moving"] = held;
    json["fixed"] = Json::array({slab, standing});
    balls["path"] = sway;
    json["movers"] = Json::array({balls});
    json["path"] = {{"file", "../paths/shapes.tum"}};
  }
  return parse_experiment(
      json.dump(), file,
      {"/frames=40", R"(/force={"cutoff_diagonal":0.08,"maximum_force_n":0.5})", "/driver/repetitions=1",
       R"(/methods=[{"name":"improved"},{"name":"certified"}])", "/probes/truth/stride_frames=9",
       "/probes/fcl/stride_frames=9", "/record/lmds=true"});
}

TEST(Objects, TheSameSceneGivesTheSameBitsUnderEitherKeys) {
  for (const bool deforms : {false, true}) {
    const ScratchDirectory scratch;
    const std::string by_kind = scratch / "kinds.h5", as_list = scratch / "list.h5";
    run_experiment_to_file(scene(false, deforms), by_kind, {"lmdbench", "run"});
    run_experiment_to_file(scene(true, deforms), as_list, {"lmdbench", "run"});
    auto expected = deterministic_datasets(by_kind), found = deterministic_datasets(as_list);
    // The table itself is in the order of the file.
    for (auto* datasets : {&expected, &found})
      std::erase_if(*datasets, [](const auto& one) { return one.first.starts_with("scene/objects/"); });
    EXPECT_GT(expected.size(), 50u);
    EXPECT_EQ(found, expected) << (deforms ? "deforming" : "rigid");
  }
}

TEST(Objects, TheResultHasATableOfThem) {
  const ScratchDirectory scratch;
  const std::string file = scratch / "list.h5";
  run_experiment_to_file(scene(true, false), file, {"lmdbench", "run"});
  const ResultReader result(file);
  EXPECT_THAT(result.texts("/scene/objects/name"), ElementsAre("probe", "mover_0", "fixed_0", "fixed_1"));
  EXPECT_THAT(result.texts("/scene/objects/role"), ElementsAre("moving", "mover_0", "fixed_0", "fixed_1"));
  EXPECT_THAT(result.texts("/scene/objects/mesh"), ElementsAre("small-blob", "small-blob", "torus", "ball"));
  EXPECT_THAT(result.texts("/scene/objects/motion"), ElementsAre("held", "sways", "stands", "stands"));
  EXPECT_THAT(result.integers("/scene/objects/first"), ElementsAre(0, 1, 0, 1));
  EXPECT_THAT(result.integers("/scene/objects/instances"), ElementsAre(1, 2, 1, 4));
  // The objects read from the result are the scene of the run.
  const ResultScene again = scene_of_result(result);
  EXPECT_EQ(again.rest.mover_count(), 3u);
  EXPECT_EQ(again.rest.fixed.size(), 5u);
}

TEST(Objects, AMeshThatIsNotThereNamesItsPlace) {
  const auto prepared = [](const char* entry) {
    prepare(parse_experiment(std::string(R"({"objects":[{"mesh":"ball"},{"mesh":"plate"},)") + entry + "]}",
                             SHAPES_FILE),
            {}, Deforming::FOLLOWED);
  };
  EXPECT_THAT(message_of<InputError>([&] { prepared(R"({"mesh":"bal"})"); }),
              AllOf(HasSubstr("/objects/2/mesh"), HasSubstr("knows no mesh 'bal'")));
  EXPECT_THAT(message_of<UsageError>([&] {
                prepare(parse_experiment(
                    R"({"objects":[{"mesh":"ball"},{"mesh":"plate"},{"mesh":"ball","motion":{"sway":{}}}]})",
                    SHAPES_FILE));
              }),
              HasSubstr("/objects/2"));
}

}  // namespace
}  // namespace lmdbench
