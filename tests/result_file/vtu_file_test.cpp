// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result_file/vtu_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;

VtuGrid two_lines() {
  VtuGrid grid;
  grid.cell = VtuCell::POLYLINE;
  grid.add({Vec3(0, 0, 0), Vec3(1, 0, 0)});
  grid.add({Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(2, 1, 0.1)});
  return grid;
}

TEST(VtuFile, CellsEndWhereTheirPointsEnd) {
  const std::string text = vtu_text(two_lines());
  EXPECT_THAT(text, HasSubstr("NumberOfPoints=\"5\" NumberOfCells=\"2\""));
  EXPECT_THAT(text,
              HasSubstr("Name=\"connectivity\" NumberOfComponents=\"1\" format=\"ascii\">\n0 1 2 3\n4 "));
  EXPECT_THAT(text, HasSubstr("Name=\"offsets\" NumberOfComponents=\"1\" format=\"ascii\">\n2 5 "));
  EXPECT_THAT(text, HasSubstr("Name=\"types\" NumberOfComponents=\"1\" format=\"ascii\">\n4 4 "));
  EXPECT_THAT(text, HasSubstr("2 1 0.1")) << "the shortest decimals that read back to the same bits";
}

TEST(VtuFile, RefusesWhatTheFormatCannotHold) {
  VtuGrid grid = two_lines();
  grid.cell_data = {{"distance [m]", 1, {1.0}}};
  EXPECT_THROW(vtu_text(grid), std::logic_error) << "one value for two cells";
  grid.cell_data[0].values = {1.0, std::nan("")};
  EXPECT_THROW(vtu_text(grid), std::logic_error);
  grid.cell_data[0].values = {1.0, 2.0};
  EXPECT_THAT(vtu_text(grid), HasSubstr("Name=\"distance [m]\""));
}

TEST(VtuFile, NamesAreEscaped) {
  VtuGrid grid = two_lines();
  grid.cell_data = {{"a<b & \"c\"", 1, {1.0, 2.0}}};
  EXPECT_THAT(vtu_text(grid), HasSubstr("Name=\"a&lt;b &amp; &quot;c&quot;\""));
  EXPECT_THAT(pvd_text({{0.5, "x/1.vtu"}}),
              HasSubstr("<DataSet timestep=\"0.5\" part=\"0\" file=\"x/1.vtu\"/>"));
}

}  // namespace
}  // namespace lmdbench
