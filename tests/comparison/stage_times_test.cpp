// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/comparison/stage_times.h>
#include <lmdbench/result_file/provenance.h>
#include <lmdbench/result_file/result_writer.h>

#include "synthetic_result.h"
#include <gtest/gtest.h>
#include <support/scratch_directory.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace lmdbench {
namespace {

constexpr double NONE = std::numeric_limits<double>::quiet_NaN();

class StageTimesOf : public ::testing::Test {
 protected:
  /// A method with these search times in four repetitions, the first of which warms up.
  ResultReader file(const std::vector<double>& times) {
    ResultWriter writer(scratch_ / "a.h5");
    writer.attribute("/", "format", RESULT_FORMAT);
    writer.attribute("/", "format_version", std::int64_t{RESULT_FORMAT_VERSION});
    writer.attribute("/methods", "warm_up_repetitions", std::int64_t{1});
    writer.write({"/methods/m/global_search_time", "s", "test data"}, times, {4, times.size() / 4});
    writer.write({"/methods/m/local_update_time", "s", "test data"}, std::vector<double>{9, 1, 1, 1}, {4, 1});
    writer.commit();
    return ResultReader(scratch_ / "a.h5");
  }
  testing::ScratchDirectory scratch_;
};

TEST_F(StageTimesOf, LeastOfTheMeasuredRepetitionsOfEveryFrameSummed) {
  // Each column has its least time in another repetition; the warm-up is faster than all.
  const ResultReader result = file({0.5, 0.5, 0.5,  //
                                    1.0, 9.0, 8.0,  //
                                    7.0, 2.0, 9.0,  //
                                    8.0, 7.0, 4.0});
  EXPECT_EQ(measured_repetitions(result), 3U);
  EXPECT_DOUBLE_EQ(stage_times(result, 3).at("m").at("search"), 1.0 + 2.0 + 4.0);
  EXPECT_DOUBLE_EQ(stage_times(result, 2).at("m").at("search"), 1.0 + 2.0 + 8.0);
  EXPECT_DOUBLE_EQ(stage_times(result, 1).at("m").at("search"), 1.0 + 9.0 + 8.0);
  EXPECT_THROW(stage_times(result, 4), InputError);
}

TEST_F(StageTimesOf, SearchesThatNeverWereAreLeftOut) {
  const ResultReader result = file({NONE, 1, NONE, 3, NONE, 4, NONE, 5});
  EXPECT_DOUBLE_EQ(stage_times(result, 3).at("m").at("search"), 3.0);
  EXPECT_FALSE(stage_times(result, 3).at("m").contains("reduction"));
}

}  // namespace
}  // namespace lmdbench
