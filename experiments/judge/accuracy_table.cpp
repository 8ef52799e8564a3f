// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <judge/accuracy_table.h>
#include <judge/distance_bracket.h>
#include <judge/distance_kernels.h>
#include <support/timing.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench::testing {
namespace {

constexpr std::uint64_t SEED = 401;
/// Pairs that are held in memory at a time.
constexpr int BLOCK = 4096;

struct Pairs {
  std::vector<Triangle> a, b;

  Pairs(const TriangleFamily& family, Random& random, int count) {
    for (int i = 0; i < count; ++i) {
      const TrianglePair pair = family.generate(random);
      a.push_back(pair.a);
      b.push_back(pair.b);
    }
  }
};

/// Proved facts about a pair.
struct Truth {
  double magnitude = 0.0;
  long double low = 0.0L, high = 0.0L;
  bool touches = false;
};

Truth truth_of(const Triangle& a, const Triangle& b) {
  const double size = magnitude({a, b});
  const DistanceBracket bracket = distance_bracket(a, b);
  if (bracket.low == 0.0L && exactly_touch(a, b)) return {size, 0.0L, 0.0L, true};
  return {size, bracket.low, bracket.high, false};
}

/// Upper bound of the distance of a point from a triangle.
long double off(const Vec3& point, const Triangle& triangle) {
  if (!point.allFinite()) return std::numeric_limits<long double>::infinity();
  return distance_bracket({point, point, point}, triangle).high;
}

long double largest_error(const DistanceAnswer& answer, const Triangle& a, const Triangle& b,
                          const Truth& truth) {
  const long double of_distance =
      std::max(std::abs(answer.distance - truth.low), std::abs(answer.distance - truth.high));
  if (!answer.points) return of_distance;
  const auto& [point_a, point_b] = *answer.points;
  // A corner is on its triangle to the bit; no bracket is needed.
  const auto is_corner = [](const Vec3& p, const Triangle& t) { return p == t[0] || p == t[1] || p == t[2]; };
  const long double off_a = is_corner(point_a, a) ? 0.0L : off(point_a, a);
  const long double off_b = is_corner(point_b, b) ? 0.0L : off(point_b, b);
  const long double between = (point_a - point_b).stableNorm();
  return std::max({of_distance, off_a, off_b, std::abs(answer.distance - between)});
}

void judge(const DistanceAnswer& answer, const Triangle& a, const Triangle& b, const Truth& truth,
           AccuracyCell& cell) {
  const long double absolute = largest_error(answer, a, b, truth);
  // All coordinates of a pair may be 0.
  auto error = absolute == 0.0L ? 0.0 : static_cast<double>(absolute / truth.magnitude);
  if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
  cell.wrong += error > WRONG_ERROR;
  cell.gross += error > GROSS_ERROR;
  cell.false_contacts += answer.touches && truth.low > WRONG_ERROR * truth.magnitude;
  cell.contact_mistakes += answer.touches != truth.touches;
  cell.worst = std::max(cell.worst, error);
}

std::string worst_text(double worst) {
  if (std::isinf(worst)) return "not a number";
  return worst == 0.0 ? "0" : fmt::format("{:.0e}", worst);
}

}  // namespace

AccuracyRow judge_family(const TriangleFamily& family, int pairs) {
  const std::vector<DistanceKernel> kernels = distance_kernels();
  AccuracyRow row{std::string(family.name), std::vector<AccuracyCell>(kernels.size())};
  Random random(SEED);
  std::vector<DistanceAnswer> answers;
  std::vector<Truth> truths;
  for (int begin = 0; begin < pairs; begin += BLOCK) {
    const Pairs list(family, random, std::min(BLOCK, pairs - begin));
    const std::size_t count = list.a.size();
    truths.resize(count);
    for (std::size_t i = 0; i < count; ++i) truths[i] = truth_of(list.a[i], list.b[i]);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
      answers.assign(count, {});
      kernels[k].run(list.a, list.b, answers);
      for (std::size_t i = 0; i < count; ++i)
        judge(answers[i], list.a[i], list.b[i], truths[i], row.cells[k]);
    }
  }
  return row;
}

std::vector<AccuracyRow> judge_accuracy(int pairs) {
  std::vector<AccuracyRow> rows;
  for (const TriangleFamily& family : triangle_families()) rows.push_back(judge_family(family, pairs));
  return rows;
}

std::vector<double> time_kernels(const TriangleFamily& family, int pairs, int repetitions) {
  Random random(SEED);
  const Pairs list(family, random, pairs);
  const std::vector<DistanceKernel> kernels = distance_kernels();
  std::vector<std::vector<double>> times(kernels.size());
  std::vector<DistanceAnswer> answers(list.a.size());
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t k = 0; k < kernels.size(); ++k) {
      const double begin = experiments::thread_seconds();
      kernels[k].run(list.a, list.b, answers);
      times[k].push_back(1e9 * (experiments::thread_seconds() - begin) / pairs);
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& samples : times) {
    std::nth_element(samples.begin(), samples.begin() + repetitions / 2, samples.end());
    medians.push_back(samples[static_cast<std::size_t>(repetitions / 2)]);
  }
  return medians;
}

std::string accuracy_markdown(const AccuracyRow& row) {
  std::string text = fmt::format("| {} |", row.family);
  for (const AccuracyCell& cell : row.cells) {
    const std::string detail =
        cell.wrong == 0 ? "0" : fmt::format("{} ({}, {})", cell.wrong, cell.gross, cell.false_contacts);
    text += fmt::format(" {} | {} |", detail, worst_text(cell.worst));
  }
  return text + "\n";
}

std::string accuracy_markdown(const std::vector<AccuracyRow>& rows, int pairs) {
  const std::vector<DistanceKernel> kernels = distance_kernels();
  std::string text = "| family |";
  std::string rule = "|---|";
  for (const DistanceKernel& kernel : kernels) {
    text += fmt::format(" {0} wrong (gross, false contact) | {0} worst |", kernel.name);
    rule += "---|---|";
  }
  text += "\n" + rule + "\n";
  AccuracyRow total{fmt::format("**all, {} pairs**", pairs * static_cast<int>(rows.size())),
                    std::vector<AccuracyCell>(kernels.size())};
  for (const AccuracyRow& row : rows) {
    text += accuracy_markdown(row);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
      total.cells[k].wrong += row.cells[k].wrong;
      total.cells[k].gross += row.cells[k].gross;
      total.cells[k].false_contacts += row.cells[k].false_contacts;
      total.cells[k].contact_mistakes += row.cells[k].contact_mistakes;
      total.cells[k].worst = std::max(total.cells[k].worst, row.cells[k].worst);
    }
  }
  text += accuracy_markdown(total) +
          "\nWhether the triangles share a point at all (FCL and CGAL: distance 0) was said wrongly";
  for (std::size_t k = 0; k < kernels.size(); ++k) {
    text +=
        fmt::format("{} {} times by {}", k == 0 ? "" : ",", total.cells[k].contact_mistakes, kernels[k].name);
  }
  return text + ".\n";
}

}  // namespace lmdbench::testing
