// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/rank_test.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace lmdbench {
namespace {

/// Share of all assignments of the pooled values to "candidate" whose agreement is at least (at most) the observed one:
/// the definition, by enumeration.
struct Enumerated {
  double larger = 0.0;
  double smaller = 0.0;
  double agreement = 0.0;
};

double agreement_of(const std::vector<double>& base, const std::vector<double>& candidate) {
  double count = 0.0;
  for (const double b : base)
    for (const double c : candidate) count += c > b ? 1.0 : c == b ? 0.5 : 0.0;
  return count / (static_cast<double>(base.size()) * static_cast<double>(candidate.size()));
}

Enumerated enumerate(const std::vector<double>& base, const std::vector<double>& candidate) {
  std::vector<double> pooled = base;
  pooled.insert(pooled.end(), candidate.begin(), candidate.end());
  Enumerated result;
  result.agreement = agreement_of(base, candidate);
  double all = 0.0;
  for (unsigned mask = 0; mask < 1U << pooled.size(); ++mask) {
    std::vector<double> b, c;
    for (std::size_t i = 0; i < pooled.size(); ++i) ((mask >> i) & 1U ? c : b).push_back(pooled[i]);
    if (c.size() != candidate.size()) continue;
    const double agreement = agreement_of(b, c);
    all += 1.0;
    result.larger += agreement >= result.agreement - 1e-12 ? 1.0 : 0.0;
    result.smaller += agreement <= result.agreement + 1e-12 ? 1.0 : 0.0;
  }
  result.larger /= all;
  result.smaller /= all;
  return result;
}

TEST(RankTest, FullSeparationHasTheProbabilityOfOneAssignment) {
  const RankTest three = rank_test(std::vector<double>{1, 2, 3}, std::vector<double>{4, 5, 6});
  EXPECT_DOUBLE_EQ(three.p_larger, 1.0 / 20.0);
  EXPECT_DOUBLE_EQ(three.p_smaller, 1.0);
  EXPECT_DOUBLE_EQ(three.agreement, 1.0);
  const RankTest down = rank_test(std::vector<double>{4, 5, 6, 7}, std::vector<double>{1, 2, 3});
  EXPECT_DOUBLE_EQ(down.p_smaller, 1.0 / 35.0);
  EXPECT_DOUBLE_EQ(down.agreement, 0.0);
}

TEST(RankTest, PublishedTable) {
  // Critical value of U for n = 8 and m = 8 at 0.025 one-sided is 13 (Mann and Whitney 1947): P(U <= 13) < 0.025 < P(U <= 14).
  std::vector<double> base, candidate;
  for (int i = 0; i < 8; ++i) base.push_back(i);
  const auto p_of_u = [&](int u) {
    candidate.assign(8, -1.0);
    for (int i = 0; i < 8; ++i) candidate[static_cast<std::size_t>(i)] -= i;  // below all, U = 0
    for (std::size_t i = 0; u > 0; ++i) {
      const int step = std::min(u, 8);
      candidate[i] = step - 0.5 + 0.001 * static_cast<double>(i);
      u -= step;
    }
    return rank_test(base, candidate).p_smaller;
  };
  EXPECT_LT(p_of_u(13), 0.025);
  EXPECT_GT(p_of_u(14), 0.025);
}

TEST(RankTest, AgreesWithEnumerationAlsoForTies) {
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) {
    std::vector<double> base(1 + random() % 5), candidate(1 + random() % 5);
    for (double& value : base) value = static_cast<double>(random() % 4);
    for (double& value : candidate) value = static_cast<double>(random() % 5);
    const Enumerated expected = enumerate(base, candidate);
    const RankTest found = rank_test(base, candidate);
    EXPECT_NEAR(found.p_larger, expected.larger, 1e-12);
    EXPECT_NEAR(found.p_smaller, expected.smaller, 1e-12);
    EXPECT_NEAR(found.agreement, expected.agreement, 1e-12);
  }
}

TEST(RankTest, ManyValuesStayProbabilities) {
  std::vector<double> base, candidate;
  for (int i = 0; i < 60; ++i) {
    base.push_back(i);
    candidate.push_back(i + 0.5);
  }
  const RankTest test = rank_test(base, candidate);
  EXPECT_GT(test.p_larger, 0.3);
  EXPECT_LT(test.p_larger, 0.7);
  EXPECT_GT(test.p_larger + test.p_smaller, 1.0);
}

}  // namespace
}  // namespace lmdbench
