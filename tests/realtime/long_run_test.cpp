// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/driver.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <realtime/clock_scene.h>

#include <cstdint>
#include <cstdlib>
#include <string>

namespace lmdbench {
namespace {

/// Seconds of each run; far more in the long runs under the thread sanitizer (ctest label "heavy").
double seconds_asked() {
  const char* const text = std::getenv("LMDBENCH_REALTIME_SECONDS");
  return text == nullptr ? 1.0 : std::stod(text);
}

TEST(LongRun, FourThreadsOfTheImprovedMethodHandOverAllAlong) {
  const auto frames = static_cast<std::int64_t>(1000.0 * seconds_asked());
  testing::BlobRun blobs(frames);
  blobs.input.keep_lmds = [](std::int64_t frame) { return frame % 7 == 0; };
  const DrivenMethod improved{"improved",
                              [&] {
                                return make_method("improved", blobs.scene, {{"search_threads", 2}});
                              },
                              ForceProfile{ForceLaw::EXPONENTIAL, 0.1, 0.0, 1.0, 4.0}};
  RealtimeSettings settings = testing::quick();
  settings.predict = true;
  const RealtimeRun run = run_realtime({improved}, blobs.input, settings, {});
  const auto counts = testing::count_frames(run.clocks[0]);
  EXPECT_EQ(counts.ticks + counts.skipped + counts.lost, frames);
  EXPECT_GT(run.records[0].searches.size(), 3u);
  EXPECT_GT(run.clocks[0].roles[2].turns, 3);
}

}  // namespace
}  // namespace lmdbench
