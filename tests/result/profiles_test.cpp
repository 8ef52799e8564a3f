// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/metrics/errors.h>
#include <lmdbench/metrics/summary.h>
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/run/run.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <result_file/result_reading.h>
#include <support/committed.h>
#include <support/message_of.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;
using testing::OpenResult;
using testing::ScratchDirectory;
using testing::SHAPES_FILE;
using testing::WALL_FILE;

const std::string HARD = R"({"name": "hard", "cutoff_m": 0.002, "maximum_force_n": 3})";
const std::string SOFT = R"({"name": "soft", "cutoff_m": 0.008, "maximum_force_n": 2, "clip": "maximum"})";

/// The approach and first contact, with `improved` alone.
Experiment shapes_under(const std::string& force, std::vector<Override> more = {}) {
  more.insert(more.begin(),
              {"/frames=240", "/driver/repetitions=1", "/driver/search_every_frames=10",
               "/driver/search_latency_frames=10",
               "/methods=[{\"name\": \"improved\", \"force_law\": \"exponential\"}]",
               "/probes/truth/stride_frames=60", "/probes/fcl/stride_frames=80", "/force=" + force});
  return load_experiment(SHAPES_FILE, more);
}

std::string both() {
  return fmt::format("[{}, {}]", HARD, SOFT);
}

TEST(Profiles, ListPutsEveryMethodUnderEachOfThem) {
  const Experiment experiment =
      shapes_under(both(), {R"(/methods/-={"name": "certified", "force_law": "linear"})"});
  ASSERT_EQ(experiment.profiles.size(), 2u);
  std::vector<std::string> labels;
  for (const MethodChoice& method : experiment.methods) labels.push_back(method.label);
  EXPECT_THAT(labels,
              ::testing::ElementsAre("improved-hard", "certified-hard", "improved-soft", "certified-soft"));
  EXPECT_EQ(experiment.methods[3].force_law, ForceLaw::LINEAR);
  EXPECT_EQ(experiment.methods[3].profile, 1u);
  EXPECT_EQ(experiment.profiles[0].sharpness, 4.0) << "defaults are filled in in a list, too";
}

TEST(Profiles, OneObjectStaysOneProfileWithoutALabel) {
  const Experiment experiment = shapes_under(HARD);
  EXPECT_EQ(experiment.profiles.size(), 1u);
  EXPECT_EQ(experiment.methods[0].label, "improved");
  EXPECT_EQ(shapes_under(fmt::format("[{}]", HARD)).methods[0].label, "improved-hard")
      << "a list of one is a list";
}

TEST(Profiles, MistakesNameTheProfile) {
  const auto place_of = [](const std::string& force) {
    return testing::message_of<UsageError>([&] { shapes_under(force); });
  };
  EXPECT_THAT(place_of(R"([{"cutoff_m": 0.01, "maximum_force_n": 3}])"), HasSubstr("/force/0"));
  EXPECT_THAT(place_of(fmt::format("[{}, {}]", HARD, HARD)), HasSubstr("/force/1/name"));
  EXPECT_THAT(place_of(fmt::format("[{}, [{}]]", HARD, SOFT)), HasSubstr("/force/1"));
  EXPECT_THAT(place_of(fmt::format(R"([{}, {{"name": "b", "cutoff_m": 1, "cutoff_diagonal": 1}}])", HARD)),
              HasSubstr("/force/1: \"cutoff_diagonal\" and \"cutoff_m\" exclude each other"));
  EXPECT_THAT(place_of(fmt::format(R"([{}, {{"name": "b", "cutof_m": 1, "maximum_force_n": 3}}])", HARD)),
              HasSubstr("/force/1/cutof_m"));
  EXPECT_THAT(place_of("[]"), HasSubstr("/force"));
}

TEST(Profiles, EachIsTheSameBitsAsAlone) {
  const RunResult together = run_experiment(shapes_under(both()));
  EXPECT_EQ(together.records[0].result_hash, run_experiment(shapes_under(HARD)).records[0].result_hash);
  EXPECT_EQ(together.records[1].result_hash, run_experiment(shapes_under(SOFT)).records[0].result_hash);
  EXPECT_NE(together.records[0].result_hash, together.records[1].result_hash);
}

TEST(Profiles, TruthContactAndCrosscheckAreEachProfilesOwn) {
  const Experiment experiment = shapes_under(both());
  const RunResult together = run_experiment(experiment);
  for (const std::size_t i : {0u, 1u}) {
    const RunResult alone = run_experiment(shapes_under(i == 0 ? HARD : SOFT));
    const Track& track = together.track_of(i);
    EXPECT_EQ(track.profile, i);
    EXPECT_EQ(track.in_contact, alone.in_contact);
    const std::vector<TruthFrame>&truth = track.truth()->frames,
          &alone_truth = alone.track_of(0).truth()->frames;
    ASSERT_EQ(truth.size(), alone_truth.size());
    for (std::size_t k = 0; k < truth.size(); ++k) {
      EXPECT_EQ(truth[k].force[0], alone_truth[k].force[0]);
      EXPECT_EQ(together.comparisons(i)[k].force_error, alone.comparisons(0)[k].force_error);
    }
    ASSERT_EQ(track.fcl()->frames.size(), alone.track_of(0).fcl()->frames.size());
  }
  double hardest = 0.0, softest = 0.0;
  for (const FrameRecord& frame : together.records[0].frames) hardest = std::max(hardest, frame.force.norm());
  for (const FrameRecord& frame : together.records[1].frames) softest = std::max(softest, frame.force.norm());
  EXPECT_LE(softest, 2.0 * (1.0 + 1e-15)) << "the soft sum is clipped to its F_max";
  EXPECT_GT(softest, 1.999);

  const RunSummary summary = summarise(experiment, together);
  ASSERT_EQ(summary.profiles.size(), 1u);
  double sum = 0.0, largest = 0.0;
  std::size_t frames = 0;
  for (std::size_t i = 0; i < together.records[0].frames.size(); ++i) {
    if (!together.track_of(1).in_contact[i]) continue;  // the farther cutoff includes it
    const double length = (together.records[1].frames[i].force - together.records[0].frames[i].force).norm();
    sum += length * length;
    largest = std::max(largest, length);
    ++frames;
  }
  EXPECT_NEAR(summary.profiles[0].force_difference_rms_n, std::sqrt(sum / static_cast<double>(frames)),
              1e-12);
  EXPECT_EQ(summary.profiles[0].force_difference_maximum_n, largest);
  EXPECT_THAT(summary_text(summary), HasSubstr("same poses: forces differ by"));
  const auto json = nlohmann::json::parse(summary_json(summary))["profiles"].at(0);
  EXPECT_EQ(json["method"], "improved");
  EXPECT_EQ(json["profile"], "soft");
  EXPECT_EQ(json["against"], "hard");
  EXPECT_EQ(json["differences"]["force_clipped_share"].get<double>(),
            summary.methods[1].force_clipped_share - summary.methods[0].force_clipped_share);
}

TEST(Profiles, ResultKeepsEachGroupsProfile) {
  const ScratchDirectory scratch;
  const auto file = scratch / "profiles.h5";
  run_experiment_to_file(shapes_under(both()), file, {"lmdbench", "run"});
  const OpenResult result(file);
  for (const char* const name : {"in_contact", "reference/frame", "crosscheck/fcl/distance", "truth/recall"})
    EXPECT_TRUE(result.has(std::string("/methods/improved-soft/") + name)) << name;
  EXPECT_FALSE(result.has("/reference/frame"));
  EXPECT_FALSE(result.has("/crosscheck/fcl/distance"));
  EXPECT_FALSE(result.has("/methods/improved"));
}

TEST(ClosedLoopFcl, IsComparedAtTheDevicesPoses) {
  const ScratchDirectory scratch;
  const auto file = scratch / "wall.h5";
  const Experiment experiment =
      load_experiment(WALL_FILE, {"/frames=400", "/loop/push_n=[0, 0, -6]", "/probes/fcl/stride_frames=50"});
  const RunResult run = run_experiment_to_file(experiment, file, {"lmdbench", "run"});
  const FclCheck& check = *run.track_of(0).fcl();
  ASSERT_EQ(check.frames.size(), 8u);
  for (const FclFrame& frame : check.frames) {
    EXPECT_TRUE(frame.agrees);
    EXPECT_NEAR(frame.distance, run.records[0].frames[static_cast<std::size_t>(frame.frame)].minimum_distance,
                1e-8)
        << frame.frame;
  }
  EXPECT_NE(check.frames[0].distance, check.frames[7].distance) << "the device has moved";
  EXPECT_TRUE(OpenResult(file).has("/methods/certified/crosscheck/fcl/distance"));
}

/// A second at 1 kHz: forces of 1 N along x, every tenth frame clipped, one of 3 N, one dropout.
MethodRecord record_of_a_second() {
  MethodRecord record;
  record.frames.resize(1000);
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    record.frames[i].force = Vec3(1.0, 0.0, 0.0);
    record.frames[i].force_clipped = i % 10 == 0;
    record.frames[i].effective_stiffness = 100.0;
  }
  record.frames[500].force.x() = 3.0;
  record.frames[700].force.x() = record.frames[701].force.x() = 0.0;
  return record;
}

TEST(Rendering, NumbersAreOfTheFramesInContact) {
  MethodRecord record = record_of_a_second();
  std::vector<bool> in_contact(1000, true);
  for (std::size_t i = 0; i < 200; ++i) in_contact[i] = false;
  record.frames[100].force.x() = 50.0;  // out of contact: ignored
  MethodSummary summary;
  summarise_rendering(summary, record, {in_contact, 1000.0, 1.0});
  EXPECT_EQ(summary.rendered_force_median_n, 1.0);
  EXPECT_EQ(summary.rendered_force_maximum_n, 3.0);
  EXPECT_EQ(summary.force_clipped_share, 0.1);
  EXPECT_EQ(summary.effective_stiffness_p99_n_per_m, 100.0);
  EXPECT_EQ(summary.dropouts, 1.0) << "the second frame without force is the same one";
  EXPECT_TRUE(std::isnan(summary.dropouts_per_second)) << "one event has no rate, ...";
  EXPECT_NEAR(summary.dropouts_per_second_high, 5.572 / 0.8, 1e-3) << "... but limits";
  EXPECT_TRUE(std::isnan(summary.energy_created_j)) << "an open loop";
}

TEST(Rendering, BuzzingIsWhatIsAbove30Hertz) {
  const auto buzz = [](double hertz) {
    MethodRecord record;
    record.frames.resize(4000);
    for (std::size_t i = 0; i < record.frames.size(); ++i)
      record.frames[i].force.x() = std::sin(2.0 * std::numbers::pi * hertz * 1e-3 * static_cast<double>(i));
    MethodSummary summary;
    summarise_rendering(summary, record, {std::vector<bool>(4000, true), 1000.0, 1.0});
    return summary.force_above_30_hz_n;
  };
  EXPECT_NEAR(buzz(200.0), std::numbers::sqrt2 / 2.0, 0.01);
  EXPECT_NEAR(buzz(30.0), 0.5, 0.01) << "the filter's corner";
  EXPECT_LT(buzz(3.0), 0.01);
  MethodRecord rest;
  rest.frames.resize(500);
  for (FrameRecord& frame : rest.frames) frame.force.z() = 3.0;
  MethodSummary summary;
  summarise_rendering(summary, rest, {std::vector<bool>(500, true), 1000.0, 1.0});
  EXPECT_LT(summary.force_above_30_hz_n, 1e-12) << "a run that begins in contact is no blow";
}

TEST(Rendering, EnergiesAreTheLoops) {
  MethodRecord record = record_of_a_second();
  record.loop.resize(1000);
  record.loop[400].energy.rendered = 0.25;
  record.loop.back().energy.rendered = -1.0;
  record.loop.back().energy.damped = -1.0 - 1e-9;
  record.loop.back().energy.moved = 2.0;
  MethodSummary summary;
  summarise_rendering(summary, record, {std::vector<bool>(1000, true), 1000.0, 1.0});
  EXPECT_EQ(summary.energy_created_j, 0.25);
  EXPECT_NEAR(summary.energy_balance_error, 0.5e-9, 1e-15);
  MethodSummary among_movers;
  summarise_rendering(among_movers, record,
                      {std::vector<bool>(1000, true), 1000.0, 1.0, {.others_move = true}});
  EXPECT_TRUE(std::isnan(among_movers.energy_created_j)) << "what moves gives energy, too";
}

}  // namespace
}  // namespace lmdbench
