// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <triangles/triangle_families.h>

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
  int false_contacts = 0;    ///< contact claimed for triangles more than WRONG_ERROR apart
  int contact_mistakes = 0;  ///< contact claimed or denied against exact predicates
  double worst = 0.0;        ///< largest relative error; infinite when the answer was not a number
};

struct AccuracyRow {
  std::string family;
  std::vector<AccuracyCell> cells;  ///< in the order of distance_kernels()
};

/// Judges every kernel on the first `pairs` pairs of a family by proved brackets of the true distance and by
/// exact predicates. An error is counted from the far end of the bracket, so none is too small; where a
/// kernel promises nearest points, the distance of a point from its triangle is an error too.
AccuracyRow judge_family(const TriangleFamily& family, int pairs);

/// The same for every family.
std::vector<AccuracyRow> judge_accuracy(int pairs);

/// Median processor time of a pair [ns] for each kernel, in runs that alternate between the kernels.
std::vector<double> time_kernels(const TriangleFamily& family, int pairs, int repetitions);

/// A row of the table of answers in Markdown. The same on every machine.
std::string accuracy_markdown(const AccuracyRow& row);

/// The whole table, with the sum of its rows and what the kernels said about contact.
std::string accuracy_markdown(const std::vector<AccuracyRow>& rows, int pairs);

/// Where the published tables stand, relative to the source tree, and the pairs a family that they are made
/// of. The short one is judged on the beginning of the long one's pairs.
inline constexpr const char* PUBLISHED_TABLE = "results/reference/triangle_accuracy.md";
inline constexpr int PUBLISHED_PAIRS = 10000;
inline constexpr const char* MILLION_TABLE = "results/reference/triangle_accuracy_million.md";
inline constexpr int MILLION_PAIRS = 1000000;

}  // namespace lmdbench::testing
