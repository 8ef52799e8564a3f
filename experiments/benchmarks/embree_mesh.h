// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <functional>
#include <memory>

struct RTCSceneTy;
struct RTCDeviceTy;

namespace lmdbench::experiments {

/// A mesh in Embree's single-precision hierarchy. Distances use the mesh's own coordinates, and
/// searches reach a little farther than asked, so that results are exact.
class EmbreeMesh {
 public:
  explicit EmbreeMesh(const TriangleMesh& mesh);

  /// Calls `visit(triangle)` for triangles within reach of the point, nearest nodes first; it
  /// returns the next reach [m], which may only shrink. Embree's point query, exact if `visit` is.
  template <class Visit>
  void for_each_near(const Vec3& point, double reach, Visit&& visit) const {
    query(point, reach, [&visit](std::int32_t triangle) { return visit(triangle); });
  }

 private:
  using Visitor = std::function<double(std::int32_t triangle)>;
  void query(const Vec3& point, double reach, const Visitor& visit) const;

  struct Release {
    void operator()(RTCDeviceTy* device) const;
    void operator()(RTCSceneTy* scene) const;
  };
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
  double margin_ = 0.0;  ///< [m]
};

}  // namespace lmdbench::experiments
