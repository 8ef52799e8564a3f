// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <support/lmd_error.h>
#include <support/tests/shapes_setting.h>

#include <cmath>

namespace lmdbench::experiments {
namespace {

class LmdErrorTest : public testing::Test {
 protected:
  LmdErrorTest() : setting_(shapes_setting(0.3, 1)) {}
  LmdError error(Promise promise, const LmdSet* lmds, double minimum) const {
    LmdError result;
    result.add(promise, "here", setting_.scene, setting_.truth[0], lmds, minimum);
    return result;
  }
  const LmdSet& truth() const { return setting_.truth[0]; }

  Setting setting_;
};

TEST_F(LmdErrorTest, AcceptsTheTruth) {
  ASSERT_GE(truth().size(), 1U);
  const LmdError result = error(Promise::COMPLETE_SET, &truth(), truth()[0].distance);
  EXPECT_EQ(result.objection, "");
  EXPECT_EQ(result.same.recall(), 1.0);
  EXPECT_EQ(result.worst_minimum_error, 0.0);
}

TEST_F(LmdErrorTest, ObjectsToAnIncompleteSetWhereCompletenessIsPromised) {
  const LmdSet nothing;
  EXPECT_EQ(error(Promise::COMPLETE_SET, &nothing, NAN).objection, "here: not the true LMD set");
  const LmdError approximate = error(Promise::APPROXIMATION, &nothing, NAN);
  EXPECT_EQ(approximate.objection, "");
  EXPECT_EQ(approximate.same.recall(), 0.0);
  EXPECT_TRUE(std::isinf(approximate.worst_minimum_error));
}

TEST_F(LmdErrorTest, ObjectsToALmdThatIsNone) {
  LmdSet more = truth();
  more.push_back(more[0]);
  more.back().feature_moving.index = more[0].feature_moving.index == 0 ? 1 : 0;
  EXPECT_NE(error(Promise::COMPLETE_SET, &more, truth()[0].distance).objection, "");
}

TEST_F(LmdErrorTest, NobodyMayFindLessThanTheMinimum) {
  const double minimum = truth()[0].distance;
  EXPECT_EQ(error(Promise::APPROXIMATION, nullptr, 0.9 * minimum).objection,
            "here: a minimum distance below the true one");
  EXPECT_NEAR(error(Promise::APPROXIMATION, nullptr, 1.5 * minimum).worst_minimum_error, 0.5, 1e-12);
  EXPECT_EQ(error(Promise::NEAREST_PAIR, nullptr, 1.5 * minimum).objection,
            "here: not the true minimum distance");
}

}  // namespace
}  // namespace lmdbench::experiments
