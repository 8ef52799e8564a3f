// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/exact_differences.h>
#include <lmdbench/comparison/experiment_differences.h>

#include "synthetic_result.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/scratch_directory.h>

#include <cmath>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::ScratchDirectory;
using testing::SyntheticResult;

class ExactDifferences : public ::testing::Test {
 protected:
  std::vector<Difference> differences(const SyntheticResult& base, const SyntheticResult& candidate,
                                      const ExactOptions& options = {}) {
    return exact_differences(open(base, "base.h5"), open(candidate, "candidate.h5"), options);
  }
  ResultReader open(const SyntheticResult& result, const std::string& name) {
    return ResultReader(result.write(scratch_ / name));
  }
  ScratchDirectory scratch_;
};

TEST_F(ExactDifferences, SameBitsAndOtherTimesAreNoDifference) {
  SyntheticResult slower;
  slower.process_factor = 3.0;
  EXPECT_THAT(differences({}, slower), IsEmpty());
}

TEST_F(ExactDifferences, LastBitOfAForceIsNamed) {
  SyntheticResult candidate;
  candidate.frame_with_other_force = 7;
  const std::vector<Difference> found = differences({}, candidate);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].method, "original");
  EXPECT_EQ(found[0].dataset, "force");
  EXPECT_EQ(found[0].frame, 7);
  EXPECT_EQ(found[0].rows, 1U);
  EXPECT_EQ(found[0].base[2].get<double>(), 0.1 * 8);
  EXPECT_EQ(found[0].candidate[2].get<double>(), std::nextafter(0.1 * 8, 1.0));
  EXPECT_NE(found[0].base.dump(), found[0].candidate.dump()) << "text must show the last bit";
}

TEST_F(ExactDifferences, ToleranceIsRelativeToTheRow) {
  SyntheticResult candidate;
  candidate.frame_with_other_force = 7;
  ExactOptions options;
  options.tolerance_relative = 1e-15;
  EXPECT_THAT(differences({}, candidate, options), IsEmpty());
  options.tolerance_relative = 1e-17;
  EXPECT_EQ(differences({}, candidate, options).size(), 1U);
}

TEST_F(ExactDifferences, LostLmdIsNamedByFrame) {
  SyntheticResult base, candidate;
  base.lists = candidate.lists = true;
  candidate.frame_with_lost_lmd = 4;
  const std::vector<Difference> found = differences(base, candidate);
  ASSERT_EQ(found.size(), 2U) << "entries behind the lost one are shifted, not different";
  EXPECT_EQ(found[0].dataset, "lmd_count");
  EXPECT_EQ(found[0].frame, 4);
  EXPECT_EQ(found[0].base, 3);
  EXPECT_EQ(found[0].candidate, 2);
  EXPECT_EQ(found[1].dataset, "lmds/frame_offset");
  EXPECT_EQ(found[1].frame, 4);
}

TEST_F(ExactDifferences, PolylinesAreNamedByTheirFrame) {
  SyntheticResult base, candidate;
  base.polylines = candidate.polylines = true;
  EXPECT_THAT(differences(base, candidate), IsEmpty());
  for (const auto& [polyline, frame] : {std::pair{0, 3}, {1, 3}, {2, 6}, {3, 6}}) {
    candidate.other_polyline = polyline;
    const std::vector<Difference> found = differences(base, candidate);
    ASSERT_EQ(found.size(), 4U) << "length and point of two methods";
    for (const Difference& difference : found) EXPECT_EQ(difference.frame, frame) << difference.dataset;
  }
}

TEST_F(ExactDifferences, CountersOfSearchesAreNamedByTheirFrameAndCanBeAllowed) {
  SyntheticResult candidate;
  candidate.search_with_more_work = 1;
  const std::vector<Difference> found = differences({}, candidate);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].dataset, "global_counters/node_pairs");
  EXPECT_EQ(found[0].frame, 5);
  ExactOptions options;
  options.allowed_counters = {"leaf_pairs"};
  EXPECT_EQ(differences({}, candidate, options).size(), 1U);
  options.allowed_counters = {"node_pairs"};
  EXPECT_THAT(differences({}, candidate, options), IsEmpty());
}

TEST_F(ExactDifferences, LossIsADifferenceAndAdditionIsNot) {
  SyntheticResult more, one;
  more.extra_counter = "bounds";
  one.methods = {"original"};
  EXPECT_THAT(differences({}, more), IsEmpty());
  EXPECT_THAT(additions(open({}, "a.h5"), open(more, "b.h5")), ElementsAre("certified/counters/bounds"));
  const std::vector<Difference> counter = differences(more, {});
  ASSERT_EQ(counter.size(), 1U);
  EXPECT_EQ(counter[0].dataset, "counters/bounds");
  EXPECT_EQ(counter[0].candidate, "absent");
  const std::vector<Difference> method = differences({}, one);
  ASSERT_EQ(method.size(), 1U);
  EXPECT_EQ(method[0].method, "certified");
  EXPECT_THAT(additions(open(one, "a.h5"), open({}, "b.h5")), ElementsAre("method certified"));
}

TEST_F(ExactDifferences, WhatARunWasAskedNotToKeepIsNoLoss) {
  SyntheticResult lists, none;
  lists.lists = true;
  EXPECT_FALSE(differences(lists, none).empty());
  none.record = R"({"lmds": false})";
  EXPECT_THAT(differences(lists, none), IsEmpty());
  none.record = R"({"lmds": true, "counters": false})";
  EXPECT_FALSE(differences(lists, none).empty());
}

TEST_F(ExactDifferences, ACounterThatWasAlwaysZeroIsNoLoss) {
  SyntheticResult base;
  base.idle_counter = "cache_hits";
  EXPECT_THAT(differences(base, {}), IsEmpty());
}

TEST_F(ExactDifferences, NumbersOfTheSummaryHaveNoFrame) {
  SyntheticResult candidate;
  candidate.summary = 0.75;
  const std::vector<Difference> found = differences({}, candidate);
  ASSERT_EQ(found.size(), 2U);  // one a method
  EXPECT_EQ(found[0].dataset, "summary/force_error_p99_n");
  EXPECT_EQ(found[0].frame, std::nullopt);
}

TEST_F(ExactDifferences, JumpsAreComparedOverTheSameFrames) {
  SyntheticResult probed, known, other;
  probed.methods = {"original"};
  known.true_jumps = other.true_jumps = 40.0;
  known.truth_of_every_frame = "certified";
  EXPECT_EQ(differences(probed, other).size(), 1U);
  EXPECT_THAT(differences(probed, known), IsEmpty()) << "a method more that knows the truth";
  EXPECT_FALSE(same_true_steps(open(probed, "a.h5"), open(known, "b.h5")));
}

TEST_F(ExactDifferences, OrderOfMethodsDoesNotMatter) {
  SyntheticResult candidate;
  candidate.methods = {"certified", "original"};
  EXPECT_THAT(differences({}, candidate), IsEmpty());
  EXPECT_THAT(experiment_differences(open({}, "a.h5"), open(candidate, "b.h5")), IsEmpty());
}

TEST_F(ExactDifferences, OtherExperimentsAndInputsAreNamed) {
  SyntheticResult force, mesh, more;
  force.cutoff = 0.02;
  mesh.moving_hash = "bb";
  more.repetitions = 4;
  const std::vector<Difference> found = experiment_differences(open({}, "a.h5"), open(force, "b.h5"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].dataset, "/provenance/experiment:/force/cutoff_m");
  EXPECT_EQ(found[0].base, 0.01);
  EXPECT_EQ(found[0].candidate, 0.02);
  const std::vector<Difference> scene = scene_differences(open({}, "a.h5"), open(force, "b.h5"));
  ASSERT_EQ(scene.size(), 1U);
  EXPECT_EQ(scene[0].dataset, "/scene:cutoff_m");
  const std::vector<Difference> input = experiment_differences(open({}, "a.h5"), open(mesh, "b.h5"));
  ASSERT_EQ(input.size(), 1U);
  EXPECT_EQ(input[0].dataset, "/provenance/inputs/sha256:mesh:moving");
  EXPECT_THAT(experiment_differences(open({}, "a.h5"), open(more, "b.h5")), IsEmpty());
}

TEST_F(ExactDifferences, NamesAndPlacesOfMeshFilesAreNoDifference) {
  SyntheticResult base, elsewhere, other, built_in;
  base.mesh = "moving.off";
  base.moving = R"({"mesh":"moving.off"})";
  elsewhere.mesh = "/elsewhere/part.stl";
  elsewhere.moving = R"({"mesh":"/elsewhere/part.stl"})";
  other = elsewhere;
  other.moving_hash = "bb";
  built_in.moving = R"({"mesh":"torus"})";
  const auto count = [&](const SyntheticResult& candidate) {
    return experiment_differences(open(base, "a.h5"), open(candidate, "b.h5")).size();
  };
  EXPECT_EQ(count(elsewhere), 0U);
  EXPECT_EQ(count(other), 1U);
  EXPECT_EQ(count(built_in), 1U) << "no file: its name is the mesh";
}

TEST_F(ExactDifferences, ListsAreComparedEntryByEntry) {
  const auto count = [&](const std::string& base, const std::string& candidate) {
    SyntheticResult a, b;
    a.moving = base;
    b.moving = candidate;
    return experiment_differences(open(a, "a.h5"), open(b, "b.h5")).size();
  };
  EXPECT_EQ(count(R"({"of":[{"a":1},{"a":2}]})", R"({"of":[{"a":1},{"a":2,"new":3}]})"), 0U);
  EXPECT_EQ(count(R"({"of":[{"a":1},{"a":2}]})", R"({"of":[{"a":1},{"a":3}]})"), 1U);
  EXPECT_EQ(count(R"({"of":[{"a":1}]})", R"({"of":[{"a":1},{"a":3}]})"), 1U);
}

TEST_F(ExactDifferences, AMeshThatDeformsIsAnotherThanARigidOne) {
  const auto count = [&](const SyntheticResult& base, const SyntheticResult& candidate) {
    return experiment_differences(open(base, "a.h5"), open(candidate, "b.h5")).size();
  };
  SyntheticResult rigid, bent, bent_more, read, read_elsewhere, read_other;
  rigid.moving = R"({"mesh":"m"})";
  bent.moving = R"({"mesh":"m","deformation":{"generator":"bend","amplitude":1}})";
  bent_more.moving = R"({"mesh":"m","deformation":{"generator":"bend","amplitude":2}})";
  read.moving = R"({"mesh":"m","deformation":{"folder":"a","end":"hold"}})";
  read.vertices_hash = "cc";
  read_elsewhere = read_other = read;
  read_elsewhere.moving = R"({"mesh":"m","deformation":{"folder":"b","end":"hold"}})";
  read_other.vertices_hash = "dd";
  EXPECT_EQ(count(rigid, rigid), 0U);
  EXPECT_EQ(count(rigid, bent), 1U);
  EXPECT_EQ(count(bent, rigid), 1U);
  EXPECT_EQ(count(bent, bent), 0U);
  EXPECT_EQ(count(bent, bent_more), 1U);
  EXPECT_EQ(count(read, rigid), 1U);
  EXPECT_EQ(count(read, read_elsewhere), 0U) << "the files' content is what counts";
  EXPECT_EQ(count(read, read_other), 1U);
}

}  // namespace
}  // namespace lmdbench
