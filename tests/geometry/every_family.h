// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <triangles/triangle_families.h>

#include <cctype>
#include <string>

namespace lmdbench::testing {

/// For INSTANTIATE_TEST_SUITE_P: one test per family of triangle pairs.
inline auto every_family() {
  return ::testing::ValuesIn(triangle_families().begin(), triangle_families().end());
}

/// The test's name has the letters and digits of the family's name.
inline std::string family_test_name(const ::testing::TestParamInfo<TriangleFamily>& parameter) {
  std::string name;
  for (const char c : parameter.param.name)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
}

}  // namespace lmdbench::testing
