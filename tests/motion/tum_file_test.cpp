// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/motion/tum_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>
#include <support/scratch_directory.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <locale>
#include <random>
#include <sstream>
#include <stdexcept>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Path read_text(const std::string& text) {
  std::istringstream stream(text);
  return read_tum(stream, "some.tum");
}

std::string tum_complaint(const std::string& text) {
  return testing::complaint_of<InputError>([&] { read_text(text); });
}

Path random_path(std::size_t count) {
  std::mt19937_64 generator(17);
  std::normal_distribution<double> normal;
  Path path;
  for (std::size_t i = 0; i < count; ++i) {
    TimedPose timed;
    timed.time = (path.empty() ? -3.0 : path.back().time) + std::abs(normal(generator)) + 1e-9;
    timed.pose.translation = Vec3(normal(generator), 1e-9 * normal(generator), 1e12 * normal(generator));
    timed.pose.rotation =
        Eigen::Quaterniond(normal(generator), normal(generator), normal(generator), normal(generator))
            .normalized();
    path.push_back(timed);
  }
  return path;
}

void expect_same_bits(const Path& a, const Path& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].time, b[i].time);
    EXPECT_EQ(a[i].pose.translation, b[i].pose.translation);
    EXPECT_EQ(a[i].pose.rotation.coeffs(), b[i].pose.rotation.coeffs()) << i;
  }
}

TEST(ReadTum, ReadsColumnsInOrder) {
  const Path path = read_text(
      "# a comment\n"
      "\n"
      "0.5 1 2 3 0.5 -0.5 0.5 0.5\r\n"
      "  +1.25\t-1e-3 .5 2.  1 0 0 0   \n"
      "   # another\n");
  ASSERT_EQ(path.size(), 2u);
  EXPECT_EQ(path[0].time, 0.5);
  EXPECT_EQ(path[0].pose.translation, Vec3(1, 2, 3));
  EXPECT_EQ(path[0].pose.rotation.x(), 0.5);
  EXPECT_EQ(path[0].pose.rotation.y(), -0.5);
  EXPECT_EQ(path[0].pose.rotation.z(), 0.5);
  EXPECT_EQ(path[0].pose.rotation.w(), 0.5);
  EXPECT_EQ(path[1].time, 1.25);
  EXPECT_EQ(path[1].pose.translation, Vec3(-1e-3, 0.5, 2.0));
  EXPECT_EQ(path[1].pose.rotation.x(), 1.0);
}

TEST(ReadTum, RoundTripKeepsEveryBit) {
  const Path path = random_path(500);
  expect_same_bits(read_text(tum_text(path, "two\nlines")), path);
  EXPECT_THAT(tum_text(path, "two\nlines"),
              ::testing::StartsWith("# two\n# lines\n# time x y z qx qy qz qw\n"));
}

TEST(ReadTum, NormalisedQuaternionsKeepTheirBitsAndOthersAreNormalised) {
  const Path path = read_text("0 0 0 0 0.1826 0.3651 0.5477 0.7303\n");  // length off by 2e-5
  EXPECT_NEAR(path[0].pose.rotation.norm(), 1.0, 1e-15);
  expect_same_bits(read_text(tum_text(path)), path);
}

/// Decimal comma and thousands separators as in a German locale, which need not be installed.
class GermanNumbers : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(ReadTum, IsIndependentOfTheLocale) {
  const Path path = random_path(3);
  const std::string before = tum_text(path);
  const std::locale old_locale = std::locale::global(std::locale(std::locale::classic(), new GermanNumbers));
  std::ostringstream probe;
  probe << 1234.5;
  const std::string during = tum_text(path);
  const Path back = read_text(before);
  std::locale::global(old_locale);
  EXPECT_EQ(probe.str(), "1.234,5") << "the test's locale has no effect";
  EXPECT_EQ(during, before);
  expect_same_bits(back, path);
}

TEST(ReadTum, ComplaintsNameFileLineAndRemedy) {
  const std::string good = "0 0 0 0 0 0 0 1\n";
  EXPECT_THAT(tum_complaint(good + "1 0 nan 0 0 0 0 1\n"),
              AllOf(HasSubstr("some.tum: line 2: "), HasSubstr("NaN"), HasSubstr("remedy")));
  EXPECT_THAT(tum_complaint("# c\n\n" + good + "1 0 0 inf 0 0 0 1\n"), HasSubstr("line 4: NaN or infinity"));
  EXPECT_THAT(tum_complaint("nan 0 0 0 0 0 0 1\n"), HasSubstr("line 1: NaN"));
  EXPECT_THAT(tum_complaint(good + "1 0 0 0 0 0 1\n"), HasSubstr("line 2: 7 columns instead of 8"));
  EXPECT_THAT(tum_complaint(good + "1 0 0 0 0 0 0 1 9\n"), HasSubstr("line 2: 9 columns instead of 8"));
  EXPECT_THAT(tum_complaint("0,0,0,0,0,0,0,1\n"), HasSubstr("separated by blanks"));
  EXPECT_THAT(tum_complaint(good + good),
              HasSubstr("line 2: time 0 does not lie after the time before it, 0"));
  EXPECT_THAT(tum_complaint(good + "-1 0 0 0 0 0 0 1\n"), HasSubstr("line 2: time -1 does not lie after"));
  EXPECT_THAT(tum_complaint("0 0 0 0 0 0 0 1.01\n"),
              HasSubstr("line 1: the quaternion's length is 1.01, not 1"));
  EXPECT_THAT(tum_complaint("0 0 0 0 0 0 0 0\n"), HasSubstr("the quaternion's length is 0, not 1"));
  EXPECT_THAT(tum_complaint("0 0 0 0 0 0 0 one\n"), HasSubstr("line 1: 'one' is not a number"));
  EXPECT_THAT(tum_complaint("0 0 0 0,5 0 0 0 1\n"), HasSubstr("line 1: '0,5' is not a number"));
  EXPECT_THAT(tum_complaint("0 0 0 1e999 0 0 0 1\n"), HasSubstr("'1e999' is out of the range"));
  EXPECT_THAT(tum_complaint("# nothing\n"), HasSubstr("some.tum: holds no pose"));
  EXPECT_THAT(tum_complaint(""), HasSubstr("holds no pose"));
}

TEST(ReadTum, AByteOrderMarkIsSkipped) {
  EXPECT_EQ(read_text("\xEF\xBB\xBF"
                      "7 0 0 0 0 0 0 1\n")
                .front()
                .time,
            7.0);
}

TEST(ReadTum, QuaternionToleranceIsOnTheLength) {
  EXPECT_EQ(tum_complaint("0 0 0 0 0 0 0 1.00099\n"), "");
  EXPECT_EQ(tum_complaint("0 0 0 0 0 0 0 0.99901\n"), "");
  EXPECT_NE(tum_complaint("0 0 0 0 0 0 0 1.00101\n"), "");
  EXPECT_NE(tum_complaint("0 0 0 0 0 0 0 0.99899\n"), "");
}

TEST(ReadTum, MissingFileIsNamed) {
  EXPECT_THAT(testing::message_of<InputError>([] { read_tum(std::filesystem::path("no/such/path.tum")); }),
              HasSubstr("no/such/path.tum: cannot read the path"));
}

class WriteTum : public ::testing::Test {
 protected:
  testing::ScratchDirectory folder_;
};

TEST_F(WriteTum, ReplacesAFileAtOnceAndLeavesNoPart) {
  const std::filesystem::path file = folder_ / "a.tum";
  std::ofstream(file) << "old";
  const Path path = random_path(20);
  write_tum(file, path);
  expect_same_bits(read_tum(file), path);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}), 1)
      << "no part is left";
}

TEST_F(WriteTum, RefusesWhatCouldNotBeReadBackAndKeepsTheOldFile) {
  const std::filesystem::path file = folder_ / "a.tum";
  const Path good = random_path(3);
  write_tum(file, good);
  Path backwards = good;
  std::swap(backwards[0].time, backwards[1].time);
  EXPECT_THROW(write_tum(file, backwards), std::invalid_argument);
  Path broken = good;
  broken[1].pose.translation.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_tum(file, broken), std::invalid_argument);
  EXPECT_THROW(write_tum(file, {}), std::invalid_argument);
  expect_same_bits(read_tum(file), good);
}

TEST_F(WriteTum, UnwritablePlaceIsAnEnvironmentError) {
  std::ofstream(folder_ / "file") << "not a folder";
  EXPECT_THROW(write_tum(folder_ / "file" / "a.tum", random_path(1)), EnvironmentError);
}

TEST(TumText, DecimalsAreFixedAndTrailingZerosCut) {
  Path path(1);
  path[0].time = 0.25;
  path[0].pose.translation = Vec3(1.0 / 3.0, -2.0, 0.1);
  EXPECT_THAT(tum_text(path, "", 6), ::testing::EndsWith("\n0.25 0.333333 -2 0.1 0 0 0 1\n"));
}

}  // namespace
}  // namespace lmdbench
