// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/prepare/new_experiment.h>
#include <lmdbench/prepare/resting_pose.h>
#include <lmdbench/prepare/scene_look.h>
#include <lmdbench/run/run.h>
#include <lmdbench/stability/stability_search.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/message_of.h>
#include <support/scenes.h>
#include <support/scratch_directory.h>
#include <support/source_directory.h>

#include <string>
#include <utility>

namespace lmdbench {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::make_scene;
using testing::ScratchDirectory;
using Json = nlohmann::json;

const std::string MESHES = LMDBENCH_SOURCE_DIR "/meshes";

/// Makes experiments of meshes that the test writes.
class InitTest : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const TriangleMesh& mesh) {
    return scratch_.write(name, to_off_text(mesh));
  }
  NewExperiment make(const std::string& moving, const std::string& fixed, const InitChoices& chosen = {}) {
    return new_experiment(moving, fixed, scratch_ / "new", MESHES, {}, chosen);
  }
  Json made(const std::string& moving, const std::string& fixed, const InitChoices& chosen = {}) {
    return Json::parse(make(moving, fixed, chosen).experiment_text);
  }
  ScratchDirectory scratch_;
};

TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  return mesh;
}

TEST_F(InitTest, OneUnitIsChosenForBoth) {
  const std::string pin = write("pin.off", make_box({2, 2, 5.06}));    // 5.8 mm
  const std::string nut = write("nut.off", make_box({16, 16, 10.8}));  // 25 mm
  for (const auto& [moving, fixed] : {std::pair(pin, nut), {nut, pin}}) {
    const Json json = made(moving, fixed);
    EXPECT_EQ(json["moving"]["scale"], 0.001);
    EXPECT_EQ(json["fixed"][0]["scale"], 0.001) << "a pin of 5.8 metres is none";
  }
  const Json metres = made(pin, nut, {.unit = "0.01"});
  EXPECT_EQ(metres["moving"]["scale"], 0.01);
  EXPECT_EQ(metres["fixed"][0]["scale"], 0.01);
}

TEST_F(InitTest, AGuessOfMillimetresThatLeavesMetresIsTold) {
  const std::string wide = write("wide.off", make_box({12000, 12000, 12000})),
                    cube = write("cube.off", make_box({9000, 9000, 9000}));
  EXPECT_THAT(make(wide, cube).warnings, Contains(HasSubstr("20.78 m large")));
  EXPECT_THAT(make(wide, cube, {.unit = "um"}).warnings, ::testing::Not(Contains(HasSubstr("m large"))));
}

TEST_F(InitTest, BuiltMeshesOfTheManifestHaveTheUnitOfTheirFile) {
  const Json manifest = {
      {"format", "lmdbench-mesh-manifest"},
      {"format_version", 1},
      {"sources",
       {{"s",
         {{"package", "some-package"},
          {"archive", "p.tar.gz"},
          {"path", "p.off"},
          {"sha256", std::string(64, '0')},
          {"licence", "none"},
          {"credit", "nobody"}}}}},
      {"meshes",
       {{"wide",
         {{"description", "d"}, {"source", "s"}, {"triangles", 12}, {"sha256", std::string(64, '0')}}}}}};
  scratch_.write("m/manifest.json", manifest.dump());
  write("m/wide.off", make_box({120, 120, 120}));
  const NewExperiment twice = new_experiment("wide", "wide", scratch_ / "new", scratch_ / "m", {}, {});
  EXPECT_EQ(Json::parse(twice.experiment_text)["moving"]["scale"], 0.001);
  const PreparedRun prepared = prepare(parse_experiment(
      R"({"mesh_folder": "m", "moving": {"mesh": "wide"}, "fixed": [{"mesh": "wide", "pose": {"translation_m": [200, 0, 0]}}]})",
      scratch_ / "two.json"));
  EXPECT_THAT(prepared.warnings, Contains(HasSubstr("its file is not the manifest's")));
}

TEST_F(InitTest, UnlikeSizesAreRefusedUnlessSomebodySaysTheirUnits) {
  const std::string pin = write("pin.off", make_box({20, 20, 50}));
  const std::string plate = write("plate.off", make_box({0.1, 0.1, 0.02}));
  const std::string message = testing::message_of<UsageError>([&] { made(pin, plate); });
  EXPECT_THAT(message, HasSubstr("--unit mm,m"));
  EXPECT_THAT(message, HasSubstr("times apart"));
  const Json json = made(pin, plate, {.unit = "mm,m"});
  EXPECT_EQ(json["moving"]["scale"], 0.001);
  EXPECT_EQ(json["fixed"][0]["scale"], 1.0) << "said, not taken";
}

TEST_F(InitTest, PartsOfAnAssemblyKeepTheirPlaceAndOthersAreCentred) {
  TriangleMesh peg = make_box({10, 10, 40});
  for (Vec3& vertex : peg.vertices) vertex += Vec3(100, 50, 30);
  TriangleMesh plate = make_box({60, 60, 20});
  for (Vec3& vertex : plate.vertices) vertex += Vec3(100, 50, -5);
  const std::string moving = write("peg.off", peg), fixed = write("plate.off", plate);
  const Json kept = made(moving, fixed);
  EXPECT_FALSE(kept["moving"].contains("centre"));
  EXPECT_FALSE(kept["fixed"][0].contains("centre"));
  EXPECT_EQ(kept["moving"]["mesh"], "../peg.off") << "a folder that is shared finds it again";
  EXPECT_EQ(made(moving, fixed, {.keep_place = false})["moving"]["centre"], true);
  const std::string apart = write("apart.off", make_box({10, 10, 40}));
  EXPECT_EQ(made(apart, fixed)["fixed"][0]["centre"], true);
  EXPECT_FALSE(made(apart, fixed, {.keep_place = true})["moving"].contains("centre"));
}

TEST_F(InitTest, SizesThatTellOfAnotherUnitAreTold) {
  const auto told = [&](const std::string& moving, const std::string& fixed) {
    const Experiment bare = parse_experiment(
        fmt::format(R"({{"moving": {{"mesh": "{}"}}, "fixed": [{{"mesh": "{}"}}]}})", moving, fixed),
        scratch_ / "two.json");
    const std::vector<MeshNote> notes = load_scene(bare).notes;
    std::vector<std::string> texts;
    for (const SceneWarning& warning : size_warnings(bare, notes)) texts.push_back(to_text(warning));
    return texts;
  };
  const std::string millimetres = write("mm.off", make_box({50, 40, 30})),
                    metres = write("m.off", make_box({0.05, 0.04, 0.03})),
                    inches = write("in.off", make_box({2, 1.6, 1.2}));
  EXPECT_THAT(told(millimetres, millimetres),
              ElementsAre(::testing::AllOf(HasSubstr("70.71 m large: its file says no unit"),
                                           HasSubstr("\"scale\": 0.001"))));
  EXPECT_THAT(told(inches, millimetres), Contains(HasSubstr("what an inch has millimetres")));
  EXPECT_TRUE(told(metres, metres).empty());
}

TEST_F(InitTest, AWrongVertexFileIsToldAtItsPlace) {
  const std::string mesh = write("box.off", make_box({0.05, 0.04, 0.03}));
  const std::string file = scratch_.write("box.xyz", "1 2\n");
  const Experiment deforming = parse_experiment(
      fmt::format(
          R"({{"moving": {{"mesh": "{0}"}}, "fixed": [{{"mesh": "{0}", "deformation": {{"files": ["{1}"]}}}}]}})",
          mesh, file),
      scratch_ / "two.json");
  EXPECT_THAT(testing::message_of<InputError>([&] { load_scene(deforming); }),
              ::testing::AllOf(HasSubstr("/fixed/0/deformation/files: "), HasSubstr("2 numbers")));
}

TEST_F(InitTest, HolesAndSelfIntersectionsAreTold) {
  TriangleMesh open = make_box({50, 40, 30});
  open.triangles.pop_back();
  const NewExperiment made_file = make(
      write("open.off", open),
      write("crossing.off", merged(make_box({50, 40, 30}), translated(make_box({50, 40, 30}), {20, 10, 5}))));
  EXPECT_THAT(made_file.warnings,
              Contains(::testing::AllOf(HasSubstr("3 boundary edges in 1 holes"), HasSubstr("open.off"))));
  EXPECT_THAT(made_file.warnings,
              Contains(::testing::AllOf(HasSubstr("touch or cross"), HasSubstr("mesh info"))));
}

TEST_F(InitTest, MeshesThatAreInsideOutAreTurned) {
  const std::string sound = write("sound.off", make_box({0.05, 0.04, 0.03}));
  const std::string turned = write("turned.off", inside_out(make_box({0.05, 0.04, 0.03})));
  const std::string ball = write("ball.off", make_sphere(0.03, 2));
  const NewExperiment experiment = make(turned, ball);
  EXPECT_EQ(Json::parse(experiment.experiment_text)["moving"]["orient"], "outward");
  EXPECT_FALSE(made(sound, ball)["moving"].contains("orient"));
  const std::string bodies = write(
      "bodies.off",
      merged(make_box({0.2, 0.1, 0.1}), translated(inside_out(make_box({0.1, 0.1, 0.1})), {0.3, 0.0, 0.0})));
  EXPECT_EQ(made(bodies, ball)["moving"]["orient"], "outward") << "one body of two";
  EXPECT_FALSE(made(turned, ball, {.orientation = OrientationChoice::KEEP})["moving"].contains("orient"));

  write_new_experiment(experiment);
  const std::vector<Override> quick{"/driver/repetitions=1", R"(/methods=[{"name": "certified"}])",
                                    "/probes/fcl/stride_frames=0"};
  const RunResult run = run_experiment(load_experiment(experiment.experiment_file, quick));
  EXPECT_EQ(run.prepared.meshes.front().orientation.turned_triangles, 12);
  EXPECT_EQ(run.prepared.meshes.front().report.outward, true);
  EXPECT_THAT(run.warnings, Contains(HasSubstr("12 triangles turned outward")));
  std::int64_t found = 0;
  for (const FrameRecord& frame : run.records.front().frames) found += frame.lmd_count;
  EXPECT_GT(found, 500);

  // Without orientation no LMD exists, and the run says why.
  std::vector<Override> as_it_is = quick;
  as_it_is.emplace_back("/moving/orient=keep");
  const RunResult empty = run_experiment(load_experiment(experiment.experiment_file, as_it_is));
  for (const FrameRecord& frame : empty.records.front().frames) EXPECT_EQ(frame.lmd_count, 0);
  EXPECT_THAT(empty.warnings,
              Contains(::testing::AllOf(HasSubstr("inside out"), HasSubstr(R"("orient": "outward")"))));
}

TEST_F(InitTest, AMinimalFileHasTheSameDefaults) {
  const std::string box = write("box.off", make_box({0.05, 0.04, 0.03}));
  const std::string ball = write("ball.off", make_sphere(0.03, 2));
  const NewExperiment written = make(box, ball);
  const Experiment minimal = parse_experiment(
      fmt::format(R"({{"moving": {{"mesh": "{}"}}, "fixed": [{{"mesh": "{}"}}]}})", box, ball),
      scratch_ / "two.json");
  const PreparedRun prepared = prepare(minimal);
  write_new_experiment(written);
  const Experiment init = load_experiment(written.experiment_file);
  EXPECT_EQ(init.probe_stride("truth"), minimal.probe_stride("truth"));
  EXPECT_EQ(init.probe_stride("fcl"), minimal.probe_stride("fcl"));
  EXPECT_EQ(init.device, minimal.device);
  EXPECT_EQ(init.driver.search_every_frames, minimal.driver.search_every_frames);
  EXPECT_EQ(init.driver.repetitions, minimal.driver.repetitions);
  ASSERT_EQ(init.methods.size(), minimal.methods.size());
  for (std::size_t i = 0; i < init.methods.size(); ++i)
    EXPECT_EQ(init.methods[i].options_json, minimal.methods[i].options_json);
  const ForceProfile& force = prepared.profiles.front().force;
  EXPECT_EQ(init.profiles.front().cutoff(1.0), force.cutoff);
  EXPECT_EQ(init.profiles.front().saturation(force.cutoff), force.saturation_distance);
  EXPECT_EQ(init.profiles.front().maximum_force_n, force.maximum_force);
  EXPECT_EQ(init.profiles.front().sharpness, force.sharpness);
}

TEST_F(InitTest, ACutoffLargerThanThePartsIsNamed) {
  const std::string box = write("box.off", make_box({0.05, 0.04, 0.03}));
  const Experiment experiment = parse_experiment(
      fmt::format(
          R"({{"moving": {{"mesh": "{0}"}}, "fixed": [{{"mesh": "{0}"}}], "force": {{"cutoff_m": 0.5}}}})",
          box),
      scratch_ / "two.json");
  const std::string message = testing::message_of<UsageError>([&] { prepare(experiment); });
  EXPECT_THAT(message, HasSubstr("/force/cutoff_m"));
  EXPECT_THAT(message, HasSubstr("larger than the smallest mesh"));
}

TEST_F(InitTest, ContactsAreFoundAndHaveAStiffness) {
  const std::string box = write("box.off", make_box({50, 40, 30}));
  const std::string block = write("block.off", make_l_block(60));
  const NewExperiment contact = make(box, block, {.contact = true});
  EXPECT_TRUE(contact.specification_text.empty()) << "a resting pose is no path that can be made again";
  write_new_experiment(contact);
  EXPECT_FALSE(std::filesystem::exists(contact.specification_file));
  const Experiment experiment =
      load_experiment(contact.experiment_file, {R"(/methods=[{"name": "certified"}, {"name": "nearest"}])"});
  EXPECT_TRUE(experiment.loop.closed);
  for (const StabilityRow& row : find_critical_stiffness(experiment))
    EXPECT_TRUE(row.has_answer()) << row.method << ": " << advice(row);
}

TEST_F(InitTest, TheHandPressesItWhereItRests) {
  const std::string box = write("box.off", make_box({50, 40, 30}));
  const std::string block = write("block.off", make_l_block(60));
  const NewExperiment contact = make(box, block, {.contact = true});
  EXPECT_EQ(Json::parse(contact.experiment_text)["title"], "box at rest on block");
  write_new_experiment(contact);
  const Experiment experiment = load_experiment(
      contact.experiment_file, {contact.press, "/driver/repetitions=1", "/probes/fcl/stride_frames=0"});
  const RunResult run = run_experiment(experiment);
  const std::vector<FrameRecord>& frames = run.records.front().frames;
  ASSERT_EQ(frames.size(), 1001u);
  const double gap = frames.front().minimum_distance;
  for (const FrameRecord& frame : frames) {
    ASSERT_GT(frame.lmd_count, 0);
    ASSERT_NEAR(frame.minimum_distance, gap, 0.05 * gap);
  }
  EXPECT_TRUE(make(box, block).press.empty());
}

/// The first seed shows one contact of these two meshes at a time, a later seed several.
TEST_F(InitTest, ThePathShowsSeveralContactsWhereASeedDoes) {
  const std::string moving = write("moving.off", make_two_boxes({0.4, 0.4, 0.4}, 0.1));
  const std::string fixed = write("fixed.off", make_two_boxes({0.4, 0.4, 0.4}, 0.1));
  const NewExperiment made_file = make(moving, fixed);
  write_new_experiment(made_file);
  const std::vector<Override> quick{"/driver/repetitions=1", R"(/methods=[{"name": "certified"}])",
                                    "/probes/fcl/stride_frames=0", "/probes/truth/stride_frames=0"};
  const auto median_of = [](const RunResult& run) {
    std::vector<double> counts;
    for (const FrameRecord& frame : run.records.front().frames)
      if (frame.lmd_count > 0) counts.push_back(static_cast<double>(frame.lmd_count));
    return median(counts);
  };
  EXPECT_GT(Json::parse(made_file.specification_text)["seed"], 1);
  EXPECT_GE(median_of(run_experiment(load_experiment(made_file.experiment_file, quick))), 2.0);
}

TEST(RestingPose, RestsHalfWayAndDoesNotSlide) {
  const ForceProfile profile{
      .cutoff = 0.02, .saturation_distance = 0.002, .maximum_force = 1.0, .sharpness = 4.0};
  const RestingPose rest =
      find_resting_pose(make_scene(make_box({1, 1, 1}), make_box({2, 2, 0.5}), 0.02), profile);
  EXPECT_NEAR(rest.gap, 0.011, 1e-5);
  EXPECT_GT(rest.stiffness_n_per_m, 0.0);
  EXPECT_FALSE(rest.slides());
  EXPECT_EQ(rest.tried, REST_DIRECTIONS) << "the first orientation has one";
  EXPECT_NEAR(rest.force_W.norm(), 1.0 * std::expm1(4.0 * 0.5) / std::expm1(4.0), 0.05);
}

TEST(RestingPose, ContactsFromAllSidesGoFirst) {
  // A wedge in a groove of two slanted blocks has a contact on either side.
  TriangleMesh groove =
      merged(translated(make_box({1, 3, 1}), {-0.8, 0, 0}), translated(make_box({1, 3, 1}), {0.8, 0, 0}));
  const ForceProfile profile{.cutoff = 0.3, .maximum_force = 1.0, .sharpness = 4.0};
  const RestingPose rest = find_resting_pose(make_scene(make_sphere(0.5, 2), groove, 0.3), profile);
  EXPECT_GE(rest.contacts, 2u);
  EXPECT_FALSE(rest.slides());
}

TEST(RestingPose, MeshesWithoutContactsAreAnError) {
  const ForceProfile profile{.cutoff = 0.1, .maximum_force = 1.0};
  EXPECT_THROW(find_resting_pose(make_scene(inside_out(make_sphere(1, 2)), make_sphere(1, 2), 0.1), profile),
               InputError);
}

}  // namespace
}  // namespace lmdbench
