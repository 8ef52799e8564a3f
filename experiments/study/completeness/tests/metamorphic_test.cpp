// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/validity.h>
#include <lmdbench/methods/registry.h>

#include <gtest/gtest.h>
#include <study/completeness/laid_poses.h>
#include <study/completeness/metamorphic.h>
#include <support/parts/parts_scenes.h>

#include <algorithm>
#include <cmath>
#include <string>

/// A change that keeps shapes and places keeps the answer.
namespace lmdbench::completeness {
namespace {

constexpr double ROUNDING = 1e-14, KNOWN = 1e-9, CUTOFF = 1.0;

LmdSet at_distances(std::initializer_list<double> distances, FeatureKind kind = FeatureKind::VERTEX) {
  LmdSet lmds;
  for (const double distance : distances) {
    lmds.emplace_back();
    lmds.back().distance = distance;
    lmds.back().point_moving = Vec3::Zero();
    lmds.back().point_fixed = lmds.back().distance * Vec3::UnitX();
    lmds.back().direction = Vec3::UnitX();
    lmds.back().feature_moving.kind = lmds.back().feature_fixed.kind = kind;
  }
  return lmds;
}

Difference difference(const LmdSet& a, const LmdSet& b) {
  ScenePair pair;
  pair.cutoff = CUTOFF;
  pair.open = {0.75};
  return compare(pair, a, b, {ROUNDING, KNOWN, 1.0});
}

TEST(Metamorphic, ComparesCountsAndDistances) {
  const LmdSet set = at_distances({0.25, 0.5});
  EXPECT_FALSE(difference(set, set).differs);
  EXPECT_FALSE(difference(set, undone(at_distances({0.5, 1.0}), {2.0, {}, false})).bits_differ);
  EXPECT_TRUE(difference(set, at_distances({0.25})).differs);
  EXPECT_TRUE(difference(set, at_distances({0.25, 0.5 + 1e-12})).differs);
  EXPECT_FALSE(difference(set, at_distances({0.25, 0.5 + 1e-15})).differs);
  EXPECT_TRUE(difference(set, at_distances({0.25, 0.5 + 1e-15})).bits_differ);
  // Extended contacts are reported at their centroids.
  const LmdSet faces = at_distances({0.5}, FeatureKind::FACE);
  EXPECT_FALSE(difference(faces, at_distances({0.5 + 1e-10}, FeatureKind::FACE)).differs);
  EXPECT_TRUE(difference(faces, at_distances({0.5 + 1e-8}, FeatureKind::FACE)).differs);
}

TEST(Metamorphic, ComparesKindsDirectionsAndPlaces) {
  const auto wrong = [](const auto& change, double distance) {
    const LmdSet set = at_distances({distance, 0.75, 0.9});
    LmdSet changed = set;
    change(changed[0]);
    return difference(set, changed).differs;
  };
  for (const double distance : {0.0, 0.25}) {
    SCOPED_TRACE(distance);
    EXPECT_FALSE(wrong([](Lmd&) {}, distance));
    EXPECT_TRUE(wrong([](Lmd& lmd) { lmd.point_fixed.y() += 0.01; }, distance));
    EXPECT_TRUE(wrong([](Lmd& lmd) { lmd.point_moving.z() += 1e-12; }, distance));
    EXPECT_FALSE(wrong([](Lmd& lmd) { lmd.point_moving.z() += 1e-14; }, distance));
    EXPECT_TRUE(wrong([](Lmd& lmd) { lmd.feature_fixed.kind = FeatureKind::EDGE; }, distance));
    EXPECT_TRUE(wrong([](Lmd& lmd) { lmd.direction.setConstant(NAN); }, distance));
  }
  EXPECT_TRUE(wrong([](Lmd& lmd) { lmd.direction = -lmd.direction; }, 0.25));
  EXPECT_TRUE(wrong([](Lmd& lmd) { lmd.direction = Vec3::UnitY(); }, 0.25));
  // Of several equally near points another one may be the first.
  const LmdSet one = at_distances({0.25}), middle = at_distances({0.25}, FeatureKind::FACE);
  const auto moved = [](LmdSet set) {
    for (Vec3* point : {&set[0].point_moving, &set[0].point_fixed}) point->y() += 0.01;
    return set;
  };
  const auto after_turn = [](const LmdSet& a, const LmdSet& b) {
    ScenePair pair;
    pair.cutoff = CUTOFF;
    return compare(pair, a, b, {ROUNDING, KNOWN, 1.0}, true);
  };
  EXPECT_TRUE(difference(one, moved(one)).differs);
  EXPECT_TRUE(after_turn(one, moved(one)).tie);
  EXPECT_FALSE(after_turn(one, moved(one)).differs);
  EXPECT_TRUE(after_turn(middle, moved(middle)).differs);
  // Of a face the direction is known at any distance.
  LmdSet face = at_distances({0.0}, FeatureKind::FACE), turned = face;
  turned[0].direction = Vec3(1.0, 1e-6, 0.0).normalized();
  EXPECT_TRUE(difference(face, turned).differs);
}

/// Each change, undone, gives the same LMDs: direction and both points.
TEST(Metamorphic, UndoesChanges) {
  const ScenePair pair = pair_of(make_rest_scene(parts::rest_fit("U on rail"), 3, 0));
  const LmdSet truth = set_of("exhaustive", pair);
  ASSERT_FALSE(truth.empty());
  experiments::Random random(3);
  for (const Change& change : metamorphic_changes()) {
    Undo undo;
    const ScenePair changed = change.make(pair, random, undo);
    const LmdSet back = undone(set_of("exhaustive", changed), undo);
    ASSERT_EQ(back.size(), truth.size()) << change.name;
    for (const Lmd& lmd : back)
      EXPECT_TRUE(std::ranges::any_of(truth, [&](const Lmd& was) {
        return (lmd.direction - was.direction).norm() < 1e-9 &&
               (lmd.point_moving - was.point_moving).norm() < 1e-9 &&
               (lmd.point_fixed - was.point_fixed).norm() < 1e-9;
      })) << change.name;
  }
}

TEST(Metamorphic, NamesWhatTouchesAndWhatLiesAtTheCutoff) {
  LmdSet one = at_distances({0.0, 0.5}), two = at_distances({0.0, 0.0, 0.5});
  // Without intersections, contacts at distance 0 are compared one by one.
  EXPECT_TRUE(difference(one, two).differs);
  two[0].intersecting = two[1].intersecting = true;
  EXPECT_FALSE(difference(one, two).differs);
  EXPECT_TRUE(difference(one, two).tie);
  EXPECT_TRUE(difference(at_distances({0.5}), two).differs) << "nothing touches in the first";
  const LmdSet at_cutoff = at_distances({0.5, CUTOFF});
  EXPECT_FALSE(difference(at_distances({0.5}), at_cutoff).differs);
  EXPECT_TRUE(difference(at_distances({0.5}), at_cutoff).tie);
  EXPECT_FALSE(difference(at_distances({0.5}), at_distances({0.5, 0.75})).differs);
  EXPECT_TRUE(difference(at_distances({0.5}), at_distances({0.5, 0.7})).differs);
}

/// Seed of the scenes of this short test; lmdbench-study metamorphic looks at more.
constexpr std::uint64_t SEED = 3;

TEST(Metamorphic, ChangesLeaveShapesAlone) {
  experiments::Random random(SEED);
  const ScenePair pair = pair_of(make_rest_scene(parts::rest_fit("U on rail"), SEED, 0));
  const auto volume = [](const TriangleMesh& mesh) {
    return check_mesh(build_surface(mesh)).volume.value_or(0.0);
  };
  for (const Change& change : metamorphic_changes()) {
    Undo undo;
    const ScenePair changed = change.make(pair, random, undo);
    const double scale = undo.scale;
    const std::string name = change.name;
    const double cubed = scale * scale * scale, sum = volume(pair.moving) + volume(pair.fixed),
                 sum_after = volume(changed.moving) + volume(changed.fixed);
    if (name == "far parts more") {
      EXPECT_GT(sum_after, 1.01 * sum);
    } else if (name == "far triangles less") {
      EXPECT_LE(changed.moving.triangles.size(), pair.moving.triangles.size());
    } else {
      EXPECT_NEAR(sum_after, cubed * sum, 1e-12 * cubed * sum) << name;
    }
    if (name.starts_with("cut ")) {
      EXPECT_GT(changed.fixed.triangles.size(), pair.fixed.triangles.size()) << name;
    }
    if (name == "in another order" || name == "other diagonals") {
      EXPECT_EQ(changed.fixed.triangles.size(), pair.fixed.triangles.size()) << name;
      EXPECT_NE(changed.fixed.triangles, pair.fixed.triangles) << name;
    }
  }
}

void expect_same_answers(const ScenePair& pair, std::uint64_t seed, const std::string& what) {
  experiments::Random random(seed);
  const LmdSet truth = set_of("exhaustive", pair);
  for (const Change& change : metamorphic_changes()) {
    std::string objection;
    const MetamorphicCounts counts = judge_change(pair, truth, change, random, objection);
    EXPECT_FALSE(counts.is_wrong(change)) << what << "\n" << objection;
  }
}

/// Of both exact methods: parts in the design's coordinates intersect by no more than rounding.
void expect_directions(const parts::RestScene& scene) {
  for (const char* method : {"exhaustive", "certified"})
    for (const Lmd& lmd : lmds_at(*make_method(method, scene.scene), scene.X_WM))
      EXPECT_FALSE(lmd.intersecting) << method << ": " << scene.text;
}

TEST(RestScenes, TouchWithDirectionsAlone) {
  for (const parts::RestFit& fit : parts::rest_fits())
    for (std::size_t index = 0; index < 15; ++index)
      if (const parts::RestScene scene = make_rest_scene(fit, 9, index); !scene.single_precision)
        expect_directions(scene);
  // Two triangles touch in a point, both on both sides of the other's plane and of every contact's:
  // planes along their edges are between them.
  expect_directions(make_rest_scene(parts::rest_fit("comb in comb"), 5, 74));
}

/// Below the middle of two faces at 1e-8 rad, the planes through it seemed to be between both.
TEST(Metamorphic, FacesThatPierceEachOtherIntersectHoweverTheyAreCut) {
  const parts::RestScene scene = make_rest_scene(parts::rest_fit("prism in V block"), 202611275, 2152);
  expect_same_answers(pair_of(scene), 1, scene.text);
}

/// Of parts in single precision: an edge along an edge, whose gap grows from nothing to less than
/// the tolerance, took from a wall the points that make its contact a minimum.
TEST(Metamorphic, AWallThatLeansWithinTheToleranceKeepsItsLmd) {
  constexpr std::uint64_t LAID_SEED = 71;
  constexpr std::size_t INDEX = 2;
  for (const char* kind : {"L bracket on I beam", "ridge in V-block"}) {
    const parts::PartsScene scene = parts::make_parts_scene(
        {kind, parts::ALL_COORDINATES[INDEX], LAID_SEED, INDEX, parts::PoseFamily::ANY});
    ScenePair pair = pair_of(scene.scene, {});
    experiments::Random random(LAID_SEED * 0x9E3779B97F4A7C15ULL + INDEX);
    pair.X_WM = laid_pose(pair.moving, pair.fixed, random);
    expect_same_answers(pair, 1, kind);
  }
}

TEST(Metamorphic, NothingChangesTheAnswerAtRest) {
  std::uint64_t seed = 0;
  for (const parts::RestFit& fit : parts::rest_fits()) {
    for (std::size_t index = 0; index < 2; ++index) {
      const parts::RestScene scene = make_rest_scene(fit, SEED, index);
      expect_same_answers(pair_of(scene), ++seed, scene.text);
    }
  }
}

}  // namespace
}  // namespace lmdbench::completeness
