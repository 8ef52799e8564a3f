// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/scene/broad_phase.h>
#include <lmdbench/scene/near_pairs.h>
#include <lmdbench/scene/scatter.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

using testing::make_body;
using testing::moved;
using testing::random_direction;
using testing::random_rotation;
using testing::uniform;

Scene world_of(const Scatter& rule, double cutoff, const Vec3& origin = Vec3::Zero()) {
  Scene scene{make_body("moving", make_blob(0.8, 0.2, 2)), {}, cutoff};
  const auto mesh = make_body("fixed", make_torus(1.0, 0.4, 12, 8));
  for (Pose pose : scatter(rule, mesh->prepared<MeshBounds>())) {
    pose.translation += origin;
    scene.fixed.emplace_back(mesh, pose);
  }
  return scene;
}

double distance_to(const Scene& scene, std::size_t instance, const Pose& X_WM) {
  const FixedBody& fixed = scene.fixed[instance];
  return nearest_pair(*scene.moving, *fixed, relative_pose(fixed.X_WF, X_WM)).distance;
}

/// Radius of a sphere round the body's origin that holds the body.
double radius_of(const Body& body) {
  double radius = 0.0;
  for (const Vec3& vertex : body.surface().mesh.vertices) radius = std::max(radius, vertex.norm());
  return radius;
}

/// Instances that may be within the cutoff at the pose, ascending.
std::vector<std::uint32_t> near_at(const Pose& pose, BroadPhase& phase, BroadPhase::Work& work) {
  std::vector<std::uint32_t> near;
  phase.advance(pose, work);
  phase.for_each_near(work, [&](const BroadPhase::Candidate& one) { near.push_back(one.other - 1); });
  return near;
}

/// A path that wanders, turns, trembles, and jumps now and then.
std::vector<Pose> wander(const Vec3& origin, double size, double step, int frames, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Pose> poses;
  Pose pose = moved(0, 0, 0);
  Vec3 direction = random_direction(random), axis = random_direction(random);
  for (int frame = 0; frame < frames; ++frame) {
    if (frame % 40 == 0) direction = random_direction(random), axis = random_direction(random);
    if (frame % 90 == 89) pose.translation = size * (uniform(random) - 0.5) * random_direction(random);
    pose.translation += step * direction;
    if (pose.translation.norm() > 0.6 * size) pose.translation *= 0.9;
    pose.rotation = (Eigen::Quaterniond(Eigen::AngleAxisd(0.02, axis)) * pose.rotation).normalized();
    poses.push_back(pose);
    poses.back().translation += origin;
  }
  return poses;
}

TEST(BroadPhase, DropsNoInstanceWithinReach) {
  for (const double offset : {0.0, 1000.0})
    for (const double cutoff : {0.01, 0.3, 2.0}) {
      const Vec3 origin(offset, -offset, 0.5 * offset);
      const Scene scene =
          world_of({.rule = Scatter::Rule::RANDOM, .count = 60, .spacing = 1.0}, cutoff, origin);
      BroadPhase phase(scene);
      BroadPhase::Work work;
      std::size_t within = 0;
      NearPairs all(scene);
      const double reach = 1.001 * (radius_of(*scene.moving) + radius_of(*scene.fixed.front().body) + cutoff);
      for (const Pose& pose : wander(origin, 9.0, 0.03, 200, 7)) {
        const std::vector<std::uint32_t> near = near_at(pose, phase, work);
        const std::vector<NearPairs::Pair>& pairs = all.within(contact_reach(scene), pose);
        for (std::uint32_t i = 0; i < scene.fixed.size(); ++i) {
          if ((scene.fixed[i].X_WF.translation - pose.translation).norm() > reach) continue;
          if (!(distance_to(scene, i, pose) <= cutoff)) continue;
          ++within;
          EXPECT_TRUE(std::binary_search(near.begin(), near.end(), i)) << "instance " << i;
          EXPECT_NE(std::ranges::find(pairs, ObjectPair{0, i + 1}, &NearPairs::Pair::objects), pairs.end())
              << "instance " << i;
        }
      }
      EXPECT_GT(within, 50u);
      EXPECT_LT(work.queries, 100u);  // not in every frame
    }
}

TEST(BroadPhase, TouchesNothingWhereNothingCanComeNear) {
  // A corridor between two walls of instances.
  Scene scene{make_body("moving", make_sphere(0.5, 2)), {}, 0.1};
  const auto mesh = make_body("fixed", make_sphere(0.5, 2));
  for (int x = -50; x <= 50; ++x)
    for (const double y : {-3.0, 3.0}) scene.fixed.emplace_back(mesh, moved(1.2 * x, y, 0.0));
  BroadPhase phase(scene);
  BroadPhase::Work work;
  int idle = 0;
  for (int frame = 0; frame < 2000; ++frame) {
    const BroadPhase::Work before = work;
    EXPECT_TRUE(near_at(moved(-5.0 + 0.005 * frame, 0.0, 0.0), phase, work).empty());
    if (work.queries == before.queries) {
      EXPECT_EQ(work.touched, before.touched);
      ++idle;
    }
  }
  EXPECT_EQ(work.touched, 0u);  // farther than cutoff and slack
  EXPECT_GT(idle, 1900);
}

TEST(BroadPhase, LooksOnlyAtCandidatesWhoseRoomIsUsedUp) {
  Scene scene{make_body("moving", make_box({1.0, 1.0, 1.0})), {}, 0.1};
  const auto mesh = make_body("fixed", make_box({1.0, 1.0, 1.0}));
  // Boxes at gaps of 0.15 and 0.25 along x; the cutoff is 0.1 and a little more.
  scene.fixed.emplace_back(mesh, moved(1.15, 0.0, 0.0));
  scene.fixed.emplace_back(mesh, moved(-1.25, 0.0, 0.0));
  BroadPhase phase(scene);
  BroadPhase::Work work;
  EXPECT_TRUE(near_at(moved(0, 0, 0), phase, work).empty());
  ASSERT_EQ(phase.candidates().size(), 2u);
  EXPECT_EQ(phase.candidates()[0].other, 1u);
  EXPECT_NEAR(phase.candidates()[0].room, 0.05, 1e-6);
  EXPECT_NEAR(phase.candidates()[1].room, 0.15, 1e-6);
  EXPECT_TRUE(near_at(moved(0, 0.049, 0), phase, work).empty());
  EXPECT_EQ(near_at(moved(0, 0.051, 0), phase, work).size(), 1u);  // whatever the direction
  EXPECT_EQ(near_at(moved(0, 0.151, 0), phase, work).size(), 2u);
  EXPECT_EQ(work.queries, 1u);
  Pose turned;
  turned.rotation = Eigen::AngleAxisd(1.0, Vec3::UnitZ());
  phase.advance(turned, work);  // a corner moves by 2 sin(0.5) 0.87
  EXPECT_EQ(work.queries, 2u);
}

TEST(BroadPhase, FindsInstancesThatAreExactlyACutoffAway) {
  const auto mesh = make_body("box", make_box({1.0, 1.0, 1.0}));
  for (const double offset : {0.0, 1024.0, 1048576.0}) {
    Scene scene{mesh, {{mesh, moved(offset + 1.25, 0.0, 0.0)}}, 0.25};
    BroadPhase phase(scene);
    BroadPhase::Work work;
    EXPECT_EQ(near_at(moved(offset, 0.0, 0.0), phase, work).size(), 1u) << offset;
    EXPECT_EQ(NearPairs(scene).within(contact_reach(scene), moved(offset, 0.0, 0.0)).size(), 1u) << offset;
  }
}

TEST(BroadPhase, AsksAgainAfterAJumpAndNotAtRest) {
  const Scene scene = world_of({.counts = {5, 5, 5}}, 0.1);
  BroadPhase phase(scene);
  BroadPhase::Work work;
  for (int frame = 0; frame < 100; ++frame) phase.advance(moved(0.1 + 1e-3 * (frame % 2), 0, 0), work);
  EXPECT_EQ(work.queries, 1u);
  phase.advance(moved(4.0, 0, 0), work);
  EXPECT_EQ(work.queries, 2u);
}

TEST(BroadPhase, GoesThroughInstancesByDistance) {
  const Scene scene = world_of({.rule = Scatter::Rule::RANDOM, .count = 80, .spacing = 1.0}, 0.1);
  const BroadPhase phase(scene);
  std::mt19937_64 random(3);
  for (int k = 0; k < 20; ++k) {
    Pose pose;
    pose.rotation = random_rotation(random);
    pose.translation = 8.0 * uniform(random) * random_direction(random);
    double last = 0.0;
    std::size_t visited = 0;
    phase.by_distance(pose, [&](std::uint32_t instance, double bound) {
      EXPECT_LE(bound, distance_to(scene, instance, pose));
      EXPECT_GE(bound, last - 1e-5);
      last = bound;
      return ++visited < 30;
    });
    EXPECT_EQ(visited, 30u);
  }
}

TEST(RelativePose, OfAFrameAtTheOriginIsThePoseItself) {
  std::mt19937_64 random(5);
  Pose pose;
  pose.rotation = random_rotation(random);
  pose.translation = random_direction(random);
  const Pose relative = relative_pose({}, pose);
  EXPECT_EQ(relative.translation, pose.translation);
  EXPECT_LT((relative.rotation.coeffs() - pose.rotation.coeffs()).norm(), 1e-15);
}

TEST(RelativePose, DoesNotDependOnWhereTheOriginIs) {
  std::mt19937_64 random(6);
  Pose fixed, moving;
  fixed.rotation = random_rotation(random);
  moving.rotation = random_rotation(random);
  fixed.translation = Vec3(0.25, -0.5, 1.0);
  moving.translation = Vec3(0.5, 0.125, -0.75);
  const Pose here = relative_pose(fixed, moving);
  const Vec3 far(1048576.0, -2097152.0, 524288.0);  // sums are exact
  fixed.translation += far;
  moving.translation += far;
  const Pose there = relative_pose(fixed, moving);
  EXPECT_EQ(here.translation, there.translation);
  EXPECT_EQ(here.rotation.coeffs(), there.rotation.coeffs());
}

TEST(MeshBounds, HoldThePlacedMesh) {
  std::mt19937_64 random(8);
  const Surface surface = build_surface(make_wedge(1.0, 3.0, 0.5));
  const MeshBounds bounds = MeshBounds::of(surface);
  for (int k = 0; k < 200; ++k) {
    Pose pose;
    pose.rotation = random_rotation(random);
    pose.translation = std::pow(10.0, 6.0 * uniform(random)) * random_direction(random);
    const RigidTransform X(pose);
    const Eigen::AlignedBox3d box = bounds.placed(X);
    for (const Vec3& vertex : surface.mesh.vertices) EXPECT_TRUE(box.contains(X.point(vertex)));
    EXPECT_LT(box.sizes().maxCoeff(), 2.0 * bounds.radius * (1.0 + 1e-9) + 1e-7);
  }
}

}  // namespace
}  // namespace lmdbench
