// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/surface.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace lmdbench {

/// FCL's answer for one pose. Invariant: the points are set only while `separated`, because FCL's
/// witness points of meshes in contact do not coincide and mean nothing.
struct FclResult {
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< metres; 0 in contact
  bool separated = false;
  std::int32_t fixed_body = -1;       ///< Index of the nearest of the fixed meshes.
  std::int32_t triangle_moving = -1;  ///< Triangle of the moving mesh that carries `point_moving`.
  std::int32_t triangle_fixed = -1;   ///< Triangle of the fixed mesh that carries `point_fixed`.
  Vec3 point_moving =
      Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< p_W, metres; NaN in contact.
  Vec3 point_fixed =
      Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< p_W, metres; NaN in contact.
};

/// Unit of length of the meshes for FCL.
enum class FclScaling : std::uint8_t {
  /// One common factor for all meshes and poses: it makes the mean edge of the *finest* mesh (with
  /// the least mean edge length) 1, so no mesh's mean is below 1.
  UNIT_MEAN_EDGE,
  /// The meshes as they are: only to show the effect of no scaling.
  NONE
};

/// Minimum distance of meshes by FCL (OBBRSS hierarchies): an independent check of the methods'
/// minimum distance, and a peer in benchmarks.
///
/// FCL's triangle kernel skips the face test when the squared length of an edge cross product is
/// under an absolute 1e-15: about a ten-thousandth of a unit in edge length. For meshes of
/// centimetres in metres it then overlooks faces, and reports contact where there is none: hence
/// the scaling. The kernel is also wrong on a few triangle pairs with nearly parallel edges. A
/// disagreement with it is a question for an arbiter, not a verdict.
class FclCrosscheck {
 public:
  /// Whether this build has FCL (LMDBENCH_WITH_FCL); without it nothing else works.
  static bool is_built_in();

  /// Builds the hierarchies; keeps no reference to the surfaces.
  /// @param fixed meshes whose vertices are already in the world frame
  /// @throws InputError for a mesh without triangles
  FclCrosscheck(const Surface& moving, const std::vector<const Surface*>& fixed,
                FclScaling scaling = FclScaling::UNIT_MEAN_EDGE);
  ~FclCrosscheck();
  FclCrosscheck(FclCrosscheck&& other) noexcept;
  FclCrosscheck& operator=(FclCrosscheck&& other) noexcept;

  /// Nearest pair, searched from scratch as FCL starts every query. Several threads may call it.
  FclResult distance(const Pose& X_WM) const;

  /// The same, with the bound of the last warm query's triangle pairs at the new pose. FCL has no
  /// such mode, but its interface allows seeding its result: a fair peer for frame sequences. The
  /// first call is cold.
  FclResult distance_warm(const Pose& X_WM);

  /// Forgets the last pairs: the next warm query is cold.
  void forget();

  /// Factor from metres to FCL's unit of length.
  double scale() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Answer of FCL's triangle kernel, unchanged.
struct FclTriangleDistance {
  /// In the triangles' unit; 0 where FCL has contact.
  double distance = std::numeric_limits<double>::quiet_NaN();
  /// Points are arbitrary when distance is 0.
  Vec3 point_a = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 point_b = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// Distance of two triangles by FCL's kernel (fcl::detail::TriangleDistance), called unchanged: a
/// peer for comparison, not a reference.
/// @warning Wrong on triangles whose squared doubled area is under 1e-15 (remedy: the scaling
/// above) and on nearly parallel edges.
FclTriangleDistance fcl_triangle_distance(const Triangle& a, const Triangle& b);

/// The kernel's answer about one pair of triangles within a query of FclCrosscheck, to the last
/// bit: FCL passes it the triangles in their own frames with the relative pose, and its errors
/// depend on such roundings.
/// @param moving_M  a triangle of the moving mesh, in that mesh's frame, metres
/// @param fixed_W   a triangle of a fixed mesh, metres
/// @param scale     FclCrosscheck::scale(); 1 for FclScaling::NONE
/// @return distance and points in metres, world frame; point_a on the moving triangle
FclTriangleDistance fcl_triangle_distance(const Triangle& moving_M, const Triangle& fixed_W, const Pose& X_WM,
                                          double scale);

}  // namespace lmdbench
