// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <benchmarks/hierarchy_build/implementation.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench::experiments {
namespace {

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

}  // namespace

/// The hierarchy of `certified`: eight children, features with tight polar cones. Uses all cores.
BuildImplementation wide_hierarchy_build() {
  return {"wide", 1e-9, [](const Surface& surface) { return std::make_unique<WideBuild>(surface); }};
}

}  // namespace lmdbench::experiments
