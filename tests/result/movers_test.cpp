// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/result/result_scene.h>
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/view/export_frames.h>
#include <lmdbench/view/report.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <result/deterministic_datasets.h>
#include <result_file/result_reading.h>
#include <support/committed.h>
#include <support/files.h>
#include <support/message_of.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using testing::deterministic_datasets;
using ::testing::Each;
using ::testing::HasSubstr;
using testing::message_of;
using testing::OpenResult;
using testing::ScratchDirectory;
using testing::SHAPES_FILE;

constexpr const char* SHAPES_PATH = R"({"file":"../paths/shapes.tum"})";
constexpr const char* BLOBS =
    R"({"mesh":"small-blob","diagonal_m":0.04,"pose":{"translation_m":[0,0,0.2]},)"
    R"("instances":{"rule":"pile","count":5,"spacing_diagonals":0.68,"turned":false},)"
    R"("path":{"way_diagonals":0.05,"period_s":0.1,"seed":4}})";
constexpr const char* BALL =
    R"({"mesh":"ball","diagonal_m":0.03,"pose":{"translation_m":[0.013,0.009,0.09]},)"
    R"("path":{"way_diagonals":0.5,"period_s":0.08}})";
constexpr const char* CUBE =
    R"({"mesh":"cube","diagonal_m":0.04,"pose":{"translation_m":[-0.027,-0.027,0.0345]},)"
    R"("path":{"period_s":0.05}})";

/// Entry of a second cube on top of the first one.
constexpr const char* SECOND_CUBE =
    R"({"mesh":"cube","diagonal_m":0.04,"pose":{"translation_m":[-0.027,-0.027,0.063]},)"
    R"("path":{"period_s":0.07,"seed":2}})";

/// A small blob along a torus, with these movers.
Experiment movers_scene(const std::vector<std::string>& entries, std::vector<Override> overrides = {},
                        const std::string& methods = R"([{"name":"improved"},{"name":"certified"}])") {
  std::string movers;
  for (const std::string& entry : entries) movers += (movers.empty() ? "" : ",") + entry;
  overrides.insert(overrides.begin(),
                   {"/frames=60", R"(/force={"cutoff_diagonal":0.05,"maximum_force_n":3})",
                    "/driver/repetitions=2", "/driver/block_frames=16", "/driver/search_every_frames=10",
                    "/driver/search_latency_frames=5", "/record/lmds=true", "/record/torque=true",
                    "/methods=" + methods, "/probes/truth/stride_frames=6", "/probes/fcl/stride_frames=9",
                    R"(/moving={"mesh":"small-blob","diagonal_m":0.1})", "/movers=[" + movers + "]"});
  return load_experiment(SHAPES_FILE, overrides);
}

RunResult run_movers(const Experiment& experiment, const std::filesystem::path& file) {
  return run_experiment_to_file(experiment, file, {"lmdbench", "run"});
}

/// Rows of a mover in a dataset of (frames, movers, width).
std::vector<double> mover_column(const std::vector<double>& values, std::size_t movers, std::size_t mover,
                                 std::size_t width) {
  std::vector<double> rows;
  for (std::size_t at = mover * width; at < values.size(); at += movers * width)
    rows.insert(rows.end(), values.begin() + static_cast<std::ptrdiff_t>(at),
                values.begin() + static_cast<std::ptrdiff_t>(at + width));
  return rows;
}

double largest_of(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// Relative poses have other rounding errors than poses in the world.
void expect_same_but_rounding(const std::vector<double>& a, const std::vector<double>& b,
                              const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  const double tolerance = 1e-11 * largest_of(b);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], tolerance) << what << ", number " << i;
}

TEST(Movers, OneOfThemFeelsWhatTheMovingMeshOfTheSameSceneFeels) {
  const ScratchDirectory scratch;
  const std::string methods = R"([{"name":"original"},{"name":"improved"},{"name":"certified"},)"
                              R"({"name":"nearest"}])";
  const std::string in_metres = R"(/force={"cutoff_m":0.02,"maximum_force_n":3})";
  // The moving mesh is very small and far from everything.
  const std::string far = scratch.write("far.tum", "0 5 0 0 0 0 0 1\n1 5 0 0 0 0 0 1\n");
  run_movers(
      movers_scene({std::string(R"({"mesh":"small-blob","diagonal_m":0.1,"path":)") + SHAPES_PATH + "}"},
                   {R"(/moving={"mesh":"ball","diagonal_m":0.01})", in_metres, "/path/file=" + far}, methods),
      scratch / "mover.h5");
  run_movers(movers_scene({}, {in_metres}, methods), scratch / "plain.h5");
  const OpenResult mover(scratch / "mover.h5"), plain(scratch / "plain.h5");
  EXPECT_FALSE(plain.has("/path/movers"));
  for (const std::string label : {"original", "improved", "certified", "nearest"}) {
    const std::string group = "/methods/" + label;
    const std::vector<double> force = plain.doubles(group + "/force");
    EXPECT_GT(largest_of(force), 0.1) << label;
    expect_same_but_rounding(mover_column(mover.doubles(group + "/movers/force"), 2, 1, 3), force, label);
    expect_same_but_rounding(mover_column(mover.doubles(group + "/movers/torque"), 2, 1, 3),
                             plain.doubles(group + "/torque"), label);
    EXPECT_EQ(largest_of(mover.doubles(group + "/force")), 0.0);
    for (const char* name : {"distance", "point_moving", "point_fixed", "direction"})
      expect_same_but_rounding(mover.doubles(group + "/lmds/" + name), plain.doubles(group + "/lmds/" + name),
                               label + " " + name);
    EXPECT_THAT(mover.integers(group + "/lmds/moving_body"), Each(1));
    EXPECT_EQ(mover.integers(group + "/lmds/fixed_body"), plain.integers(group + "/lmds/fixed_body"));
    EXPECT_EQ(mover.integers(group + "/lmd_count"), plain.integers(group + "/lmd_count"));
    expect_same_but_rounding({mover.doubles(group + "/truth/force_error").back() + 1.0,
                              mover.doubles(group + "/truth/recall").back(),
                              mover.doubles(group + "/truth/recall_adjacent").back()},
                             {plain.doubles(group + "/truth/force_error").back() + 1.0,
                              plain.doubles(group + "/truth/recall").back(),
                              plain.doubles(group + "/truth/recall_adjacent").back()},
                             label + " truth");
  }
  EXPECT_EQ(mover.bytes("/scene/in_contact"), plain.bytes("/scene/in_contact"));
}

TEST(Movers, AllPairsAgreeWithTruthAndWithFcl) {
  const ScratchDirectory scratch;
  const RunResult result = run_movers(movers_scene({BLOBS, BALL, CUBE}), scratch / "result.h5");
  const OpenResult file(scratch / "result.h5");
  EXPECT_EQ(file.shape("/path/movers/position"), (std::vector<std::size_t>{60, 8, 3}));
  EXPECT_EQ(file.shape("/methods/improved/movers/force"), (std::vector<std::size_t>{60, 8, 3}));
  EXPECT_EQ(file.integer_attribute("/scene/mover_0", "first_mover"), 1);
  EXPECT_EQ(file.integer_attribute("/scene/mover_0", "movers"), 5);
  EXPECT_EQ(file.integer_attribute("/scene/mover_2", "first_mover"), 7);
  EXPECT_EQ(mover_column(file.doubles("/path/movers/position"), 8, 0, 3), file.doubles("/path/position"));
  for (const double recall : file.doubles("/methods/certified/truth/recall")) EXPECT_FALSE(recall < 1.0);
  for (const double precision : file.doubles("/methods/certified/truth/precision"))
    EXPECT_FALSE(precision < 1.0);
  EXPECT_THAT(file.doubles("/methods/certified/truth/force_error"), Each(0.0));
  EXPECT_GT(largest_of(file.doubles("/methods/improved/truth/force_error")), 0.0);
  EXPECT_GT(file.doubles("/methods/improved/summary/recall").front(), 0.3);

  // Every mover gets forces, from standing objects and from movers.
  const std::vector<double> forces = file.doubles("/methods/certified/movers/force");
  for (std::size_t mover = 1; mover < 8; ++mover)
    EXPECT_GT(largest_of(mover_column(forces, 8, mover, 3)), 0.0) << mover;
  EXPECT_EQ(mover_column(forces, 8, 0, 3), file.doubles("/methods/certified/force"));
  const auto moving = file.integers("/methods/certified/lmds/moving_body");
  const auto other = file.integers("/methods/certified/lmds/fixed_body");
  std::size_t among_movers = 0;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    EXPECT_LT(moving[i], 8);
    EXPECT_LE(other[i], 8);  // one standing object, then the movers
    if (other[i] < 1) continue;
    ++among_movers;
    EXPECT_LT(moving[i], other[i] - 1);
  }
  EXPECT_GT(among_movers, 50u);
  EXPECT_LT(among_movers, moving.size());

  const FclCheck* fcl = result.tracks.front().fcl();
  ASSERT_TRUE(fcl);
  EXPECT_GE(fcl->frames.size(), 6u);
  for (const FclFrame& frame : fcl->frames) EXPECT_TRUE(frame.agrees) << frame.frame;
  // A frame is in contact when any pair is.
  const auto count = file.integers("/methods/certified/lmd_count");
  const auto contact = file.bytes("/scene/in_contact");
  for (std::size_t frame = 0; frame < contact.size(); ++frame)
    EXPECT_EQ(contact[frame] != 0, count[frame] > 0) << frame;
  EXPECT_TRUE(file.has("/methods/certified/counters/pairs_searched"));
  EXPECT_TRUE(file.has("/reference/movers/force_linear"));

  // The truth of sweeps has the force of each, too.
  const TrueSets truth = true_sets(result.prepared, 0, {});
  ASSERT_EQ(truth.frames.size(), 60u);
  const auto law = static_cast<std::size_t>(ForceLaw::EXPONENTIAL);
  for (std::size_t i = 0; i < result.records[1].movers.size(); ++i)
    EXPECT_EQ(truth.frames[i / 8].movers[law].at(i % 8), result.records[1].movers[i].force) << i;
}

TEST(Movers, TheirOrderInTheFileIsOnlyTheirNumbering) {
  const ScratchDirectory scratch;
  run_movers(movers_scene({BLOBS, BALL, CUBE, SECOND_CUBE}), scratch / "abc.h5");
  run_movers(movers_scene({SECOND_CUBE, CUBE, BLOBS, BALL}), scratch / "cab.h5");
  const OpenResult abc(scratch / "abc.h5"), cab(scratch / "cab.h5");
  // For each object of the first file, its place in the second file.
  const std::vector<std::size_t> place{0, 3, 4, 5, 6, 7, 8, 2, 1};
  for (const std::string label : {"improved", "certified"})
    for (const auto& [name, width] :
         {std::pair{"force", 3}, std::pair{"torque", 3}, std::pair{"minimum_distance", 1}}) {
      const std::string path = "/methods/" + label + "/movers/" + name;
      for (std::size_t mover = 0; mover < 9; ++mover) {
        const auto w = static_cast<std::size_t>(width);
        std::vector<double> a = mover_column(abc.doubles(path), 9, mover, w),
                            b = mover_column(cab.doubles(path), 9, place[mover], w);
        for (std::vector<double>* values : {&a, &b})
          std::ranges::replace_if(
              *values, [](double x) { return std::isnan(x); }, -1.0);
        EXPECT_EQ(a, b) << path << " of mover " << mover;
      }
    }
  // Two movers of one mesh change places in the file, and are in contact.
  const auto moving = abc.integers("/methods/certified/lmds/moving_body"),
             other = abc.integers("/methods/certified/lmds/fixed_body");
  std::size_t between = 0;
  for (std::size_t i = 0; i < moving.size(); ++i) between += moving[i] == 7 && other[i] == 1 + 8 ? 1 : 0;
  EXPECT_GT(between, 10u);
  for (const std::string label : {"improved", "certified"})
    EXPECT_EQ(abc.text_attribute("/methods/" + label, "result_hash"),
              cab.text_attribute("/methods/" + label, "result_hash"));
  EXPECT_EQ(abc.integers("/methods/certified/counters/pairs_searched"),
            cab.integers("/methods/certified/counters/pairs_searched"));
}

TEST(Movers, OfAPairEachPushesTheOtherAsItIsPushed) {
  const ScratchDirectory scratch;
  const std::string beside = R"({"mesh":"cube","diagonal_m":0.05,"pose":{"translation_m":[1.0,0.002,0.001]},)"
                             R"("path":{"way_diagonals":0.05,"turn_rad":0.2,"period_s":0.05}})";
  // Far from the torus: the two only touch each other.
  const std::string path = scratch.write("path.tum", "0 1.046 0 0 0 0 0 1\n1 1.046 0 0 0 0 0 1\n");
  run_movers(movers_scene({beside}, {"/path/file=" + path, "/device=ideal"}), scratch / "two.h5");
  const OpenResult file(scratch / "two.h5");
  const std::vector<double> forces = file.doubles("/methods/certified/movers/force"),
                            torques = file.doubles("/methods/certified/movers/torque"),
                            places = file.doubles("/path/movers/position");
  ASSERT_GT(largest_of(forces), 0.1);
  const auto row = [](const std::vector<double>& values, std::size_t at) {
    return Vec3(values[3 * at], values[3 * at + 1], values[3 * at + 2]);
  };
  for (std::size_t frame = 0; frame < 60; ++frame) {
    const Vec3 f0 = row(forces, 2 * frame), f1 = row(forces, 2 * frame + 1);
    EXPECT_EQ(f0, -f1) << frame;
    // Both meshes are centred: torque is about the origins of their frames.
    const Vec3 between = row(places, 2 * frame) - row(places, 2 * frame + 1);
    const Vec3 sum = row(torques, 2 * frame) + row(torques, 2 * frame + 1) + between.cross(f0);
    EXPECT_LT(sum.norm(), 1e-12) << frame;
  }
  EXPECT_EQ(file.integers("/methods/certified/movers/lmd_count")[0],
            file.integers("/methods/certified/movers/lmd_count")[1]);
}

TEST(Movers, OneInAnotherAndTwoAtOnePlaceAreWhatTheyAre) {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("two.txt", "0.3 0 0 0 0 0 1\n0.3 0 0 0 0 0 1\n");
  const std::string twice = R"({"mesh":"cube","diagonal_m":0.05,"instances":{"rule":"list","file":")" + file +
                            R"("},"path":{"way_diagonals":0,"turn_rad":0}})";
  const std::string inside =
      R"({"mesh":"ball","diagonal_m":0.02,"pose":{"translation_m":[0.3,0,0]},"path":{"way_diagonals":0.4}})";
  const RunResult result = run_movers(
      movers_scene({twice, inside}, {"/frames=20", "/probes/fcl/stride_frames=0"}), scratch / "result.h5");
  EXPECT_TRUE(result.prepared.starts_touching);
  const OpenResult open(scratch / "result.h5");
  for (const double recall : open.doubles("/methods/certified/truth/recall")) EXPECT_FALSE(recall < 1.0);
  for (const double precision : open.doubles("/methods/certified/truth/precision"))
    EXPECT_FALSE(precision < 1.0);
  const std::vector<double> least = open.doubles("/methods/certified/movers/minimum_distance");
  EXPECT_EQ(mover_column(least, 4, 1, 1), mover_column(least, 4, 2, 1));
  EXPECT_EQ(least[1], 0.0);
}

TEST(Movers, NearestIsTheNearestPairOfEach) {
  const ScratchDirectory scratch;
  run_movers(movers_scene({BLOBS, BALL, CUBE}, {}, R"([{"name":"nearest"},{"name":"certified"}])"),
             scratch / "result.h5");
  const OpenResult file(scratch / "result.h5");
  const std::vector<double> nearest = file.doubles("/methods/nearest/movers/minimum_distance"),
                            certified = file.doubles("/methods/certified/movers/minimum_distance");
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    ASSERT_EQ(std::isnan(nearest[i]), std::isnan(certified[i])) << i;
    if (std::isnan(nearest[i])) continue;
    EXPECT_NEAR(nearest[i], certified[i], 1e-12);
  }
  const auto count = file.integers("/methods/nearest/lmd_count");
  EXPECT_LE(*std::ranges::max_element(count), 8);
  EXPECT_GE(*std::ranges::max_element(count), 4);
}

TEST(Movers, SeveralProfilesEachHaveTheirContactsOfAllPairs) {
  const ScratchDirectory scratch;
  const std::string profiles =
      R"([{"name":"hard","cutoff_m":0.001,"maximum_force_n":1},{"name":"soft","cutoff_m":0.006,"maximum_force_n":1}])";
  run_movers(movers_scene({BLOBS, CUBE}, {"/force=" + profiles}, R"([{"name":"certified"}])"),
             scratch / "result.h5");
  const OpenResult file(scratch / "result.h5");
  for (const std::string label : {"certified-hard", "certified-soft"}) {
    EXPECT_THAT(file.doubles("/methods/" + label + "/truth/force_error"), Each(0.0));
    const auto count = file.integers("/methods/" + label + "/lmd_count");
    const auto contact = file.bytes("/methods/" + label + "/in_contact");
    for (std::size_t frame = 0; frame < contact.size(); ++frame)
      EXPECT_EQ(contact[frame] != 0, count[frame] > 0);
  }
}

TEST(Movers, AnInterruptedRunGoesOnToTheSameBits) {
  const ScratchDirectory scratch;
  const Experiment experiment = movers_scene({BLOBS, BALL});
  run_movers(experiment, scratch / "whole.h5");
  EXPECT_THROW(run_experiment_to_file(experiment, scratch / "again.h5", {},
                                      [](const std::string& phase, std::int64_t done, std::int64_t) {
                                        return phase != "run" || done < 70;
                                      }),
               Interrupted);
  const RunResult resumed =
      run_experiment_to_file(experiment, scratch / "again.h5", {}, {}, Leftover::RESUME);
  EXPECT_GT(resumed.resumed_frames, 0);
  EXPECT_EQ(deterministic_datasets(scratch / "whole.h5"), deterministic_datasets(scratch / "again.h5"));
}

TEST(Movers, ExportAndTheViewHaveThemAll) {
  const ScratchDirectory scratch;
  run_movers(movers_scene({BLOBS, BALL}), scratch / "result.h5");
  const ResultReader result(scratch / "result.h5");
  const auto written = export_frames(result, scratch / "vtk", 5);
  for (const char* name : {"movers.pvd", "forces-movers.pvd", "lmds-movers.pvd", "lmds-certified.pvd"})
    EXPECT_THAT(written, ::testing::Contains(scratch / "vtk" / name));
  EXPECT_THAT(testing::read_text(scratch / "vtk" / "forces-movers" / "000000.vtu"),
              AllOf(HasSubstr("NumberOfPoints=\"7\""), HasSubstr("force of certified [N]")));
  const auto left = scratch.write("vtk/movers/.000003.vtu.4711-0.part", "");
  export_frames(result, scratch / "vtk", 5);
  EXPECT_FALSE(std::filesystem::exists(left)) << "of an export that was killed";
  std::filesystem::create_directory(scratch / "view");
  write_report_scene(result, scratch / "view");
  for (const char* name : {"moving.off", "fixed_0.off", "mover_0.off", "mover_1.off"})
    EXPECT_TRUE(std::filesystem::exists(scratch / "view" / name)) << name;
  // The exact sets of all pairs.
  std::ifstream lines(scratch / "view" / "lmds.jsonl");
  const auto count = result.integers("/methods/certified/lmd_count");
  std::string line;
  for (std::size_t frame = 0; std::getline(lines, line); ++frame)
    EXPECT_EQ(static_cast<std::int64_t>(nlohmann::json::parse(line)["lmds"].size()), count[frame]) << frame;
}

TEST(Movers, AnExportOfARunOnTheClockHasTheForceThatWasRendered) {
  const ScratchDirectory scratch;
  run_movers(movers_scene({BALL}, {"/driver/kind=realtime", "/driver/realtime/floor_s=0.01",
                                   "/driver/realtime/lock_memory=false", "/frame_rate_hz=100"}),
             scratch / "result.h5");
  const ResultReader result(scratch / "result.h5");
  ASSERT_FALSE(result.has("/methods/certified/movers/force"));
  EXPECT_THAT(export_frames(result, scratch / "vtk", 5),
              ::testing::Contains(scratch / "vtk/lmds-certified.pvd"));
  EXPECT_THAT(testing::read_text(scratch / "vtk/forces-movers/000000.vtu"),
              AllOf(HasSubstr("NumberOfPoints=\"1\""), HasSubstr("force of certified [N]")));
}

TEST(Movers, WhatDoesNotGoTogetherNamesThePlace) {
  EXPECT_THAT(message_of<UsageError>([&] { prepare(movers_scene({BALL})); }), HasSubstr("/movers/0"));
  EXPECT_THAT(message_of<UsageError>([&] {
                movers_scene({BALL, R"({"mesh":"ball","path":{"file":"a.tum","turn_rad":1}})"});
              }),
              AllOf(HasSubstr("/movers/1/path"), HasSubstr("\"file\" and \"turn_rad\" exclude each other")));
}

TEST(Movers, ABadEntryNamesItsPlace) {
  const ScratchDirectory scratch;
  const auto prepared = [](const std::string& entry) {
    prepare(movers_scene({BALL, BALL, BALL, entry}), {}, Deforming::FOLLOWED);
  };
  EXPECT_THAT(message_of<Error>([&] { prepared(R"({"mesh":"bal"})"); }),
              AllOf(HasSubstr("/movers/3/mesh"), HasSubstr("knows no mesh 'bal'")));
  EXPECT_THAT(message_of<UsageError>([&] { movers_scene({BALL}, {"/movers/0/diagonal_m=NaN"}); }),
              HasSubstr("/movers/0/diagonal_m"));
  EXPECT_THAT(
      message_of<UsageError>([&] { prepared(R"({"mesh":"ball","pose":{"rotation_xyzw":[0,0,0,2]}})"); }),
      HasSubstr("/movers/3/pose/rotation_xyzw"));
  EXPECT_THAT(message_of<UsageError>([&] { prepared(R"({"mesh":"ball","instances":{"rule":"pile"}})"); }),
              HasSubstr("/movers/3/instances"));
  const std::string brief = scratch.write("brief.tum", "0 0 0 0 0 0 0 1\n0.01 0 0 0 0 0 0 1\n");
  EXPECT_THAT(
      message_of<InputError>([&] { prepared(R"({"mesh":"ball","path":{"file":")" + brief + "\"}}"); }),
      AllOf(HasSubstr("/movers/3/path/file"), HasSubstr("11 frames of the 60")));
  for (const std::string start : {"0.05", "-0.05", "0.0004"}) {
    const std::string late = scratch.write("late.tum", start + " 0 0 0 0 0 0 1\n9 0 0 0 0 0 0 1\n");
    EXPECT_THAT(
        message_of<InputError>([&] { prepared(R"({"mesh":"ball","path":{"file":")" + late + "\"}}"); }),
        AllOf(HasSubstr("/movers/3/path/file"), HasSubstr("begins at " + start)));
  }
}

TEST(Movers, OnesThatAreTheSameMeshAreReadOnce) {
  std::vector<MeshNote> notes;
  const Experiment experiment = movers_scene({BLOBS, R"({"mesh":"small-blob","diagonal_m":0.1})"});
  const PreparedRun run = prepare(experiment, {}, Deforming::FOLLOWED);
  const MoverPlay& play = *run.input.motion.movers;
  ASSERT_EQ(play.count(), 7u);
  std::vector<const Body*> body(7);
  for (std::size_t i = 0; i < 7; ++i) body[play.number[i]] = play.bodies[i].get();
  EXPECT_EQ(body[1], body[5]);
  EXPECT_EQ(body[0], body[6]);
  EXPECT_NE(body[0], body[1]);
  EXPECT_EQ(run.meshes.back().role, "mover_1");
  EXPECT_EQ(run.meshes.back().first_mover, 6);
}

}  // namespace
}  // namespace lmdbench
