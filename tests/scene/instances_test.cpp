// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/scene/mesh_bounds.h>
#include <lmdbench/scene/scatter.h>

#include <gtest/gtest.h>
#include <support/same_lmds.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

using testing::make_body;
using testing::moved;
using testing::random_direction;
using testing::uniform;

/// Instances of two meshes around the origin, near each other and intersecting.
Scene small_world(double cutoff) {
  Scene scene{make_body("moving", make_blob(0.8, 0.2, 1)), {}, cutoff};
  const auto torus = make_body("torus", make_torus(1.0, 0.4, 10, 6));
  const auto box = make_body("box", make_box({0.9, 0.7, 0.5}, 2));
  for (const Pose& pose :
       scatter({.rule = Scatter::Rule::RANDOM, .count = 14, .spacing = 0.7}, torus->prepared<MeshBounds>()))
    scene.fixed.emplace_back(torus, pose);
  for (const Pose& pose : scatter({.rule = Scatter::Rule::RANDOM, .count = 20, .spacing = 1.2, .seed = 4},
                                  box->prepared<MeshBounds>()))
    scene.fixed.emplace_back(box, pose);
  return scene;
}

std::vector<Pose> way_through(int frames, std::uint64_t seed, double size = 3.0) {
  std::mt19937_64 random(seed);
  std::vector<Pose> poses;
  Pose pose;
  Vec3 direction = random_direction(random), axis = random_direction(random);
  for (int frame = 0; frame < frames; ++frame) {
    if (frame % 25 == 0) direction = random_direction(random), axis = random_direction(random);
    if (frame % 60 == 59) pose.translation = size * (uniform(random) - 0.5) * random_direction(random);
    pose.translation += 0.01 * direction;
    pose.rotation = (Eigen::Quaterniond(Eigen::AngleAxisd(0.01, axis)) * pose.rotation).normalized();
    poses.push_back(pose);
  }
  return poses;
}

void expect_same_sets(const LmdSet& a, const LmdSet& b, const std::string& where) {
  ASSERT_EQ(a.size(), b.size()) << where;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_TRUE(same_feature_pair(a[i], b[i])) << where << ", LMD " << i;
    ASSERT_NEAR(a[i].distance, b[i].distance, 1e-12) << where;
    ASSERT_LT((a[i].point_moving - b[i].point_moving).norm(), 1e-9) << where;
  }
}

TEST(Instances, CertifiedIsCompleteInEveryFrame) {
  for (const double cutoff : {0.02, 0.1, 0.4}) {
    const Scene scene = small_world(cutoff);
    const auto certified = make_method("certified", scene), exhaustive = make_method("exhaustive", scene);
    LmdSet found, truth;
    WorkCounters counters, ignored;
    std::size_t lmds = 0, instances = 0;
    const std::vector<Pose> poses = way_through(240, 11);
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
      certified->search(poses[frame], found, counters);
      exhaustive->search(poses[frame], truth, ignored);
      expect_same_sets(found, truth, "frame " + std::to_string(frame));
      lmds += truth.size();
      for (const Lmd& lmd : truth) instances = std::max<std::size_t>(instances, lmd.fixed_body + 1u);
    }
    EXPECT_GT(lmds, 300u);
    EXPECT_GT(instances, 14u);  // of both meshes
  }
}

TEST(Instances, IsTheSceneWithEveryMeshInPlace) {
  const Scene world = small_world(0.2);
  Scene placed = world;
  for (FixedBody& fixed : placed.fixed) {
    TriangleMesh mesh = fixed->surface().mesh;
    const RigidTransform X_WF(fixed.X_WF);
    for (Vec3& vertex : mesh.vertices) vertex = X_WF.point(vertex);
    fixed = FixedBody(make_body("placed", std::move(mesh)));
  }
  ASSERT_TRUE(world.is_world());
  ASSERT_FALSE(placed.is_world());
  const auto a = make_method("certified", world), b = make_method("certified", placed);
  std::size_t lmds = 0;
  for (const Pose& pose : way_through(60, 12)) {
    const LmdSet of_world = lmds_at(*a, pose), of_placed = lmds_at(*b, pose);
    ASSERT_EQ(of_world.size(), of_placed.size());
    for (std::size_t i = 0; i < of_world.size(); ++i) {
      EXPECT_NEAR(of_world[i].distance, of_placed[i].distance, 1e-9);
      if (of_world[i].intersecting) continue;
      EXPECT_NEAR((of_world[i].point_fixed - of_world[i].point_moving).norm(), of_world[i].distance, 1e-12);
      EXPECT_NEAR(of_world[i].direction.norm(), 1.0, 1e-14);
      const Vec3 between = of_world[i].point_fixed - of_world[i].point_moving;
      if (of_world[i].distance > 1e-3) {
        EXPECT_LT((between / of_world[i].distance - of_world[i].direction).norm(), 1e-9);
      }
    }
    lmds += of_world.size();
  }
  EXPECT_GT(lmds, 100u);
}

TEST(Instances, EveryOrderOfInstancesGivesTheSameBits) {
  const Scene scene = small_world(0.2);
  std::vector<std::size_t> order(scene.fixed.size());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 random(2);
  std::shuffle(order.begin(), order.end(), random);
  Scene shuffled = scene;
  for (std::size_t i = 0; i < order.size(); ++i) shuffled.fixed[i] = scene.fixed[order[i]];
  const auto a = make_method("certified", scene), b = make_method("certified", shuffled);
  for (const Pose& pose : way_through(120, 13)) {
    const LmdSet first = lmds_at(*a, pose);
    LmdSet second = lmds_at(*b, pose);
    for (Lmd& lmd : second)
      lmd.fixed_body = static_cast<std::int32_t>(order[static_cast<std::size_t>(lmd.fixed_body)]);
    std::sort(second.begin(), second.end(), lmd_less);
    testing::expect_same_lmds(first, second);
  }
}

TEST(Instances, CoincidentInstancesHaveASetEach) {
  Scene scene = small_world(0.3);
  const std::size_t before = scene.fixed.size();
  for (std::size_t i = 0; i < before; ++i) scene.fixed.push_back(FixedBody(scene.fixed[i]));
  const auto method = make_method("certified", scene);
  std::size_t pairs = 0;
  for (const Pose& pose : way_through(60, 14)) {
    const LmdSet lmds = lmds_at(*method, pose);
    ASSERT_EQ(lmds.size() % 2, 0u);
    for (const Lmd& lmd : lmds) {
      if (lmd.fixed_body >= static_cast<std::int32_t>(before)) continue;
      const auto twin = std::find_if(lmds.begin(), lmds.end(), [&](const Lmd& other) {
        return other.fixed_body == lmd.fixed_body + static_cast<std::int32_t>(before) &&
               other.feature_moving == lmd.feature_moving && other.feature_fixed == lmd.feature_fixed;
      });
      ASSERT_NE(twin, lmds.end());
      EXPECT_EQ(twin->distance, lmd.distance);
      EXPECT_EQ(twin->point_fixed, lmd.point_fixed);
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 50u);
}

TEST(Instances, IsTheSameAKilometreAway) {
  const Scene here = small_world(0.2);
  Scene there = here;
  // Places on a grid of 2^-20: their sums with the offset are exact.
  const auto on_grid = [](const Vec3& p) { return Vec3((p * 0x1p20).array().round() * 0x1p-20); };
  const Vec3 offset(1024.0, -2048.0, 512.0);
  Scene rounded = here;
  for (std::size_t i = 0; i < here.fixed.size(); ++i) {
    rounded.fixed[i].X_WF.translation = on_grid(here.fixed[i].X_WF.translation);
    there.fixed[i].X_WF.translation = rounded.fixed[i].X_WF.translation + offset;
  }
  const auto a = make_method("certified", rounded), b = make_method("certified", there);
  std::size_t lmds = 0;
  for (Pose pose : way_through(100, 15)) {
    pose.translation = on_grid(pose.translation);
    const LmdSet near = lmds_at(*a, pose);
    pose.translation += offset;
    const LmdSet far = lmds_at(*b, pose);
    ASSERT_NO_FATAL_FAILURE(testing::expect_like_lmds(far, near, 0.0));
    for (std::size_t i = 0; i < near.size(); ++i)
      ASSERT_LT((near[i].point_fixed + offset - far[i].point_fixed).norm(), 1e-11);
    lmds += near.size();
  }
  EXPECT_GT(lmds, 100u);
}

TEST(Instances, MeshesMayLieFarFromTheirOwnOrigin) {
  Scene scene{make_body("moving", make_blob(0.8, 0.2, 1)), {}, 0.2};
  TriangleMesh shifted = make_torus(1.0, 0.4, 10, 6);
  for (Vec3& vertex : shifted.vertices) vertex += Vec3(512.0, 0.0, -256.0);
  const auto torus = make_body("torus", make_torus(1.0, 0.4, 10, 6)),
             far = make_body("far torus", std::move(shifted));
  Scene same = scene;
  for (const Pose& pose : scatter({.counts = {3, 3, 1}, .spacing = 0.8}, torus->prepared<MeshBounds>())) {
    scene.fixed.emplace_back(torus, pose);
    Pose back = pose;
    back.translation -= pose.rotation * Vec3(512.0, 0.0, -256.0);
    same.fixed.emplace_back(far, back);
  }
  const auto a = make_method("certified", scene), b = make_method("certified", same),
             truth = make_method("exhaustive", same);
  std::size_t lmds = 0;
  for (const Pose& pose : way_through(60, 16, 2.0)) {
    const LmdSet here = lmds_at(*a, pose), there = lmds_at(*b, pose);
    const LmdSet true_set = lmds_at(*truth, pose);
    expect_same_sets(there, true_set, "far");
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(here[i].distance, there[i].distance, 1e-10);
    lmds += here.size();
  }
  EXPECT_GT(lmds, 60u);
}

TEST(Instances, CountsWhatItTouches) {
  const Scene scene = small_world(0.1);
  const auto method = make_method("certified", scene);
  const auto index_of = [&](const std::string& name) {
    for (const CounterDescription& counter : method->description().counters)
      if (counter.name == name) return counter.index;
    ADD_FAILURE() << "no counter " << name;
    return std::size_t{0};
  };
  const std::size_t queries = index_of("broad_phase_queries"), touched = index_of("pairs_touched"),
                    searched = index_of("pairs_searched"), nodes = index_of("node_pairs");
  EXPECT_EQ(method->description().name, "certified");
  LmdSet lmds;
  WorkCounters counters;
  method->search(moved(100.0, 0.0, 0.0), lmds, counters);
  EXPECT_EQ(counters.values[queries], 1u);
  for (int frame = 0; frame < 50; ++frame)
    method->search(moved(100.0 + 0.001 * frame, 0.0, 0.0), lmds, counters);
  EXPECT_EQ(counters.values[queries], 1u);
  EXPECT_EQ(counters.values[touched], 0u);
  EXPECT_EQ(counters.values[searched], 0u);
  EXPECT_EQ(counters.values[nodes], 0u);
  method->search(moved(0.0, 0.0, 0.0), lmds, counters);
  EXPECT_EQ(counters.values[queries], 2u);
  EXPECT_GT(counters.values[searched], 0u);
  EXPECT_GE(counters.values[touched], counters.values[searched]);
  EXPECT_GT(counters.values[nodes], 0u);
}

TEST(Instances, KeptStateGoesFromInstanceToInstanceAndBack) {
  // One mesh at two places, in turns and at once.
  Scene scene{make_body("moving", make_blob(0.8, 0.2, 2)), {}, 0.3};
  const auto mesh = make_body("fixed", make_blob(1.0, 0.3, 2));
  for (const double x : {-4.0, 4.0, 4.3}) scene.fixed.emplace_back(mesh, moved(x, 0.0, 0.0));
  const auto coherent = make_method("certified", scene),
             scratch = make_method("certified", scene, {{"frame_coherence", false}});
  LmdSet kept, fresh;
  WorkCounters of_kept, of_fresh;
  std::size_t lmds = 0;
  for (int frame = 0; frame < 600; ++frame) {
    Pose pose = moved(((frame / 100) % 2 == 0 ? -4.0 : 4.0) + 1.9 - 0.002 * (frame % 100), 0.2, 0.1);
    coherent->search(pose, kept, of_kept);
    scratch->search(pose, fresh, of_fresh);
    testing::expect_same_lmds(kept, fresh, std::to_string(frame));
    lmds += kept.size();
  }
  EXPECT_GT(lmds, 600u);
  EXPECT_LT(of_kept.values[0], of_fresh.values[0] / 2);
}

TEST(Instances, EveryMethodWorksInIt) {
  const Scene scene = small_world(0.2);
  const auto truth = make_method("exhaustive", scene);
  LmdSet true_set, lmds;
  WorkCounters ignored;
  for (const MethodDescription& description : method_descriptions()) {
    const auto method = make_method(description.name, scene);
    std::size_t all = 0, found = 0;
    for (const Pose& pose : way_through(20, 17)) {
      truth->search(pose, true_set, ignored);
      method->search(pose, lmds, ignored);
      for (int i = 0; i < description.trackings_after_search; ++i) method->track(pose, lmds, ignored);
      lmds = within_cutoff(lmds, scene.cutoff);
      std::sort(lmds.begin(), lmds.end(), lmd_less);
      if (description.promise == Promise::NEAREST_PAIR) {
        EXPECT_EQ(lmds.size(), true_set.empty() ? 0u : 1u);
        if (!true_set.empty()) {
          EXPECT_NEAR(lmds[0].distance, true_set[0].distance, 1e-6);
        }
      }
      for (const Lmd& lmd : true_set) {
        ++all;
        found +=
            std::any_of(lmds.begin(), lmds.end(), [&](const Lmd& l) { return same_feature_pair(l, lmd); });
      }
      for (const Lmd& lmd : lmds)
        EXPECT_NEAR((lmd.point_fixed - lmd.point_moving).norm(), lmd.distance, 1e-9) << description.name;
    }
    EXPECT_GT(all, 50u);
    EXPECT_GT(found, description.promise == Promise::COMPLETE_SET ? all - 1 : 0u) << description.name;
  }
}

TEST(Instances, TrackingMovesASetAlong) {
  const Scene scene = small_world(0.3);
  const auto improved = make_method("improved", scene), truth = make_method("exhaustive", scene);
  LmdSet lmds, true_set;
  WorkCounters ignored;
  std::size_t found = 0, all = 0;
  const std::vector<Pose> poses = way_through(20, 18);
  improved->search(poses[0], lmds, ignored);
  for (const Pose& pose : poses) {
    improved->track(pose, lmds, ignored);
    truth->search(pose, true_set, ignored);
    for (const Lmd& lmd : true_set) {
      ++all;
      found += std::any_of(lmds.begin(), lmds.end(), [&](const Lmd& l) {
        return l.fixed_body == lmd.fixed_body && std::abs(l.distance - lmd.distance) < 1e-9;
      });
    }
  }
  EXPECT_GT(all, 40u);
  EXPECT_GT(found, all / 2);
}

TEST(Instances, TheMinimaOfCriticalPairsAreItsSet) {
  const Scene scene = small_world(0.8);
  const auto method = make_method("certified", scene), other = make_method("certified", scene);
  std::size_t saddles = 0;
  for (const Pose& pose : way_through(60, 19)) {
    const CriticalSet critical = critical_at(*method, pose);
    const LmdSet minima = minima_of(critical);
    expect_same_sets(minima, lmds_at(*other, pose), "critical");
    saddles += critical.size() - minima.size();
  }
  EXPECT_GT(saddles, 0u);
}

}  // namespace
}  // namespace lmdbench
