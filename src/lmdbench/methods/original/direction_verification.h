// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/feature.h>
#include <lmdbench/mesh/surface.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Test G5 of the original algorithm (paper, section 3.2.1): "the vector with selected distance is verified
/// against the vertex/edge/face normals". A face's normal set is its normal, an edge's the arc between its
/// faces' normals, a vertex's the circular cone round its pseudo-normal that holds the normals of its faces.
///
/// Decision E5, ours: a vector between two of 7x7 points hardly ever lies in such a set exactly, so it may
/// leave it by a tolerance, a parameter that reports sweep. Boundary features accept every direction: their
/// sets are not bounded by face normals.
class DirectionVerification {
 public:
  /// @param tolerance_rad angle by which a direction may leave a normal set, 0 .. pi
  DirectionVerification(const Surface& surface, double tolerance_rad);

  /// @param direction unit vector away from the surface, mesh frame
  bool accepts(const FeatureId& feature, const Vec3& direction) const;

 private:
  bool edge_accepts(std::int32_t edge, const Vec3& direction) const;

  const Surface& surface_;
  double tolerance_cosine_;
  double tolerance_sine_;
  bool accepts_all_;                    ///< The tolerance is a half turn.
  std::vector<double> vertex_cosines_;  ///< #V; cosine of the vertex cone's half angle plus the tolerance.
};

}  // namespace lmdbench
