// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <judge/accuracy_table.h>
#include <judge/distance_kernels.h>
#include <judge/judges.h>

#include <cstdio>
#include <memory>
#include <vector>

/// lmdbench-judge accuracy [--million]: prints results/reference/triangle_accuracy.md in half a
/// minute; with --million triangle_accuracy_million.md in some minutes.
namespace lmdbench::exact {
namespace {

using namespace lmdbench::testing;

void print_answers(const char* published, const char* remake, const char* owner, int pairs) {
  std::vector<AccuracyRow> rows;
  for (const TriangleFamily& family : triangle_families()) {
    fmt::print(stderr, "{}\n", family.name);
    rows.push_back(judge_family(family, pairs));
  }
  fmt::print(
      "Made by `{} > {}`;\n"
      "the answers are checked by the test `{}`.\n\n"
      "## Answers\n\n"
      "{} pairs a family (experiments/triangles/triangle_families.cpp). FCL 0.7.0 and CGAL 5.5.1\n"
      "(`Simple_cartesian<double>`) as Debian 12 ships them.\n\n"
      "- An error is relative to the pair's largest coordinate; *wrong* is above {:.0e}, *gross* above\n"
      "  {:.0e}, a *false contact* is contact claimed for triangles more than {:.0e} apart. Of ours the\n"
      "  two points are judged as well: how far they are off their triangles counts as error.\n"
      "- Every distance is known to 2e-17: bounded from above by two points of the triangles and from\n"
      "  below by a direction that keeps them apart, with the rounding of both\n"
      "  (experiments/judge/distance_bracket.h), in rational arithmetic where that does not close;\n"
      "  contact is decided by exact predicates.\n\n{}",
      remake, published, owner, pairs, WRONG_ERROR, GROSS_ERROR, WRONG_ERROR, accuracy_markdown(rows, pairs));
}

void print_times() {
  constexpr int TIMED_PAIRS = 10000;
  constexpr int REPETITIONS = 11;
  fmt::print(
      "\n## Times\n\nns of processor time a pair in one run on one machine, median of {} alternating\n"
      "runs over {} pairs. All but CGAL give witness points too.\n\n| family |",
      REPETITIONS, TIMED_PAIRS);
  for (const DistanceKernel& kernel : distance_kernels()) fmt::print(" {} |", kernel.name);
  fmt::print(" FCL / lmdbench |\n|---|---|---|---|---|\n");
  for (const TriangleFamily& family : triangle_families()) {
    const auto times = time_kernels(family, TIMED_PAIRS, REPETITIONS);
    fmt::print("| {} |", family.name);
    for (const double time : times) fmt::print(" {:.0f} |", time);
    fmt::print(" {:.2f} |\n", times[1] / times[0]);
  }
}

int judge_accuracy(bool million) {
  if (million) {
    fmt::print("# How right are triangle distances of three kernels, in a million pairs a family?\n\n");
    print_answers(MILLION_TABLE, "lmdbench-judge accuracy --million", "MillionTable", MILLION_PAIRS);
  } else {
    fmt::print("# How right and how fast are triangle distances of three kernels?\n\n");
    print_answers(PUBLISHED_TABLE, "lmdbench-judge accuracy", "AccuracyTable.IsTheOneThatIsPublished",
                  PUBLISHED_PAIRS);
    print_times();
  }
  return static_cast<int>(ExitCode::DONE);
}

}  // namespace

void add_accuracy(CLI::App& app, Run& chosen) {
  CLI::App* command = app.add_subcommand(
      "accuracy", "Wrong answers, errors and times of triangle distances: ours, FCL's, CGAL's");
  const auto million = std::make_shared<bool>(false);
  command->add_flag("--million", *million, "a million pairs a family, without times");
  command->callback([&chosen, million] { chosen = [million] { return judge_accuracy(*million); }; });
}

}  // namespace lmdbench::exact
