// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/motion/path_spec.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace lmdbench {
namespace {

using testing::HasSubstr;

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

std::string complaint_about(const std::string& text) {
  try {
    parse_path_spec(text, "spec.json");
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("remedy: "));
    return error.what();
  }
  return "";
}

TEST(PathSpec, ReadsEveryKey) {
  const PathSpec spec = parse_path_spec(SPEC, "spec.json");
  EXPECT_EQ(spec.moving.mesh, "bunny-16k");
  EXPECT_EQ(spec.moving.diagonal, 0.15);
  EXPECT_EQ(spec.fixed.mesh, "armadillo");
  EXPECT_EQ(spec.fixed.diagonal, 0.2);
  EXPECT_EQ(spec.frame_rate, 2000.0);
  EXPECT_EQ(spec.stored_rate, 250.0);
  EXPECT_EQ(spec.seed, 7u);
  EXPECT_TRUE(spec.start_direction.isApprox(Vec3(0, 0.6, -0.8), 1e-15));
  EXPECT_NEAR(spec.slide_rate, std::numbers::pi / 10.0, 1e-15);
  EXPECT_NEAR(spec.turn_rate, std::numbers::pi / 5.0, 1e-15);
  EXPECT_EQ(spec.radial_limits.speed, 0.15);
  EXPECT_EQ(spec.radial_limits.acceleration, 2.0);
  EXPECT_EQ(spec.gap_floor, 0.0002);
  ASSERT_EQ(spec.gaps.size(), 2u);
  EXPECT_EQ(spec.gaps[1].time, 1.5);
  EXPECT_EQ(spec.gaps[1].gap, 0.001);
  EXPECT_EQ(spec.duration(), 1.5);
}

TEST(PathSpec, DefaultsAreFilled) {
  std::string text = with("\"frame_rate_hz\": 2000,", "");
  text.erase(text.find("  \"stored_rate_hz\": 250,"), 25);
  const std::string direction = "\"start_direction\": [0, 3, -4],";
  text.erase(text.find(direction), direction.size());
  const PathSpec spec = parse_path_spec(text, "spec.json");
  EXPECT_EQ(spec.frame_rate, 1000.0);
  EXPECT_EQ(spec.stored_rate, 1000.0);
  EXPECT_EQ(spec.start_direction, Vec3::UnitX());
}

TEST(PathSpec, ComplaintsNameThePlace) {
  EXPECT_THAT(complaint_about("{"), HasSubstr("spec.json: line 1, column 2: not JSON"));
  EXPECT_THAT(complaint_about("[]"), HasSubstr("spec.json: /: is not an object"));
  EXPECT_THAT(complaint_about(with("\"seed\"", "\"sede\"")), HasSubstr("spec.json: /seed: is missing"));
  EXPECT_THAT(complaint_about(with("\"seed\": 7", "\"seed\": 7, \"sede\": 8")),
              HasSubstr("spec.json: /sede: is not a known key"));
  EXPECT_THAT(complaint_about(with("\"seed\": 7", "\"seed\": -7")),
              HasSubstr("/seed: is not a whole number"));
  EXPECT_THAT(complaint_about(with("\"seed\": 7", "\"seed\": 1.5")),
              HasSubstr("/seed: is not a whole number"));
  EXPECT_THAT(complaint_about(with("\"mesh\": \"armadillo\",", "")), HasSubstr("/fixed/mesh: is missing"));
  EXPECT_THAT(complaint_about(with("\"armadillo\"", "3")), HasSubstr("/fixed/mesh: is not a text"));
  EXPECT_THAT(complaint_about(with("\"armadillo\"", "\"armadillo\", \"scale\": 2")),
              HasSubstr("/fixed/scale: is not a known key"));
  EXPECT_THAT(complaint_about(with("0.2 }", "0 }")), HasSubstr("/fixed/diagonal_m: 0 is not above 0"));
  EXPECT_THAT(complaint_about(with("0.2 }", "\"0.2\" }")), HasSubstr("/fixed/diagonal_m: is not a number"));
  EXPECT_THAT(complaint_about(with("250", "300")), HasSubstr("/stored_rate_hz: 300 does not divide"));
  EXPECT_THAT(complaint_about(with("250", "4000")), HasSubstr("/stored_rate_hz: 4000 does not divide"));
  EXPECT_THAT(complaint_about(with("[0, 3, -4]", "[0, 0, 0]")),
              HasSubstr("/start_direction: is not a direction"));
  EXPECT_THAT(complaint_about(with("[0, 3, -4]", "[1, 0]")),
              HasSubstr("/start_direction: is not a direction"));
  EXPECT_THAT(complaint_about(with(": 18", ": -1")), HasSubstr("/slide_rate_deg_per_s: -1 is below 0"));
  EXPECT_THAT(complaint_about(with("0.0002", "1e999")), HasSubstr("spec.json: a number is out of range"));
  EXPECT_THAT(complaint_about(with("\"time_s\": 0,", "\"time_s\": 0.5,")),
              HasSubstr("/gaps/0/time_s: the first time is not 0"));
  EXPECT_THAT(complaint_about(with("\"time_s\": 1.5,", "\"time_s\": 0,")),
              HasSubstr("/gaps/1/time_s: 0 does not lie after 0"));
  EXPECT_THAT(complaint_about(with("\"gap\": 0.001", "\"gap\": 0.0002")),
              HasSubstr("/gaps/1/gap: 0.0002 is not above gap_floor"));
  EXPECT_THAT(complaint_about(with("\"gap\": 0.001", "\"gap\": 0.001, \"x\": 1")),
              HasSubstr("/gaps/1/x: is not a known key"));
  EXPECT_THAT(complaint_about(with(", { \"time_s\": 1.5, \"gap\": 0.001 }", "")),
              HasSubstr("/gaps: is not a list of at least two points"));
}

TEST(PathSpec, MissingFileIsNamed) {
  EXPECT_THROW(read_path_spec("no/such/spec.json"), InputError);
}

}  // namespace
}  // namespace lmdbench
