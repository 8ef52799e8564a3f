// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/run/run.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <result/deterministic_datasets.h>
#include <result_file/result_reading.h>
#include <support/message_of.h>
#include <support/source_directory.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using testing::deterministic_datasets;
using ::testing::HasSubstr;
using testing::message_of;
using testing::OpenResult;
using testing::ScratchDirectory;

constexpr std::int64_t FRAMES = 320;

/// Small blocks: the run can stop in many places.
Experiment open_loop(std::vector<Override> overrides = {}) {
  overrides.insert(overrides.begin(),
                   {"/frames=320", "/driver/repetitions=3", "/driver/block_frames=7", "/record/lmds=true"});
  return load_experiment(LMDBENCH_SOURCE_DIR "/experiments/shapes.json", overrides);
}

Experiment closed_loop() {
  return load_experiment(LMDBENCH_SOURCE_DIR "/experiments/wall.json",
                         {"/frames=320", "/driver/repetitions=3", "/driver/block_frames=7",
                          R"(/methods/-={"name":"improved","force_law":"exponential"})"});
}

RunResult run(const Experiment& experiment, const std::filesystem::path& file,
              Leftover leftover = Leftover::REFUSE) {
  return run_experiment_to_file(experiment, file, {"lmdbench", "run"}, {}, leftover);
}

/// Runs until so many frames are measured; returns how many were measured when it stopped.
std::int64_t run_until(const Experiment& experiment, const std::filesystem::path& file, std::int64_t frames,
                       Leftover leftover = Leftover::REFUSE) {
  std::int64_t measured = 0;
  EXPECT_THROW(run_experiment_to_file(
                   experiment, file, {},
                   [&](const std::string&, std::int64_t done, std::int64_t) {
                     measured = done;
                     return done < frames;
                   },
                   leftover),
               Interrupted);
  return measured;
}

std::int64_t known_times(const OpenResult& part, const std::vector<std::string>& labels) {
  std::int64_t known = 0;
  for (const std::string& label : labels)
    for (const double time : part.doubles("/methods/" + label + "/local_update_time"))
      known += std::isnan(time) ? 0 : 1;
  return known;
}

TEST(Resume, ThePartHoldsEveryFrameAsSoonAsItIsMeasured) {
  const ScratchDirectory scratch;
  const Experiment experiment = open_loop();
  run(experiment, scratch / "whole.h5");
  const std::vector<double> forces = OpenResult(scratch / "whole.h5").doubles("/methods/improved/force");
  int looks = 0;
  std::int64_t next = 0;
  run_experiment_to_file(
      experiment, scratch / "r.h5", {}, [&](const std::string& phase, std::int64_t done, std::int64_t) {
        if (phase != "run" || done < next) return true;
        ++looks;
        next += 250;
        const OpenResult part(scratch / "r.h5.part");
        EXPECT_EQ(part.integers("/frames_measured"), std::vector<std::int64_t>{done});
        EXPECT_EQ(known_times(part, {"original", "improved"}), done);
        const std::vector<double> kept = part.doubles("/methods/improved/force");
        const std::vector<double> times = part.doubles("/methods/improved/local_update_time");
        for (std::size_t frame = 0; frame < static_cast<std::size_t>(FRAMES); ++frame) {
          if (std::isnan(times[frame])) {
            EXPECT_TRUE(std::isnan(kept[3 * frame])) << "unset is NaN, frame " << frame;
          } else {
            EXPECT_EQ(kept[3 * frame], forces[3 * frame]) << "frame " << frame;
          }
        }
        return true;
      });
  EXPECT_GE(looks, 6) << "or the test above says nothing";
  EXPECT_FALSE(std::filesystem::exists(scratch / "r.h5.part"));
}

class ResumeAnywhere : public ::testing::TestWithParam<std::int64_t> {};

TEST_P(ResumeAnywhere, GivesTheBitsOfAnUninterruptedRunAndKeepsKnownTimes) {
  const ScratchDirectory scratch;
  for (const bool closed : {false, true}) {
    const Experiment experiment = closed ? closed_loop() : open_loop();
    const std::string name = closed ? "closed" : "open";
    run(experiment, scratch / (name + "-whole.h5"));
    const std::filesystem::path file = scratch / (name + ".h5");
    std::int64_t measured = run_until(experiment, file, GetParam());
    std::filesystem::copy_file(file.string() + ".part", scratch / (name + "-kept.h5"));
    // Another interruption, during the replay or after it.
    measured = std::max(measured, run_until(experiment, file, GetParam() + 100, Leftover::RESUME));
    const RunResult result = run(experiment, file, Leftover::RESUME);
    EXPECT_EQ(result.resumed_frames, measured) << name;
    EXPECT_TRUE(deterministic_datasets(file) == deterministic_datasets(scratch / (name + "-whole.h5")))
        << name;
    EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
    const OpenResult kept(scratch / (name + "-kept.h5"));
    const OpenResult final_file(file), whole(scratch / (name + "-whole.h5"));
    for (const MethodChoice& method : experiment.methods)
      for (const std::string dataset :
           {"local_update_time", "global_search_time", "first_reduction_time", "second_tracking_time"}) {
        const std::string path = "/methods/" + method.label + "/" + dataset;
        if (!final_file.has("/methods/" + method.label) || !final_file.has(path)) continue;
        const std::vector<double> before = kept.doubles(path);
        const std::vector<double> after = final_file.doubles(path);
        const std::vector<double> uninterrupted = whole.doubles(path);
        ASSERT_EQ(before.size(), after.size());
        for (std::size_t i = 0; i < before.size(); ++i) {
          EXPECT_EQ(std::isnan(after[i]), std::isnan(uninterrupted[i])) << path << ", value " << i;
          if (std::isnan(before[i])) continue;
          EXPECT_EQ(before[i], after[i]) << path << ", value " << i;
        }
      }
  }
}

// The first frame; frames and the end of the first and of later repetitions; two methods.
INSTANTIATE_TEST_SUITE_P(Resume, ResumeAnywhere,
                         ::testing::Values(1, 7, 300, 2 * FRAMES, 2 * FRAMES + 1, 1000, 4 * FRAMES,
                                           6 * FRAMES - 120));

TEST(Resume, MeasuredFramesAreNotThrownAwayByMistake) {
  const ScratchDirectory scratch;
  run_until(open_loop(), scratch / "r.h5", 100);
  EXPECT_THAT(message_of<Error>([&] { run(open_loop(), scratch / "r.h5"); }),
              AllOf(HasSubstr("r.h5.part"), HasSubstr("--resume")));
  EXPECT_THAT(message_of<Error>(
                  [&] { run(open_loop({"/force/maximum_force_n=1"}), scratch / "r.h5", Leftover::RESUME); }),
              AllOf(HasSubstr("r.h5.part"), HasSubstr("of another run")));
  EXPECT_GT(OpenResult(scratch / "r.h5.part").integers("/frames_measured").front(), 99);
}

TEST(Resume, WithoutAPartTheRunBegins) {
  const ScratchDirectory scratch;
  EXPECT_EQ(run(open_loop(), scratch / "r.h5", Leftover::RESUME).resumed_frames, 0);
}

TEST(Resume, AForeignFileOfThePartsNameIsRefused) {
  const ScratchDirectory scratch;
  // As good as any HDF5 file: a result of ours that a user gave this name.
  run(open_loop({"/driver/repetitions=1"}), scratch / "other.h5");
  std::filesystem::rename(scratch / "other.h5", scratch / "r.h5.part");
  for (const Leftover leftover : {Leftover::REFUSE, Leftover::RESUME})
    EXPECT_THAT(message_of<Error>([&] { run(open_loop(), scratch / "r.h5", leftover); }),
                AllOf(HasSubstr("r.h5.part"), HasSubstr("no part of a run")));
  EXPECT_EQ(OpenResult(scratch / "r.h5.part").doubles("/methods/improved/force").size(), 3 * FRAMES);
}

TEST(Resume, ARunThatMeasuredNothingLeavesNothing) {
  const ScratchDirectory scratch;
  Experiment experiment = open_loop();
  experiment.objects.front().motion.path_file = scratch / "missing.tum";
  EXPECT_THROW(run(experiment, scratch / "r.h5"), Error);
  EXPECT_TRUE(std::filesystem::is_empty(scratch / ""));
}

TEST(Resume, AnotherForceIsNoticed) {
  const ScratchDirectory scratch;
  run_until(open_loop(), scratch / "r.h5", 600);
  {
    const hid_t file = H5Fopen((scratch / "r.h5.part").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(file, "/methods/original/force", H5P_DEFAULT);
    std::vector<double> forces(3 * FRAMES);
    H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, forces.data());
    forces[3 * 200 + 1] += 1e-9;
    H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, forces.data());
    H5Dclose(dataset);
    H5Fclose(file);
  }
  EXPECT_THAT(message_of<Error>([&] { run(open_loop(), scratch / "r.h5", Leftover::RESUME); }),
              AllOf(HasSubstr("r.h5.part"), HasSubstr("method original, frame 200")));
}

}  // namespace
}  // namespace lmdbench
