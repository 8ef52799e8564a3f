// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/certified.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <random>
#include <vector>

namespace {

std::atomic<std::size_t> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* const memory = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// Replaced for the whole test program: every allocation is counted.
void* operator new(std::size_t size) {
  return counted(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
// The sanitizers bring a form of their own, whose memory our delete must not get.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return counted(size, alignof(std::max_align_t));
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace lmdbench {
namespace {

/// Runs the poses twice and counts what the second round allocates.
std::size_t allocations_after_warm_up(const Scene& scene, bool coherent, const std::vector<Pose>& poses) {
  CertifiedOptions options;
  options.frame_coherence = coherent;
  Certified method(scene, options);
  LmdSet lmds;
  WorkCounters counters;
  std::size_t found = 0;
  // Twice, because the way back to the first pose is a jump, after which the tests are kept in another order.
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
