// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>

#include <gtest/gtest.h>
#include <support/convex_bodies.h>
#include <support/lmd_text.h>
#include <support/scenes.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using testing::grazing_pose;
using testing::make_scene;
using testing::moved;
using testing::text;
using testing::uniform;

/// Same feature pairs in the same order, same flags, points equal up to 1e-12 of the coordinates.
::testing::AssertionResult same_set(const LmdSet& truth, const LmdSet& found) {
  const auto failure = [&] {
    return ::testing::AssertionFailure() << "truth:\n" << text(truth) << "found:\n" << text(found);
  };
  if (truth.size() != found.size()) return failure();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double scale =
        truth[i].point_moving.cwiseAbs().maxCoeff() + truth[i].point_fixed.cwiseAbs().maxCoeff();
    if (!same_feature_pair(truth[i], found[i]) || truth[i].intersecting != found[i].intersecting ||
        truth[i].triangle_moving != found[i].triangle_moving ||
        truth[i].triangle_fixed != found[i].triangle_fixed ||
        !((truth[i].point_moving - found[i].point_moving).norm() <= 1e-12 * scale) ||
        !((truth[i].point_fixed - found[i].point_fixed).norm() <= 1e-12 * scale) ||
        !(std::abs(truth[i].distance - found[i].distance) <= 1e-12 * scale))
      return failure();
  }
  return ::testing::AssertionSuccess();
}

/// Runs truth and both kernels at a pose. It counts LMDs, so that empty sets cannot pass a test.
class KernelComparison {
 public:
  void check(Scene scene, const Pose& pose, double cutoff) {
    scene.cutoff = cutoff;
    LmdSet truth, vector, scalar;
    WorkCounters of_truth, of_vector, of_scalar;
    Exhaustive(scene).search(pose, truth, of_truth);
    Certified(scene).search(pose, vector, of_vector);
    Certified(scene, {}, WideKernel::SCALAR).search(pose, scalar, of_scalar);
    lmds_ += truth.size();
    EXPECT_TRUE(same_set(truth, vector)) << where(pose, cutoff);
    EXPECT_TRUE(same_set(truth, scalar)) << where(pose, cutoff);
    EXPECT_EQ(of_vector, of_scalar) << where(pose, cutoff);
  }

  std::size_t lmds() const { return lmds_; }

 private:
  static std::string where(const Pose& pose, double cutoff) {
    std::ostringstream text;
    text.precision(17);
    text << "cutoff " << cutoff << ", pose " << pose.translation.transpose() << " "
         << pose.rotation.coeffs().transpose();
    return text.str();
  }

  std::size_t lmds_ = 0;
};

void expect_truth_at_random_poses(const Scene& scene, int poses, std::uint64_t seed) {
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  const double size = bounding_box_diagonal(scene.fixed[0]->surface().mesh);
  KernelComparison comparison;
  for (int i = 0; i < poses; ++i) {
    Pose pose = grazing_pose(scene, 0.002 * size, random);
    for (const double cutoff : {0.005, 0.02, 0.05}) comparison.check(scene, pose, cutoff * size);
    // Closer, until they intersect.
    pose.translation *= 0.97;
    comparison.check(scene, pose, 0.02 * size);
  }
  EXPECT_GT(comparison.lmds(), static_cast<std::size_t>(poses));
}

TEST(Certified, FindsTheTruthOnShapes) {
  const auto expect_truth = [](const TriangleMesh& moving, const TriangleMesh& fixed, int poses,
                               std::uint64_t seed) {
    expect_truth_at_random_poses(make_scene(moving, fixed, 0.0), poses, seed);
  };
  expect_truth(make_blob(1.0, 0.3, 3), make_blob(0.8, 0.3, 3), 15, 1);
  expect_truth(make_torus(1.0, 0.4, 30, 16), make_torus(1.0, 0.3, 24, 12), 15, 2);
  expect_truth(make_unequal(1.0, 8, 100.0), make_unequal(1.0, 7, 30.0), 15, 3);
  expect_truth(make_needles(0.5, 2.0, 40), make_needles(0.5, 2.0, 24, 0.0), 15, 4);
  expect_truth(make_patch(2.0, 10, 0.2), make_patch(2.0, 9, 0.1), 15, 5);  // open
  expect_truth(make_l_block(1.0), make_box({1.0, 2.0, 0.5}, 3), 25, 6);    // reflex edges
  expect_truth(make_two_boxes({1.0, 1.0, 1.0}, 0.3), make_wedge(1.0, 1.0, 0.5), 25, 7);
}

/// Rounding grows with the way from the mesh's own origin (PROOF.md, lemma 3): a corner over an
/// edge whose wings lean towards the other box by less than the definition grants at that distance.
TEST(Certified, FindsTheTruthNextToTouchFarFromTheMeshsOrigin) {
  std::mt19937_64 random(31);
  KernelComparison comparison;
  for (int i = 0; i < 400; ++i) {
    const Vec3 corner(-0.5, -0.5, -0.5), away = 12.0 * testing::random_direction(random);
    const Scene scene =
        make_scene(translated(make_box({1.0, 1.0, 1.0}), away), make_box({1.0, 1.0, 1.0}), 0.0);
    const double gap = std::pow(10.0, -7.5 + uniform(random)), lean = 8e-6 * uniform(random);
    Pose pose;
    pose.rotation = Eigen::AngleAxisd(lean, Vec3::UnitY()) *
                    Eigen::AngleAxisd(-0.25 * std::numbers::pi + 0.2 * uniform(random), Vec3::UnitZ());
    pose.translation = Vec3(0.5, 0.4 * uniform(random), 0.5 + gap) - pose.rotation * (away + corner);
    comparison.check(scene, pose, 0.01);
  }
  EXPECT_EQ(comparison.lmds(), 400U);
}

TEST(Certified, FindsTheTruthOnBoxesInParallel) {
  // Every kind of level contact: face on face, edge on edge, edge on face, corner on face; tilts
  // below and above the tolerances.
  const Scene scene = make_scene(make_box({0.1, 0.1, 0.1}, 3), make_box({0.1, 0.1, 0.1}, 2), 0.0);
  KernelComparison comparison;
  for (const double x : {0.0, 0.03, 0.05, 0.1, 0.11}) {
    for (const double y : {0.0, 0.02, 0.1, 0.12}) {
      for (const double z : {0.1001, 0.11, 0.12}) {
        for (const double angle : {0.0, 1e-12, 1e-9, 1e-7, 1e-4}) {
          // An overlap of width 2e-11 has no centroid exact to 1e-12 along its width.
          if (x == 0.1 && angle == 1e-9) continue;
          Pose pose = moved(x, y, z);
          pose.rotation = Eigen::AngleAxisd(angle, Vec3(0.6, 0.8, 0.0));
          comparison.check(scene, pose, 0.03);
        }
      }
    }
  }
  EXPECT_GT(comparison.lmds(), 100u);
}

TEST(Certified, FindsTheTruthOnNearlyParallelEdges) {
  // Two sharp edges that cross near an end, at angles for which the crossing's place is inexact.
  const Scene scene = make_scene(make_wedge(0.1, 0.1, 0.05), make_wedge(0.1, 0.1, 0.05), 0.0);
  std::mt19937_64 random(12);
  KernelComparison comparison;
  for (int i = 0; i < 300; ++i) {
    const double angle = std::pow(10.0, -8.0 + 6.0 * testing::uniform(random));
    const double from_end = 0.1 * std::pow(10.0, -8.0 + 8.0 * testing::uniform(random));
    Pose pose;
    pose.rotation =
        Eigen::AngleAxisd(angle, Vec3::UnitZ()) * Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY());
    // The crossing is `from_end` inside the end of the fixed edge, somewhere on the moving edge.
    const double place = i % 2 == 0 ? 0.05 - from_end : 0.09 * (testing::uniform(random) - 0.5);
    const Vec3 on_moving = pose.rotation * Vec3(0.0, place, 0.025);
    pose.translation = Vec3(0.0, 0.05 - from_end, 0.025 + 0.002 * testing::uniform(random)) - on_moving;
    comparison.check(scene, pose, 0.01);
  }
  EXPECT_GE(comparison.lmds(), 300u);
}

TEST(Certified, FindsTheTruthOnItsOwnCopy) {
  const Scene scene = make_scene(make_blob(1.0, 0.2, 2), make_blob(1.0, 0.2, 2), 0.0);
  KernelComparison comparison;
  comparison.check(scene, moved(0.0, 0.0, 0.0), 0.01);
  comparison.check(scene, moved(0.0, 0.0, 1e-13), 0.01);
  comparison.check(scene, moved(0.0, 0.0, 1e-7), 0.01);
  comparison.check(scene, moved(2.2, 0.0, 0.0), 0.1);
  comparison.check(scene, moved(2.3, 0.0, 0.0), 0.2);
  EXPECT_GT(comparison.lmds(), 0u);
}

TEST(Certified, FindsTheTruthAtTinyGaps) {
  const Scene scene = make_scene(make_blob(1.0, 0.3, 3), make_blob(1.0, 0.2, 3), 0.0);
  std::mt19937_64 random(8);
  KernelComparison comparison;
  for (const double gap : {1e-3, 1e-5, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12, 1e-14})
    comparison.check(scene, grazing_pose(scene, gap, random), 0.02);
  EXPECT_GT(comparison.lmds(), 8u);
}

TEST(Certified, FindsTheTruthAtWildScales) {
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6})
    expect_truth_at_random_poses(
        make_scene(scaled(make_blob(1.0, 0.3, 2), scale), scaled(make_torus(1.0, 0.4, 20, 10), scale), 0.0),
        5, 9);
}

TEST(Certified, FindsTheTruthWithUnequalSizes) {
  expect_truth_at_random_poses(make_scene(make_blob(1e-3, 3e-4, 2), make_blob(1.0, 0.3, 3), 0.0), 5, 10);
}

TEST(Certified, FindsTheTruthFarFromTheOrigin) {
  const Vec3 offset(1e6, -1e6, 5e5);
  Scene scene = make_scene(make_blob(1.0, 0.3, 2), translated(make_torus(1.0, 0.4, 20, 10), offset), 0.0);
  const Scene near = make_scene(make_blob(1.0, 0.3, 2), make_torus(1.0, 0.4, 20, 10), 0.0);
  std::mt19937_64 random(11);
  KernelComparison comparison;
  for (int i = 0; i < 10; ++i) {
    Pose pose = grazing_pose(near, 0.005, random);
    pose.translation += offset;
    comparison.check(scene, pose, 0.05);
  }
  EXPECT_GT(comparison.lmds(), 10u);
}

TEST(Certified, FindsTheTruthOnBrokenMeshes) {
  // Zero areas, duplicates, flipped triangles, three triangles on one edge, a vertex of two sheets.
  TriangleMesh broken = make_blob(1.0, 0.3, 2);
  broken.triangles.push_back({0, 0, 1});
  broken.triangles.push_back({3, 3, 3});
  broken.triangles.push_back(broken.triangles[10]);
  std::swap(broken.triangles[20][0], broken.triangles[20][1]);
  std::swap(broken.triangles[40][0], broken.triangles[40][1]);
  broken.vertices.push_back(broken.vertices[static_cast<std::size_t>(broken.triangles[30][0])] * 1.3);
  const auto tip = static_cast<std::int32_t>(broken.vertices.size() - 1);
  broken.triangles.push_back({broken.triangles[30][0], broken.triangles[30][1], tip});
  broken.vertices.push_back(Vec3(0.0, 0.0, 2.0));
  broken.vertices.push_back(Vec3(0.1, 0.0, 2.0));
  broken.triangles.push_back({5, tip + 1, tip + 2});
  broken.triangles.push_back({tip + 1, tip + 2, tip + 1});
  broken.triangles.erase(broken.triangles.begin() + 100, broken.triangles.begin() + 104);
  expect_truth_at_random_poses(make_scene(broken, make_torus(1.0, 0.4, 20, 10), 0.0), 10, 12);
  expect_truth_at_random_poses(make_scene(broken, broken, 0.0), 10, 13);
}

/// Some vertices moved along an edge until `left` of its length is left.
TriangleMesh with_short_edges(TriangleMesh mesh, double left, std::mt19937_64& random) {
  for (int i = 0; i < 3; ++i) {
    const auto& corners = mesh.triangles[random() % mesh.triangles.size()];
    Vec3& p = mesh.vertices[static_cast<std::size_t>(corners[0])];
    p += (1.0 - left) * (mesh.vertices[static_cast<std::size_t>(corners[1])] - p);
  }
  return mesh;
}

TEST(Certified, FindsTheTruthBesideEdgesAsShortAsRounding) {
  // A direction may leave a cone by rounding over wing length: more than the slack of a cap.
  std::mt19937_64 random(14);
  const auto power_of_ten = [&](double low, double high) {
    return std::pow(10.0, low + (high - low) * testing::uniform(random));
  };
  KernelComparison comparison;
  for (int i = 0; i < 80; ++i) {
    const TriangleMesh shapes[] = {make_box({1.0, 1.0, power_of_ten(-12.0, -5.0)}, {3, 3, 1}),
                                   make_box({1.0, 0.8, 0.6}, 2), make_blob(0.5, 0.2, 1),
                                   make_torus(0.35, 0.15, 8, 5)};
    const TriangleMesh moving = with_short_edges(shapes[i % 4], power_of_ten(-15.0, -5.0), random);
    const Scene scene = make_scene(moving, i % 8 < 4 ? moving : make_box({1.0, 1.2, 0.7}, 2), 0.0);
    for (int k = 0; k < 10; ++k) {
      Pose pose = grazing_pose(scene, 0.01 * (1.0 - testing::uniform(random)), random);
      if (k % 3 != 0)  // Side by side, nearly aligned.
        pose = {(1.0 + 0.01 * testing::uniform(random)) * Vec3::UnitX(),
                Eigen::Quaterniond(
                    Eigen::AngleAxisd(power_of_ten(-6.0, -0.5), testing::random_direction(random)))};
      comparison.check(scene, pose, 0.01);
    }
  }
  EXPECT_GT(comparison.lmds(), 800u);
}

TEST(Certified, FindsTheTruthOfMeshesAsSmallAsRoundingOfTheOther) {
  // Rounding of the large one's coordinates over the small one's wings: more than a cap's slack.
  std::mt19937_64 random(15);
  KernelComparison comparison;
  for (int i = 0; i < 60; ++i) {
    const double size = std::pow(10.0, -10.0 + 5.0 * testing::uniform(random));
    const TriangleMesh small =
        i % 2 == 0 ? make_blob(size, 0.4 * size, 1) : make_box(size * Vec3(1.0, 0.7, 1e-3), {3, 3, 1});
    const TriangleMesh large = i % 4 < 2 ? make_box({1.0, 1.2, 0.7}, 2) : make_torus(1.0, 0.4, 12, 8);
    const Scene scene = i % 8 < 4 ? make_scene(small, large, 0.0) : make_scene(large, small, 0.0);
    for (int k = 0; k < 10; ++k)
      comparison.check(scene, grazing_pose(scene, 0.01 * testing::uniform(random), random), 0.02);
  }
  EXPECT_GT(comparison.lmds(), 600u);
}

/// A cutoff of no limit saves nothing, but costs nothing either: pairs are told apart all the same.
TEST(Certified, AHugeCutoffComparesNoMoreTriangles) {
  const Scene scene = make_scene(make_blob(1.0, 0.3, 2), make_torus(1.0, 0.4, 12, 8), 0.0);
  std::vector<std::uint64_t> compared;
  for (const double cutoff : {1e2, 1e9}) {
    Scene wide = scene;
    wide.cutoff = cutoff;
    LmdSet lmds;
    WorkCounters counters;
    Certified(wide).search(moved(3.0, 0.5, 1.9), lmds, counters);
    EXPECT_FALSE(lmds.empty());
    compared.push_back(counters[Certified::Counter::TRIANGLE_DISTANCES]);
  }
  EXPECT_LE(compared[1], compared[0]);
}

TEST(Certified, FindsEverythingWithoutCutoff) {
  const Scene scene = make_scene(make_blob(1.0, 0.3, 2), make_torus(1.0, 0.4, 12, 8), 0.0);
  KernelComparison comparison;
  for (const double x : {0.0, 0.2, 3.0}) comparison.check(scene, moved(x, 0.5, 1.9), 1e3);
  EXPECT_GT(comparison.lmds(), 3u);
}

/// Up to the sizes that readers take: beyond, single precision overflows or vanishes.
TEST(Certified, FindsTheSameAtTheLeastAndTheLargestSize) {
  std::mt19937_64 random(21);
  const TriangleMesh blob = make_blob(0.25, 0.06, 2), torus = make_torus(0.3, 0.1, 12, 8);
  const Scene unscaled = make_scene(blob, torus, 0.1);
  std::vector<Pose> poses;
  for (int i = 0; i < 5; ++i) poses.push_back(grazing_pose(unscaled, 0.01, random));
  for (const double scale : {0x1p-49, 0x1p59}) {
    const Scene scene = make_scene(scaled(blob, scale), scaled(torus, scale), 0.1 * scale);
    ASSERT_LE(largest_coordinate(scene.moving->surface().mesh.vertices), LARGEST_COORDINATE);
    ASSERT_GE(bounding_box_diagonal(scene.moving->surface().mesh), SMALLEST_DIAGONAL);
    for (const Pose& pose : poses) {
      const Pose far{scale * pose.translation, pose.rotation};
      LmdSet expected, found;
      WorkCounters counters;
      Certified(unscaled).search(pose, expected, counters);
      Certified(scene).search(far, found, counters);
      EXPECT_FALSE(expected.empty());
      ASSERT_EQ(found.size(), expected.size()) << scale;
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_TRUE(same_feature_pair(found[i], expected[i])) << scale;
        EXPECT_EQ(found[i].distance, scale * expected[i].distance) << scale;
      }
    }
  }
}

TEST(Certified, IsEmptyBeyondTheCutoff) {
  const Scene scene = make_scene(make_box({1.0, 1.0, 1.0}), make_box({1.0, 1.0, 1.0}), 0.1);
  LmdSet lmds(3);
  WorkCounters counters;
  Certified(scene).search(moved(1e30, 0.0, 0.0), lmds, counters);
  EXPECT_TRUE(lmds.empty());
  lmds.resize(3);
  Certified(scene).search(moved(1.11, 0.0, 0.0), lmds, counters);
  EXPECT_TRUE(lmds.empty());
}

}  // namespace
}  // namespace lmdbench
