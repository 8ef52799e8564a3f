// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/contact_tolerance.h>
#include <lmdbench/decision/decide.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/certified/decide/filter.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>
#include <lmdbench/shape/shape_complex.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using testing::grazing_pose;
using testing::make_scene;
using testing::random_direction;
using testing::uniform;

/// Swings about a pose: slow and fast, back and forth, sometimes at rest, with a jump now and then.
std::vector<Pose> swing(const Pose& middle, double size, double speed, int frames, std::mt19937_64& random) {
  std::vector<Pose> poses;
  const Vec3 direction = random_direction(random), axis = random_direction(random);
  const Vec3 arm = middle.translation;
  for (int frame = 0; frame < frames; ++frame) {
    const double phase = 2.0 * std::numbers::pi * (frame % 100 < 20 ? frame - frame % 100 : frame) * speed;
    Pose pose;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.2 * std::sin(1.3 * phase), axis));
    pose.rotation = (turn * middle.rotation).normalized();
    pose.translation = arm + 0.03 * size * std::sin(phase) * direction;
    if (frame % 150 == 149) pose.translation += 0.2 * size * random_direction(random);
    poses.push_back(pose);
  }
  return poses;
}

/// Compares the coherent method at every pose of a path with truth and with a search from scratch.
/// @param most_work  node pairs over those from scratch
void expect_truth_along(const Scene& scene, double cutoff, const std::vector<Pose>& poses,
                        std::size_t& lmd_count, double most_work = 1.0) {
  Scene limited = scene;
  limited.cutoff = cutoff;
  CertifiedOptions from_scratch;
  from_scratch.frame_coherence = false;
  lmd_count = 0;
  Certified coherent(limited), scratch(limited, from_scratch);
  Exhaustive exhaustive(limited);
  LmdSet kept, fresh, truth;
  WorkCounters of_kept, of_fresh, of_truth;
  for (std::size_t frame = 0; frame < poses.size(); ++frame) {
    coherent.search(poses[frame], kept, of_kept);
    scratch.search(poses[frame], fresh, of_fresh);
    exhaustive.search(poses[frame], truth, of_truth);
    ASSERT_EQ(kept.size(), fresh.size()) << "frame " << frame;
    ASSERT_EQ(kept.size(), truth.size()) << "frame " << frame;
    lmd_count += truth.size();
    for (std::size_t i = 0; i < kept.size(); ++i) {
      ASSERT_TRUE(same_feature_pair(kept[i], truth[i])) << "frame " << frame;
      ASSERT_EQ(kept[i].point_moving, fresh[i].point_moving) << "frame " << frame;
      ASSERT_EQ(kept[i].point_fixed, fresh[i].point_fixed) << "frame " << frame;
      ASSERT_NEAR(kept[i].distance, truth[i].distance, 1e-12) << "frame " << frame;
    }
  }
  EXPECT_LT(static_cast<double>(of_kept[Certified::Counter::NODE_PAIRS]),
            most_work * static_cast<double>(of_fresh[Certified::Counter::NODE_PAIRS]));
}

void expect_truth_along(const Scene& scene, double cutoff, const std::vector<Pose>& poses) {
  std::size_t lmds = 0;
  expect_truth_along(scene, cutoff, poses, lmds);
  EXPECT_GT(lmds, poses.size() / 4);
}

void expect_truth_on_swings(const Scene& scene, std::uint64_t seed) {
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  const double size = bounding_box_diagonal(scene.fixed[0]->surface().mesh);
  std::size_t all = 0;  // a patch has LMDs on its outer side only
  for (const double speed : {0.0002, 0.001, 0.002, 0.01}) {
    const Pose pose = grazing_pose(scene, 0.01 * size, random);
    std::size_t lmds = 0;
    // Of the fastest swing hardly anything stands: what is made to be kept is an eighth on top.
    expect_truth_along(scene, 0.03 * size, swing(pose, size, speed, 200, random), lmds,
                       speed < 0.01 ? 1.0 : 1.125);
    all += lmds;
  }
  EXPECT_GT(all, 300u);
}

TEST(CertifiedCoherence, FindsTheTruthOnSwings) {
  expect_truth_on_swings(make_scene(make_blob(1.0, 0.3, 3), make_blob(0.8, 0.3, 3), 0.0), 1);
  expect_truth_on_swings(make_scene(make_torus(1.0, 0.4, 20, 10), make_patch(3.0, 10, 0.2), 0.0), 2);
  expect_truth_on_swings(make_scene(make_needles(0.5, 2.0, 20), make_unequal(1.0, 6, 50.0), 0.0), 3);
}

TEST(CertifiedCoherence, FindsTheTruthOnBoxesThatSlideInParallel) {
  const Scene scene = make_scene(make_box({1.0, 1.0, 1.0}, 3), make_box({1.0, 1.0, 1.0}, 2), 0.0);
  std::vector<Pose> poses;
  for (int frame = 0; frame < 400; ++frame) {
    Pose pose;
    pose.translation = {0.003 * frame, 0.0007 * frame, 1.05 - 0.0001 * frame};
    const double rock = std::max(0.0, 1e-3 * std::sin(0.05 * frame));
    pose.rotation = Eigen::AngleAxisd(rock, Vec3::UnitX());
    poses.push_back(pose);
  }
  expect_truth_along(scene, 0.1, poses);
}

TEST(CertifiedCoherence, FindsTheTruthThroughContactAndPenetration) {
  const Scene scene = make_scene(make_blob(1.0, 0.2, 2), make_box({1.0, 1.0, 1.0}, 3), 0.0);
  std::vector<Pose> poses;
  for (int frame = 0; frame < 300; ++frame) {
    Pose pose;
    pose.translation = {0.1, 0.2, 1.7 - 0.15 * (1.0 - std::cos(0.05 * frame)) - 0.0001 * frame};
    poses.push_back(pose);
  }
  expect_truth_along(scene, 0.1, poses);
}

TEST(CertifiedCoherence, FindsTheTruthWhereCoplanarFacesComeToTouch) {
  // No axis of the touch test lies in the common plane: only their exact distance shows that such
  // faces are apart.
  const Scene scene = make_scene(make_box({1.0, 1.0, 1.0}, 2), make_box({1.0, 1.0, 1.0}, 2), 0.0);
  std::vector<Pose> poses;
  for (int frame = 0; frame < 300; ++frame) {
    Pose pose;
    pose.translation = {1.1 - 0.0005 * frame, 0.0, 0.0};
    poses.push_back(pose);
  }
  expect_truth_along(scene, 0.02, poses);
}

TEST(CertifiedCoherence, AJumpLeavesNoWorkBehind) {
  Scene scene = make_scene(make_blob(1.0, 0.2, 4), make_blob(1.2, 0.3, 4), 0.1);
  std::mt19937_64 random(8);
  const Pose begin = grazing_pose(scene, 0.02, random);
  const Vec3 direction = random_direction(random);
  std::vector<Pose> slide(80, begin);
  for (std::size_t frame = 0; frame < slide.size(); ++frame)
    slide[frame].translation += 2e-4 * static_cast<double>(frame) * direction;
  Certified certified(scene);
  LmdSet lmds;
  const auto work_along_slide = [&] {
    WorkCounters counters;
    for (const Pose& pose : slide) certified.search(pose, lmds, counters);
    return counters[Certified::Counter::NODE_PAIRS] + counters[Certified::Counter::LEAF_PAIRS];
  };
  const std::uint64_t undisturbed = work_along_slide();
  Pose elsewhere = begin;
  elsewhere.translation += Vec3(0.0, 0.0, 1.0);
  WorkCounters ignored;
  certified.search(elsewhere, lmds, ignored);
  // The jump there and back must not count as a pace that continues.
  EXPECT_LE(work_along_slide(), undisturbed + undisturbed / 4);
}

TEST(CertifiedCoherence, NoFrameOfASmoothMotionIsMadeAnew) {
  // The largest coordinate passes 1: tolerances depend on it, but must not end kept results.
  const Scene scene = make_scene(make_blob(0.28, 0.02, 4), make_blob(0.28, 0.02, 4), 0.04);
  const Body &moving = *scene.moving, &fixed = scene.fixed_body();
  Certified coherent(scene), scratch(scene, {.frame_coherence = false});
  LmdSet ignored;
  std::uint64_t most_kept = 0, least_fresh = std::numeric_limits<std::uint64_t>::max();
  double least_coordinate = 2.0, largest_coordinate = 0.0;
  for (int frame = 0; frame < 300; ++frame) {
    const double angle = 0.25 * std::numbers::pi - 0.0025 * frame;
    const Pose pose{0.59 * Vec3(std::cos(angle), std::sin(angle), 0.0), Eigen::Quaterniond::Identity()};
    const double coordinate =
        ContactTolerance::of(moving, fixed, RigidTransform(pose), scene.cutoff).coordinates;
    least_coordinate = std::min(least_coordinate, coordinate);
    largest_coordinate = std::max(largest_coordinate, coordinate);
    WorkCounters of_kept, of_fresh;
    coherent.search(pose, ignored, of_kept);
    scratch.search(pose, ignored, of_fresh);
    if (frame < 10) continue;
    most_kept = std::max(most_kept, of_kept[Certified::Counter::NODE_PAIRS]);
    least_fresh = std::min(least_fresh, of_fresh[Certified::Counter::NODE_PAIRS]);
  }
  EXPECT_LT(least_coordinate, 0.95);
  EXPECT_GT(largest_coordinate, 1.05);
  EXPECT_LT(2 * most_kept, least_fresh);
}

/// Bounds of what is kept must hold beyond the size that both meshes had when they were made.
TEST(CertifiedCoherence, FindsTheTruthOfWhatMovesFarAwayWithinTheCutoff) {
  constexpr int SIDES = 15;
  TriangleMesh prism;
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < SIDES; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / SIDES;
      prism.vertices.emplace_back(0.3 * std::sin(angle), 2.0 * end - 1.0, 0.3 * std::cos(angle));
    }
  for (std::int32_t i = 0; i < SIDES; ++i) {
    const std::int32_t next = (i + 1) % SIDES;
    prism.triangles.push_back({i, next, i + SIDES});
    prism.triangles.push_back({next, next + SIDES, i + SIDES});
    if (next > 1) prism.triangles.push_back({0, next, i});
    if (next > 1) prism.triangles.push_back({SIDES, i + SIDES, next + SIDES});
  }
  const TriangleMesh small = make_sphere(0.2, 0);
  std::size_t found = 0, lmds = 0;
  for (const double aside : {0.6, 1.0})
    for (const bool prism_moves : {false, true}) {
      const Scene scene = prism_moves ? make_scene(prism, small, 10.0) : make_scene(small, prism, 10.0);
      std::vector<Pose> away;
      for (int k = 0; k < 24; ++k) {
        const Pose pose{Vec3(aside, 0.0, 0.4 * k), Eigen::Quaterniond::Identity()};
        away.push_back(prism_moves ? pose.inverse() : pose);
      }
      expect_truth_along(scene, 10.0, away, lmds, 1e3);
      found += lmds;
    }
  EXPECT_GE(found, 90u);
}

TEST(CertifiedCoherence, FindsTheTruthAtRandomPoses) {
  // There is no coherence: frames fall back to a search from scratch.
  const Scene scene = make_scene(make_blob(1.0, 0.3, 2), make_torus(1.0, 0.4, 20, 10), 0.0);
  std::mt19937_64 random(7);
  std::vector<Pose> poses;
  for (int i = 0; i < 30; ++i) poses.push_back(grazing_pose(scene, 0.02, random));
  std::size_t lmds = 0;
  expect_truth_along(scene, 0.1, poses, lmds, 2.0);
  EXPECT_GT(lmds, 30u);
}

TEST(CertifiedCoherence, FindsTheTruthUnderTremor) {
  // Forecasts are always wrong; the set must not depend on them.
  const Scene scene = make_scene(make_blob(1.0, 0.3, 2), make_torus(1.0, 0.4, 20, 10), 0.0);
  std::mt19937_64 random(9);
  std::vector<Pose> poses = swing(grazing_pose(scene, 0.02, random), 2.0, 0.001, 300, random);
  for (Pose& pose : poses) {
    pose.translation += 2e-3 * uniform(random) * random_direction(random);
    const Eigen::Quaterniond shake(Eigen::AngleAxisd(2e-3 * uniform(random), random_direction(random)));
    pose.rotation = (shake * pose.rotation).normalized();
  }
  expect_truth_along(scene, 0.1, poses);
}

TEST(CertifiedCoherence, FindsTheTruthWhereTheMotionTurnsRound) {
  // Long steady stretches make long plans; then the motion reverses.
  const Scene scene = make_scene(make_blob(1.0, 0.3, 3), make_blob(1.0, 0.2, 3), 0.0);
  std::mt19937_64 random(10);
  const Pose middle = grazing_pose(scene, 0.02, random);
  const Vec3 direction = random_direction(random), axis = random_direction(random);
  std::vector<Pose> poses;
  for (int frame = 0; frame < 400; ++frame) {
    const double along = std::abs(frame % 80 - 40.0);
    Pose pose;
    pose.translation = middle.translation + 1e-3 * along * direction;
    pose.rotation =
        (Eigen::Quaterniond(Eigen::AngleAxisd(2e-3 * along, axis)) * middle.rotation).normalized();
    poses.push_back(pose);
  }
  expect_truth_along(scene, 0.1, poses);
}

/// Centre and radius of a sphere round a feature.
std::pair<Vec3, double> body_of(const Surface& surface, const FeatureId& feature) {
  std::vector<Vec3> corners;
  const FeatureCorners vertices(surface, feature);
  for (const std::int32_t vertex : vertices.view())
    corners.push_back(surface.mesh.vertices[static_cast<std::size_t>(vertex)]);
  Vec3 centre = Vec3::Zero();
  for (const Vec3& corner : corners) centre += corner / static_cast<double>(corners.size());
  double radius = 0.0;
  for (const Vec3& corner : corners) radius = std::max(radius, (corner - centre).norm());
  return {centre, radius};
}

TEST(PairFilter, NothingIsAnLmdWhileTheRejectionStands) {
  const Scene scene = make_scene(make_blob(1.0, 0.4, 2), make_blob(1.0, 0.3, 2), 0.0);
  const Surface &moving = scene.moving->surface(), &fixed = scene.fixed[0]->surface();
  const auto& moving_shape = scene.moving->prepared<ShapeComplex>();
  const auto& fixed_shape = scene.fixed[0]->prepared<ShapeComplex>();
  const double cutoff = 0.3;
  std::mt19937_64 random(8);
  WideScratch scratch;
  std::size_t stood = 0, far = 0, ended = 0;
  for (int i = 0; i < 50; ++i) {
    const Pose pose = grazing_pose(scene, 0.05, random);
    const RigidTransform before(pose);
    // A large cutoff gives many pairs of every kind.
    const WideQuery query(scene.moving->prepared<WideHierarchy>(), scene.fixed[0]->prepared<WideHierarchy>(),
                          before, cutoff, 1e-9);
    WideCounters counters;
    find_wide_pairs(scene.moving->prepared<WideHierarchy>(), scene.fixed[0]->prepared<WideHierarchy>(), query,
                    WideKernel::VECTOR, scratch, counters);
    const ShapePair before_it(moving, moving_shape, fixed, fixed_shape, before, cutoff);
    const PairFilter first{before_it, cutoff, 1e-9, 1e-5, 1e-8};
    for (const WidePair& pair : scratch.lmd_pairs) {
      const auto [centre, radius] = body_of(moving, pair.a.feature_id());
      const PairAnswer answer = first(pair.a.feature_id(), pair.b.feature_id(), radius + 2.0 * cutoff);
      const Certificate& certificate = answer.certificate;
      if (answer.verdict != PairVerdict::NO_LMD || !(certificate.slack > 0.0)) continue;
      EXPECT_LE(certificate.gradient.norm(), 1.0 + 1e-9);
      for (int trial = 0; trial < 12; ++trial) {
        const double angle = 0.3 * uniform(random) * uniform(random) * uniform(random);
        Vec3 displacement = 0.5 * uniform(random) * uniform(random) * random_direction(random);
        // In half of the trials the motion uses no slack through the gradient, and may be long.
        if (trial % 2 == 0)
          displacement -= std::max(0.0, displacement.dot(certificate.gradient)) * certificate.gradient;
        const double left = certificate.slack - certificate.gradient.dot(displacement) -
                            certificate.spread * displacement.norm() - certificate.lever_arm * angle;
        Pose after = pose;
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, random_direction(random)));
        after.rotation = (turn * pose.rotation).normalized();
        after.translation = before.point(centre) + displacement - after.rotation * centre;
        const RigidTransform transform(after);
        ContactSet contacts;
        decide({moving, moving_shape, fixed, fixed_shape, transform, cutoff}, pair.a.feature_id(),
               pair.b.feature_id(), contacts);
        const bool is_lmd = !contacts.contacts.empty();
        if (left > 0.0 && angle < certificate.turn) {
          ASSERT_FALSE(is_lmd) << to_string(pair.a.feature_id().kind) << " "
                               << to_string(pair.b.feature_id().kind) << " slack " << certificate.slack
                               << " left " << left << " turn " << certificate.turn;
          ++stood;
          if (displacement.norm() > 1.5 * certificate.slack) ++far;
        } else if (is_lmd) {
          ++ended;
        }
      }
    }
  }
  EXPECT_GT(stood, 10000u);
  EXPECT_GT(far, 1000u);
  EXPECT_GT(ended, 20u);
}

}  // namespace
}  // namespace lmdbench
