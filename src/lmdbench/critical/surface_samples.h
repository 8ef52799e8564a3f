// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/critical/merges.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// A small patch of the moving mesh's surface and the point of a fixed mesh that is nearest to its middle; world frame.
struct SurfaceSample {
  double distance = 0.0;  ///< From the patch's middle to the fixed mesh [m].
  double area =
      0.0;         ///< Of the patch as seen along `direction` [m^2]: its area times the cosine to its normal.
  Vec3 direction;  ///< Unit, from moving to fixed.
  Vec3 point_moving;        ///< The patch's middle.
  std::size_t minimum = 0;  ///< Into the critical set: where a descent from here ends.
};

/// `lmdbench-study continuous-force --part bores --patch` sweeps it.
inline constexpr double PATCH_CUTOFF = 1.0;

/// Finds the patches of the moving mesh within the cutoff of the fixed ones. A triangle is cut in four, again and again, until its
/// edges are at most PATCH_CUTOFF times the cutoff long; what is farther away than the cutoff is dropped on the way. So patches depend
/// on where triangles end, though not on their size: forces made of them change by some thousandths when a mesh is cut otherwise.
class SurfaceSampler {
 public:
  /// @param patch_cutoff  longest edge of a patch, over the cutoff
  explicit SurfaceSampler(Scene scene, double patch_cutoff = PATCH_CUTOFF)
      : scene_(std::move(scene)), longest_edge_(patch_cutoff * scene_.cutoff) {}

  /// Nothing on a fixed mesh that the moving one touches: there distances have no direction.
  /// @param descents  has found `merges` for this pose and these critical pairs
  void find(const Pose& X_WM, const CriticalSet& critical, std::span<const Merge> merges,
            MergeFinder& descents, std::vector<SurfaceSample>& samples);

 private:
  struct Search;
  Scene scene_;
  double longest_edge_;
};

}  // namespace lmdbench
