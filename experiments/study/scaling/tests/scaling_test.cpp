// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/registry.h>

#include <gtest/gtest.h>
#include <study/scaling/measure.h>
#include <study/scaling/slide.h>
#include <study/scaling/subdivide.h>
#include <support/poses.h>

#include <memory>

namespace lmdbench::scaling {
namespace {

TEST(Subdivided, KeepsTheSurfaceClosedAndInPlace) {
  const TriangleMesh coarse = make_box(Vec3(1.0, 2.0, 4.0));
  const TriangleMesh fine = subdivided(coarse, 2);
  EXPECT_EQ(fine.triangles.size(), 16 * coarse.triangles.size());
  EXPECT_EQ(bounding_box_diagonal(fine), bounding_box_diagonal(coarse));
  const ValidityReport report = check_mesh(build_surface(fine));
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.consistently_oriented);
  EXPECT_DOUBLE_EQ(report.area, 28.0);
  EXPECT_EQ(subdivided(coarse, 0).triangles, coarse.triangles);
}

TEST(LeadIn, SlidesTowardsThePoseInEqualSteps) {
  const Body blob("blob", build_surface(make_blob(1.0, 0.2, 2)));
  const Body box("box", build_surface(make_box(Vec3(1.0, 2.0, 0.5))));
  constexpr double GAP = 0.05;
  constexpr double DIAGONAL = 2.0;
  const Pose end = experiments::grazing_poses(blob, box, GAP, 1, 5).front();
  experiments::Random random(3);
  std::vector<Pose> frames = lead_in(blob, box, end, DIAGONAL, 10, random);
  ASSERT_EQ(frames.size(), 10u);
  frames.push_back(end);
  for (std::size_t i = 0; i + 1 < frames.size(); ++i)
    EXPECT_NEAR(frames[i].rotation.angularDistance(frames[i + 1].rotation), TURN_RAD_PER_FRAME, 1e-9);
  const double before = nearest_pair(blob, box, frames[9]).distance;
  EXPECT_NEAR(before, GAP, 0.2 * SLIDE_DIAGONALS_PER_FRAME * DIAGONAL) << "tangential";
}

TEST(Measure, FindsCertifiedRightAndCountsItsWork) {
  Scene scene;
  scene.moving = std::make_shared<const Body>("blob", build_surface(make_blob(1.0, 0.2, 2)));
  scene.fixed = {std::make_shared<const Body>("box", build_surface(make_box(Vec3(1.0, 2.0, 0.5), 4)))};
  scene.cutoff = 0.05;
  MeasureChoice choice;
  choice.repetitions = 1;
  choice.lead_in_frames = 3;
  choice.gap = 0.01;
  const auto poses = experiments::grazing_poses(*scene.moving, *scene.fixed[0], choice.gap, 4, 5);
  const Measurement measurement = measure(scene, poses, choice);
  ASSERT_EQ(measurement.series.size(), method_descriptions().size() + 3);
  for (const Series& series : measurement.series) {
    EXPECT_EQ(series.objection, "") << series.name;
    EXPECT_EQ(series.seconds.size(), poses.size());
  }
  EXPECT_GT(measurement.series[0].counters[0][Certified::Counter::NODE_PAIRS], 0u);
  EXPECT_EQ(measurement.series[0].counters, measurement.series[1].counters)
      << "a slide changes no work from scratch";
  for (const std::size_t count : measurement.lmd_counts) EXPECT_GE(count, 1u);

  choice.gap = 0.02;
  EXPECT_NE(measure(scene, poses, choice).series[0].objection, "") << "a wrong minimum distance is noticed";
}

TEST(MeasureBuild, CountsBytesPerTriangle) {
  const TriangleMesh mesh = make_sphere(1.0, 4);
  const BuildCost cost = measure_build(mesh);
  EXPECT_GT(cost.wide_hierarchy_bytes, 0u);
  EXPECT_GT(cost.surface_bytes, 80 * mesh.triangles.size());
  EXPECT_LT(cost.surface_bytes, 120 * mesh.triangles.size());
  EXPECT_GT(cost.features, mesh.triangles.size()) << "a convex shape: all of them";
  EXPECT_GT(cost.surface_cpu_seconds, 0.0);
  EXPECT_GT(cost.wide_hierarchy_cpu_seconds, 0.0);
}

}  // namespace
}  // namespace lmdbench::scaling
