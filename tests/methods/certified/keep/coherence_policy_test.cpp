// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/keep/coherence_policy.h>

#include <gtest/gtest.h>

#include <vector>

namespace lmdbench {
namespace {

constexpr std::size_t KEPT = 1000, MANY = 500, FEW = 100;

/// Number of frames, from now on, in which the policy keeps nothing.
int pause_of(CoherencePolicy& policy) {
  int pause = 0;
  while (!policy.keep()) ++pause;
  return pause;
}

/// Frames with so many repeated tests until the policy pauses; -1 where it does not.
int frames_until_pause(CoherencePolicy& policy, std::size_t repeated, int at_most) {
  for (int frame = 1; frame <= at_most; ++frame) {
    policy.note(repeated, KEPT);
    CoherencePolicy copy = policy;
    if (!copy.keep()) return frame;
  }
  return -1;
}

TEST(CoherencePolicy, KeepsWhereLittleIsRepeated) {
  CoherencePolicy policy;
  for (int frame = 0; frame < 1000; ++frame) {
    EXPECT_TRUE(policy.keep());
    policy.note(FEW, KEPT);
  }
}

TEST(CoherencePolicy, TwoFifthsOfTheTestsAreTheLimit) {
  CoherencePolicy below, above;
  EXPECT_EQ(frames_until_pause(below, 399, 200), -1);
  EXPECT_EQ(frames_until_pause(above, 401, 200), 3) << "not on the strength of one or two frames";
}

TEST(CoherencePolicy, PausesLongerEachTimeUpToALimit) {
  CoherencePolicy policy;
  std::vector<int> pauses;
  for (int i = 0; i < 8; ++i) {
    ASSERT_EQ(frames_until_pause(policy, MANY, 10), 3);
    pauses.push_back(pause_of(policy));
  }
  EXPECT_EQ(pauses, (std::vector<int>{8, 16, 32, 64, 128, 256, 256, 256}));
}

TEST(CoherencePolicy, ForgivesAfterALongQuietTime) {
  CoherencePolicy policy;
  for (int i = 0; i < 4; ++i) {
    frames_until_pause(policy, MANY, 10);
    pause_of(policy);
  }
  for (int frame = 0; frame < 100; ++frame) policy.note(FEW, KEPT);
  ASSERT_GT(frames_until_pause(policy, MANY, 100), 1) << "the quiet frames are remembered for a while";
  EXPECT_EQ(pause_of(policy), 8);
}

TEST(CoherencePolicy, ASingleLoudFrameIsForgotten) {
  CoherencePolicy policy;
  for (int frame = 0; frame < 10; ++frame) policy.note(0, KEPT);
  policy.note(KEPT / 2, KEPT);
  EXPECT_TRUE(policy.keep());
}

}  // namespace
}  // namespace lmdbench
