// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/critical/merges.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lmdbench {

/// A small patch of the moving surface and the fixed point nearest to its middle; world frame.
struct SurfaceSample {
  double distance = 0.0;    ///< From the patch's middle to the fixed mesh [m].
  double area = 0.0;        ///< Of the patch [m^2], times its normal's cosine to `direction`.
  Vec3 direction;           ///< Unit, from moving to fixed.
  Vec3 point_moving;        ///< The patch's middle.
  std::size_t minimum = 0;  ///< Into the critical set: end of a descent from here.
};

/// `lmdbench-study continuous-force --part bores --patch` sweeps it.
inline constexpr double PATCH_CUTOFF = 1.0;

/// Finds the moving mesh's patches within the cutoff of the fixed ones. Triangles are cut in four
/// until edges are at most PATCH_CUTOFF times the cutoff; those beyond it are dropped. Patches
/// depend on where triangles end, not on their size: retessellation moves forces by thousandths.
class SurfaceSampler {
 public:
  /// @param patch_cutoff  longest edge of a patch, over the cutoff
  explicit SurfaceSampler(Scene scene, double patch_cutoff = PATCH_CUTOFF)
      : scene_(std::move(scene)), longest_edge_(patch_cutoff * scene_.cutoff) {}

  /// Nothing on a fixed mesh that intersects the moving one: distances have no direction there.
  /// @param descents  its `find` gave `merges` for this pose and these critical pairs
  void find(const Pose& X_WM, const CriticalSet& critical, std::span<const Merge> merges,
            MergeFinder& descents, std::vector<SurfaceSample>& samples);

 private:
  struct Search;
  Scene scene_;
  double longest_edge_;
};

}  // namespace lmdbench
