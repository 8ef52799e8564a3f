// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>
#include <lmdbench/methods/original/feature_points.h>
#include <lmdbench/methods/original/original.h>

#include <gtest/gtest.h>
#include <support/same_lmds.h>
#include <support/scenes.h>

#include <algorithm>
#include <array>

namespace lmdbench {
namespace {

using testing::make_scene;

Triangle triangle_of_size(std::mt19937_64& random, double size) {
  const Vec3 centre = testing::random_direction(random);
  return {centre + size * testing::random_direction(random),
          centre + size * testing::random_direction(random),
          centre + size * testing::random_direction(random)};
}

/// Largest distance of a point of the triangle from its feature points: the most by which 7x7
/// overestimates.
double covering_radius(const Triangle& t) {
  double radius = 0.0;
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; i + j <= 40; ++j) {
      const Vec3 point = t[0] + (i / 40.0) * (t[1] - t[0]) + (j / 40.0) * (t[2] - t[0]);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& feature : feature_points<7>(t)) nearest = std::min(nearest, (feature - point).norm());
      radius = std::max(radius, nearest);
    }
  }
  return radius * 1.05;  // the samples miss the farthest point by less
}

TEST(FeaturePoints, OverestimateTheDistanceByNoMoreThanTheCoveringRadii) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 300; ++i) {
    const Triangle a = triangle_of_size(random, 0.4), b = triangle_of_size(random, 0.4);
    const double exact = std::sqrt(triangle_distance(a, b).squared_distance);
    const double seven =
        std::sqrt(nearest_feature_points<7>(feature_points<7>(a), feature_points<7>(b)).squared_distance);
    EXPECT_GE(seven, exact - 1e-12);
    EXPECT_LE(seven, exact + covering_radius(a) + covering_radius(b));
  }
}

/// Each point is on its feature, and more points overestimate less.
template <std::size_t N>
double checked_overestimate(const Triangle& a, const Triangle& b) {
  const FeaturePoints<N> points = feature_points<N>(a);
  for (std::size_t i = 0; i < N; ++i) {
    const TriangleFeature part = part_of_feature_point<N>(i);
    const Vec3 normal = (a[1] - a[0]).cross(a[2] - a[0]);
    std::array<double, 3> shares{};
    for (std::size_t corner = 0; corner < 3; ++corner)
      shares[corner] = (a[(corner + 1) % 3] - points[i]).cross(a[(corner + 2) % 3] - points[i]).dot(normal) /
                       normal.squaredNorm();
    const auto positive = std::count_if(shares.begin(), shares.end(), [](double s) { return s > 0.05; });
    EXPECT_EQ(positive, is_vertex(part) ? 1 : is_edge(part) ? 2 : 3) << N << " points, number " << i;
    if (is_edge(part)) {
      EXPECT_NEAR(shares[static_cast<std::size_t>(local_index(part) + 2) % 3], 0.0, 1e-9);
    }
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((points[i] - points[j]).norm(), 0.0);
  }
  return std::sqrt(nearest_feature_points<N>(points, feature_points<N>(b)).squared_distance) -
         std::sqrt(triangle_distance(a, b).squared_distance);
}

TEST(FeaturePoints, MoreOfThemOverestimateLess) {
  std::mt19937_64 random(4);
  std::array<double, 4> sums{};
  for (int i = 0; i < 200; ++i) {
    const Triangle a = triangle_of_size(random, 0.4), b = triangle_of_size(random, 0.4);
    const std::array over{checked_overestimate<3>(a, b), checked_overestimate<7>(a, b),
                          checked_overestimate<13>(a, b), checked_overestimate<25>(a, b)};
    for (std::size_t k = 0; k < over.size(); ++k) {
      EXPECT_GE(over[k], -1e-12);
      sums[k] += over[k];
    }
  }
  EXPECT_GT(sums[0], 1.2 * sums[1]);
  EXPECT_GT(sums[1], 1.2 * sums[2]);
  EXPECT_GT(sums[2], 1.2 * sums[3]);
}

/// Both triangles of an edge need the same bits there; otherwise an LMD would switch between them.
TEST(FeaturePoints, OfAnEdgeAreTheSameFromBothSides) {
  std::mt19937_64 random(5);
  const Triangle a = triangle_of_size(random, 0.4);
  const Triangle b{a[1], a[0], a[2] + Vec3(0.3, 0.2, 0.1)};
  const FeaturePoints<25> of_a = feature_points<25>(a), of_b = feature_points<25>(b);
  int shared = 0;
  for (const Vec3& p : of_a) shared += static_cast<int>(std::count(of_b.begin(), of_b.end(), p));
  EXPECT_EQ(shared, 2 + 5);
}

TEST(DirectionVerification, AcceptsTheNormalSetAndItsTolerance) {
  const Surface surface = build_surface(make_box({1.0, 1.0, 1.0}));
  const DirectionVerification exact(surface, 1e-9), loose(surface, 0.3);
  const auto tilted = [](const Vec3& from, const Vec3& to, double angle) {
    return Vec3(std::cos(angle) * from + std::sin(angle) * to);
  };
  for (std::int32_t t = 0; t < 12; ++t) {
    const FeatureId face{FeatureKind::FACE, t};
    const Vec3 normal = surface.face_normals[static_cast<std::size_t>(t)];
    EXPECT_TRUE(exact.accepts(face, normal));
    EXPECT_FALSE(exact.accepts(face, tilted(normal, normal.unitOrthogonal(), 0.01)));
    EXPECT_TRUE(loose.accepts(face, tilted(normal, normal.unitOrthogonal(), 0.29)));
    EXPECT_FALSE(loose.accepts(face, tilted(normal, normal.unitOrthogonal(), 0.31)));
    EXPECT_FALSE(loose.accepts(face, -normal));
  }
  int sharp = 0;
  for (std::int32_t e = 0; e < surface.adjacency.edge_count(); ++e) {
    const auto faces = surface.adjacency.edge_triangles[e];
    const Vec3 n0 = surface.face_normals[static_cast<std::size_t>(faces[0])],
               n1 = surface.face_normals[static_cast<std::size_t>(faces[1])];
    if (n0.dot(n1) > 0.5) continue;
    ++sharp;
    const FeatureId edge{FeatureKind::EDGE, e};
    const Vec3 along = n0.cross(n1).normalized(), middle = (n0 + n1).normalized();
    EXPECT_TRUE(exact.accepts(edge, middle));
    EXPECT_TRUE(exact.accepts(edge, tilted(n0, n1, 0.2)));
    EXPECT_FALSE(exact.accepts(edge, tilted(middle, along, 0.01)));
    EXPECT_TRUE(loose.accepts(edge, tilted(middle, along, 0.29)));
    EXPECT_FALSE(loose.accepts(edge, tilted(middle, along, 0.31)));
    EXPECT_TRUE(loose.accepts(edge, tilted(middle, Vec3(-along), 0.29)));
    EXPECT_FALSE(loose.accepts(edge, tilted(middle, Vec3(-along), 0.31)));
    EXPECT_TRUE(loose.accepts(edge, tilted(n0, Vec3(-n1), 0.29)));
    EXPECT_FALSE(loose.accepts(edge, tilted(n0, Vec3(-n1), 0.31)));
  }
  EXPECT_EQ(sharp, 12);
  for (std::int32_t v = 0; v < 8; ++v) {
    const FeatureId vertex{FeatureKind::VERTEX, v};
    EXPECT_TRUE(exact.accepts(vertex, surface.mesh.vertices[static_cast<std::size_t>(v)].normalized()));
    EXPECT_FALSE(loose.accepts(vertex, -surface.mesh.vertices[static_cast<std::size_t>(v)].normalized()));
  }
}

class OriginalTest : public ::testing::Test {
 protected:
  LmdSet search(const Scene& scene, const Pose& pose, double tolerance,
                LineCone line_cone = LineCone::ONE_SIDED) {
    OriginalOptions options;
    options.g5_tolerance_deg = tolerance * 180.0 / std::numbers::pi;
    options.line_cone = line_cone;
    Original original(scene, options);
    LmdSet lmds;
    work_ = {};
    original.search(pose, lmds, work_);
    return lmds;
  }
  WorkCounters work_;
};

TEST_F(OriginalTest, AWiderToleranceKeepsMoreAndTheWidestAll) {
  std::mt19937_64 random(9);
  const Scene scene = make_scene(make_blob(0.04, 0.01, 3), make_torus(0.05, 0.02, 24, 12), 0.015);
  std::size_t tight = 0, loose = 0, all = 0;
  for (int i = 0; i < 10; ++i) {
    const Pose pose = testing::grazing_pose(scene, 0.002, random);
    tight += search(scene, pose, 0.05).size();
    loose += search(scene, pose, 0.6).size();
    all += search(scene, pose, std::numbers::pi).size();
    EXPECT_EQ(work_[Original::Counter::REJECTED_G5], 0u);
    EXPECT_EQ(work_[Original::Counter::FEATURE_POINT_DISTANCES], 49 * work_[Original::Counter::LEAF_PAIRS]);
  }
  EXPECT_LT(tight, loose);
  EXPECT_LT(loose, all);
}

TEST_F(OriginalTest, ATwoSidedLineConeLetsMoreNodePairsThrough) {
  std::mt19937_64 random(10);
  const Scene scene = make_scene(make_blob(0.04, 0.01, 3), make_torus(0.05, 0.02, 24, 12), 0.015);
  std::uint64_t all_one_sided = 0, all_two_sided = 0;
  for (int i = 0; i < 5; ++i) {
    const Pose pose = testing::grazing_pose(scene, 0.002, random);
    search(scene, pose, 0.5, LineCone::ONE_SIDED);
    const auto one_sided = work_[Original::Counter::LEAF_PAIRS];
    search(scene, pose, 0.5, LineCone::TWO_SIDED);
    EXPECT_GE(work_[Original::Counter::LEAF_PAIRS], one_sided);
    all_one_sided += one_sided;
    all_two_sided += work_[Original::Counter::LEAF_PAIRS];
  }
  EXPECT_GT(all_two_sided, all_one_sided) << "pairs whose normals face away from each other pass, too";
}

/// Decision E13: a vertex pair is one LMD.
TEST_F(OriginalTest, AVertexPairIsOneLmd) {
  const Scene scene = make_scene(make_box({0.1, 0.1, 0.1}), make_box({0.1, 0.1, 0.1}), 0.05);
  const Pose pose{Vec3(0.11, 0.12, 0.115)};
  const LmdSet lmds = search(scene, pose, 0.1);
  ASSERT_EQ(lmds.size(), 1u);
  EXPECT_EQ(lmds[0].feature_moving.kind, FeatureKind::VERTEX);
  EXPECT_GT(work_[Original::Counter::DROPPED_DUPLICATES], 0u);
}

/// Decision E12: they have no direction of their own.
TEST_F(OriginalTest, FeaturePointsThatMeetIntersect) {
  const Scene scene = make_scene(make_box({0.5, 0.5, 0.5}), make_box({0.5, 0.5, 0.5}), 0.05);
  for (const double gap : {0.0, 0.01}) {
    const LmdSet lmds = search(scene, Pose{Vec3(0.5, 0.5, 0.5 + gap)}, 0.1);
    ASSERT_EQ(lmds.size(), 1u);
    EXPECT_EQ(lmds[0].intersecting, gap == 0.0);
    EXPECT_EQ(lmds[0].direction.hasNaN(), gap == 0.0);
  }
}

/// The defect that the paper mends: on a large triangle the nearest feature points are far away.
TEST_F(OriginalTest, MissesWhatALargeTriangleHides) {
  const Scene scene = make_scene(make_sphere(0.002, 1), make_box({0.1, 0.1, 0.1}), 0.002);
  const Pose pose{Vec3(0.021, 0.013, 0.053)};
  LmdSet truth;
  Exhaustive(scene).search(pose, truth, work_);
  EXPECT_EQ(truth.size(), 1u);
  EXPECT_TRUE(search(scene, pose, 1.0).empty());
}

/// Fig. 5 (a) in both readings. Two plates of the same triangles, one above the other: after a
/// sideways motion a pair of face centres finds a nearer pair, with what lies across the edges and
/// by the face's own edges and corners.
TEST_F(OriginalTest, APairOfFaceCentresMovesOnInBothReadings) {
  TriangleMesh plate;  // triangles in the plane z = 0, normals up
  constexpr int LENGTH = 12;
  for (int i = 0; i < LENGTH; ++i) plate.vertices.emplace_back(0.5 * i, i % 2 == 0 ? 0.0 : 0.9, 0.0);
  for (int i = 0; i + 2 < LENGTH; ++i)
    plate.triangles.push_back(i % 2 == 0 ? std::array{i, i + 2, i + 1} : std::array{i, i + 1, i + 2});
  TriangleMesh upper = plate;
  for (auto& triangle : upper.triangles) std::swap(triangle[1], triangle[2]);
  const Scene scene = make_scene(upper, plate, 1.0);
  Lmd centres;
  centres.feature_moving = {FeatureKind::FACE, 2};
  centres.feature_fixed = {FeatureKind::FACE, 6};
  centres.triangle_moving = 2;
  centres.triangle_fixed = 6;
  const Pose pose{Vec3(0.0, 0.0, 0.1)};
  const auto tracked = [&](FaceNeighbourhood neighbourhood) {
    OriginalOptions options;
    options.face_neighbourhood = neighbourhood;
    LmdSet lmds{centres};
    Original(scene, options).track(pose, lmds, work_);
    return lmds.at(0);
  };
  const Lmd own = tracked(FaceNeighbourhood::OWN);
  const Lmd wide = tracked(FaceNeighbourhood::EDGE_NEIGHBOURS);
  EXPECT_NEAR(wide.distance, 0.1, 1e-9) << "the plates are 0.1 apart everywhere";
  EXPECT_NEAR(own.distance, 0.1, 1e-9);
  EXPECT_NEAR(wide.direction.z(), -1.0, 1e-9);
}

TEST(FaceNeighbours, AreTheFaceAndWhatLiesAcrossItsEdges) {
  const Surface sphere = build_surface(make_sphere(1.0, 1));
  const FaceNeighbours neighbours(sphere);
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(sphere.mesh.triangles.size()); ++t) {
    const TriangleList faces = neighbours.of(t);
    ASSERT_EQ(faces.size(), 4u) << "a closed mesh";
    EXPECT_EQ(faces.front(), t);
    for (std::size_t k = 1; k < faces.size(); ++k) {
      int shared = 0;
      for (const std::int32_t a : sphere.mesh.triangles[static_cast<std::size_t>(t)])
        for (const std::int32_t b : sphere.mesh.triangles[static_cast<std::size_t>(faces[k])])
          shared += a == b ? 1 : 0;
      EXPECT_EQ(shared, 2) << "face " << t << " and " << faces[k];
    }
  }
  const TriangleMesh alone{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}};
  EXPECT_EQ(FaceNeighbours(build_surface(alone)).of(0).size(), 1u) << "nothing is across a boundary";
}

/// Of pairs at one distance the one that is there stays: LMDs of flat grids do not wander.
TEST_F(OriginalTest, FlatGridsAtRestKeepTheirLmds) {
  const TriangleMesh slab = make_box({0.08, 0.08, 0.01}, {8, 8, 1});
  const Scene scene = make_scene(slab, slab, 0.005);
  const Pose pose{Vec3(0.0, 0.0, 0.012)};
  for (const int points : {7, 25}) {
    OriginalOptions options;
    options.feature_points = points;
    Original original(scene, options);
    LmdSet lmds = lmds_at(original, pose);
    const LmdSet found = lmds;
    EXPECT_GE(found.size(), 81u);
    for (int frame = 0; frame < 3; ++frame) {
      original.track(pose, lmds, work_);
      testing::expect_like_lmds(lmds, found, 0.0);
    }
  }
}

TEST_F(OriginalTest, TrackingNeverLengthensAPairAtRest) {
  std::mt19937_64 random(12);
  const Scene scene = make_scene(make_blob(0.04, 0.01, 3), make_torus(0.05, 0.02, 24, 12), 0.015);
  Original original(scene, {});
  for (int i = 0; i < 5; ++i) {
    const Pose pose = testing::grazing_pose(scene, 0.001, random);
    const LmdSet lmds = lmds_at(original, pose);
    LmdSet tracked = lmds;
    original.track(pose, tracked, work_);
    ASSERT_LE(tracked.size(), lmds.size());
    if (lmds.empty()) continue;
    EXPECT_LE(tracked[0].distance, lmds[0].distance);
    LmdSet again = tracked;
    original.track(pose, again, work_);
    testing::expect_like_lmds(again, tracked, 0.0);
  }
}

}  // namespace
}  // namespace lmdbench
