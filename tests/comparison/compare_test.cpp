// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/comparison/compare.h>
#include <lmdbench/comparison/comparison_text.h>

#include "synthetic_result.h"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>
#include <support/scratch_directory.h>

#include <filesystem>
#include <utility>

namespace lmdbench {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using testing::ScratchDirectory;
using testing::SyntheticResult;
using Paths = std::vector<std::filesystem::path>;

class Compare : public ::testing::Test {
 protected:
  /// `count` processes with a spread of half a percent.
  Paths side(SyntheticResult result, const std::string& name, int count) {
    Paths paths;
    for (int i = 0; i < count; ++i) {
      result.process_factor = 1.0 + 0.005 * i;
      result.jitter = 1e-9 * static_cast<double>(counter_++);
      paths.push_back(result.write(scratch_ / (name + std::to_string(i) + ".h5")));
    }
    return paths;
  }
  const Timing& timing(const Comparison& comparison, const std::string& method, const std::string& stage) {
    for (const Timing& t : comparison.timings)
      if (t.method == method && t.stage == stage) return t;
    throw std::runtime_error("no timing " + method + "/" + stage);
  }
  ScratchDirectory scratch_;
  int counter_ = 0;
};

std::string refusal(const Paths& base, const Paths& candidate, const CompareOptions& options = {}) {
  return testing::message_of<UsageError>([&] { compare_results(base, candidate, options); });
}

TEST_F(Compare, OneProcessASideIsUnsureOfTimesAndSureOfResults) {
  const Comparison same = compare_results(side({}, "a", 1), side({}, "b", 1), {});
  EXPECT_EQ(same.verdict, Verdict::UNSURE);
  EXPECT_EQ(same.timings.size(), 3U) << "original: search and local update; certified: local update";
  ASSERT_FALSE(same.notes.empty());
  EXPECT_THAT(same.notes.back(), HasSubstr("one process a side cannot judge times"));
  EXPECT_THAT(same.notes.back(), HasSubstr("at least 6 files a side"));
  SyntheticResult slow, changed;
  slow.slowdown = {{"original/search", 8.1}};
  EXPECT_EQ(compare_results(side({}, "a", 1), side(slow, "b", 1), {}).verdict, Verdict::UNSURE);
  changed.frame_with_other_force = 4;
  EXPECT_EQ(compare_results(side({}, "a", 1), side(changed, "b", 1), {}).verdict, Verdict::CHANGED);
}

TEST_F(Compare, AWholeProcessThatIsSlowerShowsNothingAlone) {
  SyntheticResult slow;
  slow.slowdown = {{"original/search", 1.4}, {"original/local update", 1.4}, {"certified/local update", 1.4}};
  EXPECT_EQ(compare_results(side({}, "a", 1), side(slow, "b", 1), {}).verdict, Verdict::UNSURE);
  EXPECT_EQ(compare_results(side({}, "a", 6), side(slow, "b", 1), {}).verdict, Verdict::UNSURE);
  EXPECT_EQ(compare_results(side({}, "a", 6), side(slow, "b", 6), {}).verdict, Verdict::SLOWER);
}

TEST_F(Compare, SlowerNamesTheStageAndItsWork) {
  SyntheticResult slow;
  slow.slowdown["original/search"] = 1.15;
  const Comparison found = compare_results(side({}, "a", 6), side(slow, "b", 6), {});
  EXPECT_EQ(found.verdict, Verdict::SLOWER);
  EXPECT_EQ(timing(found, "original", "search").verdict, Verdict::SLOWER);
  EXPECT_NEAR(timing(found, "original", "search").estimate.ratio, 1.15, 0.01);
  EXPECT_THAT(timing(found, "original", "search").work, HasSubstr("the same work"));
  EXPECT_EQ(timing(found, "original", "local update").verdict, Verdict::SAME);
  EXPECT_EQ(timing(found, "certified", "local update").verdict, Verdict::SAME);
  EXPECT_EQ(compare_results(side(slow, "a", 6), side({}, "b", 6), {}).verdict, Verdict::FASTER);
  CompareOptions lenient;
  lenient.least_effect = 0.3;
  EXPECT_EQ(compare_results(side({}, "a", 6), side(slow, "b", 6), lenient).verdict, Verdict::SAME);
}

TEST_F(Compare, MoreWorkIsNamed) {
  SyntheticResult slow;
  slow.slowdown["original/search"] = 1.15;
  slow.search_with_more_work = 0;
  CompareOptions options;
  options.exact.allowed_counters = {"node_pairs"};
  const Comparison found = compare_results(side({}, "a", 6), side(slow, "b", 6), options);
  EXPECT_EQ(found.verdict, Verdict::SLOWER);
  EXPECT_EQ(timing(found, "original", "search").work, "more work: node_pairs +5 %");
  EXPECT_EQ(compare_results(side({}, "a", 6), side(slow, "b", 6), {}).verdict, Verdict::CHANGED);
}

TEST_F(Compare, StagesShareTheFalseAlarm) {
  // 5 x 5: 1 order in 252, 0.4 %: enough for 1 % alone, too much for 1 % shared by three stages.
  SyntheticResult slow;
  slow.slowdown["original/search"] = 1.15;
  EXPECT_EQ(compare_results(side({}, "a", 5), side(slow, "b", 5), {}).verdict, Verdict::UNSURE);
  CompareOptions thrice;
  thrice.false_alarm = 0.03;
  EXPECT_EQ(compare_results(side({}, "a", 5), side(slow, "b", 5), thrice).verdict, Verdict::SLOWER);
}

TEST_F(Compare, OneStageThatIsSureIsSlowerWhateverTheOthersAre) {
  Paths candidate;
  for (int i = 0; i < 6; ++i) {
    SyntheticResult slow;
    slow.slowdown["original/search"] = 8.0;
    slow.slowdown["certified/local update"] = i % 2 == 0 ? 0.8 : 1.3;
    candidate.push_back(side(slow, "b" + std::to_string(i), 1)[0]);
  }
  const Comparison found = compare_results(side({}, "a", 6), candidate, {});
  EXPECT_EQ(timing(found, "certified", "local update").verdict, Verdict::UNSURE);
  EXPECT_EQ(found.verdict, Verdict::SLOWER);
}

TEST_F(Compare, WhatTheRunsLeftOutIsSaid) {
  SyntheticResult slow, bare;
  slow.slowdown["original/search"] = 1.15;
  slow.counters = bare.counters = false;
  const Comparison found = compare_results(side(bare, "a", 6), side(slow, "b", 6), {});
  EXPECT_EQ(found.verdict, Verdict::SLOWER);
  EXPECT_THAT(timing(found, "original", "search").work, HasSubstr("no counters"));
  bare.times = false;
  const Paths one = {side(bare, "c", 2)[0]}, other = {side(bare, "d", 2)[1]};
  EXPECT_THAT(testing::message_of<InputError>([&] { compare_results(one, other, {}); }),
              HasSubstr("/record/timings"))
      << "without times there is nothing to judge";
}

TEST_F(Compare, ASpikeInOneRepetitionDoesNotCount) {
  SyntheticResult spike;
  spike.spike_frame = 1;
  EXPECT_EQ(compare_results(side({}, "a", 4), side(spike, "b", 4), {}).verdict, Verdict::SAME);
}

TEST_F(Compare, OnlyAsManyRepetitionsAsAllHave) {
  SyntheticResult more;
  more.repetitions = 5;
  EXPECT_EQ(compare_results(side({}, "a", 2), side(more, "b", 2), {}).repetitions, 2U);
  SyntheticResult none;
  none.repetitions = 1;
  EXPECT_THROW(compare_results(side({}, "a", 1), side(none, "b", 1), {}), InputError);
}

TEST_F(Compare, ColdProcessesAreNotComparedWithWarmOnes) {
  SyntheticResult cold;
  cold.repetitions = 1;
  cold.warm_up = 0;
  const Comparison found = compare_results(side({}, "a", 6), side(cold, "b", 6), {});
  EXPECT_EQ(found.verdict, Verdict::UNSURE);
  EXPECT_TRUE(found.timings.empty());
  EXPECT_THAT(found.notes, Contains(HasSubstr("run both with /driver/repetitions of 2 or more")));
  EXPECT_EQ(compare_results(side(cold, "c", 6), side(cold, "d", 6), {}).verdict, Verdict::SAME);
}

TEST_F(Compare, StagesWithoutTimesAreNamed) {
  SyntheticResult search, certified, elsewhere;
  search.lost_times = "original/search";
  certified.lost_times = "certified/local update";
  elsewhere.processor = certified.processor = "processor B";
  const Comparison without = compare_results(side({}, "a", 4), side(search, "b", 4), {});
  EXPECT_EQ(without.timings.size(), 2U);
  EXPECT_THAT(without.notes,
              Contains(HasSubstr("b0.h5 holds no time in /methods/original/global_search_time")));
  Paths with_both = side(search, "f", 1), also_without = side(search, "g", 1);
  with_both.push_back(side({}, "h", 1)[0]);
  EXPECT_THAT(compare_results(with_both, also_without, {}).notes,
              IsSupersetOf({HasSubstr("f0.h5 holds no time"), HasSubstr("g0.h5 holds no time")}));
  Paths others = side(elsewhere, "c", 3);
  others.push_back(side(certified, "d", 1)[0]);
  const Comparison ratios = compare_results(side({}, "e", 4), others, {});
  EXPECT_TRUE(ratios.timings.empty());
  EXPECT_THAT(ratios.notes,
              Contains(HasSubstr("d0.h5 holds no time in /methods/certified/local_update_time")));
}

TEST_F(Compare, AFileOfBothSidesIsNoReplicate) {
  const Paths a = side({}, "a", 2);
  EXPECT_THAT(refusal(a, a), HasSubstr("the same file as"));
  EXPECT_EQ(compare_results({a[0]}, {a[0]}, {}).verdict, Verdict::UNSURE);
}

TEST_F(Compare, OtherProbesAreANote) {
  SyntheticResult often, seldom;
  often.patch = R"({"probes": {"truth": {"stride_frames": 4}}})";
  seldom.patch = R"({"probes": {"truth": {"stride_frames": 8}}})";
  const Comparison found = compare_results(side(often, "a", 6), side(seldom, "b", 6), {});
  EXPECT_EQ(found.verdict, Verdict::SAME);
  EXPECT_THAT(found.notes, Contains(HasSubstr("/probes/truth/stride_frames differs: 4 became 8")));
}

TEST_F(Compare, TheHeadlineSaysWhatWasForgiven) {
  CompareOptions tolerant, lenient;
  tolerant.exact.tolerance_relative = 1e-9;
  lenient.exact.allowed_counters = {"node_pairs"};
  const auto headline = [&](const CompareOptions& options) {
    return comparison_text(compare_results(side({}, "a", 6), side({}, "b", 6), options));
  };
  EXPECT_THAT(headline({}), HasSubstr("same: results are the same bits, and"));
  EXPECT_THAT(headline(tolerant), HasSubstr("same: results agree within the tolerance, and"));
  EXPECT_THAT(headline(lenient),
              HasSubstr("same: results are the same bits but for the allowed counters, and"));
}

TEST_F(Compare, MachinesThatDifferAreComparedByRatios) {
  SyntheticResult other, changed;
  other.processor = changed.processor = "processor B";
  other.slowdown = {
      {"original/search", 3.0}, {"original/local update", 3.0}, {"certified/local update", 3.0}};
  const Comparison slow_machine = compare_results(side({}, "a", 4), side(other, "b", 4), {});
  EXPECT_EQ(slow_machine.verdict, Verdict::SAME);
  EXPECT_FALSE(slow_machine.machine.comparable);
  ASSERT_EQ(slow_machine.machine.reasons.size(), 1U);
  EXPECT_THAT(slow_machine.machine.reasons[0], HasSubstr("'processor A' and 'processor B'"));
  ASSERT_EQ(slow_machine.timings.size(), 1U);
  EXPECT_EQ(slow_machine.timings[0].method, "certified / original");
  SyntheticResult alone, elsewhere;
  alone.methods = elsewhere.methods = {"certified"};
  elsewhere.processor = "processor B";
  const Comparison untimed = compare_results(side(alone, "a", 4), side(elsewhere, "b", 4), {});
  EXPECT_EQ(untimed.verdict, Verdict::UNSURE);
  EXPECT_THAT(untimed.notes, Contains(HasSubstr("no time was compared")));
  changed.slowdown = {{"certified/local update", 1.3}};
  EXPECT_EQ(compare_results(side({}, "a", 5), side(changed, "b", 5), {}).verdict, Verdict::SAME)
      << "less than what a change of machine does";
  for (const auto& [method, slowdown] :
       {std::pair{"certified", 2.0}, {"certified", 0.5}, {"original", 3.0}, {"original", 0.3}}) {
    changed.slowdown = {{fmt::format("{}/search", method), slowdown},
                        {fmt::format("{}/local update", method), slowdown}};
    EXPECT_EQ(compare_results(side({}, "a", 5), side(changed, "b", 5), {}).verdict, Verdict::UNSURE)
        << method << ": no ratio says which of its two methods changed";
  }
}

TEST_F(Compare, ResultsOfOtherFramesAreRefusedInOneLine) {
  SyntheticResult scaled, mesh, methods;
  scaled.moving = R"({"scale": 2})";
  scaled.moving_hash = mesh.moving_hash = "bb";
  scaled.cutoff = 0.02;
  SyntheticResult base;
  base.moving = R"({"scale": 1})";
  const std::string both = refusal(side(base, "a", 1), side(scaled, "b", 1));
  EXPECT_THAT(both, HasSubstr(DIFFERENT_EXPERIMENTS));
  EXPECT_THAT(both, HasSubstr("/moving/scale differs: 1 became 2 (and 1 more)")) << "the cutoff is a setting";
  EXPECT_EQ(both.find('\n'), std::string::npos);
  EXPECT_THAT(refusal(side({}, "c", 1), side(mesh, "d", 1)), HasSubstr("sha256:mesh:moving"));
  methods.methods = {"certified"};
  SyntheticResult original;
  original.methods = {"original"};
  EXPECT_THAT(refusal(side(original, "a", 1), side(methods, "b", 1)), HasSubstr("no method of the base"));
}

/// The scene's force constants follow from the experiment, so the report names their cause once.
TEST_F(Compare, OtherSettingsOnTheSameFramesAreNamedFirstAndTimed) {
  SyntheticResult cutoff;
  cutoff.cutoff = 0.02;
  cutoff.frame_with_other_force = 2;
  cutoff.slowdown["original/search"] = 1.5;
  const Comparison found = compare_results(side({}, "a", 6), side(cutoff, "b", 6), {});
  EXPECT_EQ(found.verdict, Verdict::CHANGED);
  ASSERT_EQ(found.differences.size(), 2U);
  EXPECT_EQ(difference_text(found.differences[0]),
            "/provenance/experiment:/force/cutoff_m differs: 0.01 became 0.02");
  EXPECT_EQ(found.differences[1].dataset, "force");
  EXPECT_EQ(timing(found, "original", "search").verdict, Verdict::SLOWER);
  EXPECT_THAT(found.notes, Contains(HasSubstr("differ in the settings named first")));
}

TEST_F(Compare, AnotherSceneOfOneExperimentIsChangedAndNotTimed) {
  SyntheticResult other;
  other.scene_cutoff = 0.02;
  const Comparison found = compare_results(side({}, "a", 1), side(other, "b", 1), {});
  EXPECT_EQ(found.verdict, Verdict::CHANGED);
  EXPECT_TRUE(found.timings.empty());
}

TEST_F(Compare, ASweepIsNoResultOfARun) {
  SyntheticResult sweep;
  sweep.sweep = true;
  EXPECT_THAT(refusal(side({}, "a", 1), side(sweep, "b", 1)),
              HasSubstr("a sweep of lmdbench work-precision"));
  EXPECT_THAT(refusal(side(sweep, "a", 1), side(sweep, "b", 1)),
              HasSubstr("a sweep of lmdbench work-precision"));
}

TEST_F(Compare, CopiesAndStrangersAreNoReplicates) {
  const Paths a = side({}, "a", 1);
  std::filesystem::copy_file(a[0], scratch_ / "copy.h5");
  EXPECT_THROW(compare_results({a[0], scratch_ / "copy.h5"}, side({}, "b", 1), {}), UsageError);
  SyntheticResult changed;
  changed.frame_with_other_force = 2;
  Paths mixed = side({}, "c", 1);
  mixed.push_back(side(changed, "d", 1)[0]);
  EXPECT_THROW(compare_results(a, mixed, {}), InputError);
}

TEST_F(Compare, UnknownCounterNamesItsNeighbour) {
  CompareOptions options;
  options.exact.allowed_counters = {"node_pair"};
  EXPECT_THAT(refusal(side({}, "a", 1), side({}, "b", 1), options), HasSubstr("node_pairs"));
}

TEST(CompareExitCodes, AreTheContracts) {
  EXPECT_EQ(exit_code(Verdict::SAME), 0);
  EXPECT_EQ(exit_code(Verdict::FASTER), 0);
  EXPECT_EQ(exit_code(Verdict::SLOWER), 1);
  EXPECT_EQ(exit_code(Verdict::CHANGED), 1);
  EXPECT_EQ(exit_code(Verdict::UNSURE), 4);
}

}  // namespace
}  // namespace lmdbench
