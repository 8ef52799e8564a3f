// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance_batch.h>

#include "oracle/accuracy_table.h"
#include "oracle/distance_kernels.h"
#include <fmt/format.h>

#include <cstdio>

/// Prints tests/oracle/triangle_accuracy.md. Takes no arguments; about a minute.
int main() {
  using namespace lmdbench::testing;
  constexpr int TIMED_PAIRS = 2000;
  constexpr int REPETITIONS = 11;
  fmt::print(
      "# Triangle distances: answers and times of four kernels\n\n"
      "Made by `lmdbench_triangle_accuracy > {}`; the answers are checked by the test\n"
      "`AccuracyTable.IsTheOneThatIsPublished`, the times are those of one run on one machine.\n\n"
      "## Answers\n\n"
      "{} pairs a family (tests/geometry/triangle_families.cpp). An error is relative to the pair's largest\n"
      "coordinate; *wrong* is above {:.0e}, *gross* above {:.0e}, a *false contact* is distance 0 for "
      "triangles "
      "that\ndo not touch. Exact arithmetic arbitrates. FCL 0.7.0 and CGAL 5.5.1 "
      "(`Simple_cartesian<double>`) "
      "as\nDebian 12 ships them.\n\n{}\n",
      PUBLISHED_TABLE, PUBLISHED_PAIRS, WRONG_ERROR, GROSS_ERROR,
      accuracy_markdown(judge_accuracy(PUBLISHED_PAIRS), PUBLISHED_PAIRS));
  fmt::print(
      "## Times\n\nns of processor time a pair, median of {} alternating runs over {} pairs; batch in {}. "
      "All but CGAL give "
      "witness points too.\n\n| family |",
      REPETITIONS, TIMED_PAIRS, lmdbench::triangle_distance_batch_target());
  for (const DistanceKernel& kernel : distance_kernels()) fmt::print(" {} |", kernel.name);
  fmt::print(" FCL / lmdbench | FCL / batch |\n|---|---|---|---|---|---|---|\n");
  for (const TriangleFamily& family : triangle_families()) {
    const auto times = time_kernels(family, TIMED_PAIRS, REPETITIONS);
    fmt::print("| {} |", family.name);
    for (const double time : times) fmt::print(" {:.0f} |", time);
    fmt::print(" {:.2f} | {:.2f} |\n", times[2] / times[0], times[2] / times[1]);
  }
}
