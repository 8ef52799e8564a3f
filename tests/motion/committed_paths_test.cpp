// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/motion/generate.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/mesh_scene.h>
#include <lmdbench/motion/path_facts.h>
#include <lmdbench/motion/path_spec.h>
#include <lmdbench/motion/tum_file.h>

#include <gtest/gtest.h>
#include <support/source_directory.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace lmdbench {
namespace {

const std::filesystem::path ROOT = LMDBENCH_SOURCE_DIR;

/// Every tenth frame is enough here: `lmdbench path info --spec` checks all frames.
constexpr std::size_t STRIDE = 10;

class CommittedPath : public ::testing::TestWithParam<const char*> {
 protected:
  PathSpec spec_ = read_path_spec(ROOT / "paths" / (std::string(GetParam()) + ".json"));
  PathInterpolator path_{read_tum(ROOT / "paths" / (std::string(GetParam()) + ".tum"))};
};

TEST_P(CommittedPath, HasTheTimesAndSpeedsOfItsSpecification) {
  const PathFacts facts = path_facts(path_, spec_.frame_rate);
  EXPECT_EQ(path_.start_time(), 0.0);
  EXPECT_NEAR(path_.end_time(), spec_.duration(), 1e-9);
  EXPECT_EQ(facts.pose_count, static_cast<std::size_t>(spec_.duration() * spec_.stored_rate + 1.5));
  EXPECT_EQ(facts.frame_count, static_cast<std::size_t>(spec_.duration() * spec_.frame_rate + 1.5));
  // The radial motion keeps its limits; sliding and interpolation add to it. A jump adds far more.
  EXPECT_LT(facts.maximum_speed, 2.0 * spec_.radial_speed.value());
  EXPECT_LT(facts.maximum_acceleration, 2.0 * spec_.radial_acceleration.value());
  EXPECT_GT(facts.turning, 0.3);
}

TEST_P(CommittedPath, KeepsItsGapOnTheMeshesItNames) {
  for (const PlacedMesh& mesh : {spec_.moving, spec_.fixed}) {
    const Manifest manifest = load_manifest(ROOT / "meshes" / "manifest.json");
    const ManifestEntry* entry = manifest.find(mesh.mesh);
    ASSERT_NE(entry, nullptr) << mesh.mesh;
    if (!entry->shape && !std::filesystem::exists(manifest.built_file(*entry)))
      GTEST_SKIP() << "run 'lmdbench mesh build " << mesh.mesh << "' first";
  }
  const auto place = [](const PlacedMesh& mesh) {
    return scaled_to_diagonal(resolve_mesh(mesh.mesh, ROOT / "meshes").mesh, mesh.placement.diagonal.value());
  };
  const PathScene scene = mesh_scene(place(spec_.moving), place(spec_.fixed));
  const Path all_frames = resample(path_, spec_.frame_rate);
  Path frames;
  for (std::size_t k = 0; k < all_frames.size(); k += STRIDE) frames.push_back(all_frames[k]);
  const GapMeasure measure = measure_gaps(frames, scene.distance);
  EXPECT_GE(measure.smallest(), spec_.gap_floor * scene.diagonal)
      << "frame " << STRIDE * measure.nearest_frame;
  std::size_t at_wanted_gap = 0;
  for (std::size_t k = 0; k < frames.size(); ++k)
    if (measure.gaps[k] <= 1.1 * scene.diagonal * wanted_gap(spec_.gaps, frames[k].time)) ++at_wanted_gap;
  EXPECT_GT(at_wanted_gap, frames.size() * 6 / 10) << "the limits keep it away too often";
}

INSTANTIATE_TEST_SUITE_P(, CommittedPath,
                         ::testing::Values("bunny-hard", "bunny-soft", "armadillo-bunny", "shapes"),
                         [](const auto& path) {
                           std::string name = path.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace lmdbench
