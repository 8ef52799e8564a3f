// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/motion/path.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// What lies between the poses of a path. Both pass every pose and turn along the shorter arc.
enum class Interpolation : std::uint8_t {
  LINEAR,  ///< Straight and at constant speed between poses (slerp); velocity jumps at the poses.
  CUBIC    ///< Velocity and angular velocity are continuous (C1): what a hand does, the default.
};

/// An interval of more than so many median ones is a gap of the recording, unless told otherwise.
inline constexpr double USUAL_GAP_INTERVALS = 10.0;

/// An interval in which a recording has no pose.
struct RecordingGap {
  double start = 0.0;     ///< Time of the last pose before it [s].
  double duration = 0.0;  ///< seconds
};

/// A path at any time.
///
/// Gaps: an interval longer than so many median ones is not interpolated, since a cubic through it
/// would invent centimetres of motion. The last pose is held until the next one, and the velocity
/// on each side comes from that side alone.
///
/// CUBIC, translation: cubic Hermite between neighbouring poses. The velocity at a pose is the
/// slope of the parabola through it and its two neighbours, at the ends of the outermost such
/// parabola: exact for quadratic motion at uneven times.
///
/// CUBIC, rotation: cubic Bezier curve of quaternions in cumulative form, q(u) = q_0 exp(w_1
/// b_1(u)) exp(w_2 b_2(u)) exp(w_3 b_3(u)) (Kim, Kim and Shin, SIGGRAPH 1995). Its angular
/// velocities at the poses come from the same rule, with rotation vectors for differences.
///
/// At even times neither overshoots by more than a fraction of a step, but where a path *jumps* the
/// neighbouring intervals swing, and so do long intervals beside much shorter ones (a tracker that
/// delivers in pairs): use LINEAR for such paths.
///
/// Translation is interpolated at the mesh frame's origin: a mesh whose origin is far from its
/// centre swings when it turns. Meshes are centred for that (`scaled_to_diagonal`).
class PathInterpolator {
 public:
  /// @pre the path has at least one pose and strictly increasing times (as `read_tum` gives)
  /// @param gap_intervals  intervals longer than so many median ones are gaps; 0: none is
  explicit PathInterpolator(Path path, Interpolation interpolation = Interpolation::CUBIC,
                            double gap_intervals = 0.0);

  double start_time() const { return path_.front().time; }
  double end_time() const { return path_.back().time; }
  const Path& path() const { return path_; }
  /// Median interval between poses [s]; NaN for a single pose.
  double sample_interval() const { return sample_interval_; }
  const std::vector<RecordingGap>& gaps() const { return gaps_; }

  /// Pose at a time [s]: bit for bit that of a pose at its own time, the first before the start,
  /// the last after the end. The quaternion's sign follows the pose that opens the interval.
  Pose at(double time) const;

 private:
  void find_gaps(double gap_intervals);
  void add_slopes(std::size_t first, std::size_t last);

  Path path_;
  Interpolation interpolation_;
  double sample_interval_;
  std::vector<RecordingGap> gaps_;
  std::vector<bool> held_;                ///< For each interval: whether it is a gap.
  std::vector<Vec3> velocities_;          ///< m/s at each pose; empty for LINEAR
  std::vector<Vec3> angular_velocities_;  ///< rad/s at each pose, mesh's frame; empty for LINEAR
};

/// A frame is inside the path when it is late by at most this part of a period: rounding
/// must not lose the last frame.
inline constexpr double LAST_FRAME_TOLERANCE = 1e-6;

/// Number of haptic frames start + k / rate, k = 0, 1, ..., that lie on the path; at least 1.
std::size_t frame_count(const PathInterpolator& interpolator, double rate);

/// The path's haptic frames: frame k has the time start + k / rate, without a running sum.
/// Quaternion signs are continuous from frame to frame.
/// @param rate frames a second [Hz], > 0
/// @param most  the first so many frames only; unset: all
Path resample(const PathInterpolator& interpolator, double rate,
              std::optional<std::size_t> most = std::nullopt);

/// Refuses a path whose frames no machine holds: its times are likely not in seconds.
/// @param most  the first so many frames only; unset: all
/// @param file  of the path, for the message
/// @throws InputError for more frames than `Limit::FRAMES`
void refuse_too_many_frames(const PathInterpolator& interpolator, double rate,
                            std::optional<std::size_t> most, const std::string& file);

/// A body moved from `before` to `now` in one frame. Its pose `frames` frames after `now` at the
/// same velocity and angular velocity, both in the world frame.
/// @param frames any number of at least 0
Pose extrapolated(const Pose& before, const Pose& now, double frames);

}  // namespace lmdbench
