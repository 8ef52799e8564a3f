// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/triangle_families.h"

#include <string>
#include <vector>

namespace lmdbench::testing {

/// Errors are relative to the largest coordinate of the pair.
inline constexpr double WRONG_ERROR = 1e-12;  ///< the published bound of our kernels
inline constexpr double GROSS_ERROR = 1e-3;   ///< nobody's rounding

/// What one kernel did on one family.
struct AccuracyCell {
  int wrong = 0;
  int gross = 0;
  int false_contacts = 0;  ///< distance 0 for triangles that do not share a point
  double worst = 0.0;      ///< largest relative error; infinite when the answer was not a number
};

struct AccuracyRow {
  std::string family;
  std::vector<AccuracyCell> cells;  ///< in the order of distance_kernels()
};

/// Judges every kernel on `pairs` pairs of each family: exact arithmetic decides wherever a kernel is off or
/// contact is in question, extended precision elsewhere.
std::vector<AccuracyRow> judge_accuracy(int pairs);

/// Median processor time of a pair [ns] for each kernel, in runs that alternate between the kernels.
std::vector<double> time_kernels(const TriangleFamily& family, int pairs, int repetitions);

/// The table of answers in Markdown. The same on every machine.
std::string accuracy_markdown(const std::vector<AccuracyRow>& rows, int pairs);

/// Where the published table stands, relative to the source tree, and the pairs a family that it is made of.
inline constexpr const char* PUBLISHED_TABLE = "tests/oracle/triangle_accuracy.md";
inline constexpr int PUBLISHED_PAIRS = 10000;

}  // namespace lmdbench::testing
