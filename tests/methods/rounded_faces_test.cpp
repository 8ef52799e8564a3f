// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>
#include <lmdbench/shape/flatten.h>

#include <gtest/gtest.h>
#include <support/rounded.h>
#include <support/scenes.h>

#include <numbers>

/// Flat contact of meshes whose coordinates were rounded to single precision in files of their own.
namespace lmdbench {
namespace {

using testing::make_body;
using testing::placed;
using testing::pose_of_seed;
using testing::rounded_to_floats;
using testing::stepped;
using testing::uniform;

/// Two meshes as designed, and as in files: each turned and rounded on its own.
struct Pair {
  Scene exact, rounded;
  Pose X_WD;  ///< Of the fixed file's frame; D is the frame of the design.
  Pose X_DM;  ///< What brings the moving file's frame back to that of its design.

  Pair(const TriangleMesh& moving, const TriangleMesh& fixed, double cutoff, std::uint64_t seed)
      : X_WD(pose_of_seed(2 * seed)), X_DM(pose_of_seed(2 * seed + 1).inverse()) {
    exact = {make_body("moving", moving), {make_body("fixed", placed(fixed, X_WD))}, cutoff};
    rounded = {make_body("moving", file_of(placed(moving, X_DM.inverse()))),
               {make_body("fixed", file_of(placed(fixed, X_WD)))},
               cutoff};
  }
  static TriangleMesh file_of(const TriangleMesh& mesh) {
    TriangleMesh file = rounded_to_floats(mesh);
    flatten(file);
    return file;
  }
};

LmdSet answer(const char* method, const Scene& scene, const Pose& pose) {
  return lmds_at(*make_method(method, scene), pose);
}

/// Expects as many contacts of the rounded pair as of the exact pair, at the same places.
void expect_same_contacts(const Pair& pair, const Pose& X_DA, double size, std::size_t count) {
  const Pose X_WA = pair.X_WD * X_DA;
  const LmdSet exact = answer("exhaustive", pair.exact, X_WA);
  ASSERT_EQ(exact.size(), count);
  for (const char* method : {"exhaustive", "certified"}) {
    const LmdSet rounded = answer(method, pair.rounded, X_WA * pair.X_DM);
    ASSERT_EQ(rounded.size(), count) << method;
    for (const Lmd& lmd : rounded) {
      const Lmd* nearest = &exact.front();
      for (const Lmd& other : exact)
        if ((other.point_fixed - lmd.point_fixed).norm() < (nearest->point_fixed - lmd.point_fixed).norm())
          nearest = &other;
      EXPECT_LT((lmd.point_fixed - nearest->point_fixed).norm(), 1e-6 * size) << method;
      EXPECT_LT((lmd.point_moving - nearest->point_moving).norm(), 1e-6 * size) << method;
      EXPECT_LT((lmd.direction - nearest->direction).norm(), 1e-6) << method;
      EXPECT_NEAR(lmd.distance, nearest->distance, 5e-7 * size) << method;
    }
  }
}

Pose on_top(std::mt19937_64& random, double height) {
  Pose X_DA;
  X_DA.rotation = Eigen::AngleAxisd(2.0 * std::numbers::pi * uniform(random), Vec3::UnitZ());
  X_DA.translation = Vec3(0.6 * (uniform(random) - 0.5), 0.6 * (uniform(random) - 0.5), height);
  return X_DA;
}

TEST(RoundedFaces, APlateOnAPlateIsOneContact) {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const int cells = seed % 5 == 0 ? 6 : 1 + static_cast<int>(seed % 3);
    const Pair pair(make_box(Vec3(1.0, 1.0, 0.1), cells), make_box(Vec3(1.3, 0.9, 0.1), 4), 0.02, seed);
    expect_same_contacts(pair, on_top(random, 0.101), 1.0, 1);
  }
}

/// As exact results of Boolean operations have them in doubles: the edge over such a wall is in no
/// valley, whichever way the floor beside it leads.
TEST(RoundedFaces, AWallOfRoundingIsNoMinimum) {
  TriangleMesh moving = stepped(1e-16);
  flatten(moving);
  const Scene scene =
      testing::make_scene(std::move(moving), placed(make_box({8, 8, 1}), {Vec3(0, 0, -1.5)}), 4.0);
  for (const char* method : {"exhaustive", "certified"})
    for (const double tilt : {0.1, 0.3})
      EXPECT_EQ(
          answer(method, scene, {Vec3::Zero(), Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vec3::UnitY()))})
              .size(),
          1U)
          << method << ", " << tilt;
}

TEST(RoundedFaces, TwoFeetAreTwoContacts) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const Pair pair(make_two_boxes(Vec3(0.3, 0.3, 0.3), 0.1), make_box(Vec3(3.0, 3.0, 0.1), 5), 0.02, seed);
    expect_same_contacts(pair, on_top(random, 0.201), 1.0, 2);
  }
}

TEST(RoundedFaces, AnEdgeOnAPlateIsOneContact) {
  // The wedge's sharp edge, parallel to the plate.
  const TriangleMesh wedge = make_wedge(0.3, 0.8, 0.3);
  double top = 0.0;
  for (const Vec3& p : wedge.vertices) top = std::max(top, p.z());
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const Pair pair(wedge, make_box(Vec3(3.0, 3.0, 0.1), 3), 0.02, seed);
    Pose X_DA = on_top(random, 0.05 + top + 0.001);
    X_DA.rotation = X_DA.rotation * Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX());
    expect_same_contacts(pair, X_DA, 1.0, 1);
  }
}

TEST(RoundedFaces, ParallelEdgesAreOneContact) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const Pair pair(make_box(Vec3(1.0, 0.4, 0.4), 2), make_box(Vec3(1.0, 0.4, 0.4), 3), 0.05, seed);
    const Pose X_DA{Vec3(0.6 * (uniform(random) - 0.5), 0.41, 0.42)};
    expect_same_contacts(pair, X_DA, 1.0, 1);
  }
}

// A face nearly parallel to a plate rests on one of its edges. Where that edge crosses the border
// the distance is a tie, and over the triangles there alone the edge is parallel to the plate.
TEST(RoundedFaces, AnEdgeAcrossABorderIsJudgedAsAWhole) {
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (const double along : {-1.6e-6, 8e-7, 1.6e-6})
      for (const double across : {-4e-9, 1e-9, 4e-9, 1e-7, 2e-6}) {
        SCOPED_TRACE(::testing::Message() << "seed " << seed << ", tilts " << along << ", " << across);
        const Pair pair(make_box(Vec3(1.6, 0.4, 0.4), 6), make_box(Vec3(1.0, 1.0, 0.2), 12), 0.02, seed);
        Pose X_DA;
        X_DA.rotation = Eigen::AngleAxisd(along, Vec3::UnitY()) * Eigen::AngleAxisd(across, Vec3::UnitX()) *
                        Eigen::AngleAxisd(0.002 * static_cast<double>(seed), Vec3::UnitZ());
        X_DA.translation = Vec3(0.0, 0.0, 0.302);
        const Pose X_WM = pair.X_WD * X_DA * pair.X_DM;
        const LmdSet truth = answer("exhaustive", pair.rounded, X_WM);
        const LmdSet found = answer("certified", pair.rounded, X_WM);
        ASSERT_EQ(found.size(), truth.size());
        for (std::size_t i = 0; i < truth.size(); ++i) {
          EXPECT_NEAR(found[i].distance, truth[i].distance, 1e-9);
          EXPECT_LT((found[i].point_fixed - truth[i].point_fixed).norm(), 1e-9);
        }
      }
}

TEST(RoundedFaces, ATiltThatIsMeantIsNoPlateau) {
  std::mt19937_64 random(1);
  const Pair pair(make_box(Vec3(1.0, 1.0, 0.1), 3), make_box(Vec3(3.0, 3.0, 0.1), 3), 0.02, 1);
  Pose X_DA = on_top(random, 0.101);
  X_DA.rotation = Eigen::AngleAxisd(1e-4, Vec3(0.6, 0.8, 0.0)) * X_DA.rotation;
  const Pose X_WM = pair.X_WD * X_DA * pair.X_DM;
  for (const char* method : {"exhaustive", "certified"}) {
    const LmdSet lmds = answer(method, pair.rounded, X_WM);
    ASSERT_EQ(lmds.size(), 1u) << method;
    EXPECT_EQ(lmds[0].feature_moving.kind, FeatureKind::VERTEX) << method;
  }
}

}  // namespace
}  // namespace lmdbench
