// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/contact_work.h>
#include <lmdbench/motion/rotation_vector.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

/// A mesh whose point q_M hangs on a spring, while it is drawn and turned along a way.
struct OnASpring {
  static constexpr double STIFFNESS = 300.0;
  static constexpr int FRAMES = 4000;
  const Vec3 q_M{0.03, 0.01, -0.02}, centre_M{0.005, -0.01, 0.002}, anchor_W{0.05, 0.02, 0.01};
  MethodRecord record;
  double stored_at_first = 0.0, stored_at_last = 0.0;

  OnASpring() {
    double rendered = 0.0;
    for (int i = 0; i < FRAMES; ++i) {
      const Pose now = pose(i), next = pose(i + 1);
      const Vec3 q_W = RigidTransform(now).point(q_M);
      FrameRecord frame;
      frame.force = STIFFNESS * (anchor_W - q_W);
      frame.torque = (q_W - RigidTransform(now).point(centre_M)).cross(frame.force);
      record.frames.push_back(frame);
      LoopFrame loop;
      loop.position = now.translation;
      loop.orientation = now.rotation;
      loop.energy.rendered = rendered;
      record.loop.push_back(loop);
      rendered += frame.force.dot(next.translation - now.translation);
      stored_at_last = 0.5 * STIFFNESS * (anchor_W - q_W).squaredNorm();
      if (i == 0) stored_at_first = stored_at_last;
    }
  }

  static Pose pose(int frame) {
    const double s = static_cast<double>(frame) / FRAMES;
    return {Vec3(0.02 * s, 0.01 * std::sin(5.0 * s), -0.01 * s), rotation_of(Vec3(0.3, 1.0, -0.7) * s)};
  }
};

TEST(ContactWork, ASpringGivesWhatItStoredHoweverThePathTurnsTheMesh) {
  const OnASpring spring;
  ContactPorts ports;
  ports.turned_about_M = spring.centre_M;
  const std::vector<double> work = contact_work(spring.record, ports);
  ASSERT_EQ(work.size(), spring.record.loop.size());
  EXPECT_EQ(work.front(), 0.0);
  const double given = spring.stored_at_first - spring.stored_at_last;
  EXPECT_NEAR(work.back(), given, 1e-3 * spring.stored_at_first);
  EXPECT_GT(std::abs(spring.record.loop.back().energy.rendered - given), 0.1 * spring.stored_at_first)
      << "the device alone does not feel what the turn takes";
}

TEST(ContactWork, OfADeviceThatTurnsTheMeshIsTheDevices) {
  const OnASpring spring;
  EXPECT_EQ(contact_work(spring.record, {}).back(), spring.record.loop.back().energy.rendered);
  EXPECT_TRUE(contact_work(spring.record, {.others_move = true}).empty());
}

}  // namespace
}  // namespace lmdbench
