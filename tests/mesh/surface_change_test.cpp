// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/deformation.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/flaws.h>
#include <lmdbench/mesh/surface_change.h>
#include <lmdbench/shape/shape_complex.h>

#include <gtest/gtest.h>

#include <vector>

namespace lmdbench {
namespace {

std::vector<TriangleMesh> some_meshes() {
  return {make_blob(1.0, 0.3, 3), make_torus(1.0, 0.4, 16, 10), make_box({1.0, 1.0, 1.0}, 4),
          make_l_block(1.0),      make_patch(2.0, 8, 0.0),      make_patch(2.0, 8, 0.1),
          make_caps(1.0, 0.5, 12)};
}

std::vector<DeformationChoice> some_deformations() {
  return {{DeformationKind::BEND, 0.7, 0.3, Vec3(1, 2, 3), 0},
          {DeformationKind::BEND, 0.7, 1.0, Vec3(0, 0, 1), 0},
          {DeformationKind::TWIST, 3.0, 1.0, Vec3(0, 1, 0), 0},
          {DeformationKind::DENT, 0.1, 0.2, Vec3(1, 0, 1), 0},
          {DeformationKind::BREATHE, 0.3, 1.0, Vec3(1, 0, 0), 0},
          {DeformationKind::CRUMPLE, 0.05, 0.5, Vec3(-1, 0, 0), 3}};
}

/// A shape without the numbers of regions, which depend on their order.
struct Named {
  std::vector<FeatureId> leads;
  std::vector<Vec3> normals, points, wings;
  bool operator==(const Named&) const = default;
};

Named named(const Surface& surface, const ShapeComplex& shape) {
  Named result;
  const auto look = [&](FeatureKind kind, std::size_t count) {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); ++i) {
      const FeatureId feature{kind, i};
      if (!shape.is_lead(feature)) continue;
      result.leads.push_back(feature);
      const auto visit = [&](const Vec3& wing) {
        result.wings.push_back(wing);
        return true;
      };
      if (kind == FeatureKind::VERTEX) shape.for_each_corner_wing(surface, i, visit);
      if (kind == FeatureKind::EDGE) shape.for_each_chain_wing(surface, shape.chain_of(i), visit);
      if (kind != FeatureKind::FACE || shape.region_of(i) < 0) continue;
      const Plane& plane = shape.regions.planes[static_cast<std::size_t>(shape.region_of(i))];
      result.normals.push_back(plane.normal);
      result.points.push_back(plane.point);
    }
  };
  look(FeatureKind::VERTEX, surface.mesh.vertices.size());
  look(FeatureKind::EDGE, surface.adjacency.edges.size());
  look(FeatureKind::FACE, surface.mesh.triangles.size());
  return result;
}

TEST(SurfaceChange, LeavesTheSurfaceAndShapeThatWouldBeBuilt) {
  std::uint32_t followed = 0, anew = 0;
  for (const TriangleMesh& mesh : some_meshes()) {
    for (const DeformationChoice& choice : some_deformations()) {
      const Deformation deformation(mesh, choice);
      Surface surface = build_surface(mesh);
      ShapeComplex shape = ShapeComplex::of(surface);
      SurfaceMover mover(surface);
      shape.follow(surface, mover.move(mesh.vertices, surface));
      std::vector<Vec3> vertices;
      for (int step = 1; step <= 12; ++step) {
        // Forth, to rest, and back.
        deformation.at(step == 7 ? 0.0 : 0.06 * step, vertices);
        const std::uint32_t times = shape.times_made_anew();
        const SurfaceChange& change = mover.move(vertices, surface);
        shape.follow(surface, change);
        ++(shape.times_made_anew() > times ? anew : followed);
        TriangleMesh now = mesh;
        now.vertices = vertices;
        const Surface built = build_surface(now);
        ASSERT_EQ(surface.face_normals, built.face_normals) << to_string(choice.kind) << " step " << step;
        for (std::int32_t v = 0; v < static_cast<std::int32_t>(vertices.size()); ++v)
          ASSERT_EQ(surface.vertex_normal(v), built.vertex_normal(v))
              << to_string(choice.kind) << " vertex " << v;
        const ShapeComplex expected = ShapeComplex::of(built);
        ASSERT_EQ(shape.regions.extent, expected.regions.extent);
        ASSERT_TRUE(named(surface, shape) == named(built, expected))
            << to_string(choice.kind) << " step " << step;
      }
    }
  }
  EXPECT_GT(followed, 100u) << "every step makes the shape anew";
  EXPECT_GT(anew, 20u);
}

TEST(SurfaceChange, NamesWhatChanged) {
  const TriangleMesh mesh = make_sphere(1.0, 2);
  Surface surface = build_surface(mesh);
  SurfaceMover mover(surface);
  std::vector<Vec3> vertices = mesh.vertices;
  EXPECT_TRUE(mover.move(vertices, surface).moved.empty());
  vertices[3] *= 1.25;
  const SurfaceChange& change = mover.move(vertices, surface);
  EXPECT_EQ(change.moved, std::vector<std::int32_t>{3});
  const std::size_t fan = surface.adjacency.vertex_triangles[3].size();
  EXPECT_EQ(change.faces.size(), fan);
  EXPECT_EQ(change.edges.size(), 2 * fan);
  EXPECT_EQ(change.vertices.size(), fan + 1);
  EXPECT_NEAR(change.largest_move, 0.25, 1e-15);
  EXPECT_EQ(change.turned_over, 0);
  EXPECT_EQ(change.lost_area, 0);
}

TEST(ShapeComplexFollow, ATriangleBesideARegionJoinsIt) {
  // One vertex of a level sheet is lifted, ever less, until its triangles are in the plane again.
  const TriangleMesh flat = make_patch(2.0, 6, 0.0);
  Surface surface = build_surface(flat);
  ShapeComplex shape = ShapeComplex::of(surface);
  SurfaceMover mover(surface);
  ASSERT_EQ(shape.regions.region_count(), 1);
  const std::size_t middle = flat.vertices.size() / 2;
  for (const double height : {0.1, 1e-6, 1e-12, 3e-14, 1e-14, 1e-15, 0.0}) {
    std::vector<Vec3> vertices = flat.vertices;
    vertices[middle].z() += height;
    shape.follow(surface, mover.move(vertices, surface));
    EXPECT_EQ(shape.regions.region_count(), ShapeComplex::of(surface).regions.region_count()) << height;
    EXPECT_EQ(shape.regions.region_count() == 1, height < 2e-14) << height;
  }
}

TEST(ShapeComplexFollow, ATriangleWithoutAreaThatGrowsBeyondItsEdgeHasFeatures) {
  // Zero-area triangles along first sides; a vertex inside such a side moves on, past its end.
  const TriangleMesh mesh = with_zero_areas(make_blob(1.0, 0.3, 2), 3);
  Surface surface = build_surface(mesh);
  ShapeComplex shape = ShapeComplex::of(surface);
  SurfaceMover mover(surface);
  const std::size_t first = make_blob(1.0, 0.3, 2).vertices.size();
  const auto& [a, b, c] = mesh.triangles[0];
  ASSERT_FALSE(shape.is_corner(static_cast<std::int32_t>(first)));
  for (const double share : {0.5, 0.5, 0.7, 1.5, 0.5}) {
    std::vector<Vec3> vertices = mesh.vertices;
    const Vec3 &from = vertices[static_cast<std::size_t>(a)], &to = vertices[static_cast<std::size_t>(b)];
    vertices[first] = from + share * (to - from);
    shape.follow(surface, mover.move(vertices, surface));
    EXPECT_EQ(shape.is_corner(static_cast<std::int32_t>(first)),
              ShapeComplex::of(surface).is_corner(static_cast<std::int32_t>(first)))
        << share;
    EXPECT_EQ(shape.is_corner(static_cast<std::int32_t>(first)), share > 1.0) << share;
  }
}

TEST(DeformationTest, MovesItsRegionAloneAndComesToRest) {
  const TriangleMesh mesh = make_blob(1.0, 0.3, 3);
  for (const DeformationChoice& choice : some_deformations()) {
    const Deformation deformation(mesh, choice);
    std::vector<Vec3> vertices;
    deformation.at(0.2, vertices);
    std::size_t moved = 0;
    for (std::size_t v = 0; v < vertices.size(); ++v) moved += vertices[v] != mesh.vertices[v] ? 1 : 0;
    const auto count = static_cast<double>(vertices.size());
    EXPECT_NEAR(static_cast<double>(moved) / count, choice.share, 0.03) << to_string(choice.kind);
    for (const double phase : {0.0, 0.5, 1.0, 7.0}) {
      deformation.at(phase, vertices);
      EXPECT_EQ(vertices, mesh.vertices) << to_string(choice.kind) << " at " << phase;
    }
  }
}

TEST(DeformationTest, RefusesWhatMovesNothing) {
  const TriangleMesh mesh = make_sphere(1.0, 1);
  EXPECT_THROW(Deformation(mesh, {DeformationKind::BEND, 0.5, 0.0, Vec3::UnitZ(), 0}), std::invalid_argument);
  EXPECT_THROW(Deformation(mesh, {DeformationKind::BEND, 0.5, 1.5, Vec3::UnitZ(), 0}), std::invalid_argument);
  EXPECT_THROW(Deformation(mesh, {DeformationKind::BEND, 0.5, 1.0, Vec3::Zero(), 0}), std::invalid_argument);
}

}  // namespace
}  // namespace lmdbench
