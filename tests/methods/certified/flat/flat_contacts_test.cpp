// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/flat/flat_contacts.h>
#include <lmdbench/methods/certified/flat/flat_mesh.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

namespace lmdbench {
namespace {

constexpr double TOUCH_DISTANCE_M = 1e-10;

struct Judgement {
  FlatVerdict verdict;
  bool is_in_doubt;
};

/// A cube of 0.1 above the upper face of a larger box, turned by `tilt`: its lower face is between `least` and
/// least + 0.1 tilt above the other.
Judgement judged(double least, double tilt) {
  const Scene scene = testing::make_scene(make_box({0.1, 0.1, 0.1}, 1), make_box({0.3, 0.3, 0.1}, 1), 0.01);
  const Body &moving = *scene.moving, &fixed = *scene.fixed[0];
  const RigidTransform X_WM(Pose{Vec3(0.0, 0.0, 0.1 + least + 0.05 * tilt),
                                 Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vec3::UnitY()))});
  const RigidTransform identity;
  const FlatSide below{fixed.surface(), fixed.prepared<FlatMesh>(), identity, false};
  const FlatSide above{moving.surface(), moving.prepared<FlatMesh>(), X_WM, true};
  const auto facing = [](const FlatSide& side, double z) {
    for (std::int32_t region = 0; region < static_cast<std::int32_t>(side.mesh.regions->planes.size());
         ++region)
      if (side.plane(region).normal.z() * z > 0.5) return region;
    return -1;
  };
  FlatContacts contacts;
  contacts.start(
      0, 0.01, TOUCH_DISTANCE_M, 0.15, 0.0,
      ParallelRule::of(moving.surface(), *above.mesh.regions, fixed.surface(), *below.mesh.regions));
  const FlatVerdict verdict = contacts.add_faces(above, facing(above, -1.0), below, facing(below, 1.0));
  return {verdict, contacts.is_in_doubt()};
}

// PROOF.md, lemma 20: what of a place lies within twice the touch distance goes to the triangles that come within four
// times of it. A place that leads farther is in doubt: the frame is searched by single features.

TEST(FlatContacts, FarEnoughAndParallelAreFoundWhole) {
  const Judgement parallel = judged(1e-3, 0.0);
  EXPECT_EQ(parallel.verdict, FlatVerdict::FOUND);
  EXPECT_FALSE(parallel.is_in_doubt);
}

TEST(FlatContacts, NearlyTouchingGoToTheirTriangles) {
  const Judgement near = judged(1.5 * TOUCH_DISTANCE_M, 1e-9);  // Up to 2.5 touch distances.
  EXPECT_EQ(near.verdict, FlatVerdict::UNSURE);
  EXPECT_FALSE(near.is_in_doubt);
}

TEST(FlatContacts, NearlyTouchingThatLeadBeyondTheTrianglesLookedAtAreInDoubt) {
  const Judgement leads_on = judged(1.5 * TOUCH_DISTANCE_M, 9e-9);  // Up to 10.5 touch distances.
  EXPECT_EQ(leads_on.verdict, FlatVerdict::UNSURE);
  EXPECT_TRUE(leads_on.is_in_doubt);
}

TEST(FlatContacts, TiltedByMoreThanAnyToleranceAreNone) {
  const Judgement tilted = judged(1e-3, 1e-6);
  EXPECT_EQ(tilted.verdict, FlatVerdict::NONE);
  EXPECT_FALSE(tilted.is_in_doubt);
}

TEST(FlatContacts, TiltsAreParallelOrClearAtTheDistancesOfAContact) {
  for (const double tilt : {1e-10, 1e-9, 2.9e-9}) {
    const Judgement parallel = judged(1e-3, tilt);
    EXPECT_EQ(parallel.verdict, FlatVerdict::FOUND) << tilt;
    EXPECT_FALSE(parallel.is_in_doubt) << tilt;
  }
  for (const double tilt : {3.1e-9, 8e-9, 2e-8}) {
    const Judgement clear = judged(1e-3, tilt);
    EXPECT_EQ(clear.verdict, FlatVerdict::NONE) << tilt;
    EXPECT_FALSE(clear.is_in_doubt) << tilt;
  }
}

TEST(FlatContacts, TiltsThatRoundingExplainsNearTouchAreInDoubt) {
  EXPECT_TRUE(judged(1e-8, 2e-8).is_in_doubt);
  EXPECT_EQ(judged(1e-8, 1e-6).verdict, FlatVerdict::NONE);
}

}  // namespace
}  // namespace lmdbench
