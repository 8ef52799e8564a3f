// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/motion/rotation_vector.h>
#include <lmdbench/phantom/simulated_device.h>

#include <cmath>

namespace lmdbench {

SimulatedDevice::SimulatedDevice(const DeviceDynamics& dynamics, double period, const Vec3& start_W,
                                 const Vec3& push_W, double resolution)
    : axes_(dynamics, period, push_W),
      path_position_W_(start_W),
      has_hand_(dynamics.hand.has_value()),
      period_(period),
      resolution_(resolution) {}

void SimulatedDevice::advance(const Vec3& rendered_W, const Vec3& next_path_position_W) {
  LMDBENCH_EXPECTS(rendered_W.allFinite(), "a force that nobody clipped to the device");
  const Vec3 path_velocity_W =
      has_hand_ ? Vec3((next_path_position_W - path_position_W_) / period_) : Vec3(Vec3::Zero());
  axes_.advance(rendered_W, path_velocity_W);
  if (has_hand_) path_position_W_ = next_path_position_W;
}

Vec3 SimulatedDevice::sensed_position() const {
  Vec3 result = position();
  if (resolution_ > 0.0)
    for (int axis = 0; axis < 3; ++axis)
      result[axis] = std::nearbyint(result[axis] / resolution_) * resolution_;
  return result;
}

namespace {

/// Below this angle the Jacobian's second coefficient is a series; its next term is under 1e-15.
constexpr double SERIES_ANGLE = 0.05;

/// (x - sin x) / x^3
double cubic_coefficient(double x) {
  if (x > SERIES_ANGLE) return (x - std::sin(x)) / (x * x * x);
  const double s = x * x;
  return 1.0 / 6.0 - s / 120.0 + s * s / 5040.0 - s * s * s / 362880.0;
}

}  // namespace

Vec3 generalised_torque(const Vec3& rotation_vector, const Vec3& torque_W) {
  LMDBENCH_EXPECTS(rotation_vector.allFinite(), "a turn that was never set");
  const double angle = rotation_vector.norm();
  if (angle == 0.0) return torque_W;
  const double half_sine = std::sin(0.5 * angle);
  // J = I + (1 - cos) / angle^2 [y] + (angle - sin) / angle^3 [y]^2, and [y]^T = -[y].
  const Vec3 once = rotation_vector.cross(torque_W);
  return torque_W - 2.0 * half_sine * half_sine / (angle * angle) * once +
         cubic_coefficient(angle) * rotation_vector.cross(once);
}

SimulatedGimbal::SimulatedGimbal(const DeviceDynamics& dynamics, double period,
                                 const Eigen::Quaterniond& start, const Vec3& push_W, double resolution)
    : axes_(dynamics, period, push_W),
      start_(start),
      path_orientation_(start),
      has_hand_(dynamics.hand.has_value()),
      period_(period),
      resolution_(resolution) {}

void SimulatedGimbal::advance(const Vec3& torque_W, const Eigen::Quaterniond& next_path_orientation) {
  LMDBENCH_EXPECTS(std::abs(next_path_orientation.squaredNorm() - 1.0) <= UNIT_TOLERANCE,
                   "a quaternion that was not normalised");
  Vec3 path_velocity = Vec3::Zero();
  if (has_hand_)
    path_velocity = rotation_vector_of(next_path_orientation * path_orientation_.conjugate()) / period_;
  axes_.advance(generalised_torque(axes_.offset(), torque_W), path_velocity);
  if (has_hand_) path_orientation_ = next_path_orientation;
}

Vec3 SimulatedGimbal::angular_velocity() const {
  const Vec3 y = axes_.offset();
  const Vec3 path_W = axes_.path_velocity();
  // Of exp(y) R_path: J(y) y' and the path's, turned along; J(y) = J(-y)^T.
  return generalised_torque(-y, axes_.velocity() - path_W) + rotation_of(y) * path_W;
}

Eigen::Quaterniond SimulatedGimbal::orientation() const {
  return (rotation_of(axes_.offset()) * path_orientation_).normalized();
}

Eigen::Quaterniond SimulatedGimbal::sensed_orientation() const {
  if (resolution_ == 0.0) return orientation();
  Vec3 turned = rotation_vector_of(orientation() * start_.conjugate());
  for (int axis = 0; axis < 3; ++axis)
    turned[axis] = std::nearbyint(turned[axis] / resolution_) * resolution_;
  return (rotation_of(turned) * start_).normalized();
}

}  // namespace lmdbench
