// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <triangles/triangle_families.h>

#include <cctype>
#include <string>

namespace lmdbench::testing {

/// For INSTANTIATE_TEST_SUITE_P: a test a family of triangle pairs.
inline auto every_family() {
  return ::testing::ValuesIn(triangle_families().begin(), triangle_families().end());
}

/// Name of a family's test: its letters and digits.
inline std::string family_test_name(const ::testing::TestParamInfo<TriangleFamily>& parameter) {
  std::string name;
  for (const char c : parameter.param.name)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
}

}  // namespace lmdbench::testing
