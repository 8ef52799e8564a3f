// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/sanitizers.h>
#include <lmdbench/realtime/driver.h>

#include <gtest/gtest.h>
#include <realtime/clock_scene.h>
#include <realtime/counted_calls.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <mutex>

/// The servo loop never allocates, locks or faults; the tests notice such calls when planted.
namespace lmdbench {
namespace {

using testing::clock_method;
using testing::counted_calls;
using testing::quick;
using testing::straight_path;

RealtimeRecord run_counted(const DrivenMethod& method, const DriverInput& input,
                           const RealtimeSettings& settings = quick()) {
  testing::reset_counted_calls();
  return run_realtime({method}, input, settings, {}).clocks.at(0);
}

bool memory_is_locked(const RealtimeRecord& clock) {
  return std::any_of(clock.grants.begin(), clock.grants.end(),
                     [](const Grant& grant) { return grant.asked == "locked memory" && grant.granted; });
}

void expect_clean(const RealtimeRecord& clock) {
  EXPECT_EQ(counted_calls().allocations, 0);
  EXPECT_EQ(counted_calls().locks, 0);
  // Memory that the system refuses to lock may be paged.
  if (!IS_SANITIZED && memory_is_locked(clock)) {
    EXPECT_EQ(clock.servo().use.minor_faults + clock.servo().use.major_faults, 0);
  }
}

TEST(ServoLoop, IsCleanBehindLocalTracking) {
  expect_clean(run_counted(clock_method(true), straight_path(400)));
}

TEST(ServoLoop, IsCleanWithListsToKeep) {
  DriverInput input = straight_path(400);
  input.keep_lmds = [](std::int64_t) { return true; };
  expect_clean(run_counted(clock_method(false), input));
}

TEST(ServoLoop, IsCleanWithCertifiedInIt) {
  const testing::BlobRun blobs(400);
  expect_clean(run_counted(blobs.method("certified"), blobs.input));
}

TEST(ServoLoop, IsCleanWithTheSimulatedDeviceInIt) {
  const testing::BlobRun blobs(400);
  DriverInput input = blobs.input;
  input.loop.closed = true;
  input.loop.dynamics = {0.1, 1.0, 0.05, std::nullopt};
  input.loop.resolution_m = 1e-5;
  input.loop.delay_frames = 1;
  expect_clean(run_counted(blobs.method("improved"), input));
}

TEST(ServoLoop, APlantedAllocationIsSeen) {
  const auto allocates = [] {
    // Through a volatile pointer; otherwise the compiler removes both calls.
    int* volatile memory = new int(1);
    delete memory;
  };
  run_counted(clock_method(false, allocates), straight_path(200));
  EXPECT_GT(counted_calls().allocations, 0);
}

TEST(ServoLoop, APlantedLockIsSeen) {
  if (THREAD_SANITIZER) GTEST_SKIP() << "the thread sanitizer needs the mutexes itself";
  static std::mutex mutex;
  run_counted(clock_method(false, [] { const std::lock_guard lock(mutex); }), straight_path(200));
  EXPECT_GT(counted_calls().locks, 0);
}

TEST(ServoLoop, APlantedPageFaultIsSeen) {
  // A page that is unmapped in every tick faults again in every tick.
  const auto faults = [] {
    constexpr std::size_t PAGE = 4096;
    void* const page = ::mmap(nullptr, PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(page, MAP_FAILED);
    *static_cast<volatile char*>(page) = 1;
    ::munmap(page, PAGE);
  };
  RealtimeSettings settings = quick();
  settings.choice.lock_memory = false;  // locked memory would have the page at once
  const RealtimeRecord clock = run_counted(clock_method(false, faults), straight_path(200), settings);
  EXPECT_GE(clock.servo().use.minor_faults, clock.servo().turns);
}

}  // namespace
}  // namespace lmdbench
