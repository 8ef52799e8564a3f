// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>
#include <lmdbench/scene/scatter.h>
#include <lmdbench/scene/scene_search.h>

#include <gtest/gtest.h>
#include <support/same_lmds.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using testing::make_body;
using testing::moved;
using testing::random_direction;
using testing::uniform;

using Bodies = std::vector<std::shared_ptr<const Body>>;

/// Movers with all their poses, and standing objects.
struct Play {
  Bodies movers;
  std::vector<FixedBody> standing;
  std::vector<std::vector<Pose>> frames;
};

/// The set of every pair of objects that has one.
using Sets = std::map<ObjectPair, LmdSet>;

/// Runs a method over the objects of a play.
class Player {
 public:
  explicit Player(const Play& play, double cutoff, const BroadPhase::Tuning& tuning = {},
                  const std::string& method = "certified", const nlohmann::json& options = {})
      : poses_(std::make_shared<std::vector<Pose>>(play.movers.size())),
        scene_{play.movers[0], play.standing, cutoff, play.movers, 0, poses_},
        search_(
            scene_, method_description(method),
            [&of = method_description(method),
             all = complete_options(method_description(method), options, "")](const Scene& of_pair) {
              return of.make(of_pair, all);
            },
            tuning) {}

  const LmdSet& at(const std::vector<Pose>& poses) {
    *poses_ = poses;
    search_.search(poses[scene_.held], lmds_, counters_);
    return lmds_;
  }
  Sets sets_at(const std::vector<Pose>& poses) {
    Sets sets;
    for (const Lmd& lmd : at(poses)) sets[ObjectPair::of(lmd.fixed_body, scene_)].push_back(lmd);
    return sets;
  }
  /// Count since the last call.
  std::uint64_t take_count(const std::string& name) {
    for (const CounterDescription& counter : search_.description().counters)
      if (counter.name == name) return std::exchange(counters_.values[counter.index], 0);
    ADD_FAILURE() << "no counter " << name;
    return 0;
  }
  const SceneSearch& search() const { return search_; }

 private:
  std::shared_ptr<std::vector<Pose>> poses_;
  Scene scene_;
  SceneSearch search_;
  LmdSet lmds_;
  WorkCounters counters_;
};

/// Places on a grid of 2^-20 m: adding up to kilometres changes no difference of two of them.
Vec3 on_grid(const Vec3& p) {
  return (p * 0x1p20).array().round() * 0x1p-20;
}

/// Blobs, boxes and tori of about 1 m that drift, turn and rest among some that stand; one jumps.
Play drifting(std::size_t count, int frames, std::uint64_t seed, const Vec3& origin = Vec3::Zero()) {
  const auto blob = make_body("blob", make_blob(0.5, 0.15, 1)),
             box = make_body("box", make_box({0.7, 0.6, 0.5}, 2)),
             torus = make_body("torus", make_torus(0.4, 0.15, 10, 6));
  std::mt19937_64 random(seed);
  Play play;
  std::vector<Pose> poses =
      scatter({.rule = Scatter::Rule::PILE, .count = static_cast<std::int64_t>(count), .spacing = 0.6},
              blob->prepared<MeshBounds>());
  std::vector<Vec3> directions, axes;
  for (std::size_t i = 0; i < count; ++i) {
    play.movers.push_back(i % 3 == 0 ? box : i % 3 == 1 ? blob : torus);
    directions.push_back(random_direction(random));
    axes.push_back(random_direction(random));
  }
  for (const auto& [mesh, rule_seed] : {std::pair{box, 3u}, std::pair{torus, 4u}})
    for (Pose pose : scatter({.rule = Scatter::Rule::RANDOM, .count = 6, .spacing = 1.0, .seed = rule_seed},
                             blob->prepared<MeshBounds>())) {
      pose.translation = on_grid(pose.translation) + origin;
      play.standing.emplace_back(mesh, pose);
    }
  for (int frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < count; ++i) {
      if (i % 4 == 1) continue;  // at rest
      poses[i].translation += (frame % 60 < 30 ? 0.004 : -0.004) * directions[i];
      poses[i].rotation =
          (Eigen::Quaterniond(Eigen::AngleAxisd(0.01, axes[i])) * poses[i].rotation).normalized();
    }
    if (frame % 50 == 49) poses[2].translation = 2.0 * uniform(random) * random_direction(random);
    play.frames.push_back(poses);
    for (Pose& pose : play.frames.back()) pose.translation = on_grid(pose.translation) + origin;
  }
  return play;
}

/// Brute force: `exhaustive` on every pair.
class Truth {
 public:
  Truth(const Play& play, double cutoff) : play_(play), cutoff_(cutoff) {}

  LmdSet of(std::size_t mover, std::size_t other, const std::vector<Pose>& poses) {
    const bool moves = other < play_.movers.size();
    const FixedBody fixed =
        moves ? FixedBody(play_.movers[other]) : play_.standing[other - play_.movers.size()];
    const Body *a = play_.movers[mover].get(), *b = fixed.body.get();
    auto& method = methods_[{a, b}];
    if (!method) method = make_method("exhaustive", {play_.movers[mover], {fixed.body}, cutoff_});
    return lmds_at(*method, relative_pose(moves ? poses[other] : fixed.X_WF, poses[mover]));
  }

 private:
  const Play& play_;
  double cutoff_;
  std::map<std::pair<const Body*, const Body*>, std::unique_ptr<Method>> methods_;
};

struct Judged {
  std::size_t of_movers = 0, with_standing = 0;  ///< LMDs.
};

/// Expects the true set of every pair, in every `stride`th frame.
Judged judge(const Play& play, double cutoff, Player& player, std::size_t stride = 1) {
  Truth truth(play, cutoff);
  Judged judged;
  for (std::size_t frame = 0; frame < play.frames.size(); ++frame) {
    const std::vector<Pose>& poses = play.frames[frame];
    Sets sets = player.sets_at(poses);
    if (frame % stride != 0) continue;
    for (std::uint32_t a = 0; a < play.movers.size(); ++a)
      for (std::uint32_t b = a + 1; b < play.movers.size() + play.standing.size(); ++b) {
        const LmdSet expected = truth.of(a, b, poses);
        const LmdSet& found = sets[{a, b}];
        const std::string where =
            "frame " + std::to_string(frame) + ", " + std::to_string(a) + " and " + std::to_string(b);
        EXPECT_EQ(found.size(), expected.size()) << where;
        if (::testing::Test::HasFailure()) return judged;
        for (std::size_t i = 0; i < expected.size(); ++i) {
          EXPECT_EQ(found[i].feature_moving, expected[i].feature_moving) << where;
          EXPECT_EQ(found[i].feature_fixed, expected[i].feature_fixed) << where;
          EXPECT_NEAR(found[i].distance, expected[i].distance, 1e-12) << where;
        }
        (b < play.movers.size() ? judged.of_movers : judged.with_standing) += expected.size();
      }
  }
  return judged;
}

TEST(MovingObjects, FindsTheTruthOfEveryPair) {
  for (const double away : {0.0, 1.0})
    for (const double cutoff : {0.01, 0.1, 0.4}) {
      const Play play = drifting(12, 200, 5, away * Vec3(1024.0, -2048.0, 512.0));
      Player player(play, cutoff);
      const Judged judged = judge(play, cutoff, player, 4);
      EXPECT_GT(judged.of_movers, 150u);
      EXPECT_GT(judged.with_standing, 50u);
      EXPECT_LT(player.take_count("broad_phase_queries"), 12u * 200u / 5u);
    }
}

TEST(MovingObjects, FindsWhatIsNestedAndCoincident) {
  // A turning hollow; small objects inside and outside, each twice in one place, one pair at rest.
  TriangleMesh inwards = make_sphere(1.5, 2);
  for (auto& corners : inwards.triangles) std::swap(corners[1], corners[2]);
  const auto wall = make_body("wall", std::move(inwards)), hull = make_body("hull", make_sphere(1.6, 2)),
             blob = make_body("blob", make_blob(0.4, 0.1, 1)),
             box = make_body("box", make_box({0.5, 0.4, 0.3}, 2));
  Play play{{wall, hull, blob, blob, box, box, blob, blob}, {FixedBody(box, moved(0.3, 1.8, 0.1))}, {}};
  std::vector<Pose> poses(8);
  for (int frame = 0; frame < 160; ++frame) {
    const double turn = 0.01 * frame;
    poses[0].rotation = Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vec3(0.6, 0.0, 0.8)));
    poses[1] = poses[0];
    poses[2].translation = 1.05 * Vec3(std::cos(turn), std::sin(turn), 0.1);
    poses[2].rotation = Eigen::Quaterniond(Eigen::AngleAxisd(2.0 * turn, Vec3(0.0, 0.6, 0.8)));
    poses[3] = poses[2];
    poses[4].translation = Vec3(0.2, -1.1 + 0.3 * turn, 0.3);
    poses[5] = poses[4];
    poses[6].translation = Vec3(-1.8, 0.8, 0.2);
    poses[7] = poses[6];
    play.frames.push_back(poses);
  }
  for (const double cutoff : {0.05, 0.4}) {
    Player player(play, cutoff);
    const Judged judged = judge(play, cutoff, player, 10);
    EXPECT_GT(judged.of_movers, 100u);
    EXPECT_GT(judged.with_standing, 0u);
    // Objects at the same place have the same LMDs.
    Sets sets = player.sets_at(play.frames.back());
    EXPECT_GT((sets[{0, 2}].size()), 0u);
    EXPECT_EQ((sets[{0, 2}].size()), (sets[{0, 3}].size()));
  }
}

TEST(MovingObjects, IsTheWorldWithEveryMeshInPlace) {
  const Play play = drifting(10, 60, 6);
  constexpr double CUTOFF = 0.2;
  Player player(play, CUTOFF);
  const auto in_place = [](const Body& body, const Pose& pose) {
    TriangleMesh mesh = body.surface().mesh;
    for (Vec3& vertex : mesh.vertices) vertex = RigidTransform(pose).point(vertex);
    return make_body("placed", std::move(mesh));
  };
  std::size_t lmds = 0;
  for (std::size_t frame = 0; frame < play.frames.size(); ++frame) {
    const std::vector<Pose>& poses = play.frames[frame];
    const Sets sets = player.sets_at(poses);
    if (frame % 20 != 7) continue;
    for (const auto& [pair, found] : sets) {
      const bool moves = pair.other < play.movers.size();
      const auto fixed = moves ? FixedBody(play.movers[pair.other], poses[pair.other])
                               : play.standing[pair.other - play.movers.size()];
      const auto method = make_method("exhaustive", {in_place(*play.movers[pair.mover], poses[pair.mover]),
                                                     {in_place(*fixed.body, fixed.X_WF)},
                                                     CUTOFF});
      const LmdSet expected = lmds_at(*method, Pose{});
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const Lmd& lmd = found[i];
        EXPECT_NEAR(lmd.distance, expected[i].distance, 1e-9);
        if (lmd.intersecting || lmd.distance < 1e-3) continue;
        const Vec3 between = lmd.point_fixed - lmd.point_moving;
        EXPECT_NEAR(between.norm(), lmd.distance, 1e-12);
        EXPECT_LT((between / lmd.distance - lmd.direction).norm(), 1e-9);
        EXPECT_LT((lmd.point_moving - expected[i].point_moving).norm(), 1e-6);
        ++lmds;
      }
    }
  }
  EXPECT_GT(lmds, 50u);
}

TEST(MovingObjects, OfOneMoverIsAWorld) {
  Play play = drifting(1, 0, 7);
  play.movers = {make_body("moving", make_blob(0.5, 0.15, 2))};
  for (int frame = 0; frame < 300; ++frame) {
    Pose pose = moved(-1.5 + 0.01 * frame, 0.3 * std::sin(0.02 * frame), 0.1);
    pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.02 * frame, Vec3(0.0, 0.6, 0.8)));
    play.frames.push_back({pose});
  }
  Player player(play, 0.2);
  const auto world = make_method("certified", {play.movers[0], play.standing, 0.2});
  std::size_t all = 0;
  for (const std::vector<Pose>& poses : play.frames) {
    const LmdSet& found = player.at(poses);
    const LmdSet lmds = lmds_at(*world, poses[0]);
    ASSERT_EQ(found.size(), lmds.size());
    for (std::size_t i = 0; i < lmds.size(); ++i) {
      EXPECT_EQ(found[i].fixed_body, lmds[i].fixed_body + 1);
      EXPECT_EQ(found[i].distance, lmds[i].distance);
      EXPECT_EQ(found[i].point_moving, lmds[i].point_moving);
      EXPECT_EQ(found[i].point_fixed, lmds[i].point_fixed);
    }
    all += lmds.size();
  }
  EXPECT_GT(all, 200u);
}

TEST(MovingObjects, NeitherOrderNorTuningChangesASet) {
  const Play play = drifting(9, 150, 8);
  Play shuffled = play;
  std::mt19937_64 random(3);
  std::vector<std::uint32_t> named(play.movers.size() + play.standing.size());
  std::iota(named.begin(), named.end(), 0);
  const auto standing = named.begin() + static_cast<std::ptrdiff_t>(play.movers.size());
  std::shuffle(named.begin(), standing, random);
  std::shuffle(standing, named.end(), random);
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (i >= play.movers.size()) {
      shuffled.standing[i - play.movers.size()] = play.standing[named[i] - play.movers.size()];
      continue;
    }
    shuffled.movers[i] = play.movers[named[i]];
    for (std::size_t frame = 0; frame < play.frames.size(); ++frame)
      shuffled.frames[frame][i] = play.frames[frame][named[i]];
  }
  Player player(play, 0.2), other(shuffled, 0.2);
  std::list<Player> tuned;
  for (const auto& [slack, share] : {std::pair{0.05, 0.0}, std::pair{0.05, 1.0}, std::pair{1.0, 0.5}})
    tuned.emplace_back(play, 0.2, BroadPhase::Tuning{.slack = slack, .pack_share = share});
  std::size_t swapped = 0, kept = 0;
  for (std::size_t frame = 0; frame < play.frames.size(); ++frame) {
    const LmdSet untuned = player.at(play.frames[frame]);
    for (Player& one : tuned) testing::expect_same_lmds(one.at(play.frames[frame]), untuned);
    const Sets first = player.sets_at(play.frames[frame]), second = other.sets_at(shuffled.frames[frame]);
    ASSERT_EQ(first.size(), second.size());
    for (const auto& [pair, lmds] : second) {
      const std::uint32_t a = named[pair.mover], b = named[pair.other];
      const bool swaps = a > b;
      const auto twin = first.find({std::min(a, b), std::max(a, b)});
      ASSERT_NE(twin, first.end());
      ASSERT_EQ(twin->second.size(), lmds.size());
      for (std::size_t i = 0; i < lmds.size(); ++i) {
        if (!swaps) {
          EXPECT_EQ(lmds[i].point_moving, twin->second[i].point_moving);
          EXPECT_EQ(lmds[i].point_fixed, twin->second[i].point_fixed);
          EXPECT_EQ(lmds[i].distance, twin->second[i].distance);
          ++kept;
          continue;
        }
        const bool found = std::any_of(twin->second.begin(), twin->second.end(), [&](const Lmd& lmd) {
          return lmd.feature_moving == lmds[i].feature_fixed && lmd.feature_fixed == lmds[i].feature_moving &&
                 std::abs(lmd.distance - lmds[i].distance) < 1e-12 &&
                 (lmd.point_moving - lmds[i].point_fixed).norm() < 1e-9;
        });
        EXPECT_TRUE(found) << "frame " << frame;
        ++swapped;
      }
    }
  }
  EXPECT_GT(swapped, 300u);
  EXPECT_GT(kept, 300u);
}

TEST(MovingObjects, IsTheSameAKilometreAway) {
  const Vec3 offset(1024.0, -2048.0, 512.0);
  const Play here = drifting(10, 120, 9), there = drifting(10, 120, 9, offset);
  Player a(here, 0.2), b(there, 0.2);
  std::size_t lmds = 0;
  for (std::size_t frame = 0; frame < here.frames.size(); ++frame) {
    const LmdSet &near = a.at(here.frames[frame]), &far = b.at(there.frames[frame]);
    ASSERT_NO_FATAL_FAILURE(testing::expect_like_lmds(far, near, 0.0));
    for (std::size_t i = 0; i < near.size(); ++i)
      ASSERT_LT((near[i].point_fixed + offset - far[i].point_fixed).norm(), 1e-11);
    lmds += near.size();
  }
  EXPECT_GT(lmds, 500u);
}

/// Balls of radius 0.5 in a row, `step` apart.
Play row_of_balls(std::size_t count, double step) {
  Play play{Bodies(count, make_body("ball", make_sphere(0.5, 2))), {}, {}};
  std::vector<Pose> poses(count);
  for (std::size_t i = 0; i < count; ++i) poses[i].translation.x() = step * static_cast<double>(i);
  play.frames = {poses};
  return play;
}

TEST(MovingObjects, AtRestNothingIsTouched) {
  const Play play = row_of_balls(40, 1.2);
  Player player(play, 0.05);
  player.at(play.frames[0]);
  EXPECT_EQ(player.take_count("broad_phase_queries"), 40u);
  EXPECT_EQ(player.search().candidate_count(), 39u);  // the neighbours, 0.15 beyond the cutoff
  player.take_count("pairs_touched");
  for (int frame = 0; frame < 50; ++frame) EXPECT_TRUE(player.at(play.frames[0]).empty());
  for (const CounterDescription& counter : player.search().description().counters)
    EXPECT_EQ(player.take_count(counter.name), 0u) << counter.name;
  EXPECT_EQ(player.search().method_count(), 1u);  // the first one, for pairs that come near
  // Both of a pair move 0.08 nearer, less than their slack of 0.125; together they use it up.
  std::vector<Pose> poses = play.frames[0];
  poses[7].translation.x() += 0.08;
  player.at(poses);
  EXPECT_EQ(player.take_count("pairs_searched"), 0u);
  poses[8].translation.x() -= 0.08;
  const Sets sets = player.sets_at(poses);
  EXPECT_EQ(player.take_count("broad_phase_queries"), 0u);
  EXPECT_EQ(player.take_count("pairs_searched"), 1u);
  const std::uint64_t touched = player.take_count("pairs_touched");
  EXPECT_GE(touched, 1u);
  EXPECT_LE(touched, 3u);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets.begin()->first, (ObjectPair{7, 8}));
  EXPECT_EQ(player.search().method_count(), 1u);
}

TEST(MovingObjects, OnlyWhoLeavesItsSlackIsAnchored) {
  const Play play = row_of_balls(200, 1.5);
  Player player(play, 0.05);
  std::vector<Pose> poses = play.frames[0];
  player.at(poses);
  player.take_count("broad_phase_queries");
  player.take_count("pairs_touched");
  const std::size_t candidates = player.search().candidate_count();
  // Ball 0 flies 30 m along the row, beyond the cutoff: 0.1 a frame, slack 0.125.
  poses[0].translation.z() = 1.3;
  for (int frame = 0; frame < 300; ++frame) {
    poses[0].translation.x() += 0.1;
    EXPECT_TRUE(player.at(poses).empty());
  }
  const std::uint64_t anchored = player.take_count("broad_phase_queries");
  EXPECT_GE(anchored, 150u);
  EXPECT_LE(anchored, 300u);
  EXPECT_LE(player.take_count("pairs_touched"), 4u * anchored);
  EXPECT_NEAR(static_cast<double>(player.search().candidate_count()), static_cast<double>(candidates), 3.0);
}

TEST(MovingObjects, MethodsGoFromPairToPair) {
  // One ball along a row of others, near one or two of them at a time.
  Play play{{make_body("a", make_blob(0.5, 0.1, 2))}, {}, {}};
  const auto ball = make_body("ball", make_sphere(0.5, 2));
  for (int k = 0; k < 60; ++k) play.standing.emplace_back(ball, moved(1.5 * k, 0.0, 0.0));
  for (int frame = 0; frame < 900; ++frame) play.frames.push_back({moved(0.1 * frame, 1.05, 0.0)});
  Player player(play, 0.1), scratch(play, 0.1, {}, "certified", {{"frame_coherence", false}});
  std::uint32_t met = 0;
  for (const std::vector<Pose>& poses : play.frames) {
    const Sets sets = player.sets_at(poses);
    testing::expect_same_lmds(player.at(poses), scratch.at(poses));
    for (const auto& [pair, lmds] : sets) met = std::max(met, pair.other);
  }
  EXPECT_EQ(met, 60u);
  EXPECT_LE(player.search().method_count(), 4u);
}

TEST(MovingObjects, OneMethodServesAllThatKeepNothing) {
  const Play play = drifting(6, 20, 10);
  Player certified(play, 0.2), exhaustive(play, 0.2, {}, "exhaustive");
  std::size_t lmds = 0;
  for (const std::vector<Pose>& poses : play.frames) {
    const LmdSet& truth = exhaustive.at(poses);
    testing::expect_like_lmds(certified.at(poses), truth, 1e-12);
    lmds += truth.size();
  }
  EXPECT_GT(lmds, 0u);
  EXPECT_LE(exhaustive.search().method_count(), 9u);  // ordered pairs of three meshes
}

TEST(MovingObjects, FollowsMeshesThatDeform) {
  const auto ball = std::make_shared<Body>("ball", build_surface(make_sphere(0.5, 2)));
  const Play play{{ball, ball}, {FixedBody(ball, moved(0.0, 3.0, 0.0))}, {}};
  Player player(play, 0.1);
  const std::vector<Pose> poses{moved(0.0, 0.0, 0.0), moved(1.5, 0.0, 0.0)};
  EXPECT_TRUE(player.at(poses).empty());
  std::vector<Vec3> vertices = ball->surface().mesh.vertices;
  for (Vec3& vertex : vertices) vertex *= 1.45;
  ball->deform(vertices);
  Sets sets = player.sets_at(poses);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_NEAR((sets[{0, 1}].at(0).distance), 0.05, 0.02);
  for (Vec3& vertex : vertices) vertex *= 2.03;
  ball->deform(vertices);
  EXPECT_EQ((player.sets_at(poses).count({0, 2})), 1u);
}

}  // namespace
}  // namespace lmdbench
