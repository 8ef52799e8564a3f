// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/instance_choice.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/prepare/load_scene.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/result/result_scene.h>
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/run/run.h>
#include <lmdbench/view/export_frames.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <result_file/result_reading.h>
#include <support/committed.h>
#include <support/message_of.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::message_of;
using testing::OpenResult;
using testing::ScratchDirectory;
using testing::SHAPES_FILE;

Experiment shapes_with(const std::string& instances, std::vector<Override> overrides = {}) {
  overrides.insert(overrides.begin(), {"/frames=320", "/driver/repetitions=2", "/record/lmds=true",
                                       R"(/methods=[{"name":"improved"},{"name":"certified"}])",
                                       "/probes/truth/stride_frames=40", "/probes/fcl/stride_frames=40"});
  overrides.push_back(R"(/fixed=[{"mesh":"torus","diagonal_m":0.15,"instances":)" + instances + "}]");
  return load_experiment(SHAPES_FILE, overrides);
}

/// The plain torus, another one at the same place, and two beside it.
std::string list_of_four(const ScratchDirectory& scratch) {
  return R"({"rule":"list","file":")" +
         scratch.write("list.txt",
                       "# x y z qx qy qz qw\n0 0 0 0 0 0 1\n0,0,0,0,0,0,1\n\n"
                       "0.16 0 0 0 0 0 1\n0 0 0.4 0.6 0 0 0.8\n") +
         "\"}";
}

TEST(Instances, ARunAmongThemFindsWhatTheSceneWithoutThemHas) {
  const ScratchDirectory scratch;
  const Experiment world = shapes_with(list_of_four(scratch));
  ASSERT_TRUE(world.is_world());
  const RunResult run = run_experiment_to_file(world, scratch / "world.h5", {"lmdbench", "run"});
  run_experiment_to_file(
      load_experiment(SHAPES_FILE, {"/frames=320", "/driver/repetitions=2", "/record/lmds=true",
                                    R"(/methods=[{"name":"improved"},{"name":"certified"}])"}),
      scratch / "plain.h5", {"lmdbench", "run"});
  const OpenResult result(scratch / "world.h5"), plain(scratch / "plain.h5");
  EXPECT_EQ(result.integer_attribute("/scene/fixed_0", "first_fixed_body"), 0);
  EXPECT_EQ(result.integer_attribute("/scene/fixed_0", "coincident_instances"), 1);
  EXPECT_EQ(result.doubles("/scene/fixed_0/position").size(), 12u);
  EXPECT_EQ(result.doubles("/scene/fixed_0/orientation").size(), 16u);
  EXPECT_THAT(result.strings("/scene/warnings"), ::testing::Contains(HasSubstr("1 of 4 instances")));

  const auto bodies = result.integers("/methods/certified/lmds/fixed_body");
  const auto of_plain = plain.integers("/methods/certified/lmds/fixed_body");
  ASSERT_GT(of_plain.size(), 50u);
  for (const std::int64_t body : {0, 1})
    EXPECT_EQ(std::count(bodies.begin(), bodies.end(), body), static_cast<std::ptrdiff_t>(of_plain.size()));
  for (const double recall : result.doubles("/methods/certified/truth/recall")) EXPECT_FALSE(recall < 1.0);
  for (const double precision : result.doubles("/methods/certified/truth/precision"))
    EXPECT_FALSE(precision < 1.0);
  const auto touched = result.integers("/methods/certified/counters/pairs_touched");
  const auto searched = result.integers("/methods/certified/counters/pairs_searched");
  ASSERT_EQ(touched.size(), 320u);
  EXPECT_EQ(searched.back(), 2);  // in contact with both toruses there
  for (std::size_t i = 0; i < touched.size(); ++i) EXPECT_GE(touched[i], searched[i]);
  EXPECT_FALSE(plain.has("/methods/certified/counters/pairs_touched"));
  EXPECT_EQ(run.plan.scene->meshes.at(1).instances, 4);
}

TEST(Instances, TheirListIsAnInputOfTheRun) {
  const ScratchDirectory scratch;
  const Experiment world = shapes_with(list_of_four(scratch), {"/frames=40"});
  run_experiment_to_file(world, scratch / "whole.h5", {"lmdbench", "run"});
  EXPECT_THAT(OpenResult(scratch / "whole.h5").strings("/provenance/inputs/role"),
              ::testing::Contains("instances:fixed_0"));
  EXPECT_THROW(
      run_experiment_to_file(world, scratch / "r.h5", {},
                             [](const std::string&, std::int64_t done, std::int64_t) { return done < 60; }),
      Interrupted);
  scratch.write("list.txt", "0 0 0 0 0 0 1\n");
  EXPECT_THAT(message_of<InputError>([&] {
                run_experiment_to_file(world, scratch / "r.h5", {"lmdbench", "run"}, {}, Leftover::RESUME);
              }),
              HasSubstr("is of another run"));
  EXPECT_THAT(message_of<InputError>([&] { scene_of_result(ResultReader(scratch / "whole.h5")); }),
              HasSubstr("list.txt: the list of poses has changed"));
}

/// Three entries of one mesh: the plain torus, one far away, one turned beside it.
Experiment three_entries(std::vector<Override> overrides = {}) {
  overrides.insert(overrides.begin(), {"/frames=320", "/driver/repetitions=1", "/record/lmds=true",
                                       R"(/methods=[{"name":"improved"},{"name":"certified"}])",
                                       "/probes/truth/stride_frames=0", "/probes/fcl/stride_frames=0"});
  const std::string torus = R"({"mesh":"torus","diagonal_m":0.15)";
  overrides.push_back("/fixed=[" + torus + "}," + torus + R"(,"pose":{"translation_m":[0.16,0,0]}},)" +
                      torus + R"(,"pose":{"translation_m":[0,0,0.05],"rotation_xyzw":[0.6,0,0,0.8]}}])");
  return load_experiment(SHAPES_FILE, overrides);
}

TEST(Instances, EntriesOfOneMeshShareItAndFindWhatInstancesFind) {
  const auto [scene, notes, movers] = load_scene(three_entries());
  ASSERT_EQ(scene.fixed.size(), 3u);
  EXPECT_EQ(scene.fixed[0].body, scene.fixed[2].body);
  EXPECT_EQ(notes.size(), 4u);
  const Scene apart = load_scene(three_entries({"/plan/shared_mesh=off"})).scene;
  EXPECT_NE(apart.fixed[0].body, apart.fixed[2].body);

  const ScratchDirectory scratch;
  run_experiment_to_file(three_entries(), scratch / "entries.h5", {"lmdbench", "run"});
  run_experiment_to_file(three_entries({"/plan/shared_mesh=off"}), scratch / "apart.h5", {"lmdbench", "run"});
  const std::string list =
      scratch.write("list.txt", "0 0 0 0 0 0 1\n0.16 0 0 0 0 0 1\n0 0 0.05 0.6 0 0 0.8\n");
  run_experiment_to_file(shapes_with(R"({"rule":"list","file":")" + list + "\"}"), scratch / "instances.h5",
                         {"lmdbench", "run"});
  // Outputs that need vertices in the world frame get them there.
  run_experiment_to_file(three_entries({"/record/polylines/stride_frames=40"}), scratch / "world.h5",
                         {"lmdbench", "run"});
  const OpenResult entries(scratch / "entries.h5"), instances(scratch / "instances.h5"),
      separate(scratch / "apart.h5"), world(scratch / "world.h5");
  for (const std::string method : {"/methods/certified", "/methods/improved"}) {
    const auto points = entries.doubles(method + "/lmds/point_fixed");
    EXPECT_GT(points.size(), 150u);
    for (const OpenResult* same : {&entries, &instances, &separate}) {
      EXPECT_EQ(points, same->doubles(method + "/lmds/point_fixed"));
      EXPECT_TRUE(same->has("/methods/certified/counters/pairs_touched"));
    }
  }
  // In another frame roundings differ, which may change the set of an approximation.
  const auto in_world = world.doubles("/methods/certified/lmds/distance"),
             in_mesh = entries.doubles("/methods/certified/lmds/distance");
  ASSERT_EQ(in_world.size(), in_mesh.size());
  for (std::size_t i = 0; i < in_mesh.size(); ++i) EXPECT_NEAR(in_mesh[i], in_world[i], 1e-12);
}

TEST(Instances, ContactIsWithAnyOfThem) {
  const ScratchDirectory scratch;
  const Experiment world = shapes_with(list_of_four(scratch));
  auto [scene, notes, movers] = load_scene(world);
  ASSERT_EQ(scene.fixed.size(), 4u);
  EXPECT_EQ(scene.fixed[0].body, scene.fixed[3].body);
  EXPECT_EQ(notes.size(), 2u);
  scene.cutoff = 0.001;
  Scene placed = scene;
  placed.fixed.clear();
  for (const FixedBody& fixed : scene.fixed)
    placed.fixed.push_back(
        FixedBody(std::make_shared<const Body>("placed", build_surface(placed_mesh(fixed)))));
  std::vector<Pose> poses;
  for (int k = 0; k < 60; ++k) {
    poses.push_back({Vec3(0.01, 0.002 * k, 0.009 * k)});
  }
  const std::vector<bool> contact = frames_in_contact(scene, poses);
  EXPECT_EQ(contact, frames_in_contact(placed, poses));
  EXPECT_GT(std::count(contact.begin(), contact.end(), true), 2);
  EXPECT_GT(std::count(contact.begin(), contact.end(), false), 5);
  EXPECT_NEAR(clearance(scene, std::span(poses).last(1)).least_m,
              clearance(placed, std::span(poses).last(1)).least_m, 1e-12);
}

TEST(Instances, ExportsAndReportsHaveThoseThatComeNearest) {
  const ScratchDirectory scratch;
  const Experiment world = shapes_with(R"({"rule":"grid","counts":[7,7,7]})", {"/frames=40"});
  run_experiment_to_file(world, scratch / "world.h5", {"lmdbench", "run"});
  const ResultReader result(scratch / "world.h5");
  const Scene scene = scene_of_result(result).rest;
  ASSERT_EQ(scene.fixed.size(), 343u);
  const std::vector<std::size_t> drawn = drawn_bodies(scene, tracks_of_result(result, 10));
  EXPECT_EQ(drawn.size(), MOST_DRAWN);
  EXPECT_THAT(drawn, ::testing::Contains(171u));  // in the middle
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
  EXPECT_EQ(export_frames(result, scratch / "vtk", 4).size(), MOST_DRAWN + 5);
}

TEST(Instances, BadOnesAreToldWithTheirPlace) {
  EXPECT_THAT(message_of<Error>([] { shapes_with(R"({"rule":"grid"})"); }), HasSubstr("/fixed/0/instances"));
  EXPECT_THAT(message_of<Error>([] { shapes_with(R"({"rule":"pile"})"); }), HasSubstr("needs \"count\""));
  EXPECT_THAT(message_of<Error>([] { shapes_with(R"({"rule":"list"})"); }), HasSubstr("needs \"file\""));
  EXPECT_THAT(message_of<Error>([] { shapes_with(R"({"rule":"heap","count":3})"); }),
              HasSubstr("/fixed/0/instances"));
  EXPECT_THAT(message_of<Error>([] { shapes_with(R"({"rule":"random","count":0})"); }), HasSubstr("count"));
  EXPECT_THAT(message_of<Error>([] { shapes_with(R"({"rule":"random","count":2000000})"); }),
              HasSubstr("limit"));
  EXPECT_THAT(message_of<Error>([] { shapes_with(R"({"rule":"grid","counts":[1000,1000,2]})"); }),
              HasSubstr("limit"));
  EXPECT_THAT(
      message_of<Error>([] {
        parse_experiment(
            R"({"moving":{"mesh":"blob"},"fixed":[{"mesh":"torus","instances":{"rule":"random","count":3}}]})",
            SHAPES_FILE);
      }),
      HasSubstr("/path/file"));
  for (const std::string key : {R"("turned":false)", R"("spacing_diagonals":2)", R"("seed":2)"})
    EXPECT_THAT(message_of<Error>([&] { shapes_with(R"({"rule":"list","file":"l.txt",)" + key + "}"); }),
                HasSubstr("exclude each other"))
        << key;
  EXPECT_THAT(message_of<Error>([] { prepare(shapes_with(R"({"rule":"list","file":"no-such-list.txt"})")); }),
              HasSubstr("no-such-list.txt"));
}

TEST(PoseList, NamesTheLineThatIsWrong) {
  const auto of = [](const std::string& text) {
    return message_of<Error>([&] { parse_pose_list(text, "poses.csv"); });
  };
  EXPECT_THAT(of("0 0 0 0 0 0 1\n1 2 3\n"), HasSubstr("line 2"));
  EXPECT_THAT(of("0 0 0 0 0 0 2\n"), HasSubstr("no scale"));
  EXPECT_THAT(of("0 0 0 0 0 0 1\n\n0 0 nan 0 0 0 1\n"), HasSubstr("line 3"));
  EXPECT_THAT(of("0 0 inf 0 0 0 1\n"), HasSubstr("no finite number"));
  EXPECT_THAT(of("x,y,z,qx,qy,qz,qw\n"), HasSubstr("line 1"));
  EXPECT_THAT(of("# nothing\n"), HasSubstr("has no pose"));
  EXPECT_THAT(of("0 0 0 0 0 0 1\n5 0 0 0 0 0 0 1\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("8 numbers, 7 in")));
  const std::vector<Pose> poses =
      parse_pose_list("5, 1,2,3,0,0,0.6,0.8\r\n6 1 2 3 0 0 0 1 # with a time\n", "p");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].translation, Vec3(1, 2, 3));
  EXPECT_EQ(poses[0].rotation.z(), 0.6);
  EXPECT_EQ(poses[1].translation, Vec3(1, 2, 3));
}

}  // namespace
}  // namespace lmdbench
