// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <memory>

namespace lmdbench::experiments {

/// A mesh in CGAL's tree of boxes (GPL: only the benchmark programs named after it link this).
class CgalTree {
 public:
  explicit CgalTree(const TriangleMesh& mesh);
  ~CgalTree();
  CgalTree(CgalTree&& other) noexcept;
  CgalTree& operator=(CgalTree&& other) noexcept;

  /// Distance of the mesh's nearest point, or `limit` where that is smaller [m].
  double distance(const Vec3& point, double limit) const;
  double distance(const Vec3& point) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lmdbench::experiments
