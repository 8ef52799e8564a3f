// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/drivers/contact_finder.h>
#include <lmdbench/methods/registry.h>

#include <gtest/gtest.h>
#include <support/closed_solids.h>
#include <support/scenes.h>
#include <support/sleeves.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

/// The aggregation `layered`, and the surface samples that it uses.
namespace lmdbench {
namespace {

ForceProfile linear_profile(double cutoff) {
  return {.law = ForceLaw::LINEAR, .cutoff = cutoff, .saturation_distance = 0.0, .maximum_force = 1.0};
}

/// An aggregation on a scene, with the contacts that `certified` finds.
class Rendered {
 public:
  Rendered(const Aggregation& aggregation, Scene scene)
      : scene_(std::move(scene)),
        method_(make_method("certified", scene_)),
        finder_(aggregation, scene_),
        profile_(linear_profile(scene_.cutoff)) {}
  Vec3 at(const Pose& X_WM) { return finder_.wrench_at(*method_, X_WM, profile_, X_WM.translation).force; }

 private:
  Scene scene_;
  std::unique_ptr<Method> method_;
  ContactFinder finder_;
  ForceProfile profile_;
};

std::vector<SurfaceSample> samples_of(const Scene& scene, const Pose& X_WM) {
  const auto method = make_method("certified", scene);
  const CriticalSet critical = critical_at(*method, X_WM);
  MergeFinder descents(scene);
  std::vector<Merge> merges;
  descents.find(X_WM, critical, merges);
  std::vector<SurfaceSample> samples;
  SurfaceSampler(scene).find(X_WM, critical, merges, descents, samples);
  return samples;
}

TEST(SurfaceSamples, CoverWhatIsWithinTheCutoff) {
  // A ball over a plate: seen from below, a cap of height h has the area pi (2 R h - h^2).
  constexpr double RADIUS = 1.0, CUTOFF = 0.2, GAP = 0.05, HEIGHT = CUTOFF - GAP;
  const Scene scene = testing::make_scene(make_sphere(RADIUS, 4), make_box({4.0, 4.0, 1.0}, 1), CUTOFF);
  const auto samples = samples_of(scene, testing::moved(0.013, 0.021, 0.5 + RADIUS + GAP));
  double area = 0.0;
  for (const SurfaceSample& sample : samples) {
    area += sample.area;
    EXPECT_NEAR((sample.direction - Vec3(0, 0, -1)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(sample.point_moving.z() - 0.5, sample.distance, 1e-12);
    EXPECT_EQ(sample.minimum, 0u);
  }
  EXPECT_NEAR(area, std::numbers::pi * (2.0 * RADIUS * HEIGHT - HEIGHT * HEIGHT), 0.04 * area);
}

TEST(SurfaceSamples, EachBelongsToTheMinimumBelowIt) {
  // A bar on two bumps: the samples over a bump belong to the bump's minimum.
  const TriangleMesh bumps = merged(translated(make_sphere(0.3, 3), {-1.0, 0.0, 0.0}),
                                    translated(make_sphere(0.3, 3), {1.0, 0.0, 0.0}));
  const Scene scene = testing::make_scene(make_box({3.0, 0.2, 0.2}, 4), bumps, 0.1);
  const Pose pose = testing::moved(0.0, 0.0, 0.3 + 0.1 + 0.04);
  const auto method = make_method("certified", scene);
  const CriticalSet critical = critical_at(*method, pose);
  const auto samples = samples_of(scene, pose);
  ASSERT_GT(samples.size(), 20u);
  for (const SurfaceSample& sample : samples)
    EXPECT_GT(sample.point_moving.x() * critical[sample.minimum].pair.point_moving.x(), 0.0);
}

TEST(SurfaceSamples, NoneWhereMeshesTouch) {
  const Scene scene = testing::make_scene(make_sphere(1.0, 2), make_sphere(1.0, 2), 0.2);
  EXPECT_TRUE(samples_of(scene, testing::moved(1.8, 0.0, 0.0)).empty());
  EXPECT_FALSE(samples_of(scene, testing::moved(2.05, 0.0, 0.0)).empty());
  EXPECT_TRUE(samples_of(scene, testing::moved(2.3, 0.0, 0.0)).empty());
}

Scene rod_in_bore(int rod, int bore) {
  // Polygons with the area of their circles; else a coarser polygon would have another gap.
  const auto radius_of = [](double radius, int n) {
    const double angle = 2.0 * std::numbers::pi / n;
    return radius * std::sqrt(angle / std::sin(angle));
  };
  return testing::make_scene(make_sleeve(circle_outline(radius_of(0.010, rod)), nullptr,
                                         {.height = 0.010, .around = rod, .layers = 6}),
                             make_sleeve(circle_outline(0.020), circle_outline(radius_of(0.0103, bore)),
                                         {.height = 0.030, .around = bore, .layers = 8}),
                             0.001);
}

/// Smooth surfaces, `off` the axis: the gap is g = gap - off cos(angle), the weight t - g.
double smooth_force(double cutoff, double gap, double off) {
  double force = 0.0;
  constexpr int LEVELS = 2000, ANGLES = 2000;
  for (int i = 0; i < LEVELS; ++i) {
    const double t = gap - off + (i + 0.5) / LEVELS * (cutoff - gap + off);
    double weight = 0.0, push = 0.0;
    for (int k = 0; k < ANGLES; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.5) / ANGLES;
      const double within = std::max(0.0, t - gap + off * std::cos(angle));
      weight += within;
      push += within * std::cos(angle);
    }
    force += push / weight * (cutoff - gap + off) / LEVELS / cutoff;
  }
  return force;
}

/// Mean over several roll angles.
double force_in_bore(int rod, int bore) {
  Rendered layered(layered_law(), rod_in_bore(rod, bore));
  double mean = 0.0;
  constexpr int ROLLS = 3;
  for (int k = 0; k < ROLLS; ++k) {
    const double angle = 0.1 + 1.7 * k;
    Pose pose = testing::moved(0.00015 * std::cos(angle), 0.00015 * std::sin(angle), 0.0003);
    pose.rotation = Eigen::AngleAxisd(0.37 * k, Vec3::UnitZ());
    const Vec3 force = layered.at(pose);
    EXPECT_GT(-force.dot(pose.translation), 0.9 * force.norm() * 0.00015)
        << "back to the axis: " << rod << " in " << bore << ", roll " << k;
    mean += force.norm() / ROLLS;
  }
  return mean;
}

/// The index of a ring on a plate is 0, and that of a plate with two holes -1.
TEST(FlatContacts, PushWhateverHolesTheyHave) {
  constexpr double CUTOFF = 0.1, GAP = 0.01;
  for (const TriangleMesh& part : {testing::make_ring(1.0, 0.5, 16, 1), testing::make_plate_with_holes(2)}) {
    const double height = 0.5 - bounding_box(part).min().z() + GAP;
    for (const Aggregation* law : {&shared_law(), &layered_law()}) {
      Rendered rendered(*law, testing::make_scene(part, make_box({40.0, 40.0, 1.0}), CUTOFF));
      for (const double tilt : {0.0, 1e-9, 1e-6}) {
        Pose X_WM = testing::moved(0.1, 0.2, height);
        X_WM.rotation = Eigen::AngleAxisd(tilt, Vec3(0.6, 0.8, 0.0));
        EXPECT_NEAR(rendered.at(X_WM).z(), 1.0 - GAP / CUTOFF, 1e-3) << law->name << ", tilt " << tilt;
      }
    }
  }
}

/// Two feet are one component from the distance of the groove between them on.
TEST(FlatContacts, SharedFindsTheSaddleOfParallelFaces) {
  constexpr double CUTOFF = 2.0, GAP = 0.2;
  const TriangleMesh bridge = testing::make_voxels({{0, 0, 0}, {2, 0, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 1}});
  Rendered rendered(shared_law(), testing::make_scene(bridge, make_box({40.0, 40.0, 1.0}), CUTOFF));
  const double height = 0.5 - bounding_box(bridge).min().z() + GAP;
  const double foot = 1.0 - GAP / CUTOFF, groove = 1.0 - (1.0 + GAP) / CUTOFF;
  for (const double tilt : {0.0, 1e-9, 1e-6}) {
    Pose X_WM = testing::moved(0.1, 0.2, height);
    X_WM.rotation = Eigen::AngleAxisd(tilt, Vec3::UnitX());
    EXPECT_NEAR(rendered.at(X_WM).z(), 2.0 * (foot - groove) + groove, 1e-5) << tilt;
  }
}

/// Merges are found in the frame in which methods search: else this far from the origin the turn of
/// the indices' pose moves the mesh, and some are lost.
TEST(FlatContacts, SharedForcesAreTheSameFarFromTheOrigin) {
  const TriangleMesh torus = make_torus(1.5, 0.4, 14, 9);
  const TriangleMesh rod =
      make_sleeve(circle_outline(1.0), nullptr, {.height = 6.0, .around = 10, .layers = 1});
  const auto moved_by = [](TriangleMesh mesh, const Vec3& offset) {
    for (Vec3& vertex : mesh.vertices) vertex += offset;
    return mesh;
  };
  const Vec3 offset = 131072.0 * Vec3(1.0, -2.0, 0.25);
  Rendered near(shared_law(), testing::make_scene(torus, rod, 0.3));
  Rendered far(shared_law(), testing::make_scene(moved_by(torus, offset), moved_by(rod, offset), 0.3));
  for (int k = 0; k < 24; ++k) {
    Pose X_WM = testing::moved(0.02 + 0.0005 * k, 0.01 + 0.0002 * k, 0.0), moved = X_WM;
    X_WM.rotation = moved.rotation = Eigen::AngleAxisd(6e-6 * k, Vec3(1, 2, 3).normalized());
    moved.translation += offset - moved.rotation * offset;
    EXPECT_LT((far.at(moved) - near.at(X_WM)).norm(), 1e-3) << k;
  }
}

TEST(Layered, ARodInABoreHasOneForceHoweverManyFacets) {
  const double fine = force_in_bore(64, 96);
  EXPECT_NEAR(fine, smooth_force(0.001, 0.0003, 0.00015), 0.03 * fine);
  // 64 in 64 is aligned in the first roll: every face of the rod is parallel to one of the bore,
  // and most descents cross level places.
  for (const auto& [rod, bore] : {std::pair{24, 32}, {32, 48}, {64, 64}})
    EXPECT_NEAR(force_in_bore(rod, bore), fine, 0.03 * fine) << rod << " facets in " << bore;
}

TEST(Layered, TurnsRoundSmoothlyWhereTheAxisCrossesTheCentre) {
  Rendered layered(layered_law(), rod_in_bore(24, 32));
  constexpr double STEP = 4e-6;
  Vec3 before = layered.at(testing::moved(-6 * STEP, 1e-6, 0.0003));
  double steepest = 0.0;
  for (int k = -5; k <= 5; ++k) {
    const Vec3 here = layered.at(testing::moved(k * STEP, 1e-6, 0.0003));
    steepest = std::max(steepest, (here - before).norm() / (STEP / 0.001));
    before = here;
  }
  EXPECT_LE(steepest, 4.0) << "F_max a cutoff";
  EXPECT_GT(steepest, 1.0);
}

}  // namespace
}  // namespace lmdbench
