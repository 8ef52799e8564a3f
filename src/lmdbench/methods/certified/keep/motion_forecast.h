// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace lmdbench {

/// Where the moving mesh is expected, and how far it deviates from there (PROOF.md, lemma 17).
///
/// 1. An epoch starts every few frames. c names a point of the moving mesh in the moving
///    hierarchy's frame; R_t and o_t are that frame's rotation and origin in the world at frame t.
///    The forecast of an epoch that starts at frame e is that tau frames later c will have moved by
///      tau (W c + v) + tau^2 / 2 Q c
///    with v the last frame's motion of the origin, W and Q of a steady turn; v = W = Q = 0 where
///    the last epochs show a motion that trembles about a place.
/// 2. Every frame computes each epoch's deviation (operator norm, or a bound of it):
///      |o_t - o_e - tau v| + 1.01 |R_t - R_e - tau W - tau^2 / 2 Q| * extent
///    with extent = radius + 2 search_distance. It bounds how far any c is from its forecast, plus
///    the angle turned beyond it times a lever arm L (radius of what is below a node + 2 search
///    distances), wherever |c| + L <= extent.
/// 3. A plan that allows for the deviation is safe whatever the motion; a bad forecast costs only
///    time.
class MotionForecast {
 public:
  /// No plan is longer than this [frames]: of a motion that goes on, and of one that trembles.
  static constexpr std::uint32_t LONGEST_PLAN = 60, LONGEST_TREMBLING_PLAN = 30;
  /// Frames of an epoch: of a motion that goes on, and of one that trembles, where a deviation
  /// before a plan counts as much as one after its start.
  static constexpr std::uint32_t EPOCH_FRAMES = 4, TREMBLING_EPOCH_FRAMES = 2;
  /// Epochs that are remembered. Plans end before their epoch is forgotten, or with it where a
  /// motion begins to tremble.
  static constexpr std::size_t EPOCHS = LONGEST_PLAN / EPOCH_FRAMES + 2;
  static_assert(EPOCHS >= LONGEST_TREMBLING_PLAN / TREMBLING_EPOCH_FRAMES + 2);

  /// Forgets everything; the next frame is the first.
  /// @param radius of the moving mesh about the hierarchy's origin [m]
  /// @param search_distance  the larger of reach and touch [m]
  void reset(const RigidTransform& X_WH, double radius, double search_distance);
  /// Brings the forecast to the next frame.
  /// @param rounding of a pose, as a length [m]
  void advance(const RigidTransform& X_WH, double rounding);

  std::uint32_t frame() const { return frame_; }
  double motion() const { return motion_; }  ///< Bound of any point's, last frame [m].
  /// Epoch of the plans of this frame, an index below EPOCHS.
  std::size_t epoch() const { return epoch_; }
  /// Of an epoch at this frame [m]; infinite where the epoch is no longer remembered.
  double deviation(std::size_t epoch) const { return deviations_[epoch]; }
  /// Deviation of the current epoch before plans of this frame [m].
  double used_at_start() const { return started_ ? 0.0 : deviations_[epoch_]; }

  /// Forecasts deviated lately by about base + drift * tau after tau frames: a guess, not a bound;
  /// metres and metres a frame.
  double base() const { return base_; }
  double drift() const { return drift_; }

  const Vec3& origin_velocity() const { return epochs_[epoch_].velocity; }  ///< v, metres a frame
  const Mat3& turn() const { return epochs_[epoch_].turn; }                 ///< W, a frame
  /// Added to the velocity of any point [m a frame]: what Q adds until the end of the longest plan,
  /// and rounding of velocities in single precision.
  double creep() const { return creep_; }
  double spin() const { return spin_; }      ///< Largest angle a frame within a plan [rad].
  double extent() const { return extent_; }  ///< Of `deviation` [m].
  /// No plan of this frame may be longer than this [frames].
  double longest_plan() const { return longest_plan_; }
  /// What is valid for no longer than this is not worth a plan [frames].
  double horizon() const { return horizon_; }

 private:
  struct Epoch {
    std::uint32_t start = 0;
    bool goes_on = true;  ///< Else velocity, turn and curve are zero.
    RigidTransform X_WH;
    Vec3 velocity = Vec3::Zero();
    Mat3 turn = Mat3::Zero();
    Mat3 curve = Mat3::Zero();  ///< Q
  };

  double deviation_of(const Epoch& epoch, const RigidTransform& X_WH) const;
  /// Compares, at the end of an epoch, the forecasts of a motion that goes on and of a mesh at
  /// rest.
  void judge_last_epoch(const RigidTransform& X_WH);
  void start_epoch(const RigidTransform& X_WH);

  double radius_ = 0.0, search_distance_ = 0.0, extent_ = 0.0;
  std::uint32_t frame_ = 0;
  std::size_t epoch_ = 0, epoch_count_ = 0;
  bool started_ = false;  ///< The epoch starts in this frame; an older one had its index before.
  std::array<Epoch, EPOCHS> epochs_;
  Epoch going_on_;  ///< The last epoch as a motion that goes on, whatever was forecast.
  double deviation_going_on_ = 0.0, deviation_staying_ = 0.0;  ///< Of the last epochs, fading [m].
  std::array<double, EPOCHS> deviations_{};
  RigidTransform last_;
  double motion_ = 0.0, creep_ = 0.0, spin_ = 0.0, longest_plan_ = 0.0, horizon_ = 0.0;
  double early_ = 0.0, base_ = 0.0, drift_ = 0.0;
};

}  // namespace lmdbench
