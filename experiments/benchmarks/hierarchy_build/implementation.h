// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench::experiments {

/// A query to a finished hierarchy: how far is the mesh from a small box? With the truth,
/// found by looking at every triangle.
struct BuildProbe {
  TriangleMesh box;  ///< Small beside the mesh, and apart from it.
  double distance_from_box = 0.0;
  double distance_from_corner = 0.0;  ///< From the box's first vertex, for what knows points only.
};

/// Task "hierarchy build": from a surface (mesh, adjacency, normals) to something that can be searched.
class HierarchyBuild {
 public:
  virtual ~HierarchyBuild() = default;
  /// What is timed.
  virtual void build() = 0;
  /// Drops what was built; not timed.
  virtual void clear() = 0;
  /// Asks the built hierarchy.
  /// @return relative error of the answer; NaN for none
  virtual double error_at(const BuildProbe& probe) = 0;
};

struct BuildImplementation {
  std::string name;
  /// Largest relative error of a right answer: rounding in double precision, or in single precision.
  double tolerance = 1e-9;
  std::function<std::unique_ptr<HierarchyBuild>(const Surface&)> make;
};

BuildImplementation surface_build();
BuildImplementation binary_hierarchy_build();
BuildImplementation wide_hierarchy_build();
BuildImplementation fcl_build();
BuildImplementation embree_build();
BuildImplementation cgal_build();

/// All that this build knows, but for `cgal_build`, which has a program of its own.
std::vector<BuildImplementation> build_implementations();

/// Relative error of a distance.
double relative_error(double distance, double truth);

/// Boxes around a mesh, near and far, with their true distances; the same in every run.
std::vector<BuildProbe> build_probes(const TriangleMesh& mesh, std::size_t count);

/// Builds and asks: what is wrong, or nothing.
std::string check_build(const BuildImplementation& implementation, HierarchyBuild& build,
                        const std::vector<BuildProbe>& probes);

}  // namespace lmdbench::experiments
