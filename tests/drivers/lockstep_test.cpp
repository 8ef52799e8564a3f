// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/lmd/method_description.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;

/// Calls of the driver to fake methods, in order: "A search 3" is instance A searching at frame 3
/// (poses have their frame as x coordinate).
using Log = std::vector<std::string>;

struct FakeTraits {
  bool tracks_locally = true;
  int trackings_after_search = 2;
};

/// Finds three LMDs at a distance of 1 mm per frame of the pose; the first tracking after a search
/// drops one of them. Tracked sets have the pose's frame as distance, which shows the history of
/// the driver's working set.
class FakeMethod : public Method {
 public:
  enum class Counter { SEARCHES, TRACKED_LMDS };

  FakeMethod(std::string tag, FakeTraits traits, Log* log, double drift)
      : tag_(std::move(tag)), log_(log), drift_(drift) {
    description_.name = "fake";
    description_.tracks_locally = traits.tracks_locally;
    description_.trackings_after_search = traits.trackings_after_search;
  }

  const MethodDescription& description() const override { return description_; }

  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    note("search", X_WM);
    counters[Counter::SEARCHES] += 1;
    lmds.clear();
    for (std::int32_t i = 0; i < 3; ++i) lmds.push_back(lmd_at(X_WM, i));
  }

  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    note("track", X_WM);
    counters[Counter::TRACKED_LMDS] += lmds.size();
    if (lmds.size() == 3) lmds.pop_back();
    for (Lmd& lmd : lmds) lmd = lmd_at(X_WM, lmd.feature_moving.index);
  }

 private:
  void note(const std::string& what, const Pose& X_WM) {
    if (log_ != nullptr)
      log_->push_back(tag_ + " " + what + " " + std::to_string(std::lround(X_WM.translation.x())));
  }
  Lmd lmd_at(const Pose& X_WM, std::int32_t index) const {
    Lmd lmd;
    lmd.distance = 0.001 * (1.0 + X_WM.translation.x()) + drift_;
    lmd.direction = Vec3::UnitZ();
    lmd.point_moving = X_WM.translation;
    lmd.point_fixed = lmd.point_moving + lmd.distance * lmd.direction;
    lmd.feature_moving = {FeatureKind::VERTEX, index};
    lmd.feature_fixed = {FeatureKind::FACE, 0};
    return lmd;
  }

  std::string tag_;
  MethodDescription description_;
  Log* log_;
  double drift_;
};

ForceProfile profile() {
  return {ForceLaw::LINEAR, 1.0, 0.0, 1.0, 4.0};
}

/// Instances get tags in the order of their making: the driver makes the global one first. A method
/// without local tracking has one instance.
DrivenMethod fake(const std::string& label, FakeTraits traits, Log* log,
                  const std::shared_ptr<int>& made = std::make_shared<int>(0)) {
  return {label,
          [=] {
            ++*made;
            return std::make_unique<FakeMethod>(
                label + (traits.tracks_locally && *made % 2 == 1 ? ".global" : ".local"), traits, log, 0.0);
          },
          profile()};
}

DriverInput input(int frames) {
  DriverInput result{.poses = {}, .device = VirtualPhantom(device_named("phantom-desktop")), .keep_lmds = {}};
  for (int i = 0; i < frames; ++i) {
    Pose pose;
    pose.translation.x() = i;
    result.poses.push_back(pose);
  }
  return result;
}

DriverChoice driver(std::int64_t every, std::int64_t latency, std::int64_t repetitions = 1,
                    std::int64_t block = 100) {
  return {every, latency, repetitions, block};
}

TEST(Lockstep, SearchReductionArrivalAndTrackingFollowTheClock) {
  Log log;
  run_lockstep({fake("m", {}, &log)}, input(6), driver(4, 2), {});
  EXPECT_THAT(log,
              ElementsAre("m.global search 0", "m.global track 0",  // search, first reduction
                          "m.local track 0", "m.local track 1",
                          "m.global track 2",  // second tracking, at the pose of the arrival
                          "m.local track 2", "m.local track 3",  //
                          "m.global search 4", "m.global track 4", "m.local track 4", "m.local track 5"));
}

TEST(Lockstep, AgeCountsFromThePoseThatWasSearched) {
  const auto records = run_lockstep({fake("m", {}, nullptr)}, input(9), driver(4, 2), {});
  std::vector<double> ages;
  for (const FrameRecord& frame : records[0].frames) ages.push_back(frame.lmd_age);
  EXPECT_TRUE(std::isnan(ages[0]) && std::isnan(ages[1])) << "nothing has arrived yet";
  EXPECT_THAT((std::vector<double>(ages.begin() + 2, ages.end())),
              ElementsAre(0.002, 0.003, 0.004, 0.005, 0.002, 0.003, 0.004));
}

TEST(Lockstep, BeforeTheFirstArrivalThereIsNoForceAndNoDistance) {
  const auto records = run_lockstep({fake("m", {}, nullptr)}, input(4), driver(4, 2), {});
  const FrameRecord& before = records[0].frames[1];
  EXPECT_EQ(before.lmd_count, 0);
  EXPECT_TRUE(before.force.isZero(0.0));
  EXPECT_TRUE(std::isnan(before.minimum_distance));
  EXPECT_TRUE(std::isnan(before.lmd_count_before_reduction));
  const FrameRecord& after = records[0].frames[2];
  EXPECT_EQ(after.lmd_count, 2) << "the reduction dropped one of three";
  EXPECT_EQ(after.lmd_count_before_reduction, 3.0);
  EXPECT_EQ(after.kept_after_reduction, 2.0);
  EXPECT_DOUBLE_EQ(after.minimum_distance, 0.003) << "tracked to this frame's pose";
  EXPECT_DOUBLE_EQ(after.force.z(), -2.0 * (1.0 - 0.003)) << "away from the fixed mesh, both LMDs";
}

TEST(Lockstep, LatencyOfAWholePeriodArrivesBeforeTheNextSearchStarts) {
  Log log;
  const auto records = run_lockstep({fake("m", {}, &log)}, input(5), driver(2, 2), {});
  EXPECT_THAT(log, ElementsAre("m.global search 0", "m.global track 0", "m.local track 0", "m.local track 1",
                               "m.global track 2", "m.global search 2", "m.global track 2", "m.local track 2",
                               "m.local track 3", "m.global track 4", "m.global search 4", "m.global track 4",
                               "m.local track 4"));
  EXPECT_DOUBLE_EQ(records[0].frames[4].lmd_age, 0.002);
}

TEST(Lockstep, NoLatencyArrivesInTheSameFrame) {
  const auto records = run_lockstep({fake("m", {}, nullptr)}, input(3), driver(2, 0), {});
  EXPECT_EQ(records[0].frames[0].lmd_age, 0.0);
  EXPECT_EQ(records[0].frames[0].lmd_count, 2);
  EXPECT_EQ(records[0].frames[1].lmd_age, 0.001);
  EXPECT_EQ(records[0].frames[2].lmd_age, 0.0);
}

TEST(Lockstep, SearchRecordsAndTimes) {
  const auto records = run_lockstep({fake("m", {}, nullptr)}, input(6), driver(4, 2), {});
  const MethodRecord& record = records[0];
  ASSERT_EQ(record.searches.size(), 2u);
  EXPECT_EQ(record.searches[1].frame, 4);
  EXPECT_EQ(record.searches[0].candidates, 3);
  EXPECT_EQ(record.searches[0].kept_after_reduction, 2);
  EXPECT_EQ(record.searches[0].counters[FakeMethod::Counter::SEARCHES], 1u);
  EXPECT_EQ(record.searches[0].counters[FakeMethod::Counter::TRACKED_LMDS], 3u + 2u)
      << "reduction and second tracking";
  EXPECT_EQ(record.searches[1].counters[FakeMethod::Counter::TRACKED_LMDS], 3u)
      << "the run ended before it arrived";
  const RepetitionTimes& times = record.repetitions[0];
  EXPECT_EQ(times.local_update.size(), 6u);
  EXPECT_GE(times.global_search[1], 0.0);
  EXPECT_GE(times.first_reduction[1], 0.0);
  EXPECT_GE(times.second_tracking[0], 0.0);
  EXPECT_TRUE(std::isnan(times.second_tracking[1])) << "did not happen";
}

TEST(Lockstep, MethodsWithoutTrackingsAfterTheSearchHaveNoReductionTime) {
  const auto records = run_lockstep({fake("m", {true, 0}, nullptr)}, input(3), driver(2, 1), {});
  EXPECT_TRUE(std::isnan(records[0].repetitions[0].first_reduction[0]));
  EXPECT_TRUE(std::isnan(records[0].repetitions[0].second_tracking[0]));
  EXPECT_EQ(records[0].searches[0].kept_after_reduction, 3);
}

TEST(Lockstep, MethodsWithoutLocalTrackingSearchInEveryFrame) {
  Log log;
  const auto records = run_lockstep({fake("m", {false, 0}, &log)}, input(3), driver(2, 2), {});
  EXPECT_THAT(log, ElementsAre("m.local search 0", "m.local search 1", "m.local search 2"));
  EXPECT_TRUE(records[0].searches.empty());
  EXPECT_EQ(records[0].frames[0].lmd_age, 0.0);
  EXPECT_EQ(records[0].frames[2].lmd_count, 3);
  EXPECT_EQ(records[0].frames[2].counters[FakeMethod::Counter::SEARCHES], 1u);
}

/// In a fixed order a method would always find the caches that the same other method left.
TEST(Lockstep, MethodsTakeTurnsBlockByBlockInRandomOrder) {
  Log log;
  run_lockstep({fake("a", {false, 0}, &log), fake("b", {false, 0}, &log), fake("c", {false, 0}, &log)},
               input(6), driver(2, 2, 50, 2), {});
  ASSERT_EQ(log.size(), 3u * 6u * 50u);
  std::map<std::string, int> orders;  // of the methods in a block
  for (std::size_t block = 0; block < log.size(); block += 6) {
    std::string order;
    for (std::size_t i = block; i < block + 6; i += 2) {
      EXPECT_EQ(log[i][0], log[i + 1][0]) << "two frames of one method";
      order += log[i][0];
    }
    ++orders[order];
  }
  EXPECT_EQ(orders.size(), 6u) << "every order occurs";
  for (const auto& [order, count] : orders) EXPECT_GT(count, 10) << order << " of 150 blocks";
}

TEST(Lockstep, EveryRepetitionStartsFromFreshInstances) {
  const auto made = std::make_shared<int>(0);
  const auto records = run_lockstep({fake("m", {}, nullptr, made)}, input(5), driver(2, 1, 3), {});
  EXPECT_EQ(*made, 6) << "a global and a local instance in each of three repetitions";
  EXPECT_EQ(records[0].repetitions.size(), 3u);
  EXPECT_EQ(records[0].frames.size(), 5u) << "kept once";
}

TEST(Lockstep, BlocksAndOtherMethodsDoNotChangeResults) {
  const auto alone = run_lockstep({fake("m", {}, nullptr)}, input(20), driver(4, 3, 2, 7), {});
  const auto beside = run_lockstep({fake("x", {false, 0}, nullptr), fake("m", {}, nullptr)}, input(20),
                                   driver(4, 3, 3, 1), {});
  EXPECT_EQ(alone[0].result_hash, beside[1].result_hash);
  EXPECT_EQ(alone[0].work_hash, beside[1].work_hash);
  EXPECT_NE(beside[0].result_hash, beside[1].result_hash) << "the hash sees that the methods differ";
}

TEST(Lockstep, RepetitionThatDiffersIsABug) {
  const auto made = std::make_shared<int>(0);
  const DrivenMethod drifting{"drifting",
                              [=] {
                                ++*made;
                                return std::make_unique<FakeMethod>("d", FakeTraits{}, nullptr,
                                                                    *made > 2 ? 1e-16 : 0.0);
                              },
                              profile()};
  try {
    run_lockstep({drifting}, input(5), driver(2, 1, 2), {});
    FAIL() << "did not notice";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::INTERNAL);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("method drifting: repetition 1"));
  }
}

TEST(Lockstep, KeepsTheLmdSetsThatWereAskedFor) {
  DriverInput wanted = input(6);
  wanted.keep_lmds = [](std::int64_t frame) { return frame == 1 || frame == 4; };
  const auto records = run_lockstep({fake("m", {}, nullptr)}, wanted, driver(2, 2, 2), {});
  ASSERT_EQ(records[0].lmds.size(), 2u);
  EXPECT_TRUE(records[0].lmds.at(1).empty());
  EXPECT_EQ(records[0].lmds.at(4).size(), 2u);
}

TEST(Lockstep, LmdsBeyondTheCutoffStayInTheSetButAreNotReported) {
  DrivenMethod method = fake("m", {}, nullptr);
  method.profile.cutoff = 0.0045;  // distances are 1, 2, 3, ... mm
  const auto records = run_lockstep({method}, input(6), driver(10, 1), {});
  EXPECT_EQ(records[0].frames[3].lmd_count, 2);
  EXPECT_EQ(records[0].frames[4].lmd_count, 0);
  EXPECT_TRUE(std::isnan(records[0].frames[4].minimum_distance));
  EXPECT_EQ(records[0].frames[5].counters[FakeMethod::Counter::TRACKED_LMDS], 2u) << "still tracked";
}

TEST(Lockstep, ClipsToTheDevice) {
  DrivenMethod method = fake("m", {}, nullptr);
  method.profile.maximum_force = 100.0;
  DriverInput scene = input(3);
  const auto records = run_lockstep({method}, scene, driver(10, 0), {});
  EXPECT_TRUE(records[0].frames[0].force_clipped);
  EXPECT_DOUBLE_EQ(records[0].frames[0].force.norm(), scene.device.device().maximum_force.value);
}

TEST(Lockstep, ProgressCountsFramesOfAllMethodsAndStopsTheRun) {
  std::vector<std::int64_t> seen;
  const Progress count = [&](std::int64_t done, std::int64_t total) {
    EXPECT_EQ(total, 20);
    seen.push_back(done);
    return done < 12;
  };
  EXPECT_THROW(
      run_lockstep({fake("a", {}, nullptr), fake("b", {}, nullptr)}, input(5), driver(2, 1, 2, 3), count),
      Interrupted);
  EXPECT_THAT(seen, ElementsAre(3, 6, 8, 10, 13));
}

}  // namespace
}  // namespace lmdbench
