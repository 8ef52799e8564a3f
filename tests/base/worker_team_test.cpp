// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/worker_team.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <vector>

namespace lmdbench {
namespace {

TEST(WorkerTeam, EveryMemberDoesEveryJobOnceBeforeRunReturns) {
  for (const std::size_t members : {std::size_t{1}, std::size_t{2}, std::size_t{5}}) {
    WorkerTeam team(members);
    EXPECT_EQ(team.size(), members);
    std::vector<int> done(members);
    for (int job = 1; job <= 200; ++job) {
      team.run([&](std::size_t member) { ++done[member]; });
      EXPECT_EQ(done, std::vector<int>(members, job));
    }
  }
}

TEST(WorkerTeam, MembersShareWork) {
  WorkerTeam team(3);
  std::atomic<std::size_t> next{0};
  std::vector<int> taken(1000);
  team.run([&](std::size_t) {
    for (std::size_t i = next++; i < taken.size(); i = next++) ++taken[i];
  });
  EXPECT_EQ(taken, std::vector<int>(1000, 1));
}

TEST(WorkerTeam, ATeamWithoutAJobEnds) {
  const WorkerTeam idle(4);
}

}  // namespace
}  // namespace lmdbench
