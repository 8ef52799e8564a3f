// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/deformation.h>
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/certified/layout/wide_lane.h>
#include <lmdbench/methods/certified/vector_target.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/shape/shape_complex.h>

#include <gtest/gtest.h>
#include <support/lmd_text.h>
#include <support/message_of.h>
#include <support/scenes.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using testing::grazing_pose;
using testing::make_body;
using testing::random_direction;
using testing::uniform;

std::shared_ptr<Body> deforming_body(const TriangleMesh& mesh) {
  return std::make_shared<Body>("deforming", build_surface(mesh));
}

bool same_bits(const LmdSet& a, const LmdSet& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same_feature_pair(a[i], b[i]) || a[i].distance != b[i].distance ||
        a[i].point_moving != b[i].point_moving || a[i].point_fixed != b[i].point_fixed)
      return false;
  return true;
}

/// Tolerances of complete methods: two kernels compute points of contacts of crossing triangles.
bool same_pairs(const LmdSet& a, const LmdSet& truth) {
  if (a.size() != truth.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same_feature_pair(a[i], truth[i]) || std::abs(a[i].distance - truth[i].distance) > 1e-12 ||
        (a[i].point_fixed - truth[i].point_fixed).norm() > 1e-9)
      return false;
  return true;
}

/// Results of a run over a deforming scene.
struct Ran {
  std::size_t lmds = 0;
  WorkCounters kept, fresh;
};

/// One body of a scene deforms frame by frame. Compares the method that follows it with truth and
/// with methods on a new mesh of the same shape.
/// @param shape  vertices at a frame
Ran expect_truth(const TriangleMesh& moving, const TriangleMesh& fixed, bool moving_deforms, double cutoff,
                 const std::vector<Pose>& poses,
                 const std::function<void(std::size_t frame, std::vector<Vec3>& vertices)>& shape) {
  Ran ran;
  const TriangleMesh& rest = moving_deforms ? moving : fixed;
  const auto body = deforming_body(rest);
  const auto other = make_body("other", moving_deforms ? fixed : moving);
  const auto scene_with = [&](std::shared_ptr<const Body> changed) {
    return moving_deforms ? Scene{std::move(changed), {other}, cutoff}
                          : Scene{other, {std::move(changed)}, cutoff};
  };
  Certified kept(scene_with(body));
  Certified scratch(scene_with(body), {.frame_coherence = false});
  LmdSet of_kept, of_scratch, of_fresh, truth;
  std::vector<Vec3> vertices;
  for (std::size_t frame = 0; frame < poses.size(); ++frame) {
    shape(frame, vertices);
    body->deform(vertices);
    TriangleMesh now = rest;
    now.vertices = vertices;
    const Scene fresh_scene = scene_with(make_body("fresh", now));
    Certified fresh(fresh_scene);
    Exhaustive exhaustive(fresh_scene);
    WorkCounters of_truth, of_third;
    kept.search(poses[frame], of_kept, ran.kept);
    scratch.search(poses[frame], of_scratch, of_third);
    fresh.search(poses[frame], of_fresh, ran.fresh);
    exhaustive.search(poses[frame], truth, of_truth);
    ran.lmds += truth.size();
    if (same_bits(of_kept, of_fresh) && same_bits(of_scratch, of_fresh) && same_pairs(of_fresh, truth))
      continue;
    ADD_FAILURE() << "frame " << frame << " at " << testing::text(poses[frame]) << "\ntruth\n"
                  << testing::text(truth) << "kept\n"
                  << testing::text(of_kept) << "from scratch\n"
                  << testing::text(of_scratch) << "fresh\n"
                  << testing::text(of_fresh);
    return ran;
  }
  return ran;
}

/// Slow swings about a grazing pose.
std::vector<Pose> swing_about(const Pose& middle, double size, std::size_t frames, std::mt19937_64& random) {
  const Vec3 direction = random_direction(random), axis = random_direction(random);
  std::vector<Pose> poses;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const double phase = 0.15 * static_cast<double>(frame);
    Pose pose;
    pose.rotation =
        (Eigen::Quaterniond(Eigen::AngleAxisd(0.05 * std::sin(1.3 * phase), axis)) * middle.rotation)
            .normalized();
    pose.translation = middle.translation + 0.01 * size * std::sin(phase) * direction;
    poses.push_back(pose);
  }
  return poses;
}

struct NamedMesh {
  const char* name;
  TriangleMesh mesh;
};

std::vector<NamedMesh> meshes() {
  return {{"blob", make_blob(1.0, 0.3, 2)},
          {"torus", make_torus(1.0, 0.4, 14, 9)},
          {"box", make_box({1.2, 0.9, 1.0}, 3)},
          {"l-block", make_l_block(1.0)},
          {"two boxes", make_two_boxes({0.8, 0.9, 1.0}, 0.2)},
          {"patch", make_patch(2.0, 8, 0.15)},
          {"needles", make_needles(0.7, 2.0, 12)}};
}

void expect_truth_of(DeformationKind kind, double amplitude, double share, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::size_t lmds = 0;
  for (const NamedMesh& moving : meshes()) {
    for (const bool moving_deforms : {true, false}) {
      SCOPED_TRACE(moving.name);
      const TriangleMesh other = uniform(random) < 0.5 ? make_box({1.0, 1.1, 0.9}) : make_blob(0.8, 0.2, 2);
      const Scene rest = testing::make_scene(moving_deforms ? moving.mesh : other,
                                             moving_deforms ? other : moving.mesh, 1.0);
      const Pose middle = grazing_pose(rest, 0.02, random);
      DeformationChoice choice{kind, amplitude, share, random_direction(random), seed};
      const Deformation deformation(moving.mesh, choice);
      const double cutoff = std::vector<double>{0.05, 0.15, 0.5}[random() % 3];
      const auto poses = swing_about(middle, 1.0, 30, random);
      lmds +=
          expect_truth(moving_deforms ? moving.mesh : other, moving_deforms ? other : moving.mesh,
                       moving_deforms, cutoff, poses,
                       [&](std::size_t frame, std::vector<Vec3>& vertices) {
                         // In some frames the shape stays as it was, or is back at rest.
                         const std::size_t moved = frame % 7 == 3 ? frame - 1 : frame;
                         deformation.at(frame % 10 == 9 ? 0.0 : 0.011 * static_cast<double>(moved), vertices);
                       })
              .lmds;
    }
  }
  EXPECT_GT(lmds, 100u);
}

TEST(DeformingCertified, FindsTheTruthOfWholeMeshesThatBend) {
  expect_truth_of(DeformationKind::BEND, 0.8, 1.0, 1);
}
TEST(DeformingCertified, FindsTheTruthOfEars) {
  expect_truth_of(DeformationKind::BEND, 1.0, 0.25, 2);
}
TEST(DeformingCertified, FindsTheTruthOfTwistsByTwoTurns) {
  expect_truth_of(DeformationKind::TWIST, 4.0 * std::numbers::pi, 1.0, 3);
}
TEST(DeformingCertified, FindsTheTruthOfDents) {
  expect_truth_of(DeformationKind::DENT, 0.15, 0.3, 4);
}
TEST(DeformingCertified, FindsTheTruthOfMeshesThatBreathe) {
  expect_truth_of(DeformationKind::BREATHE, 0.2, 1.0, 5);
  expect_truth_of(DeformationKind::BREATHE, 0.2, 0.5, 6);
}
TEST(DeformingCertified, FindsTheTruthOfCrumples) {
  expect_truth_of(DeformationKind::CRUMPLE, 0.05, 1.0, 7);
  expect_truth_of(DeformationKind::CRUMPLE, 0.3, 1.0, 8);
}

/// A level sheet of n by n squares with a fold along x = 0.
TriangleMesh sheet(int cells) {
  return make_patch(2.0, cells, 0.0);
}

/// Whether each lane's cone holds those of the features below it.
::testing::AssertionResult cones_hold_what_is_below(const WideHierarchy& hierarchy) {
  constexpr double ROUNDING = 3e-6;  // Of cones that were built, from others than the stored ones.
  using Slot = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<std::vector<Slot>> below(hierarchy.nodes.size());
  std::vector<std::uint32_t> order{0};
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const std::uint32_t child : hierarchy.nodes[order[k]].child)
      if (const WideRef ref = WideRef::from_bits(child); !ref.is_empty() && !ref.is_feature())
        order.push_back(ref.node_index());
  for (std::size_t k = order.size(); k-- > 0;) {
    const WideNode& node = hierarchy.nodes[order[k]];
    for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
      const WideRef ref = WideRef::from_bits(node.child[lane]);
      if (ref.is_empty()) continue;
      const std::vector<Slot> features =
          ref.is_feature() ? std::vector<Slot>{{order[k], lane}} : below[ref.node_index()];
      below[order[k]].insert(below[order[k]].end(), features.begin(), features.end());
      if (ref.is_feature()) continue;
      const Vec3 axis = axis_of_lane(node, lane);
      for (const auto& [n, l] : features) {
        const WideNode& of = hierarchy.nodes[n];
        if (of.cosine[l] == NO_LMD_COSINE) continue;
        if (axis.isZero(0.0) && node.cosine[lane] == 0.0F && node.sine[lane] == 1.0F) continue;
        const Vec3 own = axis_of_lane(of, l);
        const double angle = std::atan2(axis.cross(own).norm(), axis.dot(own));
        // Each of the two numbers alone bounds the cone.
        const double sum = angle + std::min(std::asin(std::min(1.0, static_cast<double>(of.sine[l]))),
                                            std::acos(static_cast<double>(of.cosine[l])));
        if (own.isZero(0.0) || !(std::cos(sum) >= static_cast<double>(node.cosine[lane]) - ROUNDING) ||
            !(std::sin(sum) <= static_cast<double>(node.sine[lane]) + ROUNDING))
          return ::testing::AssertionFailure() << "lane " << lane << " of node " << order[k] << ": lane " << l
                                               << " of node " << n << " is outside";
      }
    }
  }
  return ::testing::AssertionSuccess();
}

TEST(DeformingCertified, BoundsHoldWhatIsBelowAndAreTheSameOnAllTargets) {
  std::mt19937_64 random(21);
  for (const DeformationKind kind :
       {DeformationKind::BEND, DeformationKind::TWIST, DeformationKind::CRUMPLE}) {
    for (const NamedMesh& deforming : meshes()) {
      SCOPED_TRACE(deforming.name);
      const Deformation deformation(deforming.mesh, {kind, 0.4, 0.6, random_direction(random), random()});
      std::vector<WideNode> first;
      for (const VectorTarget target : {VectorTarget::SCALAR, VectorTarget::SSE4, VectorTarget::AVX2,
                                        VectorTarget::AVX512, VectorTarget::BEST}) {
        if (!is_available(target)) continue;
        const UseVectorTarget use(target);
        const auto body = deforming_body(deforming.mesh);
        const auto& hierarchy = body->prepared<WideHierarchy>();
        std::vector<Vec3> vertices;
        for (int step = 0; step < 6; ++step) {
          deformation.at(0.02 * step, vertices);
          body->deform(vertices);
          EXPECT_TRUE(cones_hold_what_is_below(hierarchy)) << step;
          EXPECT_TRUE(bounds_what_is_below(hierarchy, body->surface(), &body->prepared<ShapeComplex>()))
              << step;
        }
        if (first.empty()) first = hierarchy.nodes;
        ASSERT_EQ(first.size(), hierarchy.nodes.size());
        EXPECT_EQ(std::memcmp(first.data(), hierarchy.nodes.data(), first.size() * sizeof(WideNode)), 0)
            << static_cast<int>(target);
      }
    }
  }
}

TEST(DeformingCertified, ASheetFoldsToARidgeAndBack) {
  // The plane splits, a ridge and a valley appear and vanish, and a reflex edge becomes convex.
  std::mt19937_64 random(11);
  const TriangleMesh flat = sheet(6);
  std::size_t lmds = 0;
  for (const double angle : {1e-9, 1e-3, 10.0 * std::numbers::pi / 180.0}) {
    SCOPED_TRACE(angle);
    for (const bool moving_deforms : {true, false}) {
      const TriangleMesh ball = make_blob(0.6, 0.1, 2);
      const Scene rest = testing::make_scene(moving_deforms ? flat : ball, moving_deforms ? ball : flat, 1.0);
      const Pose middle = grazing_pose(rest, 0.01, random);
      const auto poses = swing_about(middle, 1.0, 24, random);
      lmds +=
          expect_truth(moving_deforms ? flat : ball, moving_deforms ? ball : flat, moving_deforms, 0.2, poses,
                       [&](std::size_t frame, std::vector<Vec3>& vertices) {
                         vertices = flat.vertices;
                         const double fold =
                             std::tan(angle) *
                             std::vector<double>{0.0, 0.5, 1.0, 0.5, 0.0, -0.5, -1.0, 0.0}[frame % 8];
                         for (Vec3& p : vertices) p.z() -= fold * std::abs(p.x());
                       })
              .lmds;
    }
  }
  EXPECT_GT(lmds, 20u);
}

TEST(DeformingCertified, AFoldedBoxOnATableKeepsItsContacts) {
  // A face contact splits as the table's top folds, and comes back.
  const TriangleMesh table = make_box({3.0, 3.0, 0.5}, 4), block = make_box({1.0, 1.0, 1.0}, 2);
  std::vector<Pose> poses;
  for (int frame = 0; frame < 20; ++frame) poses.push_back(testing::moved(0.01 * frame, 0.0, 0.76));
  for (const double angle : {1e-9, 1e-3, 0.17}) {
    SCOPED_TRACE(angle);
    const Ran ran =
        expect_truth(block, table, false, 0.1, poses, [&](std::size_t frame, std::vector<Vec3>& vertices) {
          vertices = table.vertices;
          const double fold =
              std::tan(angle) * (frame % 4 == 0 ? 0.0 : std::sin(0.5 * static_cast<double>(frame)));
          for (Vec3& p : vertices) p.z() -= fold * std::abs(p.x());
        });
    EXPECT_GT(ran.lmds, 0u);
  }
}

TEST(DeformingCertified, TrianglesThatTurnOverOrVanishAreFactsNotErrors) {
  std::mt19937_64 random(12);
  const TriangleMesh blob = make_blob(1.0, 0.2, 2), box = make_box({1.0, 1.0, 1.0});
  const Scene rest = testing::make_scene(blob, box, 1.0);
  const Pose middle = grazing_pose(rest, 0.02, random);
  const auto collapsed = [&](std::size_t frame, std::vector<Vec3>& vertices) {
    vertices = blob.vertices;
    const auto corner = static_cast<std::size_t>(blob.triangles[7][0]),
               to = static_cast<std::size_t>(blob.triangles[7][1]);
    // The vertex moves onto its neighbour, then beyond it.
    const double part = std::vector<double>{0.0, 0.5, 1.0, 1.6, 1.0, 0.0}[frame % 6];
    vertices[corner] += part * (vertices[to] - vertices[corner]);
  };
  const Ran ran = expect_truth(blob, box, true, 0.3, swing_about(middle, 1.0, 18, random), collapsed);
  EXPECT_GT(ran.lmds, 0u);

  const auto body = deforming_body(blob);
  std::vector<Vec3> vertices;
  collapsed(2, vertices);
  const SurfaceChange& vanished = body->deform(vertices);
  EXPECT_GE(vanished.lost_area, 2);
  EXPECT_TRUE(body->surface().face_normals[static_cast<std::size_t>(vanished.first_lost_area)].isZero(0.0));
  collapsed(0, vertices);
  EXPECT_TRUE(body->deform(vertices).regained_area);
  vertices = blob.vertices;
  for (Vec3& p : vertices) p.x() = -p.x();
  const SurfaceChange& mirrored = body->deform(vertices);
  EXPECT_GT(mirrored.turned_over, 0);
  EXPECT_GE(mirrored.first_turned_over, 0);
}

TEST(DeformingCertified, BadVerticesAreRefusedAndNothingChanges) {
  std::mt19937_64 random(13);
  const TriangleMesh blob = make_blob(1.0, 0.2, 2);
  const auto body = deforming_body(blob);
  const auto message = [&](const std::vector<Vec3>& vertices) {
    return testing::message_of<InputError>([&] { body->deform(vertices); });
  };
  std::vector<Vec3> vertices = blob.vertices;
  vertices.pop_back();
  EXPECT_NE(message(vertices).find("161 vertices for a mesh of 162"), std::string::npos) << message(vertices);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    vertices = blob.vertices;
    vertices[5].y() = bad;
    EXPECT_NE(message(vertices).find("vertex 5"), std::string::npos) << message(vertices);
  }
  EXPECT_NE(message(std::vector<Vec3>(blob.vertices.size(), Vec3(1, 2, 3))).find("one place"),
            std::string::npos);
  EXPECT_EQ(body->deformations(), 0u);
  EXPECT_EQ(body->surface().mesh.vertices, blob.vertices);
}

TEST(DeformingCertified, AScanBesideAFlatPartDeformsAlone) {
  // Triangles that are regions by themselves move; joined faces share nodes with them, but stay.
  std::mt19937_64 random(15);
  TriangleMesh mesh =
      merged(make_blob(0.5, 0.15, 2), translated(make_box({1.0, 1.0, 1.0}, 3), Vec3(1.2, 0.0, 0.0)));
  const TriangleMesh other = make_blob(0.4, 0.1, 2);
  std::vector<bool> of_blob(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) of_blob[v] = mesh.vertices[v].x() < 0.69;
  const Deformation crumple(mesh, {DeformationKind::CRUMPLE, 0.02, 1.0, Vec3::UnitX(), 4});
  const auto shape = [&](std::size_t frame, std::vector<Vec3>& vertices) {
    crumple.at(0.02 * static_cast<double>(frame), vertices);
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (!of_blob[v]) vertices[v] = mesh.vertices[v];
  };
  const auto body = deforming_body(mesh);
  const auto& complex = body->prepared<ShapeComplex>();
  body->deform(mesh.vertices);
  std::vector<Vec3> vertices;
  shape(5, vertices);
  body->deform(vertices);
  EXPECT_TRUE(complex.is_joined);
  EXPECT_EQ(complex.times_made_anew(), 0u)
      << "the part's faces are found again although nothing of them moves";
  std::size_t lmds = 0;
  for (int i = 0; i < 6; ++i) {
    const Scene rest = testing::make_scene(other, mesh, 1.0);
    lmds += expect_truth(other, mesh, false, 0.4,
                         swing_about(grazing_pose(rest, 0.02, random), 1.0, 12, random), shape)
                .lmds;
  }
  EXPECT_GT(lmds, 50u);
}

TEST(DeformingCertified, WhatIsFarFromADeformationStaysKept) {
  // The far side of a blob deforms; tests near the contact stay valid.
  const TriangleMesh blob = make_blob(1.0, 0.2, 4), box = make_box({1.0, 1.0, 1.0});
  const auto body = deforming_body(blob);
  const Scene scene{make_body("box", box), {std::shared_ptr<const Body>(body)}, 0.05};
  const Deformation ear(blob, {DeformationKind::BEND, 0.5, 0.05, Vec3::UnitZ(), 0});
  const double displacement =
      first_approach(scene.moving->surface(), scene.moving->prepared<Hierarchy>(), body->surface(),
                     Hierarchy::of(body->surface()), Pose{}, -Vec3::UnitZ(), 0.02, 1e-9)
          .displacement;
  Certified kept(scene), scratch(scene, {.frame_coherence = false});
  WorkCounters of_kept, of_scratch;
  LmdSet lmds;
  std::vector<Vec3> vertices;
  for (int frame = 0; frame < 200; ++frame) {
    ear.at(0.003 * frame, vertices);
    body->deform(vertices);
    const Pose X_WM = testing::moved(1e-4 * frame, 0.0, -displacement);
    kept.search(X_WM, lmds, of_kept);
    scratch.search(X_WM, lmds, of_scratch);
  }
  EXPECT_LT(of_kept[Certified::Counter::NODE_PAIRS], of_scratch[Certified::Counter::NODE_PAIRS] / 4)
      << "kept tests are made again although nothing near them deforms";
}

TEST(DeformingCertified, AMeshWithEdgesAsShortAsRoundingOfTheOtherIsFollowed) {
  // It has a hierarchy for such coordinates (build/hierarchies_among.h), which no refit follows.
  std::mt19937_64 random(21);
  const TriangleMesh small = merged(make_blob(1e-3, 3e-4, 2), make_box(2e-8 * Vec3::Ones())),
                     large = make_box({1.0, 1.2, 0.7}, 2);
  const Scene rest = testing::make_scene(small, large, 1.0);
  std::vector<Pose> poses;
  for (int i = 0; i < 10; ++i) poses.push_back(grazing_pose(rest, 1e-4, random));
  // What was far from the other mesh comes near it.
  const Ran ran =
      expect_truth(small, large, true, 2.5e-4, poses, [&](std::size_t frame, std::vector<Vec3>& vertices) {
        const Eigen::AngleAxisd turn(2.0 * static_cast<double>(frame), random_direction(random));
        vertices = small.vertices;
        for (Vec3& p : vertices) p = turn * ((1.0 + 0.1 * uniform(random)) * p);
      });
  EXPECT_GT(ran.lmds, 5U);
}

TEST(DeformingMethods, AllFindTheSetOfTheNewMesh) {
  std::mt19937_64 random(16);
  for (const double offset : {0.0, 1e4}) {
    const TriangleMesh blob = translated(make_blob(1.0, 0.3, 2), Vec3(offset, 0.0, 0.0)),
                       box = make_box({1.0, 1.0, 1.0});
    const auto body = deforming_body(blob);
    const Scene scene{make_body("box", box), {std::shared_ptr<const Body>(body)}, 0.3};
    Pose pose;
    pose.translation = Vec3(offset + 1.5, 0.2, 0.1);
    const Deformation bend(blob, {DeformationKind::BEND, 0.6, 1.0, random_direction(random), 0});
    std::vector<std::unique_ptr<Method>> methods;
    for (const MethodDescription& description : method_descriptions())
      methods.push_back(make_method(description.name, scene));
    WorkCounters counters;
    LmdSet kept, fresh;
    std::vector<Vec3> vertices;
    std::size_t lmds = 0, pairs = 0;
    for (int frame = 0; frame < 5; ++frame) {
      bend.at(0.05 * frame, vertices);
      body->deform(vertices);
      // From the mesh at rest, which says where the frame is.
      const auto now = deforming_body(blob);
      now->deform(vertices);
      const Scene fresh_scene{scene.moving, {std::shared_ptr<const Body>(now)}, scene.cutoff};
      for (const auto& method : methods) {
        method->search(pose, kept, counters);
        make_method(method->description().name, fresh_scene)->search(pose, fresh, counters);
        EXPECT_TRUE(same_bits(kept, fresh))
            << method->description().name << " frame " << frame << " at " << offset;
        lmds += fresh.size();
        if (!method->description().finds_critical_pairs) continue;
        CriticalSet critical, fresh_critical;
        method->find_critical(pose, critical, counters);
        make_method(method->description().name, fresh_scene)->find_critical(pose, fresh_critical, counters);
        ASSERT_EQ(critical.size(), fresh_critical.size()) << method->description().name << " frame " << frame;
        for (std::size_t i = 0; i < critical.size(); ++i) {
          EXPECT_TRUE(same_feature_pair(critical[i].pair, fresh_critical[i].pair)) << "frame " << frame;
          EXPECT_EQ(critical[i].pair.distance, fresh_critical[i].pair.distance) << "frame " << frame;
        }
        pairs += critical.size();
      }
    }
    EXPECT_GT(lmds, 20u);
    EXPECT_GT(pairs, 5u);
  }
}

TEST(DeformingCertified, ManyMethodsMayFollowOneBodyAndSkipSteps) {
  std::mt19937_64 random(14);
  const TriangleMesh blob = make_blob(1.0, 0.3, 3), box = make_box({1.0, 1.0, 1.0});
  const auto body = deforming_body(blob);
  const Scene scene{make_body("box", box), {std::shared_ptr<const Body>(body)}, 0.2};
  const Pose middle = grazing_pose(scene, 0.02, random);
  const auto poses = swing_about(middle, 1.0, 60, random);
  const Deformation crumple(blob, {DeformationKind::CRUMPLE, 0.05, 0.5, random_direction(random), 3});
  Certified always(scene), seldom(scene);
  WorkCounters counters;
  LmdSet of_always, of_seldom;
  std::size_t lmds = 0;
  std::vector<Vec3> vertices;
  for (std::size_t frame = 0; frame < poses.size(); ++frame) {
    crumple.at(0.01 * static_cast<double>(frame), vertices);
    body->deform(vertices);
    always.search(poses[frame], of_always, counters);
    if (frame % 3 != 0) continue;
    seldom.search(poses[frame], of_seldom, counters);
    ASSERT_TRUE(same_bits(of_always, of_seldom)) << "frame " << frame;
    lmds += of_seldom.size();
  }
  EXPECT_GT(lmds, 10u);
}

}  // namespace
}  // namespace lmdbench
