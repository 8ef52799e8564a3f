// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/mesh_scene.h>
#include <lmdbench/motion/rotation_vector.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

TEST(MeshScene, BoxesHaveTheirKnownDistance) {
  const PathScene scene = mesh_scene(make_box(Vec3(2, 2, 2)), make_box(Vec3(2, 2, 2)));
  EXPECT_NEAR(scene.diagonal, std::sqrt(12.0), 1e-15);
  EXPECT_NEAR(scene.moving_radius, std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(scene.fixed_radius, std::sqrt(3.0), 1e-15);
  const auto at = [](double x, double y, double z) {
    return Pose{Vec3(x, y, z), Eigen::Quaterniond::Identity()};
  };
  EXPECT_NEAR(scene.distance(at(5, 0, 0)), 3.0, 1e-15);             // face to face
  EXPECT_NEAR(scene.distance(at(0, 3, 3)), std::sqrt(2.0), 1e-15);  // edge to edge
  EXPECT_NEAR(scene.distance(at(-3, -3, -3)), std::sqrt(3.0), 1e-15);
  EXPECT_EQ(scene.distance(at(1.0, 0.7, 0.3)), 0.0);
  EXPECT_NEAR(scene.distance(at(0, 0, 2.5)), 0.5, 1e-15) << "after contact";
}

TEST(MeshScene, DistancesDoNotDependOnEarlierOnes) {
  const TriangleMesh torus = scaled_to_diagonal(make_torus(1.0, 0.4, 24, 12), 0.15);
  const TriangleMesh blob = scaled_to_diagonal(make_blob(1.0, 0.2, 3), 0.15);
  const PathScene warm = mesh_scene(torus, blob);
  for (int i = 0; i < 60; ++i) {
    // Small motions, and a jump now and then.
    const double t = 0.01 * i + (i % 10 == 0 ? 2.0 : 0.0);
    const Pose pose = {rotation_of(Vec3(t, 0.5, -t)) * Vec3(0.15, 0, 0), rotation_of(Vec3(0, t, 1.0))};
    const PathScene cold = mesh_scene(torus, blob);
    EXPECT_EQ(warm.distance(pose), cold.distance(pose)) << i;
  }
}

// Everywhere before it the gap is larger, and there it is reached. Conservative advancement stops
// there or, at a nearly tangential approach, a little farther out.
TEST(MeshScene, ReachIsWhereTheGapIsHadForTheFirstTime) {
  const TriangleMesh torus = scaled_to_diagonal(make_torus(1.0, 0.4, 24, 12), 0.15);
  const TriangleMesh plate = make_box(Vec3(0.4, 0.4, 0.01));
  const PathScene scene = mesh_scene(torus, plate);
  PathScene advancing = scene;
  advancing.centre_distance = nullptr;
  int reached = 0;
  for (int i = 0; i < 25; ++i) {
    const Vec3 direction = rotation_of(Vec3(0.37 * i, 0.11 * i, 0.05 * i)) * Vec3::UnitX();
    const Eigen::Quaterniond rotation = rotation_of(Vec3(0.2 * i, 0.9, -0.3 * i));
    for (const double gap : {1e-2, 1e-4}) {
      const double centre_distance = first_centre_distance(scene, direction, rotation, gap);
      const double advanced = first_centre_distance(advancing, direction, rotation, gap);
      const auto distance_at = [&](double s) {
        return scene.distance(
            {scene.fixed_centre_W + s * direction - rotation * scene.moving_centre_M, rotation});
      };
      reached += centre_distance > 0.0 ? 1 : 0;
      EXPECT_LE(centre_distance, advanced + GAP_TOLERANCE * gap) << i;
      if (centre_distance > 0.0) {
        EXPECT_LE(distance_at(centre_distance), gap * (1.0 + 1.001 * GAP_TOLERANCE)) << i;
        EXPECT_GE(distance_at(centre_distance), gap * (1.0 - 1e-9)) << i;
      }
      for (int k = 1; k <= 20; ++k)
        EXPECT_GE(distance_at(centre_distance + 0.02 * k * k * gap), gap * (1.0 - 1e-9)) << i << ", " << k;
    }
  }
  EXPECT_GT(reached, 20);
}

TEST(MeshScene, WhatIsNeverReachedIsZero) {
  // The ball passes through the hole of a ring along its axis.
  const PathScene scene = mesh_scene(make_sphere(0.1, 2), make_torus(1.0, 0.3, 40, 20));
  EXPECT_EQ(first_centre_distance(scene, Vec3::UnitZ(), Eigen::Quaterniond::Identity(), 1e-3), 0.0);
  EXPECT_GT(first_centre_distance(scene, Vec3::UnitX(), Eigen::Quaterniond::Identity(), 1e-3), 1.3);
}

TEST(MeshScene, GeneratedPathKeepsTheGapOnMeshes) {
  PathSpec spec;
  spec.stored_rate = 250.0;
  spec.frame_rate = 1000.0;
  spec.seed = 3;
  spec.slide_rate = 0.6;
  spec.turn_rate = 0.8;
  spec.radial_speed = 0.15;
  spec.radial_acceleration = 2.0;
  spec.gap_floor = 0.0003;
  spec.gaps = {{0.0, 0.02}, {0.4, 0.001}, {0.7, 0.001}};
  const PathScene scene = mesh_scene(scaled_to_diagonal(make_torus(1.0, 0.4, 24, 12), 0.15),
                                     scaled_to_diagonal(make_l_block(1.0), 0.15));
  const Path frames = resample(PathInterpolator(generate_path(spec, scene)), 1000.0);
  const GapMeasure measure = measure_gaps(frames, scene.distance);
  for (std::size_t k = 0; k < frames.size(); ++k)
    EXPECT_GE(measure.gaps[k], 0.15 * wanted_gap(spec.gaps, frames[k].time) - 1e-5) << k;
  EXPECT_GT(measure.frames_within(0.15 * 0.0015), 200u) << "it slides in close contact";
}

TEST(ScaledToDiagonal, CentresAndScales) {
  TriangleMesh box = make_box(Vec3(3, 4, 12));  // diagonal 13
  for (Vec3& vertex : box.vertices) vertex += Vec3(100, -20, 7);
  const TriangleMesh placed = scaled_to_diagonal(box, 0.26);
  EXPECT_NEAR(bounding_box_diagonal(placed), 0.26, 1e-15);
  EXPECT_LT(bounding_box_centre(placed).norm(), 1e-15);
  EXPECT_EQ(placed.triangles, box.triangles);
  double largest_x = 0.0;
  for (const Vec3& vertex : placed.vertices) largest_x = std::max(largest_x, vertex.x());
  EXPECT_NEAR(largest_x, 0.03, 1e-15);
}

TEST(ScaledToDiagonal, RefusesAMeshWithoutExtent) {
  EXPECT_THROW(scaled_to_diagonal(TriangleMesh{}, 0.15), InputError);
  EXPECT_THROW(scaled_to_diagonal(TriangleMesh{{Vec3(1, 2, 3)}, {{0, 0, 0}}}, 0.15), InputError);
}

}  // namespace
}  // namespace lmdbench
