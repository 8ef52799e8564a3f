// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/motion/path_spec.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>

#include <numbers>
#include <optional>
#include <string>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;

const std::string SPEC = R"({
  "moving": { "mesh": "bunny-16k", "diagonal_m": 0.15 },
  "fixed": { "mesh": "armadillo", "diagonal_m": 0.2 },
  "frame_rate_hz": 2000,
  "stored_rate_hz": 250,
  "seed": 7,
  "start_direction": [0, 3, -4],
  "slide_rate_deg_per_s": 18,
  "turn_rate_deg_per_s": 36,
  "radial_speed_m_per_s": 0.15,
  "radial_acceleration_m_per_s2": 2,
  "gap_floor": 0.0002,
  "gaps": [ { "time_s": 0, "gap": 0.1 }, { "time_s": 1.5, "gap": 0.001 } ]
})";

std::string with(const std::string& from, const std::string& to) {
  std::string text = SPEC;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string spec_complaint(const std::string& text) {
  const std::string complaint = testing::message_of<UsageError>([&] { parse_path_spec(text, "spec.json"); });
  EXPECT_THAT(complaint, HasSubstr("remedy: "));
  return complaint;
}

TEST(PathSpec, ReadsEveryKey) {
  const PathSpec spec = parse_path_spec(SPEC, "spec.json");
  EXPECT_EQ(spec.moving.mesh, "bunny-16k");
  EXPECT_EQ(spec.moving.placement.diagonal, 0.15);
  EXPECT_EQ(spec.fixed.mesh, "armadillo");
  EXPECT_EQ(spec.fixed.placement.diagonal, 0.2);
  EXPECT_EQ(spec.frame_rate, 2000.0);
  EXPECT_EQ(spec.stored_rate, 250.0);
  EXPECT_EQ(spec.seed, 7u);
  EXPECT_TRUE(spec.start_direction.isApprox(Vec3(0, 0.6, -0.8), 1e-15));
  EXPECT_NEAR(spec.slide_rate, std::numbers::pi / 10.0, 1e-15);
  EXPECT_NEAR(spec.turn_rate, std::numbers::pi / 5.0, 1e-15);
  EXPECT_EQ(spec.radial_speed, 0.15);
  EXPECT_EQ(spec.radial_acceleration, 2.0);
  EXPECT_EQ(spec.gap_floor, 0.0002);
  ASSERT_EQ(spec.gaps.size(), 2u);
  EXPECT_EQ(spec.gaps[1].time, 1.5);
  EXPECT_EQ(spec.gaps[1].gap, 0.001);
  EXPECT_EQ(spec.duration(), 1.5);
}

TEST(PathSpec, TwoMeshesAreEnough) {
  const PathSpec spec =
      parse_path_spec(R"({ "moving": { "mesh": "a.stl" }, "fixed": { "mesh": "b.stl" } })", "spec.json");
  EXPECT_EQ(spec.moving.mesh, "a.stl");
  EXPECT_EQ(spec.moving.placement.diagonal, std::nullopt);
  EXPECT_EQ(spec.frame_rate, 1000.0);
  EXPECT_EQ(spec.stored_rate, 1000.0);
  EXPECT_EQ(spec.start_direction, Vec3::UnitX());
  EXPECT_EQ(spec.seed, 1u);
  EXPECT_NEAR(spec.slide_rate, std::numbers::pi / 6.0, 1e-15);
  // The recorded paths' limits, 0.15 m/s and 3 m/s^2 for 0.15 m, at ten times the size.
  EXPECT_NEAR(spec.radial_limits(1.5).speed, 1.5, 1e-15);
  EXPECT_NEAR(spec.radial_limits(1.5).acceleration, 30.0, 1e-14);
  ASSERT_GE(spec.gaps.size(), 2u);
  for (const GapPoint& point : spec.gaps) EXPECT_GT(point.gap, spec.gap_floor);
  EXPECT_EQ(spec.duration(), 3.0);
}

TEST(PathSpec, WhatIsGivenReplacesTheDefaultLimits) {
  const MotionLimits limits = parse_path_spec(SPEC, "spec.json").radial_limits(7.0);
  EXPECT_EQ(limits.speed, 0.15);
  EXPECT_EQ(limits.acceleration, 2.0);
}

TEST(PathSpec, ComplaintsNameThePlace) {
  EXPECT_THAT(spec_complaint("{"), HasSubstr("spec.json: line 1, column 2: not JSON"));
  EXPECT_THAT(spec_complaint("[]"), HasSubstr("spec.json: / (line 1): "));
  EXPECT_THAT(spec_complaint(with("\"seed\"", "\"sead\"")),
              HasSubstr("spec.json: /sead (line 6): unknown key \"sead\" (remedy: did you mean \"seed\"?)"));
  EXPECT_THAT(spec_complaint(with("\"seed\": 7", "\"seed\": -7")), HasSubstr("/seed (line 6): "));
  EXPECT_THAT(spec_complaint(with("\"seed\": 7", "\"seed\": 1.5")), HasSubstr("/seed (line 6): "));
  EXPECT_THAT(spec_complaint(with("\"mesh\": \"armadillo\",", "")), HasSubstr("/fixed (line 3): "));
  EXPECT_THAT(spec_complaint(with("\"armadillo\"", "3")), HasSubstr("/fixed/mesh (line 3): "));
  EXPECT_THAT(spec_complaint(with("\"armadillo\"", "\"armadillo\", \"size\": 2")),
              HasSubstr("/fixed/size (line 3): unknown key"));
  EXPECT_THAT(spec_complaint(with("0.2 }", "0 }")), HasSubstr("/fixed/diagonal_m (line 3): "));
  EXPECT_THAT(spec_complaint(with("0.2 }", "\"0.2\" }")), HasSubstr("/fixed/diagonal_m (line 3): "));
  EXPECT_THAT(spec_complaint(with("250", "300")), HasSubstr("/stored_rate_hz (line 5): 300 does not divide"));
  EXPECT_THAT(spec_complaint(with("250", "4000")),
              HasSubstr("/stored_rate_hz (line 5): 4000 does not divide"));
  EXPECT_THAT(spec_complaint(with("[0, 3, -4]", "[0, 0, 0]")),
              HasSubstr("/start_direction (line 7): is not a direction"));
  EXPECT_THAT(spec_complaint(with("[0, 3, -4]", "[1, 0]")), HasSubstr("/start_direction (line 7): "));
  EXPECT_THAT(spec_complaint(with(": 18", ": -1")), HasSubstr("/slide_rate_deg_per_s (line 8): "));
  EXPECT_THAT(spec_complaint(with("0.0002", "1e999")), HasSubstr("out of range"));
  EXPECT_THAT(spec_complaint(with("\"time_s\": 0,", "\"time_s\": 0.5,")),
              HasSubstr("/gaps/0/time_s (line 13): the first time is not 0"));
  EXPECT_THAT(spec_complaint(with("\"time_s\": 1.5,", "\"time_s\": 0,")),
              HasSubstr("/gaps/1/time_s (line 13): 0 does not lie after 0"));
  EXPECT_THAT(spec_complaint(with("\"gap\": 0.001", "\"gap\": 0.0002")),
              HasSubstr("/gaps/1/gap (line 13): 0.0002 is not above gap_floor"));
  EXPECT_THAT(spec_complaint(with("\"gap\": 0.001", "\"gap\": 1.1e6")), HasSubstr("/gaps/1/gap (line 13): "));
  EXPECT_THAT(spec_complaint(with("\"gap\": 0.001", "\"gap\": 0.001, \"x\": 1")),
              HasSubstr("/gaps/1/x (line 13): unknown key"));
  EXPECT_THAT(spec_complaint(with(", { \"time_s\": 1.5, \"gap\": 0.001 }", "")),
              HasSubstr("/gaps (line 13): "));
}

TEST(PathSpec, MissingFileIsNamed) {
  EXPECT_THROW(read_path_spec("no/such/spec.json"), UsageError);
}

}  // namespace
}  // namespace lmdbench
