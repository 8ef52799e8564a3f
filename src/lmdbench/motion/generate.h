// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/motion/path.h>
#include <lmdbench/motion/path_spec.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace lmdbench {

/// Exact minimum distance [m] of the moving mesh at X_WM to the fixed one; 0 if they intersect.
using DistanceFunction = std::function<double(const Pose& X_WM)>;

/// Exact `first_centre_distance` of a scene, without its many distances; 0 where there is none.
using CentreDistanceFunction =
    std::function<double(const Vec3& direction_W, const Eigen::Quaterniond& rotation, double gap)>;

/// Called now and then with the number of frames done and of all frames.
using ProgressFunction = std::function<void(std::size_t done, std::size_t all)>;

/// All that the generator knows of the two meshes. Each sphere contains its mesh.
struct PathScene {
  DistanceFunction distance;
  /// Unset: by conservative advancement over `distance`.
  CentreDistanceFunction centre_distance = nullptr;
  double diagonal = 0.0;                ///< Of the moving mesh: the unit of gaps [m].
  Vec3 moving_centre_M = Vec3::Zero();  ///< What the moving mesh turns about.
  double moving_radius = 0.0;
  Vec3 fixed_centre_W = Vec3::Zero();
  double fixed_radius = 0.0;
};

/// A gap counts as reached when it exceeds the wanted one by less than this part of it.
inline constexpr double GAP_TOLERANCE = 1e-3;

/// Most steps of one approach. One that has not ended by then (nearly tangential) stops where it
/// is, which is outside.
inline constexpr int MAXIMUM_APPROACH_STEPS = 400;

/// Distance between the centres at which the moving mesh, coming from outside along `direction_W`,
/// first has the gap. By the scene's own `centre_distance`, or by conservative advancement: a
/// translation by s changes the distance by at most s, so steps of distance minus gap never come
/// nearer than the gap. Every larger centre distance on the ray has at least this gap. 0 when the
/// meshes pass each other without coming that near.
/// @param direction_W unit, from the fixed mesh's centre to the moving one's
/// @param gap metres, > 0
double first_centre_distance(const PathScene& scene, const Vec3& direction_W,
                             const Eigen::Quaterniond& rotation, double gap);

/// Wanted gap at a time, as a fraction of the diagonal (see GapPoint); constant before
/// the first and after the last.
double wanted_gap(const std::vector<GapPoint>& gaps, double time);

/// In the first line of every generated path: tells it from recorded ones.
inline constexpr const char* GENERATED_PATH_MARK = "made by 'lmdbench path generate";

/// Makes a path:
///  1. The direction from the fixed mesh to the moving one wanders over the sphere, and the moving
///     mesh turns about its own centre (`Wander`); both are smooth and depend on the seed alone.
///  2. In every frame `first_centre_distance` finds the centre distance with the wanted gap.
///  3. That distance jumps where the first contact jumps (silhouettes) and has kinks where contacts
///     change. `bounded_majorant` lays a motion above it that a hand could make. Above is outside,
///     so gaps only grow.
///  4. Every (frame rate / stored rate)-th pose is kept.
///
/// Between stored poses the interpolated path may be nearer than wanted by micrometres: check it
/// (`measure_gaps`).
Path generate_path(const PathSpec& spec, const PathScene& scene, const ProgressFunction& progress = {});

/// Gaps of a path's frames.
struct GapMeasure {
  std::vector<double> gaps;       ///< One a frame [m]; 0 where the meshes intersect.
  std::size_t nearest_frame = 0;  ///< Frame of the smallest gap.

  double smallest() const { return gaps.at(nearest_frame); }
  /// Number of frames whose gap is at most `limit` [m].
  std::size_t frames_within(double limit) const;
};

/// Exact gap in every frame.
/// @pre at least one frame
GapMeasure measure_gaps(const Path& frames, const DistanceFunction& distance,
                        const ProgressFunction& progress = {});

}  // namespace lmdbench
