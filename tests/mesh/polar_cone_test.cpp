// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/polar_cone.h>
#include <lmdbench/mesh/vertex_fan.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace lmdbench {
namespace {

FeatureId vertex(std::int32_t index) {
  return {FeatureKind::VERTEX, index};
}
FeatureId face(std::int32_t index) {
  return {FeatureKind::FACE, index};
}

FeatureId edge_between(const Surface& surface, std::int32_t a, std::int32_t b) {
  const std::array<std::int32_t, 2> ends{std::min(a, b), std::max(a, b)};
  const auto& edges = surface.adjacency.edges;
  const auto found = std::find(edges.begin(), edges.end(), ends);
  EXPECT_NE(found, edges.end());
  return {FeatureKind::EDGE, static_cast<std::int32_t>(found - edges.begin())};
}

bool has_generator(const PolarCone& cone, const Vec3& wanted) {
  return std::any_of(cone.generators.begin(), cone.generators.end(),
                     [&](const Vec3& g) { return (g - wanted.normalized()).norm() < 1e-6; });
}

bool all_generators_near_one_of(const PolarCone& cone, const std::vector<Vec3>& wanted) {
  return std::all_of(cone.generators.begin(), cone.generators.end(), [&](const Vec3& g) {
    return std::any_of(wanted.begin(), wanted.end(),
                       [&](const Vec3& w) { return (g - w.normalized()).norm() < 1e-6; });
  });
}

// Two triangles over the edge from 0 to 1 (the x axis); the second one hangs by `angle` below the first one's
// plane (negative: stands above it). Outer side up.
Surface hinge(double angle) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0.3, 1, 0}, {0.4, -std::cos(angle), -std::sin(angle)}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  return build_surface(mesh);
}

TEST(PolarConeTest, ConvexEdgeIsTheArcBetweenItsNormals) {
  const Surface surface = hinge(0.5);
  const FeatureId edge = edge_between(surface, 0, 1);
  const PolarCone cone = polar_cone(surface, edge);
  EXPECT_TRUE(has_generator(cone, surface.face_normals[0]));
  EXPECT_TRUE(has_generator(cone, surface.face_normals[1]));
  EXPECT_TRUE(all_generators_near_one_of(cone, {surface.face_normals[0], surface.face_normals[1]}));
  const Vec3 p(0.5, 0, 0);
  EXPECT_TRUE(in_polar_cone(surface, edge, p, surface.face_normals[0] + surface.face_normals[1]));
  EXPECT_FALSE(in_polar_cone(surface, edge, p, Vec3(0, 0.1, 1)));
  EXPECT_FALSE(in_polar_cone(surface, edge, p, Vec3(0.1, -0.1, 1)));
  EXPECT_FALSE(in_polar_cone(surface, edge, p, -surface.face_normals[0])) << "the inner side";
}

TEST(PolarConeTest, FlatEdgeHasTheNormalAndReflexEdgeHasNothing) {
  const Surface flat = hinge(0.0);
  const PolarCone cone = polar_cone(flat, edge_between(flat, 0, 1));
  EXPECT_FALSE(cone.empty());
  EXPECT_TRUE(all_generators_near_one_of(cone, {Vec3::UnitZ()}));
  for (const double angle : {-1e-6, -0.01, -1.0, -3.0}) {
    const Surface reflex = hinge(angle);
    EXPECT_FALSE(has_polar_cone(reflex, edge_between(reflex, 0, 1))) << angle;
  }
  const Surface doubtful = hinge(-1e-10);
  EXPECT_TRUE(has_polar_cone(doubtful, edge_between(doubtful, 0, 1))) << "in doubt a feature keeps its cone";
}

TEST(PolarConeTest, BoundaryEdgeHasAHalfPlane) {
  const Surface surface = hinge(0.5);
  const FeatureId edge = edge_between(surface, 1, 2);
  const Vec3 along = surface.mesh.vertices[2] - surface.mesh.vertices[1];
  const Vec3 away = along.cross(Vec3::UnitZ());
  const PolarCone cone = polar_cone(surface, edge);
  for (const Vec3& wanted : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(away)})
    EXPECT_TRUE(has_generator(cone, wanted));
  EXPECT_EQ(cone.generators.size() >= 3, true);
  const Vec3 p = surface.mesh.vertices[1] + 0.25 * along;
  EXPECT_TRUE(in_polar_cone(surface, edge, p, away + Vec3(0, 0, 1)));
  EXPECT_TRUE(in_polar_cone(surface, edge, p, away - Vec3(0, 0, 5))) << "no side is asked for";
  EXPECT_FALSE(in_polar_cone(surface, edge, p, -away + Vec3(0, 0, 5)));
}

TEST(PolarConeTest, BoundaryVertexIsThePolarOfItsEdgesOnBothSides) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const Surface surface = build_surface(mesh);
  const PolarCone cone = polar_cone(surface, vertex(0));
  for (const Vec3& wanted : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(-1, 0, 0), Vec3(0, -1, 0)})
    EXPECT_TRUE(has_generator(cone, wanted)) << wanted.transpose();
  EXPECT_TRUE(in_polar_cone(surface, vertex(0), mesh.vertices[0], Vec3(-1, -2, 3)));
  EXPECT_TRUE(in_polar_cone(surface, vertex(0), mesh.vertices[0], Vec3(-1, -2, -3)));
  EXPECT_FALSE(in_polar_cone(surface, vertex(0), mesh.vertices[0], Vec3(1, -2, 3)));
}

TEST(PolarConeTest, CubeCornerIsTheOctant) {
  const Surface surface = build_surface(make_box({2, 2, 2}));
  for (std::int32_t v = 0; v < 8; ++v) {
    const Vec3& corner = surface.mesh.vertices[static_cast<std::size_t>(v)];
    const std::vector<Vec3> wanted{corner.x() * Vec3::UnitX(), corner.y() * Vec3::UnitY(),
                                   corner.z() * Vec3::UnitZ()};
    const PolarCone cone = polar_cone(surface, vertex(v));
    for (const Vec3& w : wanted) EXPECT_TRUE(has_generator(cone, w));
    EXPECT_TRUE(all_generators_near_one_of(cone, wanted));
    EXPECT_FALSE(in_polar_cone(surface, vertex(v), corner, -corner)) << "the octant inside";
  }
}

TEST(PolarConeTest, PitsAndSaddlesHaveNothing) {
  // The box inside out: every corner a pit, every edge reflex; faces keep their normals.
  TriangleMesh hollow = make_box({2, 2, 2});
  for (auto& corners : hollow.triangles) std::swap(corners[1], corners[2]);
  const Surface surface = build_surface(hollow);
  for (std::int32_t v = 0; v < 8; ++v) EXPECT_FALSE(has_polar_cone(surface, vertex(v)));
  int edges = 0;
  for (std::int32_t e = 0; e < surface.adjacency.edge_count(); ++e)
    edges += has_polar_cone(surface, {FeatureKind::EDGE, e}) ? 1 : 0;
  EXPECT_EQ(edges, 6) << "the sides' diagonals";
  for (std::int32_t f = 0; f < 12; ++f) EXPECT_TRUE(has_polar_cone(surface, face(f)));

  const Surface torus = build_surface(make_torus(1.0, 0.3, 24, 12));
  for (std::int32_t v = 0; v < 24 * 12; ++v) {
    const Vec3& p = torus.mesh.vertices[static_cast<std::size_t>(v)];
    const double from_axis = std::hypot(p.x(), p.y());
    if (from_axis < 0.95) {
      EXPECT_FALSE(has_polar_cone(torus, vertex(v))) << "saddle " << v;
    } else if (from_axis > 1.05) {
      EXPECT_TRUE(has_polar_cone(torus, vertex(v))) << "convex " << v;
    }
  }
}

// Solid angle of a pointed cone's generators (van Oosterom and Strackee), in order round their mean.
double solid_angle(std::vector<Vec3> rays) {
  Vec3 axis = Vec3::Zero();
  for (const Vec3& ray : rays) axis += ray;
  axis.normalize();
  const Vec3 u = axis.unitOrthogonal(), w = axis.cross(u);
  std::sort(rays.begin(), rays.end(), [&](const Vec3& a, const Vec3& b) {
    return std::atan2(a.dot(w), a.dot(u)) < std::atan2(b.dot(w), b.dot(u));
  });
  double sum = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vec3& a = rays[i];
    const Vec3& b = rays[(i + 1) % rays.size()];
    sum += 2.0 * std::atan2(axis.dot(a.cross(b)), 1.0 + axis.dot(a) + a.dot(b) + b.dot(axis));
  }
  return sum;
}

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};
std::string name_of(const ::testing::TestParamInfo<NamedMesh>& info) {
  return info.param.name;
}

class ConvexShapeTest : public ::testing::TestWithParam<NamedMesh> {};

// Gauss map: the vertex cones of a convex solid tile the sphere of directions, and every feature has a cone.
TEST_P(ConvexShapeTest, VertexConesTileTheSphere) {
  const Surface surface = build_surface(GetParam().mesh);
  double sum = 0.0;
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v)
    sum += solid_angle(polar_cone(surface, vertex(static_cast<std::int32_t>(v))).generators);
  EXPECT_NEAR(sum, 4.0 * M_PI, 1e-5);
  EXPECT_EQ(features_with_polar_cones(surface).size(),
            surface.mesh.vertices.size() + surface.adjacency.edges.size() + surface.mesh.triangles.size());
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, ConvexShapeTest,
    ::testing::Values(NamedMesh{"sphere", make_sphere(1.0, 3)}, NamedMesh{"box", make_box({1, 2, 3})},
                      NamedMesh{"wedge", make_wedge(1.0, 1.0, 1.0)},
                      NamedMesh{"sharp_wedge", make_wedge(0.001, 1.0, 1.0)},
                      NamedMesh{"needles", make_needles(1.0, 4.0, 40, 0.0)},
                      NamedMesh{"spike", make_needles(0.001, 4.0, 20, 0.0)},
                      NamedMesh{"tiny", make_sphere(1e-9, 2)}, NamedMesh{"huge", make_sphere(1e9, 2)},
                      NamedMesh{"far", translated(make_box({1, 2, 3}), {1e6, -1e6, 1e6})}),
    name_of);

class AnyShapeTest : public ::testing::TestWithParam<NamedMesh> {};

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vec3 direction;
  do direction = Vec3(normal(random), normal(random), normal(random));
  while (direction.norm() < 1e-3);
  return direction.normalized();
}

// Positive combinations of generators pass the definition; directions near an empty cone's feature never do.
TEST_P(AnyShapeTest, GeneratorsAgreeWithTheDefinition) {
  const Surface surface = build_surface(GetParam().mesh);
  std::mt19937 random(11);
  std::exponential_distribution<double> weight;
  for (std::size_t i = 0; i < surface.mesh.vertices.size(); ++i) {
    const FeatureId id = vertex(static_cast<std::int32_t>(i));
    const Vec3& p = surface.mesh.vertices[i];
    const PolarCone cone = polar_cone(surface, id);
    EXPECT_EQ(cone.empty(), !has_polar_cone(surface, id));
    for (int trial = 0; trial < 20; ++trial) {
      if (cone.empty()) {
        const Vec3 n = surface.vertex_pseudo_normals[i] + 0.5 * trial / 20.0 * random_direction(random);
        EXPECT_FALSE(in_polar_cone(surface, id, p, n, 1e-10));
      } else {
        Vec3 n = Vec3::Zero();
        for (const Vec3& generator : cone.generators) n += weight(random) * generator;
        if (n.norm() < 1e-2) continue;  // opposite generators of a boundary vertex can cancel
        EXPECT_TRUE(in_polar_cone(surface, id, p, n, 1e-5)) << GetParam().name << " vertex " << i;
      }
    }
  }
}

// A point near the surface, in the direction of a feature's cone, has its nearest point among
// the incident triangles on that feature: what makes the cone an LMD's. Checked by distances to
// a fine sample of those triangles.
TEST_P(AnyShapeTest, NothingIncidentIsNearerThanTheFeature) {
  const Surface surface = build_surface(GetParam().mesh);
  std::mt19937 random(5);
  std::exponential_distribution<double> weight;
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  for (const FeatureId& id : features_with_polar_cones(surface)) {
    const auto triangles = surface.incident_triangles(id);
    Vec3 p;
    if (id.kind == FeatureKind::VERTEX) {
      p = surface.mesh.vertices[static_cast<std::size_t>(id.index)];
    } else if (id.kind == FeatureKind::EDGE) {
      const auto [a, b] = surface.adjacency.edges[static_cast<std::size_t>(id.index)];
      const double s = unit(random);
      p = (1 - s) * surface.mesh.vertices[static_cast<std::size_t>(a)] +
          s * surface.mesh.vertices[static_cast<std::size_t>(b)];
    } else {
      const Triangle t = surface.mesh.triangle(id.index);
      p = (t[0] + t[1] + t[2]) / 3.0;
    }
    Vec3 n = Vec3::Zero();
    for (const Vec3& generator : polar_cone(surface, id).generators) n += weight(random) * generator;
    if (n.norm() < 1e-2) continue;
    n.normalize();
    const double size = bounding_box_diagonal(surface.mesh);
    const Vec3 q = p + size * n;
    for (const std::int32_t triangle : triangles) {
      const Triangle t = surface.mesh.triangle(triangle);
      for (int sample = 0; sample < 10; ++sample) {
        Vec3 x = Vec3::Zero();
        double total = 0.0;
        for (const Vec3& corner : t) {
          const double w = weight(random);
          x += w * corner;
          total += w;
        }
        x /= total;
        EXPECT_GE((x - q).norm(), size * (1.0 - 1e-6))
            << GetParam().name << " " << to_string(id.kind) << " " << id.index;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, AnyShapeTest,
    ::testing::Values(NamedMesh{"blob", make_blob(1.0, 0.4, 3)},
                      NamedMesh{"torus", make_torus(1.0, 0.3, 20, 10)},
                      NamedMesh{"l_block", make_l_block(1.0)}, NamedMesh{"patch", make_patch(1.0, 9, 0.2)},
                      NamedMesh{"needles", make_needles(1.0, 4.0, 30)},
                      NamedMesh{"unequal", make_unequal(1.0, 9, 300.0)},
                      NamedMesh{"small_far_blob", translated(make_blob(0.01, 0.003, 2), {10, 20, -30})}),
    name_of);

TEST(PolarConeTest, NonManifoldFeaturesHaveNoSide) {
  // Two tetrahedra that touch in vertex 0 only.
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}};
  const Surface bow_tie = build_surface(mesh);
  EXPECT_EQ(fan_count(bow_tie, 0), 2);
  EXPECT_EQ(fan_count(bow_tie, 1), 1);
  EXPECT_FALSE(has_outer_side(bow_tie, vertex(0)));
  EXPECT_TRUE(has_outer_side(bow_tie, vertex(1)));
  EXPECT_FALSE(has_polar_cone(bow_tie, vertex(0)));
  EXPECT_TRUE(has_polar_cone(bow_tie, vertex(1)));

  // Three triangles on one edge, all on one side of the plane y = 0.
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 1, 0.5}, {0.5, 1, -0.5}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const Surface book = build_surface(mesh);
  const FeatureId spine = edge_between(book, 0, 1);
  EXPECT_FALSE(has_outer_side(book, spine));
  EXPECT_TRUE(in_polar_cone(book, spine, Vec3(0.5, 0, 0), Vec3(0, -1, 0)));
  EXPECT_TRUE(has_generator(polar_cone(book, spine), Vec3(0, -1, 2)));
  EXPECT_TRUE(has_generator(polar_cone(book, spine), Vec3(0, -1, -2)));
}

TEST(PolarConeTest, FoldedSheetKeepsTheHalfPlaneOfItsFold) {
  const Surface fold = hinge(M_PI);
  ASSERT_LT(fold.pseudo_normal({FeatureKind::EDGE, 0}).norm() *
                (fold.face_normals[0] + fold.face_normals[1]).norm(),
            1e-9);
  const FeatureId edge = edge_between(fold, 0, 1);
  const PolarCone cone = polar_cone(fold, edge);
  ASSERT_FALSE(cone.empty());
  EXPECT_TRUE(has_generator(cone, Vec3(0, -1, 0)));
}

TEST(PolarConeTest, TrianglesWithoutAreaCountThroughTheirCorners) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {3, 3, 3}};
  const Surface surface = build_surface(mesh);
  EXPECT_FALSE(has_polar_cone(surface, face(0)));
  EXPECT_FALSE(has_polar_cone(surface, face(1)));
  EXPECT_TRUE(in_polar_cone(surface, vertex(0), mesh.vertices[0], Vec3(-1, 5, 0))) << "end of a segment";
  EXPECT_FALSE(in_polar_cone(surface, vertex(0), mesh.vertices[0], Vec3(1, 5, 0)));
  EXPECT_EQ(polar_cone(surface, vertex(0)).generators.size(), 5u) << "a half-space";
  EXPECT_TRUE(has_polar_cone(surface, edge_between(surface, 0, 1)));
  EXPECT_EQ(polar_cone(surface, vertex(3)).generators.size(), 6u) << "a point: every direction";
  EXPECT_FALSE(has_polar_cone(surface, edge_between(surface, 3, 3))) << "no length";
  EXPECT_FALSE(has_polar_cone(surface, vertex(4))) << "not on the surface";
  EXPECT_FALSE(in_polar_cone(surface, vertex(4), mesh.vertices[4], Vec3(1, 0, 0)));
}

TEST(PolarConeTest, ListsFeaturesInOrder) {
  const auto features = features_with_polar_cones(build_surface(make_l_block(1.0)));
  EXPECT_TRUE(std::is_sorted(features.begin(), features.end()));
  EXPECT_EQ(std::adjacent_find(features.begin(), features.end()), features.end());
}

}  // namespace
}  // namespace lmdbench
