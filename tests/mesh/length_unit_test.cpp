// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/mesh/length_unit.h>

#include <gtest/gtest.h>

#include <utility>

namespace lmdbench {
namespace {

TEST(LengthUnit, NamesAndNumbers) {
  EXPECT_EQ(metres_of_unit("mm", "--unit"), 0.001);
  EXPECT_EQ(metres_of_unit("in", "--unit"), 0.0254);
  EXPECT_EQ(metres_of_unit("0.5", "--unit"), 0.5);
  EXPECT_EQ(metres_of_units("mm", "--unit"), std::pair(0.001, 0.001));
  EXPECT_EQ(metres_of_units("mm,m", "--unit"), std::pair(0.001, 1.0));
}

TEST(LengthUnit, AnythingElseIsAnError) {
  for (const char* text : {"", "mile", "0", "-1", "nan", "inf", "1e999", "mm,", ",mm", "mm,m,m", "1 "})
    EXPECT_THROW(metres_of_units(text, "--unit"), UsageError) << text;
}

TEST(LengthUnit, GltfIsInMetresAndOtherFormatsDoNotSay) {
  EXPECT_EQ(metres_of_format("a.gltf"), 1.0);
  EXPECT_EQ(metres_of_format("folder/A.GLB"), 1.0);
  for (const char* file : {"a.obj", "a.stl", "a.ply", "a.off", "gltf"})
    EXPECT_EQ(metres_of_format(file), std::nullopt);
}

}  // namespace
}  // namespace lmdbench
