// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/methods/certified/keep/motion_forecast.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lmdbench {

namespace {

constexpr double UNKNOWN = std::numeric_limits<double>::infinity();
/// base and drift are learnt from epochs no older than this [frames], with a factor of room.
constexpr std::uint32_t JUDGED_FRAMES = 20;
constexpr double ROOM = 1.25;
/// Share of what was learnt that is left after a frame: bad forecasts are soon forgotten.
constexpr double MEMORY = 0.9;
/// The same after an epoch, of whether the motion goes on or trembles.
constexpr double EPOCH_MEMORY = 0.75;
/// Largest norm of the rotation's change since an epoch's start. Between two frames it is then at
/// most twice that, and the angle the norm over sqrt(2) to ANGLE_ROUNDING: it is 2 asin(norm /
/// sqrt(8)), and asin(x) <= 1.01 x for x <= 0.23.
constexpr double LARGEST_EPOCH_TURN = 0.32;
constexpr double ANGLE_ROUNDING = 1.01;
/// The difference of two rotations has two equal singular values and no third.
constexpr double OPERATOR_NORM_OF_ROTATIONS = 1.0 / std::numbers::sqrt2;
/// Speeds are at least this where something is divided by them.
constexpr double LEAST = 1e-30;
/// Longest motion during a plan, in search distances: lanes that a test let through are kept until
/// its plan ends, and over longer motions too many would be kept for nothing.
constexpr double PLAN_CUTOFFS = 8.0;
/// A horizon saves repeated tests, but keeps more of them (swept by scripts/tuned_constants.py).
/// Frames, search distances, radians.
constexpr double LARGEST_HORIZON = 8.0, HORIZON_CUTOFFS = 1.0, HORIZON_TURN = 0.01;
/// Relative rounding of the quantities below, generously, and of what is computed
/// from them in single precision.
constexpr double ROUNDING = 1e-12;
constexpr double SINGLE_ROUNDING = 1e-5;

}  // namespace

void MotionForecast::reset(const RigidTransform& X_WH, double radius, double search_distance) {
  LMDBENCH_EXPECTS(radius >= 0.0 && search_distance > 0.0, "a mesh without extent is searched from scratch");
  radius_ = radius;
  search_distance_ = search_distance;
  extent_ = radius + 2.0 * search_distance;
  frame_ = 0;
  epoch_ = EPOCHS - 1;
  started_ = false;
  epoch_count_ = 0;
  deviations_.fill(UNKNOWN);
  last_ = X_WH;
  motion_ = early_ = base_ = drift_ = 0.0;
  deviation_going_on_ = deviation_staying_ = 0.0;
}

double MotionForecast::deviation_of(const Epoch& epoch, const RigidTransform& X_WH) const {
  LMDBENCH_EXPECTS(frame_ >= epoch.start, "an epoch of before the last reset");
  const double tau = frame_ - epoch.start;
  const Mat3 turned = X_WH.rotation - epoch.X_WH.rotation;
  const double norm = turned.norm();
  if (!(norm <= LARGEST_EPOCH_TURN)) return UNKNOWN;
  const double rest = epoch.goes_on ? (turned - tau * (epoch.turn + 0.5 * tau * epoch.curve)).norm()
                                    : OPERATOR_NORM_OF_ROTATIONS * norm;
  return (X_WH.translation - epoch.X_WH.translation - tau * epoch.velocity).norm() +
         ANGLE_ROUNDING * rest * extent_;
}

void MotionForecast::judge_last_epoch(const RigidTransform& X_WH) {
  Epoch staying;
  staying.goes_on = false;
  staying.start = going_on_.start;
  staying.X_WH = going_on_.X_WH;
  const auto note = [&](double& faded, const Epoch& epoch) {
    faded = EPOCH_MEMORY * faded + std::min(deviation_of(epoch, X_WH), extent_);
  };
  note(deviation_going_on_, going_on_);
  note(deviation_staying_, staying);
}

void MotionForecast::start_epoch(const RigidTransform& X_WH) {
  epoch_ = (epoch_ + 1) % EPOCHS;
  epoch_count_ = std::min(epoch_count_ + 1, EPOCHS);
  started_ = true;
  Epoch& epoch = epochs_[epoch_];
  const Mat3 last_turn = X_WH.rotation - last_.rotation;
  epoch.start = frame_;
  epoch.X_WH = X_WH;
  epoch.velocity = X_WH.translation - last_.translation;
  epoch.curve = last_turn * X_WH.rotation.transpose() * last_turn;
  // A difference that looks back lags half a frame.
  epoch.turn = last_turn + 0.5 * epoch.curve;
  // Of the motion that goes on: plans of one that trembles are not longer.
  const double speed = epoch.velocity.norm() + epoch.turn.norm() * radius_;
  epoch.goes_on = true;
  going_on_ = epoch;
  if (deviation_staying_ < deviation_going_on_) {
    epoch.goes_on = false;
    epoch.velocity.setZero();
    epoch.turn.setZero();
    epoch.curve.setZero();
  }
  // Plans of the older epoch with this index end: its deviation is no longer known.
  deviations_[epoch_] = UNKNOWN;

  const double turn = epoch.turn.norm(), curve = epoch.curve.norm();
  // Half of LARGEST_EPOCH_TURN is left for deviations.
  longest_plan_ = std::min({static_cast<double>(epoch.goes_on ? LONGEST_PLAN : LONGEST_TREMBLING_PLAN),
                            PLAN_CUTOFFS * search_distance_ / std::max(speed, LEAST),
                            0.5 * LARGEST_EPOCH_TURN / std::max(turn + LONGEST_PLAN * curve, LEAST)});
  // A plan from frame s to frame t of an epoch: (t^2 - s^2) / 2 = (t - s) (t + s) / 2.
  const double frames = EPOCH_FRAMES + 0.5 * longest_plan_;
  creep_ = frames * curve * radius_ + SINGLE_ROUNDING * speed;
  spin_ = ANGLE_ROUNDING / std::numbers::sqrt2 * (turn + frames * curve) * (1.0 + SINGLE_ROUNDING);
  horizon_ = std::min({LARGEST_HORIZON, HORIZON_CUTOFFS * search_distance_ / std::max(speed, LEAST),
                       HORIZON_TURN / std::max(spin_, LEAST)});
  LMDBENCH_ENSURES(longest_plan_ >= 0.0 && creep_ >= 0.0 && spin_ >= 0.0, "a pose that is not a rotation");
}

void MotionForecast::advance(const RigidTransform& X_WH, double rounding) {
  LMDBENCH_EXPECTS(rounding >= 0.0, "a rounding that is negative or not a number");
  ++frame_;
  started_ = false;
  early_ *= MEMORY;
  drift_ *= MEMORY;
  for (std::size_t i = 0; i < epoch_count_; ++i) {
    const std::size_t index = (epoch_ + EPOCHS - i) % EPOCHS;
    const double deviation = deviation_of(epochs_[index], X_WH) * (1.0 + ROUNDING) + rounding;
    deviations_[index] = deviation;
    const std::uint32_t age = frame_ - epochs_[index].start;
    if (age > JUDGED_FRAMES || !(deviation < UNKNOWN)) continue;
    if (age <= EPOCH_FRAMES) {
      early_ = std::max(early_, ROOM * deviation);
    } else {
      drift_ = std::max(drift_, ROOM * deviation / age);
    }
  }
  // Plans start with what their epoch has deviated by, and count it twice.
  base_ = 2.0 * early_;
  motion_ = (X_WH.translation - last_.translation).norm() + (X_WH.rotation - last_.rotation).norm() * radius_;
  // The first epoch is short: until it is judged, nothing is known of the motion's kind.
  const bool is_long = epoch_count_ > 1 && epochs_[epoch_].goes_on;
  const std::uint32_t epoch_frames = is_long ? EPOCH_FRAMES : TREMBLING_EPOCH_FRAMES;
  if (epoch_count_ == 0 || frame_ - epochs_[epoch_].start >= epoch_frames) {
    if (epoch_count_ > 0) judge_last_epoch(X_WH);
    start_epoch(X_WH);
  }
  last_ = X_WH;
}

}  // namespace lmdbench
