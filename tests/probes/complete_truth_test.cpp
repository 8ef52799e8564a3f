// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/probes/truth_probe.h>

#include <gtest/gtest.h>

namespace lmdbench {
namespace {

MethodRecord labelled(const std::string& label, bool both_laws) {
  MethodRecord record;
  record.label = label;
  record.frames.resize(3);
  record.frames[1].lmd_count = 4;
  if (both_laws)
    for (std::vector<Vec3>& forces : record.force_by_law) forces.assign(3, Vec3::UnitX());
  return record;
}

/// Two probed frames; in the second the method misses so many of five true LMDs.
std::vector<TruthComparison> probed(std::size_t missed) {
  std::vector<TruthComparison> rows(2);
  rows[1].same = {5, 5 - missed, 5 - missed, 5 - missed};
  return rows;
}

TEST(CompleteTruth, IsTheFirstByLabelWhoseSetsStand) {
  const MethodRecord a = labelled("a", true), b = labelled("b", true);
  const auto exact = probed(0), wrong = probed(1);
  const auto found = complete_truth({{&b, &exact}, {&a, &exact}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->label, "a");
  EXPECT_EQ(found->lmd_count, (std::vector<std::int64_t>{0, 4, 0}));
  EXPECT_EQ(found->force[0].size(), 3U);
  EXPECT_EQ(complete_truth({{&a, &wrong}, {&b, &exact}})->label, "b")
      << "the exhaustive set says otherwise of a";
  EXPECT_FALSE(complete_truth({{&a, &wrong}}));
}

TEST(CompleteTruth, NeedsAProbeAndBothLaws) {
  const MethodRecord a = labelled("a", true), without = labelled("b", false);
  const std::vector<TruthComparison> none;
  const auto exact = probed(0);
  EXPECT_FALSE(complete_truth({{&a, &none}}));
  EXPECT_FALSE(complete_truth({{&without, &exact}}));
  EXPECT_FALSE(complete_truth({}));
}

}  // namespace
}  // namespace lmdbench
