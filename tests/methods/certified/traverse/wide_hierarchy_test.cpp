// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/deformation.h>
#include <lmdbench/decision/polar_condition.h>
#include <lmdbench/lmd/body.h>
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/build/polar_cap.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/methods/certified/layout/wide_lane.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include "methods/certified/traverse/wide_samples.h"
#include <gtest/gtest.h>
#include <support/polar_cone.h>
#include <support/scenes.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace lmdbench {
namespace {

using testing::expect_same_pairs;
using testing::extreme_directions;
using testing::for_each_random_node_test;
using testing::LaneSample;
using testing::make_bushing;
using testing::random_direction;
using testing::random_rotation;
using testing::random_transform;
using testing::shapes;
using testing::uniform;

std::vector<FeatureId> all_features(const Surface& surface) {
  std::vector<FeatureId> features;
  const auto add = [&](FeatureKind kind, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) features.push_back({kind, static_cast<std::int32_t>(i)});
  };
  add(FeatureKind::VERTEX, surface.mesh.vertices.size());
  add(FeatureKind::EDGE, surface.adjacency.edges.size());
  add(FeatureKind::FACE, surface.mesh.triangles.size());
  return features;
}

TEST(PolarCap, HoldsThePolarCone) {
  std::size_t narrow = 0, none = 0;
  for (const TriangleMesh& mesh : shapes()) {
    const Surface surface = build_surface(mesh);
    for (const FeatureId& feature : all_features(surface)) {
      const std::vector<Vec3> extremes = extreme_directions(surface, feature);
      const auto cap = polar_cap(surface, feature);
      if (!cap) {
        EXPECT_TRUE(extremes.empty()) << to_string(feature.kind) << feature.index;
        ++none;
        continue;
      }
      if (cap->is_all_directions()) continue;
      EXPECT_NEAR(cap->axis.norm(), 1.0, 1e-12);
      for (const Vec3& direction : extremes) {
        EXPECT_GE(cap->axis.dot(direction), cap->cosine) << to_string(feature.kind) << feature.index;
        EXPECT_LE(cap->axis.cross(direction).norm(), cap->sine);
      }
      if (cap->cosine > 0.5) ++narrow;
    }
  }
  EXPECT_GT(narrow, 1000u);
  EXPECT_GT(none, 1000u);
}

TEST(PolarCap, OfTentsOfAnyBend) {
  // Two triangles on one edge, flat to folded both ways, thin to fat. The cone is the arc from
  // normal to normal where the edge is convex, empty where it is reflex.
  std::mt19937_64 random(7);
  std::size_t convex = 0, reflex = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = std::pow(10.0, 4.0 * uniform(random) - 2.0);
    const double bend = (2.0 * uniform(random) - 1.0) * (i % 4 == 0 ? 1e-4 : 3.1);  // > 0: convex
    const auto wing = [&](double angle) {
      return Vec3(uniform(random) * 3.0 - 1.0, size * std::cos(angle), -size * std::sin(angle));
    };
    const Vec3 left = wing(0.5 * bend);
    Vec3 right = wing(0.5 * bend);
    right.y() = -right.y();
    const Mat3 turn = testing::random_rotation(random).toRotationMatrix();
    TriangleMesh tent;
    tent.vertices = {turn * Vec3::Zero(), turn * Vec3::UnitX(), turn * left, turn * right};
    tent.triangles = {{0, 1, 2}, {1, 0, 3}};
    const Surface surface = build_surface(tent);
    const auto cap = polar_cap(surface, {FeatureKind::EDGE, 0});
    const double flatness = (3.0 + size) / size;
    const double doubt = 50.0 * POLAR_SLACK * flatness + 4.0 * LARGEST_PARALLEL_TILT;
    if (bend > 0.0) {
      ASSERT_TRUE(cap) << "bend " << bend << ", size " << size;
      ++convex;
      if (cap->is_all_directions()) {
        ASSERT_GT(0.5 * bend + doubt, 1.5) << "bend " << bend << ", size " << size;
        continue;
      }
      for (const Vec3& normal : surface.face_normals) {
        ASSERT_GE(cap->axis.dot(normal), cap->cosine) << "bend " << bend << ", size " << size;
        ASSERT_LE(cap->axis.cross(normal).norm(), cap->sine);
      }
      ASSERT_LE(std::acos(cap->cosine), 0.5 * bend + doubt) << "bend " << bend << ", size " << size;
    } else if (-bend > doubt && -bend < 3.0) {
      ASSERT_FALSE(cap) << "bend " << bend << ", size " << size;
      ++reflex;
    }
  }
  EXPECT_GT(convex, 5000u);
  EXPECT_GT(reflex, 5000u);
}

/// Parallel chains are granted the tilt: they may meet a reflex edge of twice that.
TEST(PolarCap, OfAnEdgeThatBendsInwardsByLessThanTheTilt) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 1000; ++i) {
    const double tilt = LARGEST_PARALLEL_TILT * uniform(random), size = 0.2 + uniform(random);
    TriangleMesh valley;
    valley.vertices = {
        Vec3::Zero(), Vec3::UnitX(), {0.4, size, size * std::tan(tilt)}, {0.6, -size, size * std::tan(tilt)}};
    valley.triangles = {{0, 1, 2}, {1, 0, 3}};
    const auto cap = polar_cap(build_surface(valley), {FeatureKind::EDGE, 0});
    ASSERT_TRUE(cap) << "tilt " << tilt;
    // Square to the mean of two chains, so off the plane square to this one by half the tilt; and
    // leaning to a side until the wing there leads up by the tilt.
    for (const double lean : {-0.5, 0.0, 0.5})
      for (const double side : {-1.0, 0.0, 1.0}) {
        const Vec3 up =
            Vec3(lean * LARGEST_PARALLEL_TILT, side * (LARGEST_PARALLEL_TILT - tilt), 1.0).normalized();
        EXPECT_GE(cap->axis.dot(up), cap->cosine) << "tilt " << tilt;
      }
    EXPECT_LE(std::acos(cap->cosine), 5.0 * LARGEST_PARALLEL_TILT);
  }
}

/// Its two triangles are clearly no needles along the edge, of 1e-12, but one of them has no area.
TEST(PolarCap, OfAReflexEdgeWithOneNormal) {
  TriangleMesh fold;
  fold.vertices = {Vec3::Zero(), Vec3(1e-12, 0.0, 0.0), Vec3(0.0, 0.3, 0.0), Vec3(0.0, 1.1, 1.9)};
  fold.triangles = {{0, 1, 2}, {1, 0, 3}};
  const Surface surface = build_surface(fold);
  ASSERT_EQ(surface.face_normals[0], Vec3::UnitZ());
  ASSERT_TRUE(surface.face_normals[1].isZero(0.0));
  const FeatureId edge{FeatureKind::EDGE, 0};
  const std::vector<Vec3> extremes = extreme_directions(surface, edge);
  ASSERT_FALSE(extremes.empty());
  const auto cap = polar_cap(surface, edge);
  ASSERT_TRUE(cap);
  for (const Vec3& direction : extremes) EXPECT_GE(cap->axis.dot(direction), cap->cosine);
}

/// Their sum is rounding, along the edge: no outer side, which must not cut the cone.
TEST(PolarCap, OfAnEdgeWhoseNormalsCancel) {
  TriangleMesh fold;
  fold.vertices = {{-1.6112176410658267e-09, -3.3191047260829516e-09, -1.6073332055874179e-09},
                   {3.1169241280783188e-09, -3.0591551646468974e-10, 1.841415016597065e-09},
                   {-1.6112176410658267e-09, -3.3191047260829516e-09, -1.6073332055874179e-09},
                   {-2.9397845364018317e-09, -3.2468890067652776e-09, 0.50000000194675054}};
  fold.triangles = {{0, 1, 3}, {1, 2, 3}};
  const Body body("fold", build_surface(fold));
  const Surface& surface = body.surface();
  std::size_t folds = 0;
  for (std::int32_t edge = 0; edge < static_cast<std::int32_t>(surface.adjacency.edges.size()); ++edge) {
    if (surface.edge_is_boundary[static_cast<std::size_t>(edge)]) continue;
    ++folds;
    EXPECT_TRUE(surface.pseudo_normal({FeatureKind::EDGE, edge}).isZero(0.0));
    const auto cap = polar_cap(surface, {FeatureKind::EDGE, edge}, &body.prepared<ShapeComplex>());
    ASSERT_TRUE(cap);
    EXPECT_TRUE(cap->is_all_directions());
  }
  EXPECT_EQ(folds, 1u);
}

/// Rounding turns its product with another line out of the plane square to it.
TEST(PolarCap, OfALineAsShortAsRoundingIsAllDirections) {
  for (const double length : {0.9 * LEAST_WING, 1.1 * LEAST_WING}) {
    TriangleMesh tent;  // Its ridge is an edge of its own, the upright edges of a plate are chains.
    tent.vertices = {{0.0, 0.0, 0.0}, {length, 0.0, 0.0}, {0.0, 1.0, -0.1}, {0.0, -1.0, -0.1}};
    tent.triangles = {{0, 1, 2}, {1, 0, 3}};
    for (const TriangleMesh& mesh : {tent, make_box(Vec3(2.0, 2.0, length))}) {
      const Body body("short", build_surface(mesh));
      const Surface& surface = body.surface();
      const auto& shape = body.prepared<ShapeComplex>();
      ASSERT_EQ(shape.regions.extent, 1.0);
      std::size_t shorts = 0;
      for (std::int32_t chain = 0; chain < static_cast<std::int32_t>(shape.regions.straight_edges.size());
           ++chain) {
        const Segment line = surface.mesh.segment(shape.ends_of_chain(chain));
        if ((line[1] - line[0]).norm() > 2.0 * length) continue;
        ++shorts;
        const auto cap = polar_cap(surface, {FeatureKind::EDGE, shape.lead_of_chain(chain)}, &shape);
        ASSERT_TRUE(cap);
        EXPECT_EQ(cap->is_all_directions(), length < LEAST_WING);
      }
      EXPECT_GT(shorts, 0u);
    }
  }
}

/// Corners 1 and 3, and 2 and 6, are within the tolerance: triangle 2 is a needle of its region
/// whose own normal is turned over, and edge 1 is beside it.
TEST(PolarCap, OfChainsBesideANeedleTurnedOver) {
  TriangleMesh mesh;
  mesh.vertices = {{-1.7900472887021111e-05, -8.2744147232466893e-05, -8.5611274672167664e-05},
                   {2.3512033348913642e-05, -0.00010697663673534196, 2.0164052310685455e-05},
                   {3.3572137908777222e-05, -2.5502364223939367e-05, 8.3242943219374865e-05},
                   {2.3512033294537105e-05, -0.00010697663674363866, 2.0164052330073901e-05},
                   {-1.9699271464930161e-05, 8.9629073040441905e-05, -1.6894206044282321e-05},
                   {-4.0069971806575037e-05, 3.0438304758074993e-05, -9.935448181421675e-05},
                   {3.3572137892927914e-05, -2.5502364226357632e-05, 8.3242943225026079e-05},
                   {0.46616837382316589, 0.071127377450466156, -0.16621652245521545}};
  mesh.triangles = {{0, 1, 6}, {1, 0, 7}, {1, 2, 6}, {2, 1, 7}, {2, 3, 6}, {3, 2, 7},
                    {3, 4, 6}, {4, 3, 7}, {4, 5, 6}, {5, 4, 7}, {5, 0, 6}, {0, 5, 7}};
  mesh.planar_tolerance = 1.1920928955078125e-07;
  const Body body("needle", build_surface(mesh));
  const Surface& surface = body.surface();
  const auto& shape = body.prepared<ShapeComplex>();
  ASSERT_EQ(shape.region_of(2), shape.region_of(4));
  ASSERT_LT(surface.face_normals[2].dot(surface.face_normals[4]), 0.0);
  const ShapeSide side{surface, shape, RigidTransform(), false};
  std::size_t admitted = 0;
  for (std::int32_t chain = 0; chain < static_cast<std::int32_t>(shape.regions.straight_edges.size());
       ++chain) {
    const auto& ends = shape.ends_of_chain(chain);
    const PlanarFrame square(Vec3::Zero(), (side.vertex(ends[1]) - side.vertex(ends[0])).normalized());
    const auto cap = polar_cap(surface, {FeatureKind::EDGE, shape.lead_of_chain(chain)}, &shape);
    for (int k = 0; k < 720; ++k) {
      const double angle = k * std::numbers::pi / 360.0;
      const Vec3 u = square.lifted(Vec2(std::cos(angle), std::sin(angle)));
      if (!admits(side, {FeatureKind::EDGE, chain}, u, {0.0, 0.0})) continue;
      ++admitted;
      ASSERT_TRUE(cap) << "chain " << chain;
      EXPECT_TRUE(cap->is_all_directions() || cap->axis.dot(u) >= cap->cosine) << "chain " << chain;
    }
  }
  EXPECT_GT(admitted, 100u);
}

TEST(PolarCap, IsTight) {
  const Surface box = build_surface(make_box({1.0, 1.0, 1.0}));
  for (const FeatureId& feature : all_features(box)) {
    const auto cap = polar_cap(box, feature);
    ASSERT_TRUE(cap);
    const auto expected = [&] {
      if (feature.kind == FeatureKind::FACE) return 1.0;
      if (feature.kind == FeatureKind::VERTEX) return 1.0 / std::sqrt(3.0);
      const auto triangles = box.incident_triangles(feature);
      const bool flat = box.face_normals[static_cast<std::size_t>(triangles[0])].dot(
                            box.face_normals[static_cast<std::size_t>(triangles[1])]) > 0.5;
      return flat ? 1.0 : std::sqrt(0.5);
    }();
    EXPECT_NEAR(cap->cosine, expected, 1e-4) << to_string(feature.kind) << feature.index;
  }
}

/// Calls visit(node, lane, features below the lane).
std::vector<FeatureId> visit_lanes(
    const WideHierarchy& hierarchy, std::uint32_t node_index,
    const std::function<void(std::uint32_t, std::size_t, const std::vector<FeatureId>&)>& visit) {
  std::vector<FeatureId> all;
  const WideNode& node = hierarchy.nodes[node_index];
  for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
    const WideRef ref = WideRef::from_bits(node.child[lane]);
    if (ref.is_empty()) continue;
    const std::vector<FeatureId> below = ref.is_feature() ? std::vector<FeatureId>{ref.feature_id()}
                                                          : visit_lanes(hierarchy, ref.node_index(), visit);
    visit(node_index, lane, below);
    all.insert(all.end(), below.begin(), below.end());
  }
  return all;
}

/// @param shape  null for a hierarchy of the mesh itself
void expect_owns_and_bounds(const WideHierarchy& hierarchy, const Surface& surface,
                            const ShapeComplex* shape) {
  ASSERT_TRUE(bounds_what_is_below(hierarchy, surface, shape));
  std::map<FeatureId, std::vector<Vec3>> extremes;  // Each is asked of every lane above it.
  const auto extremes_of = [&](const FeatureId& feature) -> const std::vector<Vec3>& {
    const auto [place, is_new] = extremes.try_emplace(feature);
    if (is_new) place->second = extreme_directions(surface, feature);
    return place->second;
  };
  const auto check = [&](std::uint32_t node_index, std::size_t lane, const std::vector<FeatureId>& below) {
    const WideNode& node = hierarchy.nodes[node_index];
    const Vec3 axis = axis_of_lane(node, static_cast<std::uint32_t>(lane));
    // With a shape, the wings of a corner are not its edges.
    if (axis.isZero(0.0) || (shape != nullptr && shape->is_joined)) return;
    for (const FeatureId& feature : below)
      for (const Vec3& direction : extremes_of(feature))
        ASSERT_GE(direction.dot(axis), static_cast<double>(node.cosine[lane]));
  };
  std::vector<FeatureId> owned = visit_lanes(hierarchy, 0, check);
  std::sort(owned.begin(), owned.end());
  std::vector<FeatureId> expected;
  for (const FeatureId& feature : all_features(surface))
    if ((shape == nullptr || shape->is_lead(feature)) &&
        (feature.kind == FeatureKind::FACE || polar_cap(surface, feature, shape)))
      expected.push_back(feature);
  EXPECT_EQ(owned, expected);
  EXPECT_EQ(hierarchy.feature_count, expected.size());
}

TEST(WideHierarchy, OwnsEveryFeatureOnceAndBoundsIt) {
  for (const TriangleMesh& mesh : shapes()) {
    const Surface surface = build_surface(mesh);
    expect_owns_and_bounds(build_wide_hierarchy(surface), surface, nullptr);
  }
}

/// With a shape a lane holds a whole wall: every vertex of its region.
TEST(WideHierarchy, KnowsHowNarrowLongWallsAre) {
  const TriangleMesh mesh = make_bushing(48);
  const Body body("bushing", build_surface(mesh));
  const auto& hierarchy = body.prepared<WideHierarchy>();
  const auto& shape = body.prepared<ShapeComplex>();
  expect_owns_and_bounds(hierarchy, body.surface(), &shape);
  ASSERT_EQ(hierarchy.widths.size(), hierarchy.nodes.size());
  const double wall = 2.0 * 0.5 * std::sin(std::numbers::pi / 48.0);
  std::size_t walls = 0;
  visit_lanes(hierarchy, 0, [&](std::uint32_t n, std::size_t lane, const std::vector<FeatureId>& below) {
    const WideNode& node = hierarchy.nodes[n];
    const WideWidths& widths = hierarchy.widths[n];
    const Vec3 across(widths.across[0][lane], widths.across[1][lane], widths.across[2][lane]);
    const Vec3 axis(node.axis[0][lane], node.axis[1][lane], node.axis[2][lane]);
    if (widths.half_width[lane] == 0.0F) {
      EXPECT_TRUE(across.isZero(0.0));
      return;
    }
    EXPECT_NEAR(across.norm(), 1.0, 1e-6);
    EXPECT_NEAR(across.dot(axis), 0.0, 1e-6);
    if (below.size() != 1 || below[0].kind != FeatureKind::FACE) return;
    EXPECT_LE(static_cast<double>(widths.half_width[lane]), 0.51 * wall);
    const Vec3 centre(node.centre[0][lane], node.centre[1][lane], node.centre[2][lane]);
    std::vector<std::int32_t> corners;
    shape.append_corners(body.surface(), below[0], corners);
    for (const std::int32_t v : corners)
      EXPECT_LE(
          std::abs((mesh.vertices[static_cast<std::size_t>(v)] - hierarchy.origin - centre).dot(across)),
          static_cast<double>(widths.half_width[lane]));
    ++walls;
  });
  EXPECT_EQ(walls, 96u);

  Body deforming("deforming", build_surface(mesh));
  const auto& followed = deforming.prepared<WideHierarchy>();
  deforming.prepared<ShapeComplex>();
  std::vector<Vec3> vertices = mesh.vertices;
  for (Vec3& p : vertices) p.x() *= 1.5;
  deforming.deform(vertices);
  EXPECT_TRUE(followed.widths.empty()) << "widths of another mesh";
}

TEST(WideHierarchy, WallsOfABoreMeetAFewOfAPeg) {
  // Whatever the number of walls; a disc round a wall would meet half of all the others.
  const auto touching_a_wall = [](int segments) {
    const Body peg("peg", build_surface(make_sleeve(circle_outline(0.3999), nullptr,
                                                    {.height = 1.0, .around = segments})));
    const Body bushing("bushing", build_surface(make_bushing(segments)));
    const auto &a = peg.prepared<WideHierarchy>(), &b = bushing.prepared<WideHierarchy>();
    WideScratch scratch;
    WideCounters counters;
    find_wide_pairs(a, b, WideQuery(a, b, RigidTransform(), 0.01, 2e-8), WideKernel::VECTOR, scratch,
                    counters);
    return static_cast<double>(scratch.touch_pairs.size()) / segments;
  };
  EXPECT_LE(touching_a_wall(256), 8.0);
}

TEST(WideHierarchy, OwnsEveryFeatureOnceAndBoundsItWhileTheMeshDeforms) {
  std::mt19937_64 random(21);
  std::uint32_t refitted = 0, built_anew = 0;
  for (const TriangleMesh& mesh : shapes()) {
    for (const DeformationKind kind : {DeformationKind::BEND, DeformationKind::TWIST, DeformationKind::DENT,
                                       DeformationKind::BREATHE, DeformationKind::CRUMPLE}) {
      const double amplitude = kind == DeformationKind::TWIST  ? 6.0
                               : kind == DeformationKind::BEND ? 1.0
                                                               : 0.1;
      const Deformation deformation(
          mesh, {kind, amplitude, 0.2 + 0.8 * uniform(random), random_direction(random), 1});
      Body body("deforming", build_surface(mesh));
      const auto& hierarchy = body.prepared<WideHierarchy>();
      const auto& shape = body.prepared<ShapeComplex>();
      body.deform(mesh.vertices);
      std::vector<Vec3> vertices;
      for (int step = 1; step < 12; ++step) {
        deformation.at(0.02 * step, vertices);
        const std::uint32_t times = hierarchy.times_built_anew();
        body.deform(vertices);
        ++(hierarchy.times_built_anew() > times ? built_anew : refitted);
        expect_owns_and_bounds(hierarchy, body.surface(), &shape);
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
  EXPECT_GT(refitted, built_anew);
  EXPECT_GT(built_anew, 10u);
}

TEST(WideHierarchy, ABoundThatLosesAVertexIsSeen) {
  const Surface box = build_surface(make_box({1.0, 1.0, 1.0}));
  const WideHierarchy good = build_wide_hierarchy(box);
  ASSERT_TRUE(bounds_what_is_below(good, box, nullptr));
  WideHierarchy bad = good;
  bad.nodes[0].radius[0] *= 0.99F;
  EXPECT_FALSE(bounds_what_is_below(bad, box, nullptr));
  bad = good;
  bad.nodes.back().centre[1][0] += 0.01F;
  EXPECT_FALSE(bounds_what_is_below(bad, box, nullptr));
  bad = good;
  bad.radius *= 0.99;
  EXPECT_FALSE(bounds_what_is_below(bad, box, nullptr));
}

/// Turning a mesh in its frame changes its node tests by 3 % here; by divisions along the frame's
/// axes it was 13 %.
TEST(WideHierarchy, OfAPartThatLiesAskewIsAsGood) {
  const TriangleMesh ring = make_torus(1.0, 0.1, 96, 12);
  const auto tests_of = [&](const Eigen::Quaterniond& turn) {
    TriangleMesh turned = ring;
    for (Vec3& vertex : turned.vertices) vertex = turn * vertex;
    const Body body("ring", build_surface(turned));
    const auto& hierarchy = body.prepared<WideHierarchy>();
    double sum = 0.0;
    std::mt19937_64 random(3);
    for (int i = 0; i < 40; ++i) {
      const Eigen::Quaterniond rotation = random_rotation(random);
      const RigidTransform X(
          Pose{turn * (1.1 * random_direction(random)), turn * rotation * turn.conjugate()});
      WideScratch scratch;
      WideCounters counters;
      find_wide_pairs(hierarchy, hierarchy, WideQuery(hierarchy, hierarchy, X, 0.05, 1e-9),
                      WideKernel::VECTOR, scratch, counters);
      sum += static_cast<double>(counters.node_tests);
    }
    return sum;
  };
  std::vector<double> sums;
  for (const double degrees : {0.0, 20.0, 33.0, 45.0})
    sums.push_back(tests_of(Eigen::Quaterniond(
        Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vec3(1, 2, 3).normalized()))));
  const auto [least, most] = std::ranges::minmax(sums);
  EXPECT_LE(most, 1.07 * least) << ::testing::PrintToString(sums);
}

TEST(WideHierarchy, DoesNotDependOnTheNumberOfThreads) {
  const TriangleMesh mesh = make_blob(1.0, 0.3, 5);  // large enough to be built by several threads
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return build_wide_hierarchy(build_surface(mesh));
  };
  const WideHierarchy one = with_threads(1), four = with_threads(4);
  ASSERT_EQ(one.nodes.size(), four.nodes.size());
  EXPECT_EQ(std::memcmp(one.nodes.data(), four.nodes.data(), one.nodes.size() * sizeof(WideNode)), 0);
}

TEST(WideHierarchy, IsCompact) {
  const Surface surface = build_surface(make_blob(1.0, 0.3, 5));
  const WideHierarchy hierarchy = build_wide_hierarchy(surface);
  EXPECT_LE(static_cast<double>(hierarchy.bytes()) / static_cast<double>(surface.mesh.triangles.size()),
            140.0);
}

TEST(WideHierarchy, OfAnEmptyMeshIsEmpty) {
  EXPECT_TRUE(build_wide_hierarchy(build_surface(TriangleMesh{})).nodes.empty());
}

TEST(WideNodeTest, VectorAndScalarAgreeBitForBit) {
  std::mt19937_64 random(1);
  std::size_t alive = 0;
  std::size_t with_widths = 0;
  for_each_random_node_test(random, [&](const WideQuery& query, const WideNode& node, const WideProbe& probe,
                                        const WideWidthTest* widths) {
    const WideMasks scalar = test_lanes_scalar(node, probe, query.limits, widths);
    const WideMasks vector = test_lanes_vector(node, probe, query.limits, widths);
    ASSERT_EQ(scalar.lmd, vector.lmd);
    ASSERT_EQ(scalar.touch, vector.touch);
    ASSERT_EQ(scalar.used, vector.used);
    ASSERT_EQ(scalar.beyond, vector.beyond);
    ASSERT_EQ(scalar.not_collinear, vector.not_collinear);
    if (scalar.lmd != 0) ++alive;
    if (widths != nullptr && scalar.lmd != 0) ++with_widths;
  });
  EXPECT_GT(with_widths, 10u);
  EXPECT_GT(alive, 100u);
}

TEST(WideNodeTest, NeverRejectsAPairOfOppositeDirections) {
  // The lane is placed so that the direction from the probe's point to the lane's point is in both
  // cones, at a distance within the cutoff: the pair must be kept, whatever the bodies. At a
  // distance within the touch distance it must touch.
  std::mt19937_64 random(2);
  std::size_t rejected = 0, by_width = 0;
  for (int i = 0; i < 200000; ++i) {
    const LaneSample a(random);
    LaneSample b(random);
    const double cutoff = 0.2 * uniform(random);
    const double distance = cutoff * (i % 2 == 0 ? 1.0 : uniform(random));
    // Turn b so that its direction is opposite to a's, then move its point to a's point + distance.
    const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(b.direction, -a.direction).toRotationMatrix();
    b.turn(turn, a.point + distance * a.direction - turn * b.point);
    WideNode home{}, node{};
    WideWidths of_probe{}, of_node{};
    a.store(home, 0);
    b.store(node, 3);
    if (i % 3 != 1) a.store(of_probe, 0);
    if (i % 3 != 2) b.store(of_node, 3);
    const WideTransform same(Mat3::Identity(), Vec3::Zero());
    const WideProbe probe = make_probe(WideChild(home, 0), same);
    const WideWidthTest widths = make_width_test(of_node, of_probe, 0, same);
    const double size = 1.0 + b.centre.norm();
    const WideLimits limits{static_cast<float>(cutoff * (1.0 + 1e-7)),
                            static_cast<float>(distance * (1.0 + 1e-7)),
                            static_cast<float>(POSITION_ROUNDING * size)};
    for (const WideWidthTest* const with : {static_cast<const WideWidthTest*>(nullptr), &widths}) {
      const WideMasks masks = test_lanes_scalar(node, probe, limits, with);
      ASSERT_EQ(masks.lmd, 8u) << i;
      ASSERT_EQ(masks.touch, 8u) << i;
    }
    // The test is worth something if it rejects a pair at a gap slightly beyond the cutoff.
    WideLimits shorter = limits;
    shorter.reach *= 0.5F;
    shorter.touch = 0.0F;
    if (test_lanes_scalar(node, probe, shorter).lmd == 0)
      ++rejected;
    else if (test_lanes_scalar(node, probe, shorter, &widths).lmd == 0)
      ++by_width;
  }
  EXPECT_GT(rejected, 10000u);
  EXPECT_GT(by_width, 1000u);
}

TEST(WideTraversal, VectorAndScalarFindTheSamePairs) {
  std::mt19937_64 random(3);
  std::size_t pairs = 0;
  for (const TriangleMesh& mesh : shapes()) {
    const Body body("shape", build_surface(mesh));
    const auto& hierarchy = body.prepared<WideHierarchy>();
    for (int i = 0; i < 30; ++i) {
      const WideQuery query(hierarchy, hierarchy,
                            random_transform(2.0 * hierarchy.radius * uniform(random), random),
                            0.2 * uniform(random), 1e-9);
      WideScratch vector, scalar;
      WideCounters of_vector, of_scalar;
      find_wide_pairs(hierarchy, hierarchy, query, WideKernel::VECTOR, vector, of_vector);
      find_wide_pairs(hierarchy, hierarchy, query, WideKernel::SCALAR, scalar, of_scalar);
      ASSERT_NO_FATAL_FAILURE(expect_same_pairs(vector, of_vector, scalar, of_scalar));
      pairs += vector.lmd_pairs.size();
      std::set<std::pair<std::uint32_t, std::uint32_t>> unique;
      for (const WidePair& pair : vector.lmd_pairs) unique.emplace(pair.a.bits(), pair.b.bits());
      EXPECT_EQ(unique.size(), vector.lmd_pairs.size());
    }
  }
  EXPECT_GT(pairs, 1000u);
}

}  // namespace
}  // namespace lmdbench
