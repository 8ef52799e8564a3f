// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <triangles/triangle_families.h>

#include <string>
#include <vector>

namespace lmdbench::testing {

/// Errors are relative to the largest coordinate of the pair.
inline constexpr double WRONG_ERROR = 1e-12;  ///< published bound of our kernels
inline constexpr double GROSS_ERROR = 1e-3;   ///< too large for any rounding

/// Results of one kernel on one family.
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

/// Judges every kernel on the first `pairs` pairs of a family by proved brackets of the true
/// distance and by exact predicates. Errors count from the bracket's far end, so none is too small.
/// Where a kernel promises nearest points, a point off its triangle is an error too.
AccuracyRow judge_family(const TriangleFamily& family, int pairs);

/// The same for every family.
std::vector<AccuracyRow> judge_accuracy(int pairs);

/// Median processor time of a pair [ns] for each kernel, from runs that alternate between kernels.
std::vector<double> time_kernels(const TriangleFamily& family, int pairs, int repetitions);

/// A row of the table of answers in Markdown, the same on every machine.
std::string accuracy_markdown(const AccuracyRow& row);

/// The whole table, with the sum of its rows and the kernels' answers about contact.
std::string accuracy_markdown(const std::vector<AccuracyRow>& rows, int pairs);

/// The published tables, relative to the source tree, and their pairs per family. The short one
/// uses the first pairs of the long one.
inline constexpr const char* PUBLISHED_TABLE = "results/reference/triangle_accuracy.md";
inline constexpr int PUBLISHED_PAIRS = 10000;
inline constexpr const char* MILLION_TABLE = "results/reference/triangle_accuracy_million.md";
inline constexpr int MILLION_PAIRS = 1000000;

}  // namespace lmdbench::testing
