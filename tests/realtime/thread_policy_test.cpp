// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/servo_clock.h>
#include <lmdbench/realtime/thread_policy.h>
#include <lmdbench/realtime/thread_use.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>

#include <cmath>
#include <cstddef>
#include <thread>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;

TEST(ThreadPolicy, ACoreIsGrantedAndKept) {
  const int core = usable_cores().back();
  std::thread([&] {
    const std::vector<Grant> grants = apply({core, 0}, "servo");
    ASSERT_EQ(grants.size(), 1u);
    EXPECT_TRUE(grants[0].granted) << grants[0].reason;
    EXPECT_EQ(usable_cores(), std::vector<int>{core});
    EXPECT_EQ(::sched_getcpu(), core);
  }).join();
  EXPECT_GE(usable_cores().size(), 1u) << "of that thread alone";
}

TEST(ThreadPolicy, WhatIsRefusedSaysWhy) {
  std::thread([] {
    // No machine has this core, and no kernel this priority.
    const std::vector<Grant> grants = apply({1000, 120}, "tracking");
    ASSERT_EQ(grants.size(), 2u);
    for (const Grant& grant : grants) {
      EXPECT_FALSE(grant.granted);
      EXPECT_EQ(grant.thread, "tracking");
      EXPECT_FALSE(grant.reason.empty());
    }
    EXPECT_EQ(grants[0].asked, "core 1000");
    EXPECT_THAT(grants[1].reason, HasSubstr("CAP_SYS_NICE"));
  }).join();
}

TEST(ThreadPolicy, NothingIsAskedOfTheNormalPolicyOnAnyCore) {
  EXPECT_TRUE(apply({}, "scene").empty());
}

TEST(ThreadUse, CountsProcessorTimeAndFaultsOfTheThreadAlone) {
  const ThreadUse before = ThreadUse::now();
  const std::int64_t end = monotonic_ns() + 20'000'000;
  while (monotonic_ns() < end) {
  }
  constexpr std::size_t PAGES = 64, PAGE = 4096;
  void* const fresh =
      ::mmap(nullptr, PAGES * PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(fresh, MAP_FAILED);
  auto* const bytes = static_cast<volatile char*>(fresh);
  for (std::size_t i = 0; i < PAGES; ++i) bytes[i * PAGE] = 1;
  const ThreadUse use = ThreadUse::now() - before;
  ::munmap(fresh, PAGES * PAGE);
  EXPECT_GT(use.processor_ns, 1'000'000);
  EXPECT_LT(use.processor_ns, 1'000'000'000);
  EXPECT_GE(use.minor_faults + use.major_faults, static_cast<std::int64_t>(PAGES) / 2)
      << "the system may bring several at once";
}

TEST(StolenSeconds, IsATimeOrUnknown) {
  const double stolen = stolen_seconds(usable_cores());
  EXPECT_TRUE(std::isnan(stolen) || stolen >= 0.0);
  EXPECT_TRUE(std::isnan(stolen_seconds({100000}))) << "no such core";
}

}  // namespace
}  // namespace lmdbench
