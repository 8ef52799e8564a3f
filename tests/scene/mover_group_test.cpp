// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/scene/mover_group.h>
#include <lmdbench/scene/scatter.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;
using testing::make_body;
using testing::message_of;
using testing::moved;
using testing::random_direction;
using testing::random_rotation;
using testing::uniform;

using Bodies = std::vector<std::shared_ptr<const Body>>;

/// Movers with all their poses, among what stands.
struct Play {
  Bodies movers;
  std::vector<FixedBody> standing;
  std::vector<std::vector<Pose>> frames;
};

MoverGroup group_of(const Play& play, double cutoff, const MoverGroup::Tuning& tuning = {},
                    const std::string& method = "certified") {
  return {play.movers, play.standing, cutoff, method_maker(method), tuning};
}

/// Places on a grid of 2^-20 m: what is added to them, up to kilometres, changes none of their differences.
Vec3 on_grid(const Vec3& p) {
  return (p * 0x1p20).array().round() * 0x1p-20;
}

/// Blobs, boxes and tori of about 1 m that drift there and back, turn, rest, and of which one jumps now and then, among a few that stand.
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
    LmdSet lmds;
    WorkCounters ignored;
    method->search(relative_pose(moves ? poses[other] : fixed.X_WF, poses[mover]), lmds, ignored);
    return lmds;
  }

 private:
  const Play& play_;
  double cutoff_;
  std::map<std::pair<const Body*, const Body*>, std::unique_ptr<Method>> methods_;
};

struct Judged {
  std::size_t of_movers = 0, with_standing = 0;  ///< LMDs.
};

/// Expects the true set of every pair, in every `stride`th frame, in the order of pairs.
Judged judge(const Play& play, double cutoff, MoverGroup& group, MoverGroup::Work& work,
             std::size_t stride = 1) {
  Truth truth(play, cutoff);
  MoverContacts contacts;
  Judged judged;
  for (std::size_t frame = 0; frame < play.frames.size(); ++frame) {
    const std::vector<Pose>& poses = play.frames[frame];
    group.search(poses, contacts, work);
    if (frame % stride != 0) continue;
    std::size_t at = 0, end = 0;
    for (std::size_t a = 0; a < play.movers.size(); ++a)
      for (std::size_t b = a + 1; b < play.movers.size() + play.standing.size(); ++b) {
        const LmdSet expected = truth.of(a, b, poses);
        if (expected.empty()) continue;
        const std::string where =
            "frame " + std::to_string(frame) + ", " + std::to_string(a) + " and " + std::to_string(b);
        EXPECT_LT(at, contacts.pairs.size()) << where;
        if (at >= contacts.pairs.size()) return judged;
        const MoverContacts::Pair& pair = contacts.pairs[at++];
        EXPECT_TRUE(pair.mover == a && pair.other == b) << where << ": " << pair.mover << " " << pair.other;
        EXPECT_EQ(pair.count, expected.size()) << where;
        EXPECT_EQ(pair.begin, end) << where;
        end += pair.count;
        if (::testing::Test::HasFailure()) return judged;
        for (std::size_t i = 0; i < expected.size(); ++i) {
          const Lmd& lmd = contacts.of(pair)[i];
          EXPECT_EQ(lmd.feature_moving, expected[i].feature_moving) << where;
          EXPECT_EQ(lmd.feature_fixed, expected[i].feature_fixed) << where;
          EXPECT_NEAR(lmd.distance, expected[i].distance, 1e-12) << where;
          EXPECT_EQ(lmd.fixed_body, static_cast<std::int32_t>(b)) << where;
        }
        (b < play.movers.size() ? judged.of_movers : judged.with_standing) += expected.size();
      }
    EXPECT_EQ(at, contacts.pairs.size()) << "frame " << frame;
    EXPECT_EQ(end, contacts.lmds.size()) << "frame " << frame;
    if (::testing::Test::HasFailure()) return judged;
  }
  return judged;
}

TEST(MoverGroup, FindsTheTruthOfEveryPair) {
  for (const double away : {0.0, 1.0})
    for (const double cutoff : {0.01, 0.1, 0.4}) {
      const Play play = drifting(12, 200, 5, away * Vec3(1024.0, -2048.0, 512.0));
      MoverGroup group = group_of(play, cutoff);
      MoverGroup::Work work;
      const Judged judged = judge(play, cutoff, group, work, 4);
      EXPECT_GT(judged.of_movers, 150u);
      EXPECT_GT(judged.with_standing, 50u);
      EXPECT_LT(work.anchored, 12u * 200u / 5u);
    }
}

TEST(MoverGroup, FindsWhatIsNestedAndCoincident) {
  // A hollow that turns, what tumbles inside of it and what is outside; each of the small ones twice at the same place, one pair of them at rest.
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
    MoverGroup group = group_of(play, cutoff);
    MoverGroup::Work work;
    const Judged judged = judge(play, cutoff, group, work, 10);
    EXPECT_GT(judged.of_movers, 100u);
    EXPECT_GT(judged.with_standing, 0u);
    // What coincides has the same LMDs.
    MoverContacts contacts;
    group.search(play.frames.back(), contacts, work);
    std::map<std::uint32_t, std::size_t> with_wall;
    for (const MoverContacts::Pair& pair : contacts.pairs)
      if (pair.mover == 0) with_wall[pair.other] = pair.count;
    EXPECT_GT(with_wall[2], 0u);
    EXPECT_EQ(with_wall[2], with_wall[3]);
  }
}

TEST(MoverGroup, IsTheWorldWithEveryMeshInPlace) {
  const Play play = drifting(10, 60, 6);
  constexpr double CUTOFF = 0.2;
  MoverGroup group = group_of(play, CUTOFF);
  MoverGroup::Work work;
  MoverContacts contacts;
  const auto in_place = [](const Body& body, const Pose& pose) {
    TriangleMesh mesh = body.surface().mesh;
    for (Vec3& vertex : mesh.vertices) vertex = RigidTransform(pose).point(vertex);
    return make_body("placed", std::move(mesh));
  };
  std::size_t lmds = 0;
  for (std::size_t frame = 0; frame < play.frames.size(); ++frame) {
    const std::vector<Pose>& poses = play.frames[frame];
    group.search(poses, contacts, work);
    if (frame % 20 != 7) continue;
    for (const MoverContacts::Pair& pair : contacts.pairs) {
      const bool moves = pair.other < play.movers.size();
      const auto fixed = moves ? FixedBody(play.movers[pair.other], poses[pair.other])
                               : play.standing[pair.other - play.movers.size()];
      const auto method = make_method("exhaustive", {in_place(*play.movers[pair.mover], poses[pair.mover]),
                                                     {in_place(*fixed.body, fixed.X_WF)},
                                                     CUTOFF});
      LmdSet expected;
      WorkCounters ignored;
      method->search(Pose{}, expected, ignored);
      ASSERT_EQ(pair.count, expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const Lmd& lmd = contacts.of(pair)[i];
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

TEST(MoverGroup, OfOneMoverIsAWorld) {
  Play play = drifting(1, 0, 7);
  play.movers = {make_body("moving", make_blob(0.5, 0.15, 2))};
  for (int frame = 0; frame < 300; ++frame) {
    Pose pose = moved(-1.5 + 0.01 * frame, 0.3 * std::sin(0.02 * frame), 0.1);
    pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.02 * frame, Vec3(0.0, 0.6, 0.8)));
    play.frames.push_back({pose});
  }
  MoverGroup group = group_of(play, 0.2);
  const auto world = make_method("certified", {play.movers[0], play.standing, 0.2});
  MoverGroup::Work work;
  MoverContacts contacts;
  LmdSet lmds;
  WorkCounters counters;
  std::size_t all = 0;
  for (const std::vector<Pose>& poses : play.frames) {
    group.search(poses, contacts, work);
    world->search(poses[0], lmds, counters);
    std::sort(contacts.lmds.begin(), contacts.lmds.end(), lmd_less);
    ASSERT_EQ(contacts.lmds.size(), lmds.size());
    for (std::size_t i = 0; i < lmds.size(); ++i) {
      EXPECT_EQ(contacts.lmds[i].fixed_body, lmds[i].fixed_body + 1);
      EXPECT_EQ(contacts.lmds[i].distance, lmds[i].distance);
      EXPECT_EQ(contacts.lmds[i].point_moving, lmds[i].point_moving);
      EXPECT_EQ(contacts.lmds[i].point_fixed, lmds[i].point_fixed);
    }
    all += lmds.size();
  }
  EXPECT_GT(all, 200u);
}

/// The set of every pair of objects that has one.
using Sets = std::map<std::pair<std::size_t, std::size_t>, LmdSet>;

Sets sets_of(const MoverContacts& contacts, const std::vector<std::size_t>& named) {
  Sets sets;
  for (const MoverContacts::Pair& pair : contacts.pairs) {
    const auto lmds = contacts.of(pair);
    sets[{named[pair.mover], named[pair.other]}] = LmdSet(lmds.begin(), lmds.end());
  }
  return sets;
}

TEST(MoverGroup, NeitherOrderNorTuningChangesASet) {
  const Play play = drifting(9, 150, 8);
  Play shuffled = play;
  std::mt19937_64 random(3);
  std::vector<std::size_t> same(play.movers.size() + play.standing.size());
  std::iota(same.begin(), same.end(), 0);
  std::vector<std::size_t> named = same;
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
  MoverGroup group = group_of(play, 0.2), other = group_of(shuffled, 0.2);
  std::vector<MoverGroup> tuned;
  for (const auto& [slack, share] : {std::pair{0.05, 0.0}, std::pair{0.05, 1.0}, std::pair{1.0, 0.5}})
    tuned.push_back(group_of(play, 0.2, {.slack = slack, .pack_share = share}));
  MoverGroup::Work work;
  MoverContacts contacts;
  std::size_t swapped = 0, kept = 0;
  for (std::size_t frame = 0; frame < play.frames.size(); ++frame) {
    group.search(play.frames[frame], contacts, work);
    const Sets first = sets_of(contacts, same);
    for (MoverGroup& one : tuned) {
      MoverContacts again;
      one.search(play.frames[frame], again, work);
      ASSERT_EQ(again.pairs.size(), contacts.pairs.size());
      ASSERT_EQ(again.lmds.size(), contacts.lmds.size());
      for (std::size_t i = 0; i < again.lmds.size(); ++i) {
        EXPECT_TRUE(same_feature_pair(again.lmds[i], contacts.lmds[i]));
        EXPECT_EQ(again.lmds[i].point_moving, contacts.lmds[i].point_moving);
        EXPECT_EQ(again.lmds[i].distance, contacts.lmds[i].distance);
      }
    }
    other.search(shuffled.frames[frame], contacts, work);
    const Sets second = sets_of(contacts, named);
    ASSERT_EQ(first.size(), second.size());
    for (const auto& [pair, lmds] : second) {
      const bool swaps = pair.first > pair.second;
      const auto twin = first.find(swaps ? std::pair{pair.second, pair.first} : pair);
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

TEST(MoverGroup, IsTheSameAKilometreAway) {
  const Vec3 offset(1024.0, -2048.0, 512.0);
  const Play here = drifting(10, 120, 9), there = drifting(10, 120, 9, offset);
  MoverGroup a = group_of(here, 0.2), b = group_of(there, 0.2);
  MoverGroup::Work work;
  MoverContacts near, far;
  std::size_t lmds = 0;
  for (std::size_t frame = 0; frame < here.frames.size(); ++frame) {
    a.search(here.frames[frame], near, work);
    b.search(there.frames[frame], far, work);
    ASSERT_EQ(near.lmds.size(), far.lmds.size());
    for (std::size_t i = 0; i < near.lmds.size(); ++i) {
      ASSERT_TRUE(same_feature_pair(near.lmds[i], far.lmds[i]));
      ASSERT_EQ(near.lmds[i].distance, far.lmds[i].distance);
      ASSERT_LT((near.lmds[i].point_fixed + offset - far.lmds[i].point_fixed).norm(), 1e-11);
    }
    lmds += near.lmds.size();
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

TEST(MoverGroup, AtRestNothingIsTouched) {
  const Play play = row_of_balls(40, 1.2);
  MoverGroup group = group_of(play, 0.05);
  MoverContacts contacts;
  MoverGroup::Work first, work;
  group.search(play.frames[0], contacts, first);
  EXPECT_EQ(first.anchored, 40u);
  EXPECT_EQ(group.candidate_count(), 39u);  // the neighbours, 0.15 from reach
  for (int frame = 0; frame < 50; ++frame) group.search(play.frames[0], contacts, work);
  EXPECT_EQ(work.anchored, 0u);
  EXPECT_EQ(work.pairs_touched, 0u);
  EXPECT_EQ(work.pairs_searched, 0u);
  EXPECT_EQ(work.of_methods, WorkCounters{});
  EXPECT_EQ(group.method_count(), 0u);
  EXPECT_TRUE(contacts.pairs.empty());
  // Both of a pair come nearer by 0.08, within their slack of 0.125: together they use up its room.
  std::vector<Pose> poses = play.frames[0];
  poses[7].translation.x() += 0.08;
  group.search(poses, contacts, work);
  EXPECT_EQ(work.pairs_searched, 0u);
  poses[8].translation.x() -= 0.08;
  group.search(poses, contacts, work);
  EXPECT_EQ(work.anchored, 0u);
  EXPECT_EQ(work.pairs_searched, 1u);
  EXPECT_GE(work.pairs_touched, work.pairs_searched);
  EXPECT_LE(work.pairs_touched, 3u);
  ASSERT_EQ(contacts.pairs.size(), 1u);
  EXPECT_EQ(contacts.pairs[0].mover, 7u);
  EXPECT_EQ(contacts.pairs[0].other, 8u);
  EXPECT_EQ(group.method_count(), 1u);
}

TEST(MoverGroup, OnlyWhoLeavesItsSlackIsAnchored) {
  const Play play = row_of_balls(200, 1.5);
  MoverGroup group = group_of(play, 0.05);
  MoverContacts contacts;
  MoverGroup::Work first, work;
  std::vector<Pose> poses = play.frames[0];
  group.search(poses, contacts, first);
  const std::size_t candidates = group.candidate_count();
  // Ball 0 flies along the row, well out of reach, by 30 m: 0.1 a frame, slack 0.125.
  poses[0].translation.z() = 1.3;
  for (int frame = 0; frame < 300; ++frame) {
    poses[0].translation.x() += 0.1;
    group.search(poses, contacts, work);
    EXPECT_TRUE(contacts.pairs.empty());
  }
  EXPECT_GE(work.anchored, 150u);
  EXPECT_LE(work.anchored, 300u);
  EXPECT_LE(work.pairs_touched, 4u * work.anchored);
  EXPECT_NEAR(static_cast<double>(group.candidate_count()), static_cast<double>(candidates), 3.0);
}

TEST(MoverGroup, MethodsGoFromPairToPair) {
  // One ball along a row of others, near one or two of them at a time.
  Play play{{make_body("a", make_blob(0.5, 0.1, 2))}, {}, {}};
  const auto ball = make_body("ball", make_sphere(0.5, 2));
  for (int k = 0; k < 60; ++k) play.standing.emplace_back(ball, moved(1.5 * k, 0.0, 0.0));
  for (int frame = 0; frame < 900; ++frame) play.frames.push_back({moved(0.1 * frame, 1.05, 0.0)});
  MoverGroup group = group_of(play, 0.1), scratch(play.movers, play.standing, 0.1,
                                                  method_maker("certified", {{"frame_coherence", false}}));
  MoverContacts contacts, fresh;
  MoverGroup::Work work, ignored;
  std::size_t met = 0;
  for (const std::vector<Pose>& poses : play.frames) {
    group.search(poses, contacts, work);
    scratch.search(poses, fresh, ignored);
    ASSERT_EQ(contacts.pairs.size(), fresh.pairs.size());
    ASSERT_EQ(contacts.lmds.size(), fresh.lmds.size());
    for (std::size_t i = 0; i < fresh.lmds.size(); ++i)
      ASSERT_EQ(contacts.lmds[i].point_fixed, fresh.lmds[i].point_fixed);
    for (const MoverContacts::Pair& pair : contacts.pairs) met = std::max<std::size_t>(met, pair.other);
  }
  EXPECT_EQ(met, 60u);
  EXPECT_LE(group.method_count(), 4u);
}

TEST(MoverGroup, OneMethodServesAllThatKeepNothing) {
  const Play play = drifting(6, 20, 10);
  MoverGroup certified = group_of(play, 0.2), exhaustive = group_of(play, 0.2, {}, "exhaustive");
  MoverContacts found, truth;
  MoverGroup::Work work;
  for (const std::vector<Pose>& poses : play.frames) {
    certified.search(poses, found, work);
    exhaustive.search(poses, truth, work);
    ASSERT_EQ(found.lmds.size(), truth.lmds.size());
    for (std::size_t i = 0; i < truth.lmds.size(); ++i)
      EXPECT_TRUE(same_feature_pair(found.lmds[i], truth.lmds[i]));
  }
  EXPECT_FALSE(truth.lmds.empty());
  EXPECT_LE(exhaustive.method_count(), 9u);  // ordered pairs of three meshes
}

TEST(MoverGroup, FollowsMeshesThatDeform) {
  const auto ball = std::make_shared<Body>("ball", build_surface(make_sphere(0.5, 2)));
  const Play play{{ball, ball}, {FixedBody(ball, moved(0.0, 3.0, 0.0))}, {}};
  MoverGroup group = group_of(play, 0.1);
  MoverContacts contacts;
  MoverGroup::Work work;
  const std::vector<Pose> poses{moved(0.0, 0.0, 0.0), moved(1.5, 0.0, 0.0)};
  group.search(poses, contacts, work);
  EXPECT_TRUE(contacts.pairs.empty());
  std::vector<Vec3> vertices = ball->surface().mesh.vertices;
  for (Vec3& vertex : vertices) vertex *= 1.45;
  ball->deform(vertices);
  group.search(poses, contacts, work);
  ASSERT_EQ(contacts.pairs.size(), 1u);
  EXPECT_NEAR(contacts.lmds[0].distance, 0.05, 0.02);
  for (Vec3& vertex : vertices) vertex *= 2.03;
  ball->deform(vertices);
  group.search(poses, contacts, work);
  const auto with_standing = [](const MoverContacts::Pair& pair) {
    return pair.mover == 0 && pair.other == 2;
  };
  EXPECT_EQ(std::count_if(contacts.pairs.begin(), contacts.pairs.end(), with_standing), 1);
}

TEST(MoverGroup, MayBeEmpty) {
  MoverGroup group({}, {FixedBody(make_body("ball", make_sphere(0.5, 1)))}, 0.1, method_maker("certified"));
  MoverContacts contacts;
  MoverGroup::Work work;
  group.search({}, contacts, work);
  EXPECT_TRUE(contacts.pairs.empty());
  EXPECT_EQ(group.mover_count(), 0u);
  EXPECT_EQ(group.object_count(), 1u);
}

TEST(MoverGroup, RefusesWhatIsNoPose) {
  const Play play = row_of_balls(2, 1.2);
  MoverGroup group = group_of(play, 0.1);
  const auto message = [&](const std::vector<Pose>& poses) {
    return message_of<UsageError>([&] {
      MoverContacts contacts;
      MoverGroup::Work work;
      group.search(poses, contacts, work);
    });
  };
  EXPECT_THAT(message({Pose{}}), HasSubstr("1 poses of 2 movers"));
  Pose scaled, lost;
  scaled.rotation.coeffs() *= 2.0;
  lost.translation.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message({Pose{}, scaled}), HasSubstr("pose 1"));
  EXPECT_THAT(message({lost, Pose{}}), HasSubstr("pose 0"));
  EXPECT_THAT(message({moved(1e300, 0.0, 0.0), Pose{}}), HasSubstr("pose 0"));
}

}  // namespace
}  // namespace lmdbench
