// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shapes.h>

#include "support/message_of.h"
#include "support/scratch_directory.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/area_turning_left.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

namespace lmdbench {
namespace {

using testing::message_of;
using testing::ScratchDirectory;

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(OffFileTest, ReadsBackTheSameBits) {
  const ScratchDirectory folder;
  TriangleMesh mesh = make_blob(0.1, 0.03, 2);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300.0, 300.0), mantissa(-1.0, 1.0);
  for (std::size_t i = 0; i < 100; ++i)
    for (int axis = 0; axis < 3; ++axis)
      mesh.vertices[i][axis] = mantissa(random) * std::pow(10.0, exponent(random));
  mesh.vertices[100] = {5e-324, -0.0, std::numeric_limits<double>::max()};
  const auto file = folder.path() / "mesh.off";
  write_off(file, mesh);
  const auto read = read_off(file);
  EXPECT_EQ(read.triangles, mesh.triangles);
  ASSERT_EQ(read.vertices.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(read.vertices[i][axis], mesh.vertices[i][axis]);
      EXPECT_EQ(std::signbit(read.vertices[i][axis]), std::signbit(mesh.vertices[i][axis]));
    }
  }
}

TEST(OffFileTest, ReadsCommentsBlankLinesColoursPolygonsAndWindowsLineEnds) {
  const ScratchDirectory folder;
  const auto file =
      folder.write("mesh.off",
                   "# made by hand\r\nOFF # keyword\r\n\r\n4 3 0\r\n0 0 0 255 0 0\r\n+1 0 0\r\n"
                   "1e0 1. 0\r\n\t0  1 0 \r\n# faces\r\n4 0 1 2 3 0.5 0.5 0.5\r\n2 0 1\r\n3 0 2 1");
  const auto mesh = read_off(file);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  using Corners = std::array<std::int32_t, 3>;
  EXPECT_THAT(mesh.triangles, ::testing::ElementsAre(Corners{0, 1, 2}, Corners{0, 2, 3}, Corners{0, 2, 1}));
}

TEST(OffFileTest, ReadsCountsOnTheKeywordsLine) {
  const ScratchDirectory folder;
  const auto mesh = read_off(folder.write("mesh.off", "OFF 3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(OffFileTest, ReadsVariantsThatHaveMoreColumnsAndNoOthers) {
  const ScratchDirectory folder;
  for (const std::string keyword : {"COFF", "NOFF", "CNOFF", "STOFF"}) {
    const auto mesh = read_off(
        folder.write("a.off", keyword + "\n3 1 0\n0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2\n"));
    EXPECT_EQ(mesh.vertices[1], Vec3(1, 0, 0)) << keyword;
    EXPECT_EQ(mesh.triangles.size(), 1u) << keyword;
  }
  EXPECT_THAT(message_of<InputError>([&] { read_off(folder.write("b.off", "OFF BINARY\n\1\2\3")); }),
              HasSubstr("binary"));
  EXPECT_THAT(message_of<InputError>([&] { read_off(folder.write("c.off", "4OFF\n3 1 0\n")); }),
              HasSubstr("'4OFF'"));
}

/// A U, begun at a corner from which a fan would cover its gap.
TEST(OffFileTest, CutsPolygonsFromACornerThatSeesThemWhole) {
  const std::string arrow = "0 0 0\n4 0 0\n4 4 0\n2 1 0\n";  // A dart whose third corner is inside.
  const std::vector<std::string> faces{"4 0 1 2 3\n", "4 1 2 3 0\n", "4 2 3 0 1\n", "4 3 0 1 2\n"};
  for (const std::string& face : faces) {
    const TriangleMesh mesh = parse_off("OFF\n4 1 0\n" + arrow + face, "dart.off");
    ASSERT_EQ(mesh.triangles.size(), 2u);
    SCOPED_TRACE(face);
    EXPECT_DOUBLE_EQ(testing::area_turning_left(mesh), 6.0);
  }
}

struct BrokenOff {
  std::string name, content, place, problem;
};

class BrokenOffTest : public ::testing::TestWithParam<BrokenOff> {};

TEST_P(BrokenOffTest, IsRefusedWithItsPlaceAndARemedy) {
  const ScratchDirectory folder;
  const std::filesystem::path file = folder.write("broken.off", GetParam().content);
  const std::string message = message_of<InputError>([&] { read_off(file); });
  EXPECT_THAT(message, AllOf(HasSubstr(file.string()), HasSubstr(GetParam().place),
                             HasSubstr(GetParam().problem), HasSubstr("remedy")));
}

const std::string THREE = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";

INSTANTIATE_TEST_SUITE_P(
    Files, BrokenOffTest,
    ::testing::Values(
        BrokenOff{"nan", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "line 4", "vertex 1"},
        BrokenOff{"infinity", "OFF\n3 1 0\n0 0 0\n1 -inf 0\n0 1 0\n3 0 1 2\n", "line 4", "vertex 1"},
        BrokenOff{"too_large", "OFF\n3 1 0\n0 0 0\n1 1e999 0\n0 1 0\n3 0 1 2\n", "line 4", "out of range"},
        BrokenOff{"word", "OFF\n3 1 0\n0 0 0\n1 2,5 0\n0 1 0\n3 0 1 2\n", "line 4", "'2,5' is not a number"},
        BrokenOff{"two_coordinates", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "line 4", "missing"},
        BrokenOff{"index_too_large", THREE + "3 0 1 3\n", "line 6", "face 0 names vertex 3"},
        BrokenOff{"index_negative", THREE + "3 0 1 -2\n", "line 6", "face 0 names vertex -2"},
        BrokenOff{"index_missing", THREE + "3 0 1\n", "line 6", "missing"},
        BrokenOff{"index_fraction", THREE + "3 0 1 1.5\n", "line 6", "'1.5' is not a whole number"},
        BrokenOff{"crossing_sides", "OFF\n5 1 0\n0 0 0\n4 0 0\n1 3 0\n3 3 0\n0 1 0\n5 0 1 2 3 4\n", "line 8",
                  "sides cross"},
        BrokenOff{"no_corners", THREE + "0\n", "line 6", "has 0 corners"},
        BrokenOff{"cut_in_vertices", "OFF\n5 1 0\n0 0 0\n1 0 0\n", "line 4", "after 2 of 5 vertices"},
        BrokenOff{"cut_in_faces", "OFF\n3 4 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "line 6",
                  "after 1 of 4 faces"},
        BrokenOff{"more_faces", THREE + "3 0 1 2\n3 0 2 1\n", "line 7",
                  "goes on behind what its header announces"},
        BrokenOff{"cut_in_header", "OFF\n", "line 1", "ends after its keyword"},
        BrokenOff{"negative_count", "OFF\n-3 1 0\n", "line 2", "negative"},
        BrokenOff{"huge_count", "OFF\n4000000000 1 0\n", "line 2", "too large"}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(OffFileTest, WritesAllOrNothing) {
  const ScratchDirectory folder;
  const std::filesystem::path file = folder.write("mesh.off", "old");
  // The new content does not fit, as on a full disk: SIGXFSZ is ignored, so that write() fails.
  const auto previous_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit previous{};
  getrlimit(RLIMIT_FSIZE, &previous);
  const rlimit small{100, previous.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write_off(file, make_box({1, 1, 1})), EnvironmentError);
  setrlimit(RLIMIT_FSIZE, &previous);
  std::signal(SIGXFSZ, previous_handler);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "no part is left";
  std::ifstream stream(file);
  std::string content;
  stream >> content;
  EXPECT_EQ(content, "old");
}

TEST(OffFileTest, MakesMissingFoldersAndLeavesNoPart) {
  const ScratchDirectory folder;
  write_off(folder.path() / "a" / "b" / "mesh.off", make_box({1, 1, 1}));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a" / "b" / "mesh.off"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path() / "a" / "b"), {}), 1);
}

}  // namespace
}  // namespace lmdbench
