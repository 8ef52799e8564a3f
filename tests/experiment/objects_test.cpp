// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/experiment.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>

#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::message_of;

Experiment scene_of(const std::string& keys) {
  return parse_experiment("{" + keys + R"(,"force":{"cutoff_m":0.01}})", "/data/e.json");
}

std::string message(const std::string& keys) {
  return message_of<UsageError>([&] { scene_of(keys); });
}

constexpr const char* PEG = R"({"name":"peg","mesh":"peg.stl","motion":{"path":"p.tum","gap_intervals":3}})";
constexpr const char* HOLE = R"({"mesh":"hole.stl","pose":{"translation_m":[1,2,3]}})";
constexpr const char* BALL =
    R"({"name":"ball","mesh":"ball","motion":{"sway":{"way_diagonals":0.3}},"instances":{"rule":"random","count":2}})";

std::string objects(const std::vector<std::string>& entries) {
  std::string list;
  for (const std::string& entry : entries) list += (list.empty() ? "" : ",") + entry;
  return R"("objects":[)" + list + "]";
}

TEST(Objects, EachHasItsMotionNameAndRole) {
  const Experiment experiment = scene_of(objects({PEG, BALL, HOLE}));
  ASSERT_EQ(experiment.objects.size(), 3u);
  const ObjectChoice &peg = experiment.held(), &ball = experiment.objects[1], &hole = experiment.objects[2];
  EXPECT_EQ(peg.motion.kind, MotionKind::HELD);
  EXPECT_EQ(peg.motion.path_file, "/data/p.tum");
  EXPECT_EQ(peg.motion.gap_intervals, 3.0);
  EXPECT_EQ(peg.name, "peg");
  EXPECT_EQ(peg.role, "moving");
  EXPECT_EQ(ball.motion.kind, MotionKind::SWAYS);
  EXPECT_EQ(ball.motion.sway.way_diagonals, 0.3);
  EXPECT_EQ(ball.motion.sway.turn_rad, Sway().turn_rad);
  EXPECT_EQ(ball.role, "mover_0");
  EXPECT_TRUE(ball.instances.has_value());
  EXPECT_TRUE(hole.stands());
  EXPECT_EQ(hole.name, "fixed_0") << "its role, where it has no name";
  EXPECT_EQ(hole.pose.translation, Vec3(1, 2, 3));
  EXPECT_EQ(hole.place, "/objects/2");
  EXPECT_TRUE(experiment.several_move());
  EXPECT_FALSE(experiment.is_world()) << "instances that move are no world";
}

TEST(Objects, TheOtherKeysSayTheSame) {
  const Experiment experiment = scene_of(
      R"("moving":{"mesh":"peg.stl"},"fixed":[{"mesh":"hole.stl"}],"path":{"file":"p.tum","gap_intervals":3},)"
      R"("movers":[{"mesh":"ball","path":{"file":"q.tum"}}])");
  ASSERT_EQ(experiment.objects.size(), 3u);
  EXPECT_EQ(experiment.held().motion.path_file, "/data/p.tum");
  EXPECT_EQ(experiment.held().motion.gap_intervals, 3.0);
  EXPECT_EQ(experiment.objects[1].role, "fixed_0");
  EXPECT_EQ(experiment.objects[1].place, "/fixed/0");
  EXPECT_EQ(experiment.objects[2].motion.kind, MotionKind::PATH);
  EXPECT_EQ(experiment.objects[2].motion.path_file, "/data/q.tum");
  EXPECT_EQ(experiment.objects[2].motion.path_place, "/movers/0/path/file");
}

TEST(Objects, TheHeldOneMayFollowThePathOfTheFile) {
  const Experiment experiment = scene_of(objects({R"({"mesh":"a"})", HOLE}) + R"(,"path":{"file":"p.tum"})");
  EXPECT_EQ(experiment.held().motion.path_file, "/data/p.tum");
  const Experiment made = scene_of(objects({R"({"mesh":"a"})", HOLE}));
  EXPECT_TRUE(made.held().motion.path_file.empty());
  // Probes of a first look at two meshes are closer together than those of a scene with a path.
  EXPECT_EQ(scene_of(objects({PEG, HOLE})).probe_stride("truth"), experiment.probe_stride("truth"));
  EXPECT_NE(made.probe_stride("truth"), experiment.probe_stride("truth"));
}

TEST(Objects, AreReadBackAsTheyWereResolved) {
  const Experiment experiment = scene_of(objects({PEG, BALL, HOLE}));
  const Experiment again = parse_experiment(experiment.resolved_json, "/data/e.json");
  EXPECT_EQ(again.resolved_json, experiment.resolved_json);
  EXPECT_EQ(again.held().motion.path_file, experiment.held().motion.path_file);
}

TEST(Objects, AnOverrideInsideOfAWayToMoveTakesThePlaceOfTheOther) {
  const std::string text = "{" + objects({PEG, BALL, R"({"mesh":"b","motion":{"path":"q.tum"}})", HOLE}) +
                           R"(,"force":{"cutoff_m":0.01}})";
  const Experiment experiment =
      parse_experiment(text, "/data/e.json", {"/objects/2/motion/sway/period_s=0.1"});
  EXPECT_EQ(experiment.objects[2].motion.kind, MotionKind::SWAYS);
  EXPECT_EQ(experiment.notes.size(), 1u);
  EXPECT_THROW(parse_experiment(text, "/data/e.json",
                                {"/objects/2/motion/sway/period_s=0.1", "/objects/2/motion/path=r.tum"}),
               UsageError);
}

TEST(Objects, AnOverrideDoesNotTurnOneFormOfASceneIntoTheOther) {
  EXPECT_THAT(message_of<UsageError>([] {
                parse_experiment(
                    R"({"moving":{"mesh":"a"},"fixed":[{"mesh":"b"}],"force":{"cutoff_m":0.01}})",
                    "/data/e.json", {"/objects/0/mesh=c"});
              }),
              HasSubstr("exclude each other"));
}

TEST(Objects, WhatDoesNotGoTogetherNamesThePlace) {
  EXPECT_THAT(message(objects({PEG, HOLE}) + R"(,"moving":{"mesh":"a"})"),
              HasSubstr("\"moving\" and \"objects\" exclude each other"));
  EXPECT_THAT(message(objects({PEG, HOLE}) + R"(,"movers":[])"),
              HasSubstr("\"movers\" and \"objects\" exclude each other"));
  EXPECT_THAT(message(objects({PEG, HOLE}) + R"(,"path":{"file":"p.tum"})"),
              AllOf(HasSubstr("/path"), HasSubstr("motion")));
  EXPECT_THAT(message(R"("moving":{"mesh":"a"})"), HasSubstr("Missing required property 'fixed'"));
  EXPECT_THAT(message(objects({PEG, R"({"mesh":"b","motion":{"path":"q.tum","sway":{}}})", HOLE})),
              AllOf(HasSubstr("/objects/1/motion"), HasSubstr("\"path\" and \"sway\" exclude each other")));
  EXPECT_THAT(message(objects({PEG, R"({"mesh":"b","motion":{"sway":{},"interpolation":"linear"}})", HOLE})),
              HasSubstr("\"interpolation\" and \"sway\" exclude each other"));
  EXPECT_THAT(message(objects({PEG, R"({"mesh":"b","motion":{"sway":{},"gap_intervals":5}})", HOLE})),
              HasSubstr("\"gap_intervals\" and \"sway\" exclude each other"));
  EXPECT_THAT(message(objects({PEG, R"({"mesh":"b","motion":{}})", HOLE})), HasSubstr("/objects/1/motion"));
  EXPECT_THAT(message(objects({R"({"mesh":"b","motion":{"sway":{}}})", HOLE})),
              HasSubstr("/objects/0/motion/sway"));
  EXPECT_THAT(message(objects({R"({"mesh":"b","pose":{"translation_m":[1,0,0]}})", HOLE})),
              HasSubstr("/objects/0/pose"));
  EXPECT_THAT(message(objects({R"({"mesh":"b","instances":{"rule":"random","count":2}})", HOLE})),
              HasSubstr("/objects/0/instances"));
  EXPECT_THAT(
      message(objects({PEG, R"({"mesh":"b","instances":{"rule":"grid","counts":[2,2,1],"count":7}})"})),
      AllOf(HasSubstr("/objects/1/instances"), HasSubstr("has no \"count\", only \"counts\"")));
  EXPECT_THAT(message(objects({PEG, R"({"mesh":"b","instances":{"rule":"random","count":7,"file":"a"}})"})),
              HasSubstr("has no \"file\", only \"count\""));
  EXPECT_THAT(message(objects({PEG, R"({"mesh":"b","pose":{"translation_m":[1,0,0]},"instances":{}})"})),
              AllOf(HasSubstr("Missing required property 'rule'"), HasSubstr("remedy: add it")));
  EXPECT_THAT(message(objects({PEG, BALL})), HasSubstr("every object moves"));
  EXPECT_THAT(message(objects({PEG, BALL, R"({"name":"ball","mesh":"b"})"})),
              AllOf(HasSubstr("/objects/2/name"), HasSubstr("two objects are called \"ball\"")));
  EXPECT_THAT(message(objects({PEG, R"({"mesh":"b","pose":{"rotation_xyzw":[0,0,0,2]}})"})),
              HasSubstr("/objects/1/pose/rotation_xyzw"));
  EXPECT_THAT(message(objects({PEG, HOLE, R"({"mesh":"b","diagonal_m":-1})"})),
              HasSubstr("/objects/2/diagonal_m"));
}

}  // namespace
}  // namespace lmdbench
