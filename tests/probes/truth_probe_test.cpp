// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>
#include <lmdbench/probes/fcl_probe.h>
#include <lmdbench/probes/truth_probe.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double PROBE_CUTOFF = 0.05;

/// Two spheres that approach along x, vertex to vertex.
Scene facing_spheres() {
  return testing::make_scene(make_sphere(0.5, 3), make_sphere(0.5, 3), PROBE_CUTOFF);
}

DriverInput approach(const std::vector<double>& gaps) {
  DriverInput input{.poses = {}, .device = VirtualPhantom(device_named("phantom-desktop")), .keep_lmds = {}};
  for (const double gap : gaps) {
    input.poses.push_back({Vec3(1.0 + gap, 0.0, 0.0)});
  }
  return input;
}

const ForceProfile PROFILE{ForceLaw::LINEAR, PROBE_CUTOFF, 0.0, 2.0, 4.0};

/// A record with the forces of the sets in every frame.
MethodRecord record_of(const std::vector<LmdSet>& sets, const std::vector<Vec3>& forces) {
  MethodRecord record;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    FrameRecord frame;
    frame.force = forces[i];
    record.frames.push_back(frame);
    record.lmds.emplace(static_cast<std::int64_t>(i), sets[i]);
  }
  return record;
}

TEST(ProbedFrames, StopBeforeTheLastFrame) {
  EXPECT_THAT(probed_frames(10, 3), ElementsAre(0, 3, 6));
  EXPECT_THAT(probed_frames(7, 3), ElementsAre(0, 3)) << "frame 6 has no next frame";
  EXPECT_THAT(probed_frames(10, 0), IsEmpty());
  EXPECT_THAT(probed_frames(1, 1), IsEmpty());
  EXPECT_THAT(probed_frames(10, 3, 3), ElementsAre(3, 6));
  EXPECT_THAT(probed_frames(10, 3, 4), ElementsAre(6)) << "the same grid, whatever comes first";
}

TEST(TruthProbe, TrueForceFollowsTheLawAndItsJumpTheNextFrame) {
  const DriverInput input = approach({0.04, 0.02, 1.0});
  const auto truth = probe_truth(facing_spheres(), input, PROFILE, sum_law(), {0, 1}, {});
  ASSERT_EQ(truth.size(), 2u);
  ASSERT_EQ(truth[0].lmds.size(), 1u);
  EXPECT_NEAR(truth[0].lmds[0].distance, 0.04, 1e-9);
  const auto linear = static_cast<std::size_t>(ForceLaw::LINEAR);
  const auto exponential = static_cast<std::size_t>(ForceLaw::EXPONENTIAL);
  EXPECT_NEAR(truth[0].force[linear].x(), 2.0 * 0.2, 1e-6) << "pushes the moving sphere away, towards +x";
  EXPECT_NEAR(truth[0].force_jump[linear], 2.0 * 0.4, 1e-6);
  EXPECT_LT(truth[0].force[exponential].x(), truth[0].force[linear].x());
  EXPECT_NEAR(truth[1].force_jump[linear], 2.0 * 0.6, 1e-6) << "everything is lost in the last frame";
}

TEST(TruthProbe, APerfectSetHasNoError) {
  const DriverInput input = approach({0.04, 0.02, 0.02});
  const Scene scene = facing_spheres();
  const auto truth = probe_truth(scene, input, PROFILE, sum_law(), {0, 1}, {});
  const auto linear = static_cast<std::size_t>(ForceLaw::LINEAR);
  const MethodRecord record =
      record_of({truth[0].lmds, truth[1].lmds, truth[1].lmds},
                {truth[0].force[linear], truth[1].force[linear], truth[1].force[linear]});
  const auto rows = compare_with_truth(truth, record, ForceLaw::LINEAR, &scene);
  for (const TruthComparison& row : rows) {
    EXPECT_EQ(row.same.recall(), 1.0);
    EXPECT_EQ(row.same.precision(), 1.0);
    EXPECT_EQ(row.neighbours.recall(), 1.0);
    EXPECT_EQ(row.minimum_distance_error, 0.0);
    EXPECT_EQ(row.force_error, 0.0);
    EXPECT_EQ(row.force_angle_error, 0.0);
  }
  EXPECT_NEAR(rows[0].force_jump, 2.0 * 0.4, 1e-6);
  EXPECT_EQ(rows[1].force_jump, 0.0);
}

TEST(TruthProbe, ErrorsAreSignedAndUnsetWhereNothingCompares) {
  const DriverInput input = approach({0.04, 0.02});
  const Scene scene = facing_spheres();
  const auto truth = probe_truth(scene, input, PROFILE, sum_law(), {0}, {});
  LmdSet late = truth[0].lmds;
  late[0].distance += 0.003;
  const Vec3 sideways(0.0, truth[0].force[static_cast<std::size_t>(ForceLaw::LINEAR)].x(), 0.0);
  const auto turned =
      compare_with_truth(truth, record_of({late, {}}, {sideways, Vec3::Zero()}), ForceLaw::LINEAR, &scene);
  EXPECT_NEAR(turned[0].minimum_distance_error, 0.003, 1e-12);
  EXPECT_NEAR(turned[0].force_angle_error, std::numbers::pi / 2.0, 1e-6);
  EXPECT_NEAR(turned[0].force_error, std::numbers::sqrt2 * sideways.y(), 1e-6);

  const auto lost =
      compare_with_truth(truth, record_of({{}, {}}, {Vec3::Zero(), Vec3::Zero()}), ForceLaw::LINEAR, &scene);
  EXPECT_EQ(lost[0].same.recall(), 0.0);
  EXPECT_TRUE(std::isnan(lost[0].same.precision()));
  EXPECT_TRUE(std::isnan(lost[0].minimum_distance_error));
  EXPECT_TRUE(std::isnan(lost[0].force_angle_error));
  EXPECT_NEAR(lost[0].force_error, sideways.y(), 1e-6);
}

TEST(TruthProbe, WhereTrianglesIntersectNoForceIsTheTrueOne) {
  const DriverInput input = approach({0.04, -0.1, 0.04});
  const Scene scene = facing_spheres();
  const auto truth = probe_truth(scene, input, PROFILE, sum_law(), {0, 1}, {});
  const auto linear = static_cast<std::size_t>(ForceLaw::LINEAR);
  EXPECT_NEAR(truth[0].force[linear].x(), 2.0 * 0.2, 1e-6);
  EXPECT_TRUE(std::isnan(truth[0].force_jump[linear]));
  EXPECT_GT(truth[1].contact_without_direction(), 0);
  for (const Vec3& unknown : {truth[1].force[linear], truth[1].torque[linear]})
    EXPECT_TRUE(unknown.array().isNaN().all()) << unknown;
  EXPECT_TRUE(std::isnan(truth[1].force_jump[linear]));
  const auto rows = compare_with_truth(
      truth, record_of({truth[0].lmds, truth[1].lmds, truth[0].lmds}, {3, Vec3(Vec3::UnitX())}),
      ForceLaw::LINEAR, &scene);
  EXPECT_NEAR(rows[0].force_error, 1.0 - truth[0].force[linear].x(), 1e-6);
  EXPECT_TRUE(std::isnan(rows[1].force_error)) << rows[1].force_error;
  EXPECT_TRUE(std::isnan(rows[1].force_angle_error)) << rows[1].force_angle_error;
}

TEST(TruthProbe, StopsWhenAsked) {
  const DriverInput input = approach({0.04, 0.02, 0.03});
  EXPECT_THROW(probe_truth(facing_spheres(), input, PROFILE, sum_law(), {0, 1},
                           [](std::int64_t, std::int64_t) { return false; }),
               Interrupted);
}

TEST(FclProbe, AgreesOnSpheresAndComparesOnlyWhereItMeansSomething) {
  const Scene scene = facing_spheres();
  const DriverInput input = approach({0.04, 0.06, -0.1, 0.01});  // within, beyond, contact, within
  const DrivenMethod improved{"improved", [scene] { return make_method("improved", scene); }, PROFILE};
  const auto checked = probe_fcl(scene, input, {improved}, {0, 1, 2}, 1e-6, {});
  const FclCheck& check = *checked;
  ASSERT_EQ(check.frames.size(), 3u);
  EXPECT_TRUE(check.exceptions.empty());
  for (const FclFrame& frame : check.frames) EXPECT_TRUE(frame.agrees) << frame.frame;
  EXPECT_TRUE(check.frames[0].separated);
  EXPECT_NEAR(check.frames[0].distance, 0.04, 1e-9);
  EXPECT_LE(std::abs(check.frames[0].method_difference[0]), 1e-6);
  EXPECT_TRUE(std::isnan(check.frames[1].method_difference[0])) << "beyond the cutoff";
  EXPECT_FALSE(check.frames[2].separated);
  EXPECT_EQ(check.frames[2].lmdbench_distance, 0.0);
  EXPECT_TRUE(std::isnan(check.frames[2].relative_difference)) << "in contact";
  EXPECT_TRUE(std::isnan(check.frames[2].method_difference[0]));
}

/// With tolerance 0 rounding alone is a disagreement, and is listed.
TEST(FclProbe, DisagreesBeyondTheTolerance) {
  const Scene scene = facing_spheres();
  DriverInput input = approach({0.04, 0.03, 0.02});
  for (Pose& pose : input.poses) pose.rotation = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized());
  const auto checked = probe_fcl(scene, input, {}, {0, 1, 2}, 0.0, {});
  const FclCheck& check = *checked;
  std::size_t differing = 0;
  for (const FclFrame& frame : check.frames) {
    EXPECT_TRUE(frame.separated);
    EXPECT_EQ(frame.agrees, frame.relative_difference == 0.0);
    differing += frame.agrees ? 0 : 1;
  }
  ASSERT_GT(differing, 0u) << "or the tolerance was not put to the test";
  EXPECT_EQ(check.exceptions.size(), differing);
  for (const FclException& exception : check.exceptions) EXPECT_EQ(exception.who, "lmdbench");
}

/// Has an empty set, or one pair that is too far away.
class WrongMethod : public Method {
 public:
  explicit WrongMethod(double distance, Promise promise = Promise::APPROXIMATION) : distance_(distance) {
    description_.name = "wrong";
    description_.promise = promise;
  }
  const MethodDescription& description() const override { return description_; }
  void search(const Pose&, LmdSet& lmds, WorkCounters&) override {
    lmds.clear();
    if (std::isnan(distance_)) return;
    Lmd lmd;
    lmd.distance = distance_;
    lmds.push_back(lmd);
  }
  void track(const Pose&, LmdSet&, WorkCounters&) override {}

 private:
  double distance_;
  MethodDescription description_;
};

TEST(FclProbe, AFrameAtThePoseOfTheOneBeforeHasItsAnswers) {
  const Scene scene = facing_spheres();
  const DriverInput input = approach({0.04, 0.04, 0.04, 0.03, 0.03});
  const DrivenMethod off{"off", [] { return std::make_unique<WrongMethod>(0.044); }, PROFILE};
  const auto reused_check = probe_fcl(scene, input, {off}, {0, 1, 2, 3, 4}, 1e-6, {});
  const FclCheck& reused = *reused_check;
  const auto fresh_check =
      probe_fcl(scene, input, {off}, {0, 1, 2, 3, 4}, 1e-6, {}, {.warm = true, .reuse_repeated = false});
  const FclCheck& fresh = *fresh_check;
  ASSERT_EQ(reused.frames.size(), 5u);
  ASSERT_EQ(reused.exceptions.size(), 5u) << "the method is wrong in every frame";
  ASSERT_EQ(fresh.exceptions.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(reused.frames[k].frame, fresh.frames[k].frame);
    EXPECT_EQ(reused.frames[k].distance, fresh.frames[k].distance);
    EXPECT_EQ(reused.frames[k].lmdbench_distance, fresh.frames[k].lmdbench_distance);
    EXPECT_EQ(reused.frames[k].method_difference, fresh.frames[k].method_difference);
    EXPECT_EQ(reused.exceptions[k].frame, static_cast<std::int64_t>(k));
    EXPECT_EQ(reused.exceptions[k].fcl_distance, fresh.exceptions[k].fcl_distance);
  }
}

TEST(TruthProbe, AFrameAtThePoseOfTheOneBeforeHasItsSet) {
  const DriverInput input = approach({0.04, 0.04, 0.02, 0.02, 0.04});  // frame 4 repeats 0, not 3
  const auto reused = probe_truth(facing_spheres(), input, PROFILE, sum_law(), {0, 1, 2, 3}, {});
  const auto fresh =
      probe_truth(facing_spheres(), input, PROFILE, sum_law(), {0, 1, 2, 3}, {}, nullptr, false);
  ASSERT_EQ(reused.size(), fresh.size());
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    ASSERT_EQ(reused[k].lmds.size(), fresh[k].lmds.size()) << k;
    EXPECT_EQ(minimum_distance(reused[k].lmds), minimum_distance(fresh[k].lmds)) << k;
    EXPECT_EQ(reused[k].force, fresh[k].force) << k;
    EXPECT_EQ(reused[k].force_jump, fresh[k].force_jump) << k;
  }
  EXPECT_EQ(reused[0].force_jump[0], 0.0);
  EXPECT_GT(reused[1].force_jump[0], 0.0);
}

TEST(FclProbe, ListsExceptionsWithTheirPoses) {
  const Scene scene = facing_spheres();
  const DriverInput input = approach({0.04, 0.03});
  const DrivenMethod blind{"blind", [] { return std::make_unique<WrongMethod>(std::nan("")); }, PROFILE};
  const DrivenMethod off{"off", [] { return std::make_unique<WrongMethod>(0.044); }, PROFILE};
  const auto checked = probe_fcl(scene, input, {blind, off}, {0}, 1e-6, {});
  const FclCheck& check = *checked;
  EXPECT_EQ(check.frames[0].method_difference[0], std::numeric_limits<double>::infinity()) << "found no pair";
  EXPECT_NEAR(check.frames[0].method_difference[1], 0.1, 1e-6);
  ASSERT_EQ(check.exceptions.size(), 2u);
  EXPECT_EQ(check.exceptions[0].who, "blind");
  EXPECT_EQ(check.exceptions[1].who, "off");
  EXPECT_EQ(check.exceptions[1].pose.translation, input.poses[0].translation);
  EXPECT_EQ(check.exceptions[1].distance, 0.044);
  EXPECT_NEAR(check.exceptions[1].fcl_distance, 0.04, 1e-9);
}

/// Whether a method with this promise and nearest distance is an error in the first frame.
bool is_error(const Scene& scene, const DriverInput& input, double distance,
              Promise promise = Promise::COMPLETE_SET) {
  const DrivenMethod method{"m", [=] { return std::make_unique<WrongMethod>(distance, promise); }, PROFILE};
  const auto check = probe_fcl(scene, input, {method}, {0}, 1e-6, {});
  return std::ranges::any_of(check->exceptions, &FclException::is_error);
}

TEST(FclProbe, AWrongNearestDistanceIsAnErrorOfWhoPromisesTheCompleteSet) {
  const double none = std::nan("");
  const Scene scene = facing_spheres();
  const DriverInput apart = approach({0.04});
  EXPECT_FALSE(is_error(scene, apart, 0.04 + 1e-10)) << "within what contacts of one LMD may differ by";
  EXPECT_TRUE(is_error(scene, apart, 0.04 + 1e-6)) << "farther than the nearest pair";
  EXPECT_TRUE(is_error(scene, apart, 0.04 - 1e-6)) << "nearer than the nearest pair";
  EXPECT_TRUE(is_error(scene, apart, none));
  for (const Promise promise : {Promise::APPROXIMATION, Promise::NEAREST_PAIR})
    EXPECT_FALSE(is_error(scene, apart, none, promise));
  EXPECT_FALSE(is_error(scene, approach({0.06}), none)) << "beyond the cutoff";

  // Gaps at which FCL sees a contact and compares no distance.
  for (const double gap : {-0.1, 0.0, 1e-16, 1e-12}) {
    EXPECT_TRUE(is_error(scene, approach({gap}), 0.0043)) << gap;
    EXPECT_TRUE(is_error(scene, approach({gap}), none)) << gap;
    EXPECT_FALSE(is_error(scene, approach({gap}), 0.0)) << gap;
  }
  // The distance of floor and wall joined to one LMD, their mean.
  EXPECT_TRUE(is_error(scene, approach({1e-9}), 5.0005e-6));
}

TEST(FclProbe, ANearestPairThatIsNoLmdOwesNone) {
  const double none = std::nan("");
  DriverInput input = approach({0.0});
  input.poses[0].translation = Vec3(0.47, 0.0, 0.0);
  const Scene inside = testing::make_scene(make_sphere(0.5, 3), make_sphere(1.0, 3), PROBE_CUTOFF);
  EXPECT_FALSE(is_error(inside, input, none)) << "one lies inside the other";
  EXPECT_TRUE(is_error(inside, input, 0.01)) << "but nothing is nearer than the nearest pair";
  input.poses[0].translation = Vec3(0.5 - 1e-14, 0.0, 0.0);
  EXPECT_FALSE(is_error(inside, input, none)) << "inside, at rest";
  input.poses[0].translation = Vec3(0.5, 0.0, 0.0);
  EXPECT_TRUE(is_error(inside, input, none)) << "triangles that share a point are a contact";
}

/// Boxes in turned frames, face on face, gaps of rounding and more: FCL, truth and methods agree.
TEST(FclProbe, WhoIsRightAtRestIsNoError) {
  const TriangleMesh box = make_box(Vec3(1.0, 0.6, 0.2));
  const Scene scene = testing::make_scene(box, box, PROBE_CUTOFF);
  std::size_t poses = 0;
  for (const double gap : {0.0, 1e-16, 1e-12, 1e-9, 1e-6, 1e-3}) {
    for (int turn = 0; turn < 8; ++turn) {
      DriverInput input = approach({0.0});
      Pose& pose = input.poses[0];
      pose.rotation = Eigen::AngleAxisd(0.1 * turn, Vec3::UnitZ());
      pose.translation = Vec3(0.1 * turn, 0.03, 0.2 + gap);
      for (const char* name : {"certified", "exhaustive"}) {
        const DrivenMethod method{name, [&] { return make_method(name, scene); }, PROFILE};
        const auto check = probe_fcl(scene, input, {method}, {0}, 1e-6, {});
        for (const FclException& e : check->exceptions)
          EXPECT_FALSE(e.is_error) << name << " gap " << gap << " turn " << turn << ": " << e.distance
                                   << ", FCL " << e.fcl_distance << ", exact " << e.lmdbench_distance;
        ++poses;
      }
    }
  }
  EXPECT_EQ(poses, 96u);
}

}  // namespace
}  // namespace lmdbench
