// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/run/run.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;

TEST(ClippingWarning, ManyClippedFramesAreNamed) {
  MethodRecord record;
  record.label = "improved";
  record.frames.resize(100);
  std::vector<bool> in_contact(100, false);
  for (std::size_t i = 0; i < 50; ++i) in_contact[i] = true;
  for (std::size_t i = 0; i < 5; ++i) record.frames[i].force_clipped = true;
  record.frames[99].force_clipped = true;  // out of contact: not counted
  EXPECT_FALSE(clipping_warning(record, in_contact, false).has_value()) << "a tenth";
  record.frames[5].force_clipped = true;
  EXPECT_THAT(clipping_warning(record, in_contact, false)->what,
              HasSubstr("the device clips the force in 12 % of the frames in contact (6 of 50)"));
  EXPECT_THAT(clipping_warning(record, in_contact, true)->what, HasSubstr("maximum_force_n clips"));
  EXPECT_THAT(clipping_warning(record, in_contact, true)->remedy, HasSubstr("/force/clip"));
}

}  // namespace
}  // namespace lmdbench
