// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/certified.h>

#include <gtest/gtest.h>
#include <support/noted_allocations.h>
#include <support/scenes.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace {

std::atomic<std::size_t> allocations{0};

}  // namespace

void lmdbench::testing::note_allocation() {
  ++allocations;
}

namespace lmdbench {
namespace {

/// Runs the poses twice and counts allocations of a third round.
std::size_t allocations_after_warm_up(const Scene& scene, bool coherent, const std::vector<Pose>& poses) {
  CertifiedOptions options;
  options.frame_coherence = coherent;
  Certified method(scene, options);
  LmdSet lmds;
  WorkCounters counters;
  std::size_t found = 0;
  // Twice: the way back to the first pose is a jump, after which the tests are in another order.
  for (int round = 0; round < 2; ++round)
    for (const Pose& pose : poses) method.search(pose, lmds, counters);
  const std::size_t before = allocations;
  for (const Pose& pose : poses) {
    method.search(pose, lmds, counters);
    found += lmds.size();
  }
  const std::size_t after = allocations;
  EXPECT_GT(found, poses.size() / 2);
  return after - before;
}

TEST(CertifiedAllocation, NothingIsAllocatedAfterWarmUp) {
  Scene scene = testing::make_scene(make_blob(1.0, 0.3, 4), make_blob(0.9, 0.3, 4), 0.0);
  std::mt19937_64 random(1);
  const Pose middle = testing::grazing_pose(scene, 0.01, random);
  std::vector<Pose> poses;
  for (int frame = 0; frame < 300; ++frame) {
    Pose pose = middle;
    pose.translation += 0.01 * std::sin(0.02 * frame) * middle.translation.unitOrthogonal();
    poses.push_back(pose);
  }
  scene.cutoff = 0.1;
  EXPECT_EQ(allocations_after_warm_up(scene, true, poses), 0u);
  EXPECT_EQ(allocations_after_warm_up(scene, false, poses), 0u);
}

}  // namespace
}  // namespace lmdbench
