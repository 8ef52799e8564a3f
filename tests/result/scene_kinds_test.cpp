// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/sanitizers.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/run/run.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <result_file/result_reading.h>
#include <support/committed.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using testing::ScratchDirectory;
using testing::SHAPES_FILE;

constexpr const char* BLOB = R"("mesh":"small-blob","diagonal_m":0.1)";
constexpr const char* TORUS = R"("mesh":"torus","diagonal_m":0.15)";
constexpr const char* TURNED = R"("pose":{"translation_m":[0.001,0,0],"rotation_xyzw":[0,0,0.6,0.8]})";
constexpr const char* BENDS =
    R"("deformation":{"generator":"bend","amplitude":0.3,"share":0.3,"direction":[0,0,1],"period_s":0.03})";
constexpr const char* BREATHES = R"("deformation":{"generator":"breathe","amplitude":0.02,"period_s":0.02})";
/// Two balls that sway across the blob's path, and through each other's.
constexpr const char* BALLS =
    R"("mesh":"small-blob","diagonal_m":0.04,"pose":{"translation_m":[0.013,0.009,0.09]},)"
    R"("instances":{"rule":"grid","counts":[2,1,1],"spacing_diagonals":0.7},)"
    R"("path":{"way_diagonals":0.3,"period_s":0.05})";

std::string in_braces(const std::vector<std::string>& keys) {
  std::string all;
  for (const std::string& key : keys) all += (all.empty() ? "" : ",") + key;
  return "{" + all + "}";
}

RunResult run_scene(const std::vector<std::string>& moving, const std::vector<std::string>& fixed,
                    const std::vector<std::string>& movers, const std::vector<Override>& more = {}) {
  std::vector<Override> overrides{"/frames=40",
                                  R"(/force={"cutoff_diagonal":0.08,"maximum_force_n":0.5})",
                                  "/driver/repetitions=1",
                                  R"(/methods=[{"name":"certified"}])",
                                  "/probes/truth/stride_frames=6",
                                  "/probes/fcl/stride_frames=7",
                                  "/moving=" + in_braces(moving),
                                  "/fixed=[" + in_braces(fixed) + "]"};
  if (!movers.empty()) overrides.push_back("/movers=[" + in_braces(movers) + "]");
  overrides.insert(overrides.end(), more.begin(), more.end());
  return run_experiment(load_experiment(SHAPES_FILE, overrides));
}

/// The set is that of `exhaustive` in every probed frame, and FCL agrees on the nearest distance.
void expect_complete(const RunResult& run, const std::string& what) {
  std::int64_t lmds = 0;
  const std::vector<TruthFrame>& frames = run.tracks.front().truth()->frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const TruthComparison& row = run.comparisons(0)[i];
    lmds += std::ssize(frames[i].lmds);
    EXPECT_TRUE(row.same.exact()) << what;
    if (frames[i].contact_without_direction() == 0) EXPECT_LT(row.force_error, 1e-9) << what;
  }
  EXPECT_GT(lmds, 0) << what << ": nothing to find";
  for (const FclFrame& frame : run.tracks.front().fcl()->frames) EXPECT_TRUE(frame.agrees) << what;
}

std::vector<Vec3> forces_of(const RunResult& run) {
  std::vector<Vec3> forces;
  for (const FrameRecord& frame : run.records.front().frames) forces.push_back(frame.force);
  return forces;
}

const std::vector<std::string> AGGREGATIONS{"sum", "shared", "signed", "layered"};

TEST(SceneKinds, AreCompleteWhateverDeformsAndMoves) {
  const ScratchDirectory scratch;
  const std::string places =
      scratch.write("places.txt", "0.001 0 0 0 0 0.6 0.8\n0 0 0.1 0 0 0 1\n3 0 0 0 0 0 1\n");
  const std::string grid = R"("instances":{"rule":"list","file":")" + places + "\"}";
  for (const std::string loop : {"/loop/kind=open", "/loop/kind=closed"}) {
    expect_complete(run_scene({BLOB}, {TORUS}, {BALLS}, {loop}), "movers, " + loop);
    expect_complete(run_scene({BLOB, BENDS}, {TORUS, TURNED}, {BALLS, BREATHES}, {loop}),
                    "movers that deform, " + loop);
    expect_complete(run_scene({BLOB}, {TORUS, BREATHES, grid}, {}, {loop}), "instances that deform, " + loop);
    expect_complete(run_scene({BLOB, BENDS}, {TORUS, BREATHES, grid}, {BALLS, BREATHES}, {loop}),
                    "all of it, " + loop);
  }
}

TEST(SceneKinds, AnInstanceExertsWhatTheSameMeshInItsPlaceExerts) {
  const ScratchDirectory scratch;
  const std::string places = scratch.write("places.txt", "0.001 0 0 0 0 0.6 0.8\n");
  for (const std::string& aggregation : AGGREGATIONS) {
    const std::vector<Override> set{"/force/aggregation=" + aggregation};
    const std::vector<Vec3> there = forces_of(run_scene({BLOB}, {TORUS, TURNED}, {}, set)),
                            instance = forces_of(run_scene(
                                {BLOB}, {TORUS, R"("instances":{"rule":"list","file":")" + places + "\"}"},
                                {}, set));
    double largest = 0.0;
    for (std::size_t i = 0; i < there.size(); ++i) {
      EXPECT_LT((instance[i] - there[i]).norm(), 1e-7) << aggregation << ", frame " << i;
      largest = std::max(largest, there[i].norm());
    }
    EXPECT_GT(largest, 0.01) << aggregation;
  }
}

TEST(SceneKinds, TheDefaultCutoffIsTheSameHoweverTheSceneIsTold) {
  const ScratchDirectory scratch;
  const std::string places = scratch.write("places.txt", "0 0 0 0 0 0 1\n");
  const auto cutoff = [&](const std::vector<std::string>& fixed, const std::vector<Override>& more = {}) {
    std::vector<Override> overrides{R"(/force={"maximum_force_n":0.5})", "/frames=2"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return run_scene({BLOB}, fixed, {}, overrides).prepared.scene().cutoff;
  };
  const std::string small = R"("mesh":"small-blob","diagonal_m":0.05)";
  const double told = cutoff({small});
  EXPECT_GT(told, 0.0);
  EXPECT_EQ(cutoff({small, TURNED}), told);
  EXPECT_EQ(cutoff({small, TURNED}, {"/record/polylines/stride_frames=1"}), told);
  EXPECT_EQ(cutoff({small, TURNED}, {"/force/aggregation=shared"}), told);
  EXPECT_EQ(cutoff({small, TURNED, R"("instances":{"rule":"list","file":")" + places + "\"}"}), told);
}

TEST(SceneKinds, ABystanderChangesNoForce) {
  const std::string torus = in_braces({TORUS, TURNED});
  for (const std::string& law : AGGREGATIONS) {
    const auto forces = [&](const std::string& bystander) {
      return forces_of(run_scene({BLOB}, {TORUS}, {},
                                 {"/fixed=[" + torus + bystander + "]", "/force/aggregation=" + law}));
    };
    const std::vector<Vec3> alone = forces("");
    const std::vector<Vec3> beside =
        forces(R"(,{"mesh":"small-blob","diagonal_m":0.001,"pose":{"translation_m":[10,0,0]}})");
    double largest = 0.0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_LT((alone[i] - beside[i]).norm(), 1e-12) << law << ", frame " << i;
      largest = std::max(largest, alone[i].norm());
    }
    EXPECT_GT(largest, 0.01) << law;
  }
}

TEST(SceneKinds, AForceIsTheSumOfThoseOfItsPairs) {
  const std::string torus = in_braces({TORUS, TURNED});
  const std::string ball =
      R"({"mesh":"small-blob","diagonal_m":0.02,"pose":{"translation_m":[0.03,0.02,0.075]}})";
  for (const std::string& law : AGGREGATIONS) {
    const auto forces = [&](const std::string& fixed) {
      return forces_of(
          run_scene({BLOB}, {TORUS}, {}, {"/fixed=[" + fixed + "]", "/force/aggregation=" + law}));
    };
    const std::vector<Vec3> both = forces(torus + "," + ball), first = forces(torus), second = forces(ball);
    double least_of_both = 0.0;
    for (std::size_t i = 0; i < both.size(); ++i) {
      EXPECT_LT((both[i] - first[i] - second[i]).norm(), 1e-12) << law << ", frame " << i;
      least_of_both = std::max(least_of_both, std::min(first[i].norm(), second[i].norm()));
    }
    EXPECT_GT(least_of_both, 1e-3) << law << ": never two at once";
  }
}

TEST(SceneKinds, LayeredGoesByTheSmallerMeshOfAPair) {
  const ScratchDirectory scratch;
  TriangleMesh torus = make_torus(0.04, 0.015, 64, 32);
  const auto forces = [&](const char* name) {
    const std::string file = scratch.write(name, to_off_text(torus));
    return forces_of(
        run_scene({BLOB}, {"\"mesh\":\"" + file + "\"", TURNED}, {}, {"/force/aggregation=layered"}));
  };
  const std::vector<Vec3> alone = forces("torus.off");
  // A far part makes the larger mesh still larger.
  const auto first = static_cast<std::int32_t>(torus.vertices.size());
  for (const Vec3& corner : {Vec3(10, 0, 0), Vec3(10, 0.01, 0), Vec3(10, 0, 0.01)})
    torus.vertices.push_back(corner);
  torus.triangles.push_back({first, first + 1, first + 2});
  const std::vector<Vec3> longer = forces("longer.off");
  double largest = 0.0;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_LT((alone[i] - longer[i]).norm(), 1e-9) << i;
    largest = std::max(largest, alone[i].norm());
  }
  EXPECT_GT(largest, 0.01);
}

TEST(SceneKinds, WhatTwoMoversExertOnEachOtherIsOpposite) {
  for (const std::string& aggregation : AGGREGATIONS) {
    // The torus moves too, and nothing else is near.
    const RunResult run = run_scene({BLOB}, {R"("mesh":"ball")", R"("pose":{"translation_m":[0,0,9]})"},
                                    {TORUS, R"("path":{"way_diagonals":0.01,"period_s":0.05})"},
                                    {"/force/aggregation=" + aggregation, "/force/maximum_force_n=0.05"});
    const MoverPlay& play = *run.prepared.input.motion.movers;
    const std::vector<MoverFrame>& movers = run.records.front().movers;
    double largest = 0.0;
    for (std::size_t frame = 0; 2 * frame < movers.size(); ++frame) {
      Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
      for (std::size_t i = 0; i < 2; ++i) {
        const MoverFrame& one = movers[2 * frame + play.number[i]];
        const Vec3 reference_W = RigidTransform(play.poses[frame][i]).point(play.references_M[i]);
        force += one.force;
        torque += one.torque + reference_W.cross(one.force);
        largest = std::max(largest, one.force.norm());
      }
      EXPECT_LT(force.norm(), 1e-12) << aggregation << ", frame " << frame;
      EXPECT_LT(torque.norm(), 1e-12) << aggregation << ", frame " << frame;
    }
    EXPECT_GT(largest, 0.01) << aggregation;
  }
}

TEST(SceneKinds, AMoverFeelsUnderEveryAggregationWhatTheMovingMeshOfThatSceneFeels) {
  const ScratchDirectory scratch;
  const std::string far = scratch.write("far.tum", "0 5 0 0 0 0 0 1\n1 5 0 0 0 0 0 1\n");
  const std::string metres = R"(/force={"cutoff_m":0.008,"maximum_force_n":0.5,"aggregation":")";
  for (const std::string& aggregation : AGGREGATIONS) {
    const std::vector<Vec3> alone = forces_of(run_scene({BLOB}, {TORUS}, {}, {metres + aggregation + "\"}"}));
    const RunResult run = run_scene({R"("mesh":"ball","diagonal_m":0.2)"}, {TORUS},
                                    {BLOB, R"("path":{"file":"../paths/shapes.tum"})"},
                                    {metres + aggregation + "\"}", "/path/file=" + far});
    double largest = 0.0;
    for (std::size_t frame = 0; frame < alone.size(); ++frame) {
      EXPECT_LT((run.records.front().movers[2 * frame + 1].force - alone[frame]).norm(), 1e-7)
          << aggregation << ", frame " << frame;
      largest = std::max(largest, alone[frame].norm());
    }
    EXPECT_GT(largest, 0.01) << aggregation;
  }
}

TEST(SceneKinds, OnTheClockFramesAreThoseOfLockstep) {
  const std::vector<Override> shared{"/force/aggregation=shared", "/probes/truth/stride_frames=0"};
  std::vector<Override> clock = shared;
  clock.insert(clock.end(), {"/driver/kind=realtime", "/driver/realtime/floor_s=0.01",
                             "/driver/realtime/lock_memory=false", "/frame_rate_hz=100"});
  std::vector<Override> slow = shared;
  slow.emplace_back("/frame_rate_hz=100");
  const std::vector<Vec3> lockstep = forces_of(run_scene({BLOB, BENDS}, {TORUS}, {BALLS}, slow)),
                          clocked = forces_of(run_scene({BLOB, BENDS}, {TORUS}, {BALLS}, clock));
  ASSERT_EQ(lockstep.size(), clocked.size());
  // A late tick skips its period.
  std::size_t same = 0, pressed = 0;
  for (std::size_t i = 0; i < lockstep.size(); ++i) {
    if (lockstep[i].isZero(0.0)) continue;
    ++pressed;
    same += lockstep[i] == clocked[i] ? 1 : 0;
  }
  EXPECT_GT(pressed, 5u);
  EXPECT_GT(2 * same, IS_SANITIZED ? 0 : pressed) << "a sanitizer makes most ticks late";
}

TEST(SceneKinds, WhoListsMoversInAnotherOrderGetsTheSameBits) {
  const std::string first = in_braces({BALLS, BREATHES}),
                    second = in_braces({R"("mesh":"ball","diagonal_m":0.03)", TURNED});
  const std::vector<Override> shared{"/force/aggregation=shared", "/loop/kind=closed"};
  std::vector<Override> one = shared, other = shared;
  one.push_back("/movers=[" + first + "," + second + "]");
  other.push_back("/movers=[" + second + "," + first + "]");
  const std::vector<Vec3> forces = forces_of(run_scene({BLOB}, {TORUS}, {}, one));
  EXPECT_EQ(forces, forces_of(run_scene({BLOB}, {TORUS}, {}, other)));
  EXPECT_TRUE(std::ranges::any_of(forces, [](const Vec3& force) { return force.norm() > 0.0; }));
}

}  // namespace
}  // namespace lmdbench
