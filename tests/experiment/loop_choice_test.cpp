// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/experiment.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/message_of.h>

#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Experiment parse_loop(const std::vector<Override>& overrides) {
  return parse_experiment(R"({"name": "small", "moving": {"mesh": "a"}, "fixed": [{"mesh": "b"}],
    "path": {"file": "p.tum"}, "force": {"cutoff_m": 0.01, "maximum_force_n": 2},
    "methods": [{"name": "certified", "force_law": "linear"}]})",
                          "/data/e.json", overrides);
}

std::string loop_message(const std::vector<Override>& overrides) {
  return testing::message_of<UsageError>([&] { parse_loop(overrides); });
}

TEST(LoopChoice, IsOpenUnlessAskedFor) {
  EXPECT_FALSE(parse_loop({}).loop.closed);
  EXPECT_TRUE(parse_loop({"/loop/kind=closed"}).loop.closed);
}

TEST(LoopChoice, DeviceFillsWhatTheFileLeavesOut) {
  const Experiment experiment =
      parse_loop({"/device=phantom-omni", "/loop/kind=closed", "/loop/mass_kg=0.1", "/loop/delay_frames=3"});
  EXPECT_EQ(experiment.loop.dynamics.mass_kg, 0.1);
  EXPECT_EQ(experiment.loop.dynamics.damping_n_s_per_m, 0.005);
  EXPECT_EQ(experiment.loop.dynamics.friction_n, 0.26);
  EXPECT_EQ(experiment.loop.resolution_m, 0.055e-3);
  EXPECT_EQ(experiment.loop.delay_frames, 3);
  EXPECT_FALSE(experiment.loop.dynamics.hand.has_value());
  const auto resolved = nlohmann::json::parse(experiment.resolved_json);
  EXPECT_EQ(resolved["loop"]["friction_n"], 0.26) << "the record holds what was used";
  EXPECT_EQ(resolved["loop"]["push_n"], nlohmann::json({0, 0, 0}));
}

TEST(LoopChoice, SixDegreesTakeWhatIsLeftOutFromTheTranslationAtALever) {
  EXPECT_FALSE(parse_loop({"/loop/kind=closed", "/device=ideal"}).loop.rotation.has_value());
  const Experiment experiment = parse_loop(
      {"/device=phantom-premium-1.5-6dof", "/loop/kind=closed", "/loop/actuated=6", "/loop/mass_kg=0.1",
       "/loop/hand=postural-arm", "/loop/rotation/lever_m=0.1", "/loop/rotation/damping_n_m_s=0.002"});
  const RotationChoice& rotation = experiment.loop.rotation.value();
  EXPECT_NEAR(rotation.dynamics.mass_kg, 0.1 * 0.01, 1e-18);
  EXPECT_EQ(rotation.dynamics.damping_n_s_per_m, 0.002);
  EXPECT_NEAR(rotation.dynamics.friction_n, 0.04 * 0.1, 1e-18);
  EXPECT_NEAR(rotation.resolution_rad, 0.03e-3 / 0.1, 1e-18);
  EXPECT_NEAR(rotation.dynamics.hand.value().mass_kg, 0.554 * 0.01, 1e-17);
  EXPECT_NEAR(rotation.dynamics.hand.value().damping_n_s_per_m, 6.45 * 0.01, 1e-16);
  EXPECT_NEAR(rotation.dynamics.hand.value().stiffness_n_per_m, 135.0 * 0.01, 1e-14);
  const auto resolved = nlohmann::json::parse(experiment.resolved_json);
  EXPECT_NEAR(resolved["loop"]["rotation"]["inertia_kg_m2"].get<double>(), 0.1 * 0.01, 1e-18);
}

TEST(LoopChoice, TurningHandIsNoneOrGivenByItsFigures) {
  const std::vector<Override> six{"/device=ideal", "/loop/kind=closed", "/loop/actuated=6",
                                  "/loop/hand=postural-arm"};
  const auto rotation = [&](const std::string& hand) {
    std::vector<Override> overrides = six;
    overrides.push_back("/loop/rotation/hand=" + hand);
    return parse_loop(overrides).loop.rotation.value().dynamics;
  };
  EXPECT_FALSE(rotation("null").hand.has_value());
  const Hand hand =
      rotation(R"({"inertia_kg_m2": 1e-3, "damping_n_m_s": 0.02, "stiffness_n_m": 2})").hand.value();
  EXPECT_EQ(hand.mass_kg, 1e-3);
  EXPECT_EQ(hand.damping_n_s_per_m, 0.02);
  EXPECT_EQ(hand.stiffness_n_per_m, 2.0);
  EXPECT_FALSE(hand.has_grip());
}

TEST(LoopChoice, SixDegreesNeedADeviceThatRendersTorque) {
  EXPECT_THAT(loop_message({"/device=phantom-desktop", "/loop/actuated=6"}),
              AllOf(HasSubstr("/loop/actuated"), HasSubstr("'phantom-desktop' renders no torque"),
                    HasSubstr("phantom-premium-1.5-6dof")));
  EXPECT_THAT(loop_message({"/device=ideal", "/loop/actuated=4"}), HasSubstr("/loop/actuated"));
  EXPECT_THAT(loop_message({"/device=ideal", "/loop/rotation/lever_m=0"}),
              HasSubstr("/loop/rotation/lever_m"));
}

TEST(LoopChoice, HandIsNamedOrGivenByItsFigures) {
  const Experiment named = parse_loop({"/loop/hand=speich-2005"});
  EXPECT_EQ(named.loop.dynamics.hand.value().grip_stiffness_n_per_m, 375.0);
  const Experiment custom = parse_loop({R"(/loop/hand={"mass_kg": 0.5, "stiffness_n_per_m": 100})"});
  EXPECT_EQ(custom.loop.dynamics.hand.value().mass_kg, 0.5);
  EXPECT_EQ(custom.loop.dynamics.hand.value().stiffness_n_per_m, 100.0);
  EXPECT_EQ(custom.loop.dynamics.hand.value().damping_n_s_per_m, 0.0);
  EXPECT_FALSE(custom.loop.dynamics.hand.value().has_grip());
}

TEST(LoopChoice, OldFilesMayNameTheExactIntegrator) {
  EXPECT_NO_THROW(parse_loop({"/loop/integrator=exact"}));
  EXPECT_THROW(parse_loop({"/loop/integrator=rosenbrock"}), UsageError);
}

TEST(LoopChoice, MistakesNamePlaceAndRemedy) {
  EXPECT_THAT(loop_message({"/loop/hand=hogarth"}), AllOf(HasSubstr("/loop/hand"), HasSubstr("hogan-1989")));
  EXPECT_THAT(loop_message({"/loop/hand={\"mass\": 1}"}),
              AllOf(HasSubstr("/loop/hand/mass"), HasSubstr("mass_kg")));
  EXPECT_THAT(loop_message({"/loop/hand={\"grip_stiffness_n_per_m\": 1}"}), HasSubstr("/loop/hand/mass_kg"));
  EXPECT_THAT(loop_message({"/loop/hand=3"}), HasSubstr("/loop/hand"));
  EXPECT_THAT(loop_message({"/loop/mass_kg=0"}), HasSubstr("/loop/mass_kg"));
  EXPECT_THAT(loop_message({"/loop/damping_n_s_per_m=-1"}), HasSubstr("/loop/damping_n_s_per_m"));
  EXPECT_THAT(loop_message({"/loop/delay_frames=1.5"}), HasSubstr("/loop/delay_frames"));
  EXPECT_THAT(loop_message({"/loop/push_n=[1, 2]"}), HasSubstr("/loop/push_n"));
}

TEST(ForceClip, IsTheDevicesUnlessAskedFor) {
  EXPECT_FALSE(parse_loop({}).profiles[0].clip_at_maximum);
  EXPECT_TRUE(parse_loop({"/force/clip=maximum"}).profiles[0].clip_at_maximum);
  EXPECT_THAT(loop_message({"/force/clip=none"}), HasSubstr("/force/clip"));
}

}  // namespace
}  // namespace lmdbench
