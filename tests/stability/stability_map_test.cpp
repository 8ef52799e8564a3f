// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/stability/stability_map.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/source_directory.h>

#include <cmath>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

const std::string WEDGE = LMDBENCH_SOURCE_DIR "/experiments/stability/wedge.json";
const std::string HARD_ONLY =
    R"(/force=[{"name": "hard", "cutoff_m": 0.001, "saturation_cutoff": 0.1, "maximum_force_n": 1}])";

std::vector<StabilityMapRun> runs(const StabilityMapGrid& grid, std::vector<Override> overrides) {
  overrides.push_back(HARD_ONLY);
  std::vector<StabilityMapRun> result;
  map_stability(load_experiment(WEDGE, overrides), grid, [&](const StabilityMapRun& run) {
    result.push_back(run);
    return true;
  });
  return result;
}

const std::string CERTIFIED = R"(/methods=[{"name": "certified", "force_law": "exponential"}])";

/// A wedge under 1 N, 0.9 mm in the cutoff: 50 N/m carry 0.05 N; 1500 N/m carry it, and it shakes.
TEST(StabilityMap, TellsThroughCleanAndShaking) {
  const auto found = runs({{50.0, 1500.0, 40000.0}, {0}, 2, 900}, {CERTIFIED});
  ASSERT_EQ(found.size(), 6u);
  for (const StabilityMapRun& run : found) {
    EXPECT_LE(run.balance_error, 1e-12);
    EXPECT_EQ(run.method, "certified");
    EXPECT_EQ(run.profile, "hard");
    if (run.stiffness_n_per_m == 50.0) {
      EXPECT_TRUE(run.through());
      EXPECT_EQ(run.clearance_m, 0.0);
    } else if (run.stiffness_n_per_m == 1500.0) {
      EXPECT_TRUE(run.clean());
      EXPECT_NEAR(run.force_mean_n, LOAD_N, 0.15) << "the hand's spring, less what the device has moved";
      EXPECT_GT(run.clearance_m, 1e-4);
      EXPECT_LT(run.amplitude_m, 1e-4);
      EXPECT_EQ(run.jumps, 0);
    } else {
      EXPECT_TRUE(run.shaking());
      EXPECT_GT(run.jumps, 10);
      EXPECT_GT(run.frequency_hz, 10.0);
    }
  }
}

TEST(StabilityMap, SeedsDifferAndARunRepeats) {
  const StabilityMapGrid grid{{1500.0}, {0}, 2, 700};
  const auto first = runs(grid, {CERTIFIED});
  const auto again = runs(grid, {CERTIFIED});
  EXPECT_NE(first[0].amplitude_m, first[1].amplitude_m);
  EXPECT_EQ(stability_map_json("wedge", first[1]), stability_map_json("wedge", again[1]));
}

TEST(StabilityMap, OnlyMethodsThatTrackHaveAges) {
  const auto found = runs(
      {{1500.0}, {0, 20}, 1, 700},
      {R"(/methods=[{"name": "improved", "force_law": "exponential"}, {"name": "certified", "force_law": "exponential"}])"});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].age_frames, 0);
  EXPECT_EQ(found[1].age_frames, 20);
  EXPECT_EQ(found[1].method, "improved");
  EXPECT_EQ(found[2].method, "certified");
}

/// At 50 Hz there is nothing above 30 Hz that could be told.
TEST(StabilityMap, ASlowRateIsRefused) {
  EXPECT_THROW(runs({{50.0}, {0}, 1, 50}, {CERTIFIED, "/frame_rate_hz=50"}), UsageError);
}

/// What stands and what rests as a mover are the same to the held mesh.
TEST(StabilityMap, RestingMoversAreTouched) {
  const StabilityMapGrid grid{{50.0}, {0}, 1, 800};
  const auto standing = runs(grid, {CERTIFIED});
  const auto resting = runs(
      grid, {CERTIFIED, R"(/fixed=[{"mesh": "slab", "pose": {"translation_m": [50, 0, 0]}}])",
             R"(/movers=[{"mesh": "slab", "path": {"way_diagonals": 0, "turn_rad": 0, "period_s": 1}}])"});
  ASSERT_EQ(resting.size(), 1u);
  EXPECT_TRUE(resting[0].through());
  EXPECT_EQ(resting[0].clearance_m, 0.0);
  EXPECT_EQ(resting[0].penetration_share, standing[0].penetration_share);
}

TEST(StabilityMap, StopsWhenAskedAndRefusesWhatCannotShake) {
  int count = 0;
  const auto stop = [&count](const StabilityMapRun&) { return ++count < 2; };
  map_stability(load_experiment(WEDGE, {CERTIFIED, HARD_ONLY}), {{1500.0}, {0}, 9, 700}, stop);
  EXPECT_EQ(count, 2);
  const StabilityMapGrid grid{{1500.0}, {0}, 1, 700};
  const auto refused = [&](const std::vector<Override>& overrides, const StabilityMapGrid& asked) {
    EXPECT_THROW(map_stability(load_experiment(WEDGE, overrides), asked, stop), UsageError);
  };
  refused({"/loop/kind=open"}, grid);
  refused({"/loop/hand=null"}, grid);
  refused({}, {{1500.0}, {0}, 1, 100});
  refused({R"(/force={"cutoff_m": 0.0001, "maximum_force_n": 1})"}, grid);
}

}  // namespace
}  // namespace lmdbench
