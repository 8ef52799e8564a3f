// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/feature.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/original/face_neighbours.h>
#include <lmdbench/methods/original/feature_points.h>
#include <lmdbench/methods/original/options.h>
#include <lmdbench/snch/traversal.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace lmdbench {

/// Test G5 of the original algorithm (paper, section 3.2.1): "the vector with selected distance is
/// verified against the vertex/edge/face normals". The normal set of a face is its normal; of an
/// edge the arc between its faces' normals; of a vertex the circular cone round its pseudo-normal
/// that holds its faces' normals.
///
/// Decision E5, ours: a vector between two of 7x7 points is hardly ever exactly in such a set, so a
/// tolerance is granted, which reports sweep. Boundary features accept every direction: face
/// normals do not bound their sets.
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
  std::vector<double> vertex_cosines_;  ///< #V; cosine of half vertex cone angle + tolerance.
};

const MethodDescription& original_method();

/// The original algorithm (Johnson and Cohen 2001; Johnson and Willemsen 2003, 2004; as told in the
/// paper, section 3.2). Global search: G1, G2, G3 (dual solution line cone) on the nodes; at leaves
/// the least of 7x7 point distances (G4), its vector verified against both features' normals (G5).
/// Local tracking: L1..L4 with 7x7 distances.
///
/// Decision E4, ours: the paper does not print the formula of G3; the default reads the line of
/// centres as a ray, equal to the improved algorithm's G3.a/b, which favours the original. Decision
/// E13: LMDs with the same pair of feature points are one LMD.
class Original : public Method {
 public:
  /// What it counts.
  enum class Counter : std::uint8_t {
    NODE_PAIRS,
    REJECTED_G1,
    REJECTED_G2,
    REJECTED_G3,
    LEAF_PAIRS,
    REJECTED_CUTOFF,
    REJECTED_G5,
    FEATURE_POINT_DISTANCES,
    TRACKING_STEPS,
    DROPPED_DUPLICATES
  };

  /// @param of_pair `Scene::is_pair`
  explicit Original(Scene of_pair, const OriginalOptions& options = {});

  const MethodDescription& description() const override { return original_method(); }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;

 private:
  /// @param of template <std::size_t N> () -> Lmd, called with the option's number of points
  template <class Of>
  Lmd by_feature_points(Of&& of) const;
  template <std::size_t N>
  Lmd lmd_of(const FeaturePoints<N>& a, const FeaturePoints<N>& b, const FeaturePointPair& nearest,
             std::int32_t t_moving, std::int32_t t_fixed) const;
  Lmd feature_point_pair(const RigidTransform& X_WM, std::int32_t t_moving, std::int32_t t_fixed,
                         WorkCounters& counters) const;
  /// The nearest points of an LMD's own features, on its own triangles, at another pose.
  Lmd moved_point_pair(const RigidTransform& X_WM, const Lmd& lmd, WorkCounters& counters) const;

  Scene scene_;
  OriginalOptions options_;
  const Surface &moving_, &fixed_;
  const Hierarchy &hierarchy_moving_, &hierarchy_fixed_;
  DirectionVerification verify_moving_, verify_fixed_;
  std::optional<FaceNeighbours> faces_moving_, faces_fixed_;  ///< If the option asks.
  DualTraversal traversal_;
};

}  // namespace lmdbench
