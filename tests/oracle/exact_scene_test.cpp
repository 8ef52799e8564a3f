// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "oracle/exact_scene.h"

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/experiment/prepare.h>
#include <lmdbench/lmd/registry.h>
#include <lmdbench/mesh/shapes.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using exact::compare_with_exact;
using exact::ExactAgreement;
using exact::ExactLmd;
using testing::make_scene;

Pose moved(double x, double y, double z) {
  return {{x, y, z}, Eigen::Quaterniond::Identity()};
}

TEST(ExactLmds, ACornerOverAFaceIsOneVertexFacePair) {
  const Scene scene = make_scene(make_wedge(0.1, 0.1, 0.1), make_box({1, 1, 1}), 0.05);
  // A vertex of the box's upper side lies far away; the wedge stands on its edge, turned upside down and
  // tilted, so that one end of the edge is lowest.
  Pose pose;
  pose.rotation = Eigen::AngleAxisd(0.2, Vec3::UnitX()) * Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY());
  pose.translation = {0.21, 0.07, 0.58};
  const std::vector<ExactLmd> lmds = exact::exact_lmds(scene, pose);
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_EQ(lmds[0].feature_moving.kind, FeatureKind::VERTEX);
  EXPECT_EQ(lmds[0].feature_fixed.kind, FeatureKind::FACE);
  EXPECT_TRUE(lmds[0].certain);
}

TEST(ExactLmds, ParallelFacesGiveTheCornersOfTheirOverlap) {
  // All numbers are exact in binary; the overlap is a rectangle with four corners: two vertices on a face
  // from each box or crossings of edges, and the crossings with the diagonals of the two sides.
  const Scene scene = make_scene(make_box({1, 1, 1}), make_box({1, 1, 1}), 0.5);
  const std::vector<ExactLmd> lmds = exact::exact_lmds(scene, moved(0.25, 0.5, 1.125));
  ASSERT_GE(lmds.size(), 4u);
  for (const ExactLmd& lmd : lmds) EXPECT_EQ(lmd.distance, 0.125) << describe(lmd);
}

TEST(ExactLmds, InsideAndOutsideAreToldApart) {
  // A small box inside a large one: nearest points exist, but never on the outer side.
  const Scene scene = make_scene(make_box({0.5, 0.5, 0.5}), make_box({1, 1, 1}), 1.0);
  EXPECT_TRUE(exact::exact_lmds(scene, moved(0.1, 0.05, 0.02)).empty());
}

TEST(ExactLmds, TheComparisonSeesWhatIsMissingAndWhatIsUntrue) {
  const Scene scene = make_scene(make_box({1, 1, 1}), make_box({1, 1, 1}), 0.5);
  const Pose pose = moved(1.1, 1.2, 1.3);
  const std::vector<ExactLmd> truth = exact::exact_lmds(scene, pose);
  LmdSet found;
  WorkCounters counters;
  make_method("exhaustive", scene)->search(pose, found, counters);
  ASSERT_EQ(truth.size(), 1u);
  EXPECT_EQ(compare_with_exact(found, truth).same_features, 1);
  EXPECT_EQ(compare_with_exact({}, truth).missed.size(), 1u);
  found[0].feature_fixed.index += 1;
  found[0].point_fixed += Vec3(0.01, 0, 0);
  EXPECT_EQ(compare_with_exact(found, truth).untrue.size(), 1u);
  EXPECT_EQ(compare_with_exact(found, truth).missed.size(), 1u);
}

/// Frames of an experiment that are judged: each scene takes its share of a given number.
struct SampledScene {
  std::string file;
  std::int64_t frames;
};

class ExactTruth : public ::testing::TestWithParam<SampledScene> {};

/// `exhaustive`, the truth of all reports, against the definition in exact arithmetic, and `certified` with
/// it.
TEST_P(ExactTruth, HasEveryExactLmd) {
  const std::filesystem::path file = std::string(LMDBENCH_SOURCE_DIR "/experiments/") + GetParam().file;
  const Experiment experiment = load_experiment(file);
  const PreparedRun run = prepare(experiment);
  const auto frames = static_cast<std::int64_t>(run.input.poses.size());
  const std::int64_t samples = std::min(GetParam().frames, frames);
  int judged = 0, uncertain = 0, same_contact = 0, found = 0, untrue = 0, touching = 0;
  for (const char* name : {"exhaustive", "certified"}) {
    const auto method = make_method(name, run.scene);
    for (std::int64_t i = 0; i < samples; ++i) {
      // From the first frame to the last one.
      const std::int64_t frame = samples == 1 ? 0 : i * (frames - 1) / (samples - 1);
      const Pose& pose = run.input.poses[static_cast<std::size_t>(frame)];
      LmdSet lmds;
      WorkCounters counters;
      method->search(pose, lmds, counters);
      const ExactAgreement agreement = compare_with_exact(lmds, exact::exact_lmds(run.scene, pose));
      for (const ExactLmd& lmd : agreement.missed)
        ADD_FAILURE() << name << " misses in frame " << frame << ": " << describe(lmd);
      const bool contact =
          std::any_of(lmds.begin(), lmds.end(), [](const Lmd& lmd) { return lmd.intersecting; });
      EXPECT_EQ(contact, exact::exactly_touching(run.scene, pose)) << name << ", frame " << frame;
      touching += contact;
      judged += agreement.exact;
      uncertain += agreement.uncertain;
      same_contact += agreement.same_contact;
      found += agreement.found;
      untrue += static_cast<int>(agreement.untrue.size());
      for (const Lmd& lmd : agreement.untrue)
        EXPECT_TRUE(exact::within_tolerance(run.scene, pose, lmd))
            << name << ", frame " << frame << ": untrue at distance " << lmd.distance;
    }
  }
  std::cout << GetParam().file << ": " << 2 * samples << " sets, " << judged << " exact LMDs, "
            << same_contact << " of them within a plateau, " << uncertain << " uncertain, " << found
            << " reported, " << untrue << " of them within the tolerance of the first-order test only, "
            << touching << " touching\n";
  EXPECT_GT(judged + touching, 0) << "nothing was judged";
}

std::vector<SampledScene> extreme_scenes() {
  std::vector<SampledScene> scenes;
  const std::filesystem::path folder = LMDBENCH_SOURCE_DIR "/experiments/extreme";
  const char* frames = std::getenv("LMDBENCH_ORACLE_FRAMES");
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json")
      scenes.push_back({"extreme/" + entry.path().filename().string(), frames ? std::atoi(frames) : 5});
  std::sort(scenes.begin(), scenes.end(),
            [](const SampledScene& a, const SampledScene& b) { return a.file < b.file; });
  return scenes;
}

std::string name_of(const ::testing::TestParamInfo<SampledScene>& info) {
  std::string name = std::filesystem::path(info.param.file).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Extreme, ExactTruth, ::testing::ValuesIn(extreme_scenes()), name_of);
/// Fetched meshes: only under the label of the long runs.
INSTANTIATE_TEST_SUITE_P(Fetched, ExactTruth,
                         ::testing::Values(SampledScene{"bunny-hard.json", 40},
                                           SampledScene{"bunny-soft.json", 20},
                                           SampledScene{"armadillo-bunny.json", 20}),
                         name_of);

}  // namespace
}  // namespace lmdbench
