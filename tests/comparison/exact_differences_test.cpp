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

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;
using testing::ScratchDirectory;
using testing::SyntheticResult;

class ExactDifferences : public ::testing::Test {
 protected:
  std::vector<Difference> differences(const SyntheticResult& base, const SyntheticResult& candidate,
                                      const ExactOptions& options = {}) {
    return exact_differences(open(base, "base.h5"), open(candidate, "candidate.h5"), options);
  }
  std::vector<Difference> settings(const SyntheticResult& base, const SyntheticResult& candidate) {
    return experiment_differences(open(base, "base.h5"), open(candidate, "candidate.h5"));
  }
  /// Of results that differ in one text.
  std::size_t differing_settings(std::string SyntheticResult::*text, const std::string& base,
                                 const std::string& candidate) {
    SyntheticResult a, b;
    a.*text = base;
    b.*text = candidate;
    return settings(a, b).size();
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

TEST_F(ExactDifferences, WhatAllMethodsShareIsCompared) {
  SyntheticResult base;
  base.more = {{"/reference/frame", {0, 4, 8}},
               {"/reference/lmd_count", {1, 2, 3}},
               {"/reference/movers/lmd_count", {1, 2, 3}},
               {"/crosscheck/fcl/frame", {0, 5}},
               {"/crosscheck/fcl/agrees", {1, 1}},
               {"/polylines/frame", {3, 6}},
               {"/polylines/frame_offset", {0, 1, 2}},
               {"/polylines/closed", {1, 1}},
               {"/summary/frames_in_contact", {7}},
               {"/scene/in_contact", {0, 0, 0, 1, 1, 1, 1, 1, 1, 1}},
               {"/scene/warnings", {1, 2}},
               {"/scene/fixed_0/position", {0, 0, 0, 1, 1, 1, 1, 1, 1, 1}},
               {"/scene/moving/deformation/moved_vertices", {0, 0, 0, 1, 1, 1, 1, 1, 1, 1}}};
  const auto found = [&](const SyntheticResult& candidate) {
    std::vector<Difference> all = differences(base, candidate);
    for (Difference& d : scene_differences(open(base, "a.h5"), open(candidate, "b.h5"))) all.push_back(d);
    return all;
  };
  EXPECT_THAT(found(base), IsEmpty());
  const std::map<std::string, std::optional<std::int64_t>> frames = {
      {"/reference/lmd_count", 8},   {"/reference/movers/lmd_count", 8},
      {"/crosscheck/fcl/agrees", 5}, {"/polylines/closed", 6},
      {"/scene/in_contact", 9},      {"/scene/moving/deformation/moved_vertices", 9}};
  for (const auto& [path, values] : base.more) {
    SyntheticResult other = base, lost = base;
    ++other.more[path].back();
    lost.more.erase(path);
    if (path == "/scene/warnings") {
      EXPECT_THAT(found(other), IsEmpty()) << "notes for people";
      continue;
    }
    const std::vector<Difference> changed = found(other);
    ASSERT_FALSE(changed.empty()) << path;
    EXPECT_EQ(changed.front().dataset, path);
    const auto frame = frames.find(path);
    if (frame != frames.end()) {
      EXPECT_EQ(changed.front().frame, frame->second) << path;
    }
    if (path == "/scene/fixed_0/position") {
      EXPECT_EQ(changed.front().frame, std::nullopt) << "a row an instance";
      EXPECT_EQ(found(lost).front().dataset, "/scene/fixed_0");
    } else {
      EXPECT_FALSE(found(lost).empty()) << path;
    }
  }
  const std::vector<Difference> all = differences(base, {});
  for (const char* group : {"/reference", "/crosscheck/fcl", "/polylines"})
    EXPECT_THAT(all, Contains(Field(&Difference::dataset, group)));
  EXPECT_THAT(additions(open({}, "a.h5"), open(base, "b.h5")), Contains("/polylines"));
}

TEST_F(ExactDifferences, RowsOfOneFrameAreCompared) {
  SyntheticResult base, candidate;
  base.more = {{"/reference/frame", {0, 4, 8}}, {"/reference/lmd_count", {1, 2, 3}}};
  candidate.more = {{"/reference/frame", {0, 2, 4, 6, 8}}, {"/reference/lmd_count", {1, 9, 2, 9, 4}}};
  std::vector<Difference> found = differences(base, candidate);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].dataset, "/reference/frame");
  EXPECT_EQ(found[0].frame, 2) << "that one side alone has";
  EXPECT_EQ(found[0].base, "absent");
  EXPECT_EQ(found[0].rows, 2U);
  EXPECT_EQ(found[1].dataset, "/reference/lmd_count");
  EXPECT_EQ(found[1].frame, 8);
  EXPECT_EQ(found[1].base, 3);
  EXPECT_EQ(found[1].candidate, 4);
  EXPECT_EQ(found[1].rows, 1U);
  base.patch = R"({"probes": {"truth": {"stride_frames": 4}}})";
  candidate.patch = R"({"probes": {"truth": {"stride_frames": 2}}})";
  found = differences(base, candidate);
  ASSERT_EQ(found.size(), 1U) << "it was asked for other frames";
  EXPECT_EQ(found[0].dataset, "/reference/lmd_count");
  base.more = {{"/methods/m/global_frame", {0, 4, 8}}, {"/methods/m/candidates", {1, 2, 3}}};
  candidate.more = {{"/methods/m/global_frame", {0, 8}}, {"/methods/m/candidates", {1, 4}}};
  found = differences(base, candidate);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].dataset, "global_frame");
  EXPECT_EQ(found[0].frame, 4);
  EXPECT_EQ(found[1].dataset, "candidates");
  EXPECT_EQ(found[1].frame, 8);
}

TEST_F(ExactDifferences, WhatWasNotProbedIsNoLossAndNamed) {
  SyntheticResult base, off, other_summary;
  base.patch = R"({"probes": {"truth": {"stride_frames": 4}}, "record": {"frames": true}})";
  base.more = {{"/reference/frame", {0, 4, 8}},
               {"/methods/certified/truth/frame", {0, 4, 8}},
               {"/methods/certified/lmd_age", {1}}};
  other_summary = base;
  off.patch = R"({"probes": {"truth": {"stride_frames": 0}}, "record": {"frames": false}})";
  off.summary = other_summary.summary = 0.75;  // errors of the force in probed frames
  EXPECT_THAT(differences(base, off), IsEmpty());
  EXPECT_THAT(additions(open(off, "a.h5"), open(base, "b.h5")), IsEmpty());
  EXPECT_EQ(differences(base, other_summary).size(), 2U);
  const std::vector<Difference> kept = kept_differences(open(base, "a.h5"), open(off, "b.h5"));
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].dataset, "/provenance/experiment:/probes/truth/stride_frames");
  EXPECT_EQ(kept[1].dataset, "/provenance/experiment:/record/frames");
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
  EXPECT_THAT(settings({}, candidate), IsEmpty());
}

/// In a closed loop the number of true LMDs is that of the first method's own way.
TEST_F(ExactDifferences, TrueLmdsOfAnotherFirstMethodAreNotCompared) {
  SyntheticResult base, other, reversed;
  base.methods = other.methods = {"certified", "nearest"};
  reversed.methods = {"nearest", "certified"};
  base.more = {{"/summary/true_lmd_count_median", {2}}};
  other.more = reversed.more = {{"/summary/true_lmd_count_median", {1}}};
  EXPECT_EQ(differences(base, other).size(), 1U);
  EXPECT_THAT(differences(base, reversed), IsEmpty());
}

/// What a run is asked to keep to changes none of its numbers.
TEST_F(ExactDifferences, LimitsAreNoSetting) {
  SyntheticResult limited;
  limited.patch = R"({"limits": {"late_frames": 5}})";
  EXPECT_THAT(settings({}, limited), IsEmpty());
}

TEST_F(ExactDifferences, OtherExperimentsAndInputsAreNamed) {
  SyntheticResult force, mesh, more;
  force.cutoff = 0.02;
  mesh.moving_hash = "bb";
  more.repetitions = 4;
  const std::vector<Difference> found = settings({}, force);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].dataset, "/provenance/experiment:/force/cutoff_m");
  EXPECT_EQ(found[0].base, 0.01);
  EXPECT_EQ(found[0].candidate, 0.02);
  const std::vector<Difference> scene = scene_differences(open({}, "a.h5"), open(force, "b.h5"));
  ASSERT_EQ(scene.size(), 1U);
  EXPECT_EQ(scene[0].dataset, "/scene:cutoff_m");
  const std::vector<Difference> input = settings({}, mesh);
  ASSERT_EQ(input.size(), 1U);
  EXPECT_EQ(input[0].dataset, "/provenance/inputs/sha256:mesh:moving");
  EXPECT_THAT(settings({}, more), IsEmpty());
}

TEST_F(ExactDifferences, SettingsOfOneSideAloneAreNamedWhereTheyHaveNoDefault) {
  const auto found = [&](const std::string& patch) {
    SyntheticResult other;
    other.patch = patch;
    return settings({}, other);
  };
  const std::vector<Difference> frames = found(R"({"frames": 5})");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].dataset, "/provenance/experiment:/frames");
  EXPECT_EQ(frames[0].base, 10) << "all of the path";
  EXPECT_TRUE(is_of_frames(frames[0]));
  EXPECT_THAT(found(R"({"frames": 10})"), IsEmpty());
  const std::vector<Difference> cutoff = found(R"({"force": {"cutoff_m": null, "cutoff_diagonal": 0.1}})");
  ASSERT_EQ(cutoff.size(), 2U);
  EXPECT_EQ(cutoff[0].candidate, "absent");
  EXPECT_EQ(cutoff[1].base, "absent");
  EXPECT_FALSE(is_of_frames(cutoff[0]));
  EXPECT_THAT(found(R"({"force": {"clip": "device"}})"), IsEmpty()) << "a default of another version";
}

TEST_F(ExactDifferences, BlocksOfFramesAreASetting) {
  EXPECT_EQ(differing_settings(&SyntheticResult::patch, R"({"driver": {"block_frames": 10}})",
                               R"({"driver": {"block_frames": 100}})"),
            1U);
}

TEST_F(ExactDifferences, BothFormsOfASceneAreOne) {
  const auto count = [&](const std::string& base, const std::string& candidate) {
    return differing_settings(&SyntheticResult::patch, base, candidate);
  };
  const std::string by_kind =
      R"({"moving": {"mesh": "m"}, "fixed": [{"mesh": "f", "pose": 1}], "path": {"file": "p", "gap": 1},
          "movers": [{"mesh": "g", "pose": 2, "path": {"way_diagonals": 0.5, "gap": 1}}]})";
  const auto objects = [](const std::string& name, const std::string& pose) {
    return R"({"moving": null, "path": null, "objects": [{"name": ")" + name +
           R"(", "mesh": "m", "pose": 0, "motion": {"path": "q", "gap": 1}},
               {"mesh": "g", "pose": 2, "motion": {"sway": {"way_diagonals": 0.5}, "gap": 1}},
               {"name": "table", "mesh": "f", "pose": )" +
           pose + "}]}";
  };
  EXPECT_EQ(count(by_kind, objects("peg", "1")), 0U);
  EXPECT_EQ(count(objects("pin", "1"), objects("peg", "1")), 0U);
  EXPECT_EQ(count(by_kind, objects("peg", "3")), 1U);
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
  const auto count = [&](const SyntheticResult& candidate) { return settings(base, candidate).size(); };
  EXPECT_EQ(count(elsewhere), 0U);
  EXPECT_EQ(count(other), 1U);
  EXPECT_EQ(count(built_in), 1U) << "no file: its name is the mesh";
}

TEST_F(ExactDifferences, ListsAreComparedEntryByEntry) {
  const auto count = [&](const std::string& base, const std::string& candidate) {
    return differing_settings(&SyntheticResult::moving, base, candidate);
  };
  EXPECT_EQ(count(R"({"of":[{"a":1},{"a":2}]})", R"({"of":[{"a":1},{"a":2,"new":3}]})"), 0U);
  EXPECT_EQ(count(R"({"of":[{"a":1},{"a":2}]})", R"({"of":[{"a":1},{"a":3}]})"), 1U);
  EXPECT_EQ(count(R"({"of":[{"a":1}]})", R"({"of":[{"a":1},{"a":3}]})"), 1U);
}

TEST_F(ExactDifferences, AMeshThatDeformsIsAnotherThanARigidOne) {
  const auto count = [&](const SyntheticResult& base, const SyntheticResult& candidate) {
    return settings(base, candidate).size();
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
