// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/methods/registry.h>

#include <gtest/gtest.h>
#include <judge/exact_scene.h>
#include <judge/exact_scene_judgement.h>
#include <support/scenes.h>
#include <support/source_directory.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using exact::compare_with_exact;
using exact::ExactLmd;
using testing::make_scene;

Pose moved(double x, double y, double z) {
  return {{x, y, z}, Eigen::Quaterniond::Identity()};
}

TEST(ExactLmds, ACornerOverAFaceIsOneVertexFacePair) {
  const Scene scene = make_scene(make_wedge(0.1, 0.1, 0.1), make_box({1, 1, 1}), 0.05);
  // A vertex of the box's upper side is far away. The wedge is upside down on its edge, tilted so
  // that one end of the edge is lowest.
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
  // All numbers are exact in binary. The overlap is a rectangle: its corners are vertices over
  // faces or crossings of edges; further LMDs are crossings with the diagonals of both sides.
  const Scene scene = make_scene(make_box({1, 1, 1}), make_box({1, 1, 1}), 0.5);
  const std::vector<ExactLmd> lmds = exact::exact_lmds(scene, moved(0.25, 0.5, 1.125));
  ASSERT_GE(lmds.size(), 4u);
  for (const ExactLmd& lmd : lmds) EXPECT_EQ(lmd.distance, 0.125) << describe(lmd);
}

TEST(ExactLmds, InsideAndOutsideAreToldApart) {
  // A small box inside a large one: the nearest points are never on the outer side.
  const Scene scene = make_scene(make_box({0.5, 0.5, 0.5}), make_box({1, 1, 1}), 1.0);
  EXPECT_TRUE(exact::exact_lmds(scene, moved(0.1, 0.05, 0.02)).empty());
}

TEST(ExactLmds, TrianglesAroundAPointAreAllThatHoldIt) {
  // A vertex in the middle of the upper side that only belongs to a triangle without area: the side
  // continues around it, so it has no LMD of its own with a corner that hangs beside it.
  TriangleMesh box = make_box({1, 1, 1});
  const auto first = static_cast<std::int32_t>(box.vertices.size());
  for (int i = 0; i < 3; ++i) box.vertices.emplace_back(0.25, 0.125, 0.5);
  box.triangles.push_back({first, first + 1, first + 2});
  const Scene scene = make_scene(make_wedge(0.1, 0.1, 0.1), box, 0.5);
  Pose pose = moved(-0.25, -0.125, 0.58);
  pose.rotation = Eigen::AngleAxisd(0.2, Vec3::UnitX()) * Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY());
  for (const ExactLmd& lmd : exact::exact_lmds(scene, pose))
    EXPECT_EQ(lmd.feature_fixed.kind, FeatureKind::FACE) << describe(lmd);
}

TEST(ExactLmds, ContactIsDecidedExactly) {
  const Scene scene = make_scene(make_box({1, 1, 1}), make_box({1, 1, 1}), 0.5);
  EXPECT_TRUE(exact::exactly_touching(scene, moved(0.25, 0.5, 1.0)));
  EXPECT_TRUE(exact::exactly_touching(scene, moved(1.0, 1.0, 1.0)));
  EXPECT_FALSE(exact::exactly_touching(scene, moved(0.25, 0.5, 1.0 + 0x1.0p-52)));
  EXPECT_TRUE(exact::exactly_touching(scene, moved(0.25, 0.5, 1.0 - 0x1.0p-53)));
}

TEST(ExactLmds, TheComparisonSeesWhatIsMissingAndWhatIsUntrue) {
  const Scene scene = make_scene(make_box({1, 1, 1}), make_box({1, 1, 1}), 0.5);
  const Pose pose = moved(1.1, 1.2, 1.3);
  const std::vector<ExactLmd> truth = exact::exact_lmds(scene, pose);
  LmdSet found = lmds_at(*make_method("exhaustive", scene), pose);
  ASSERT_EQ(truth.size(), 1u);
  EXPECT_EQ(compare_with_exact(scene, found, truth).same_features, 1);
  EXPECT_EQ(compare_with_exact(scene, {}, truth).missed.size(), 1u);
  found[0].feature_fixed.index += 1;
  found[0].point_fixed += Vec3(0.01, 0, 0);
  EXPECT_EQ(compare_with_exact(scene, found, truth).untrue.size(), 1u);
  EXPECT_EQ(compare_with_exact(scene, found, truth).missed.size(), 1u);
}

TEST(ExactLmds, APartOfAPlateauIsKnownUpToTheToleranceOfTheMeshes) {
  // A rod over a box, tilted so little that its gap changes by less than the meshes are known to
  // (1e-9): the one LMD is the middle of the overlap, the exact ones are its lower corners.
  const Scene scene = make_scene(make_box({0.02, 0.02, 1.0}), make_box({1, 1, 1}), 0.1);
  Pose pose = moved(0.21, 0.07, 1.05);
  pose.rotation = Eigen::AngleAxisd(4e-8, Vec3::UnitY());
  const std::vector<ExactLmd> truth = exact::exact_lmds(scene, pose);
  ASSERT_FALSE(truth.empty());
  LmdSet found = lmds_at(*make_method("exhaustive", scene), pose);
  ASSERT_EQ(found.size(), 1u);
  const auto unknown = [&] {
    const exact::ExactAgreement agreement = compare_with_exact(scene, found, truth);
    return agreement.missed.size() + agreement.untrue.size();
  };
  EXPECT_EQ(unknown(), 0u);
  const Vec3 further = 1e-8 * found[0].direction;
  found[0].point_fixed += further;
  EXPECT_GE(unknown(), 2u) << "farther than the tolerance explains";
}

/// Frames of an experiment to judge: each scene takes its share of a given number.
struct SampledScene {
  std::string file;
  std::int64_t frames;
};

class ExactTruth : public ::testing::TestWithParam<SampledScene> {};

TEST_P(ExactTruth, HasEveryExactLmd) {
  std::int64_t judged = 0;
  for (const exact::Judgement& judgement : exact::judge_experiment(
           std::string(LMDBENCH_SOURCE_DIR "/experiments/") + GetParam().file, GetParam().frames)) {
    EXPECT_GT(judgement.frames, 0);
    EXPECT_EQ(judgement.exact, judgement.same_features + judgement.same_contact + judgement.uncertain);
    EXPECT_EQ(judgement.untrue + judgement.wrong_contacts, 0);
    for (const std::string& failure : judgement.failures) ADD_FAILURE() << failure;
    judged += judgement.exact + judgement.touching;
  }
  EXPECT_GT(judged, 0) << "nothing was judged";
}

bool takes_seconds_a_frame(const std::filesystem::path& scene) {
  const std::set<std::string> large{"bolt", "peg-round", "peg-square"};
  return large.contains(scene.stem().string());
}

/// All scenes but those of meshes rounded to floats. The exact judge takes coordinates literally,
/// and then a contact of rounded faces is a point, not the area within the planar tolerance. Those
/// scenes are compared with the truth as defined for them (FlatScenesOfTheStudy, RoundedFaces).
std::vector<SampledScene> extreme_scenes() {
  std::vector<SampledScene> scenes;
  const std::filesystem::path folder = LMDBENCH_SOURCE_DIR "/experiments/extreme";
  const char* frames = std::getenv("LMDBENCH_ORACLE_FRAMES");
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json" && !entry.path().stem().string().ends_with("-floats"))
      scenes.push_back({"extreme/" + entry.path().filename().string(), frames ? std::atoi(frames)
                                                                       : takes_seconds_a_frame(entry) ? 2
                                                                                                      : 20});
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
/// Fetched meshes: only in the long runs.
INSTANTIATE_TEST_SUITE_P(Fetched, ExactTruth,
                         ::testing::Values(SampledScene{"bunny-hard.json", 40},
                                           SampledScene{"bunny-soft.json", 20},
                                           SampledScene{"armadillo-bunny.json", 20}),
                         name_of);

}  // namespace
}  // namespace lmdbench
