// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/prepare/contact.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/prepare/scene_look.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/scratch_directory.h>
#include <support/source_directory.h>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::ScratchDirectory;

/// A cube of diagonal 0.1 m (side 57.7 mm) along the given poses, past another cube.
SceneLook look(const std::string& poses, const std::vector<Override>& more = {}) {
  const ScratchDirectory scratch;
  std::vector<Override> overrides{"/path/file=" + scratch.write("p.tum", poses),
                                  "/mesh_folder=" LMDBENCH_SOURCE_DIR "/meshes"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const Experiment experiment = parse_experiment(
      R"({"moving": {"mesh": "cube", "diagonal_m": 0.1}, "fixed": [{"mesh": "cube", "diagonal_m": 0.1}],
          "force": {"cutoff_m": 0.001}})",
      "/data/e.json", overrides);
  const PreparedRun prepared = prepare(experiment);
  return look_at(experiment, prepared, frames_in_contact(prepared.scene(), prepared.input.poses));
}

std::vector<std::string> warnings(const SceneLook& look) {
  std::vector<std::string> texts;
  for (const SceneWarning& warning : look.warnings) {
    EXPECT_FALSE(warning.remedy.empty());
    texts.push_back(warning.what);
  }
  return texts;
}

const char* const GOOD = "0 0 0 0.06 0 0 0 1\n0.1 0 0 0.0582 0 0 0 1\n";

TEST(SceneLook, AGoodSceneIsPassedInSilence) {
  const SceneLook good = look(GOOD);
  EXPECT_THAT(warnings(good), IsEmpty());
  EXPECT_EQ(good.frames, 101);
  EXPECT_GT(good.frames_in_contact, 0);
  EXPECT_EQ(good.meshes.size(), 2u);
  EXPECT_EQ(good.meshes[1].triangles, 48);
}

TEST(SceneLook, APathThatStaysOutsideTheCutoffIsMeasured) {
  const SceneLook far = look("0 0 0 0.08 0 0 0 1\n0.1 0 0 0.0592 0 0 0 1\n");
  EXPECT_EQ(far.frames_in_contact, 0);
  EXPECT_EQ(far.nearest_frame, 100);
  EXPECT_NEAR(far.nearest, 0.0592 - 0.1 / std::sqrt(3.0), 1e-12);
  EXPECT_THAT(warnings(far), ElementsAre(AllOf(HasSubstr("never comes within the cutoff of 0.001 m"),
                                               HasSubstr("in frame 100"))));
}

TEST(SceneLook, AMeshThatIsListedTwiceAtOnePlaceIsNoticed) {
  const std::string cube = R"({"mesh": "cube", "diagonal_m": 0.1)";
  EXPECT_THAT(warnings(look(GOOD, {"/fixed=[" + cube + "}, " + cube + "}, " + cube + "}]"})),
              ElementsAre(AllOf(HasSubstr("fixed_1 is the mesh of fixed_0, cube, at the same place"),
                                HasSubstr("first of 2"), HasSubstr("pushes twice"))));
  const std::string beside = cube + R"(, "pose": {"translation_m": [0.2, 0, 0]}})";
  EXPECT_THAT(warnings(look(GOOD, {"/fixed=[" + cube + "}, " + beside + "]"})), IsEmpty());
  // The check for a mesh inside another uses the poses of the fixed meshes.
  const std::string above = cube + R"(, "pose": {"translation_m": [0, 0, 0.06]}})";
  EXPECT_THAT(warnings(look(GOOD, {"/fixed=[" + beside + ", " + above + "]"})),
              ::testing::Contains(HasSubstr("encloses a vertex of fixed_1")));
}

TEST(SceneLook, AMeshInOtherUnitsIsNoticed) {
  EXPECT_THAT(
      warnings(look(GOOD, {"/moving/diagonal_m=100"})),
      ElementsAre(HasSubstr("1000 times as much"), HasSubstr("the moving mesh (100 m) encloses a vertex"),
                  HasSubstr("never comes within the cutoff")));
}

TEST(SceneLook, MeshesOfHundredMetresAreAsTheExperimentSays) {
  EXPECT_THAT(warnings(look("0 0 0 60 0 0 0 1\n1 0 0 57.8 0 0 0 1\n",
                            {"/moving/diagonal_m=100", "/fixed/0/diagonal_m=100", "/force/cutoff_m=1"})),
              IsEmpty());
}

TEST(SceneLook, APathInsideTheMeshIsNoticed) {
  EXPECT_THAT(warnings(look("0 0 0 0.02 0 0 0 1\n0.1 0 0 0 0 0 0 1\n", {"/moving/diagonal_m=0.01"})),
              ElementsAre(HasSubstr("inside fixed_0 cube in 32 of 32 frames looked at, first in frame 0:"),
                          HasSubstr("never comes within the cutoff")));
}

/// Cubes of 0.1 / sqrt(3) m: the moving one lies on the fixed one, corner on face.
TEST(SceneLook, WhatRestsOnAMeshIsNotInside) {
  const double side = 0.1 / std::sqrt(3.0);
  const std::string pose = fmt::format("0.013 0.017 {:.17g} 0 0 0 1", side);
  EXPECT_THAT(warnings(look("0 " + pose + "\n0.1 " + pose + "\n")), IsEmpty());
}

TEST(SceneLook, GapsOfARecordingAreCounted) {
  std::string poses;
  for (int i = 0; i < 20; ++i) poses += fmt::format("{} 0 0 0.06 0 0 0 1\n", 0.01 * i);
  poses += "3.19 0 0 0.0582 0 0 0 1\n3.2 0 0 0.0582 0 0 0 1\n";
  EXPECT_THAT(warnings(look(poses)),
              ElementsAre(AllOf(HasSubstr("1 gaps of 3 s"), HasSubstr("from 0.19 s on"))));
  EXPECT_THAT(warnings(look(poses, {"/path/gap_intervals=0"})), IsEmpty());
}

TEST(SceneLook, TextAndJsonSayTheSame) {
  const SceneLook far = look("0 0 0 0.08 0 0 0 1\n0.1 0 0 0.0592 0 0 0 1\n");
  const auto json = to_json(far);
  EXPECT_EQ(json["frames"], 101);
  EXPECT_EQ(json["warnings"].size(), 1u);
  EXPECT_THAT(to_text(far),
              AllOf(HasSubstr("101 frames, 0 of them in contact"), HasSubstr("warning: the path never")));
}

}  // namespace
}  // namespace lmdbench
