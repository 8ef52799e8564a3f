// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "oracle/accuracy_table.h"

#include "geometry/brute_force_distance.h"
#include "oracle/distance_kernels.h"
#include "oracle/exact_distance.h"
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench::testing {
namespace {

constexpr std::uint64_t SEED = 401;
/// Error of the extended precision reference, with room; the oracle's own test checks it.
constexpr double REFERENCE_BOUND = 1e-15;
/// An answer this near the reference is right whatever exact arithmetic would add.
constexpr double AGREEMENT = 0.5 * WRONG_ERROR;

struct Pairs {
  std::vector<Triangle> a, b;

  Pairs(const TriangleFamily& family, int count) {
    Random random(SEED);
    for (int i = 0; i < count; ++i) {
      const TrianglePair pair = family.generate(random);
      a.push_back(pair.a);
      b.push_back(pair.b);
    }
  }
};

double true_distance(const Triangle& a, const Triangle& b, double magnitude,
                     const std::vector<std::vector<double>>& answers, std::size_t pair) {
  const auto reference = static_cast<double>(brute_force_distance(a, b));
  bool in_doubt = reference <= REFERENCE_BOUND * magnitude;
  for (const auto& answer : answers)
    in_doubt |= !(std::abs(answer[pair] - reference) <= AGREEMENT * magnitude);
  return in_doubt ? exact_distance(a, b) : reference;
}

void judge(double answer, double truth, double magnitude, AccuracyCell& cell) {
  double error = std::abs(answer - truth) / magnitude;
  if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
  cell.wrong += error > WRONG_ERROR;
  cell.gross += error > GROSS_ERROR;
  cell.false_contacts += answer == 0.0 && truth > WRONG_ERROR * magnitude;
  cell.worst = std::max(cell.worst, error);
}

/// Processor time of this thread: other processes on the machine do not count.
double thread_nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

std::string worst_text(double worst) {
  if (std::isinf(worst)) return "not a number";
  return worst == 0.0 ? "0" : fmt::format("{:.0e}", worst);
}

}  // namespace

std::vector<AccuracyRow> judge_accuracy(int pairs) {
  const std::vector<DistanceKernel> kernels = distance_kernels();
  std::vector<AccuracyRow> rows;
  for (const TriangleFamily& family : triangle_families()) {
    const Pairs list(family, pairs);
    std::vector<std::vector<double>> answers;
    for (const DistanceKernel& kernel : kernels) {
      answers.emplace_back(list.a.size());
      kernel.run(list.a, list.b, answers.back());
    }
    AccuracyRow row{std::string(family.name), std::vector<AccuracyCell>(kernels.size())};
    for (std::size_t i = 0; i < list.a.size(); ++i) {
      const double size = magnitude({list.a[i], list.b[i]});
      const double truth = true_distance(list.a[i], list.b[i], size, answers, i);
      for (std::size_t k = 0; k < kernels.size(); ++k) judge(answers[k][i], truth, size, row.cells[k]);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<double> time_kernels(const TriangleFamily& family, int pairs, int repetitions) {
  const Pairs list(family, pairs);
  const std::vector<DistanceKernel> kernels = distance_kernels();
  std::vector<std::vector<double>> times(kernels.size());
  std::vector<double> distances(list.a.size());
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t k = 0; k < kernels.size(); ++k) {
      const double begin = thread_nanoseconds();
      kernels[k].run(list.a, list.b, distances);
      times[k].push_back((thread_nanoseconds() - begin) / pairs);
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& samples : times) {
    std::nth_element(samples.begin(), samples.begin() + repetitions / 2, samples.end());
    medians.push_back(samples[static_cast<std::size_t>(repetitions / 2)]);
  }
  return medians;
}

std::string accuracy_markdown(const std::vector<AccuracyRow>& rows, int pairs) {
  std::string text = "| family |";
  std::string rule = "|---|";
  for (const DistanceKernel& kernel : distance_kernels()) {
    text += fmt::format(" {0} wrong (gross, false contact) | {0} worst |", kernel.name);
    rule += "---|---|";
  }
  text += "\n" + rule + "\n";
  std::vector<AccuracyCell> total(distance_kernels().size());
  const auto append = [&text](const std::string& name, const std::vector<AccuracyCell>& cells) {
    text += fmt::format("| {} |", name);
    for (const AccuracyCell& cell : cells) {
      const std::string detail =
          cell.wrong == 0 ? "0" : fmt::format("{} ({}, {})", cell.wrong, cell.gross, cell.false_contacts);
      text += fmt::format(" {} | {} |", detail, worst_text(cell.worst));
    }
    text += "\n";
  };
  for (const AccuracyRow& row : rows) {
    append(row.family, row.cells);
    for (std::size_t k = 0; k < total.size(); ++k) {
      total[k].wrong += row.cells[k].wrong;
      total[k].gross += row.cells[k].gross;
      total[k].false_contacts += row.cells[k].false_contacts;
      total[k].worst = std::max(total[k].worst, row.cells[k].worst);
    }
  }
  append(fmt::format("**all, {} pairs**", pairs * static_cast<int>(rows.size())), total);
  return text;
}

}  // namespace lmdbench::testing
