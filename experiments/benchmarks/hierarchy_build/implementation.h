// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench::experiments {

/// A query to a built hierarchy: the distance of a small box. The truth is from all triangles.
struct BuildProbe {
  TriangleMesh box;  ///< Small beside the mesh, and apart from it.
  double distance_from_box = 0.0;
  double distance_from_corner = 0.0;  ///< From the box's first vertex, for queries by points.
};

/// Task "hierarchy build": from a surface (mesh, adjacency, normals) to a searchable hierarchy.
class HierarchyBuild {
 public:
  virtual ~HierarchyBuild() = default;
  /// The timed work.
  virtual void build() = 0;
  /// Drops what was built; not timed.
  virtual void clear() = 0;
  /// Queries the built hierarchy.
  /// @return relative error of the answer; NaN for none
  virtual double error_at(const BuildProbe& probe) = 0;
};

struct BuildImplementation {
  std::string name;
  /// Largest relative error of a right answer: rounding of double precision or of single precision.
  double tolerance = 1e-9;
  std::function<std::unique_ptr<HierarchyBuild>(const Surface&)> make;
};

BuildImplementation fcl_build();
BuildImplementation embree_build();
BuildImplementation cgal_build();

/// All implementations of this build, except `cgal_build`, which has its own program.
std::vector<BuildImplementation> build_implementations();

/// Relative error of a distance.
double relative_error(double distance, double truth);

/// Boxes around a mesh, near and far, with true distances; the same in every run.
std::vector<BuildProbe> build_probes(const TriangleMesh& mesh, std::size_t count);

/// Builds and queries; returns the error, or nothing.
std::string check_build(const BuildImplementation& implementation, HierarchyBuild& build,
                        const std::vector<BuildProbe>& probes);

}  // namespace lmdbench::experiments
