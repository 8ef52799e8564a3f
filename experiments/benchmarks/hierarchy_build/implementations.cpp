// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>
#include <lmdbench/snch/hierarchy.h>
#include <lmdbench/snch/minimum_distance.h>

#include <benchmarks/hierarchy_build/implementation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace lmdbench::experiments {
namespace {

/// Adjacency and normals, from which both our hierarchies start, with a copy of the mesh.
class SurfaceBuild : public HierarchyBuild {
 public:
  explicit SurfaceBuild(const Surface& surface) : mesh_(surface.mesh) {}
  void build() override { built_ = build_surface(mesh_); }
  void clear() override { built_.reset(); }
  /// There is no query: its parts exist or not.
  double error_at(const BuildProbe&) override {
    return built_ && built_->face_normals.size() == mesh_.triangles.size() ? 0.0 : 1.0;
  }

 private:
  const TriangleMesh& mesh_;
  std::optional<Surface> built_;
};

/// The paper's hierarchy: binary, spheres with normal cones, one triangle a leaf.
class BinaryBuild : public HierarchyBuild {
 public:
  explicit BinaryBuild(const Surface& surface) : surface_(surface) {}
  void build() override { hierarchy_ = Hierarchy::of(surface_); }
  void clear() override { hierarchy_ = {}; }
  double error_at(const BuildProbe& probe) override {
    const Surface other = build_surface(probe.box);
    const NearestPair nearest = nearest_pair(surface_, hierarchy_, other, Hierarchy::of(other), Pose());
    return relative_error(nearest.distance, probe.distance_from_box);
  }

 private:
  const Surface& surface_;
  Hierarchy hierarchy_;
};

/// The hierarchy of `certified`: eight children, features with tight polar cones. Uses all cores.
class WideBuild : public HierarchyBuild {
 public:
  explicit WideBuild(const Surface& surface) : surface_(surface) {}
  void build() override { hierarchy_ = build_wide_hierarchy(surface_); }
  void clear() override { hierarchy_ = {}; }
  /// The nearest pair is an LMD, so a descent without a cutoff keeps it.
  double error_at(const BuildProbe& probe) override {
    const Surface other = build_surface(probe.box);
    const WideHierarchy small = build_wide_hierarchy(other);
    const WideQuery query(hierarchy_, small, RigidTransform(), std::numeric_limits<double>::infinity(), 0.0);
    WideScratch scratch;
    WideCounters counters;
    find_wide_pairs(hierarchy_, small, query, WideKernel::VECTOR, scratch, counters);
    double least = std::numeric_limits<double>::infinity();
    for (const WidePair& pair : scratch.lmd_pairs)
      for (const std::int32_t t : surface_.incident_triangles(pair.a.feature_id()))
        for (const std::int32_t side : other.incident_triangles(pair.b.feature_id()))
          least = std::min(
              least, triangle_distance(surface_.mesh.triangle(t), probe.box.triangle(side)).squared_distance);
    return relative_error(std::sqrt(least), probe.distance_from_box);
  }

 private:
  const Surface& surface_;
  WideHierarchy hierarchy_;
};

template <class Build>
std::unique_ptr<HierarchyBuild> make_build(const Surface& surface) {
  return std::make_unique<Build>(surface);
}

}  // namespace

std::vector<BuildImplementation> build_implementations() {
  std::vector<BuildImplementation> all = {{"surface", 0.0, make_build<SurfaceBuild>},
                                          {"binary", 1e-9, make_build<BinaryBuild>},
                                          {"wide", 1e-9, make_build<WideBuild>},
                                          fcl_build()};
#ifdef LMDBENCH_HAS_EMBREE
  all.push_back(embree_build());
#endif
  return all;
}

}  // namespace lmdbench::experiments
