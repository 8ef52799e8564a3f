// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/hierarchy.h>
#include <lmdbench/snch/minimum_distance.h>

#include <benchmarks/hierarchy_build/implementation.h>

namespace lmdbench::experiments {
namespace {

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

}  // namespace

/// The paper's hierarchy: binary, spheres with normal cones, one triangle a leaf.
BuildImplementation binary_hierarchy_build() {
  return {"binary", 1e-9, [](const Surface& surface) { return std::make_unique<BinaryBuild>(surface); }};
}

}  // namespace lmdbench::experiments
