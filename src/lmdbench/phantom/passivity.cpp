// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/passivity.h>

#include <algorithm>
#include <limits>

namespace lmdbench {
namespace {

/// A force of newtons changes the speed of this mass by less than a rounding error in a second.
constexpr double IMMOVABLE_KG = 1e12;

}  // namespace

Excursion carry_through(const SampledWall& wall, double damping_n_s_per_m, double friction_n, double way_m,
                        int depth) {
  const double speed = way_m / wall.period_s;
  SimulatedDevice device({IMMOVABLE_KG, damping_n_s_per_m, friction_n, std::nullopt}, wall.period_s,
                         Vec3(-0.5 * way_m, 0.0, 0.0), Vec3::Zero(), wall.resolution_m);
  Excursion excursion;
  const auto go = [&] {
    const double force = wall_force(wall, device.sensed_position().x());
    if (force != 0.0) ++excursion.periods;
    device.advance(Vec3(force, 0.0, 0.0), Vec3::Zero());
  };
  device.strike(Vec3(-speed, 0.0, 0.0));
  for (int i = 0; i < depth; ++i) go();
  device.strike(Vec3(2.0 * speed, 0.0, 0.0));
  for (int i = 0; i <= depth; ++i) go();
  const EnergyAccount energy = device.energy();
  excursion.net_energy_j = energy.rendered - energy.damped - energy.friction;
  return excursion;
}

RestingSwing rest_on(const SampledWall& wall, const DeviceDynamics& dynamics, double load_n,
                     double tap_m_per_s, std::int64_t periods) {
  const Vec3 start(-load_n / wall.stiffness_n_per_m, 0.0, 0.0);
  SimulatedDevice device(dynamics, wall.period_s, start, Vec3(-load_n, 0.0, 0.0), wall.resolution_m);
  device.strike(Vec3(tap_m_per_s, 0.0, 0.0));
  const std::int64_t half = periods / 2;
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  double work = 0.0;
  double last_speed = 0.0;
  std::int64_t turns = 0;
  for (std::int64_t i = 0; i < periods; ++i) {
    if (i == half) work = device.energy().rendered + device.energy().push;
    if (i >= half) {
      least = std::min(least, device.position().x());
      most = std::max(most, device.position().x());
      const double speed = device.velocity().x();
      if (speed * last_speed < 0.0) ++turns;
      if (speed != 0.0) last_speed = speed;
    }
    device.advance(Vec3(wall_force(wall, device.sensed_position().x()), 0.0, 0.0), start);
  }
  const double seconds = static_cast<double>(periods - half) * wall.period_s;
  RestingSwing swing;
  swing.amplitude_m = 0.5 * (most - least);
  swing.frequency_hz = static_cast<double>(turns) / (2.0 * seconds);
  swing.net_power_w = (device.energy().rendered + device.energy().push - work) / seconds;
  return swing;
}

}  // namespace lmdbench
