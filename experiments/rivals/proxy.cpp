// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// A god object (Ortega, Redon and Coquillart 2007) over a virtual coupling. The proxy is the pose
// nearest to the device's with no features nearer than the skin. A step is the nearest motion in
// kinetic energy (Gauss) under n.v >= skin - d for near vertex-triangle and edge-edge pairs, by
// projected Gauss-Seidel. Force: stiffness times offset; torque: stiffness times radius^2 times
// turn. Our decisions: the skin is the cutoff (force begins where an LMD's does); frames start at
// the device's pose (a method has one answer a pose; off paths through the mesh the proxy is the
// same; memory beyond thin walls is not studied); the mass has the vertices' mean and gyration.
#include "near_pairs.h"
#include "plugin.hpp"
#include <nlohmann/json.hpp>

#include <memory>

namespace {

using namespace rivals;

using Rotation = std::array<Point, 3>;  // rows

Rotation turn_of(const Point& axis_times_angle) {
  const double angle = norm(axis_times_angle);
  const Point n = angle > 0.0 ? (1.0 / angle) * axis_times_angle : Point{1, 0, 0};
  const double s = std::sin(angle), c = 1.0 - std::cos(angle);
  return {Point{1 - c * (n[1] * n[1] + n[2] * n[2]), c * n[0] * n[1] - s * n[2], c * n[0] * n[2] + s * n[1]},
          Point{c * n[0] * n[1] + s * n[2], 1 - c * (n[0] * n[0] + n[2] * n[2]), c * n[1] * n[2] - s * n[0]},
          Point{c * n[0] * n[2] - s * n[1], c * n[1] * n[2] + s * n[0], 1 - c * (n[0] * n[0] + n[1] * n[1])}};
}

/// A motion of A from the device's pose: first the turn about the centre, then the translation.
struct Motion {
  Point way{}, turn{};
};

class Proxy {
 public:
  Proxy(const lmdbench_mesh& a, const lmdbench_mesh& b, double cutoff, const std::string& options)
      : near_(std::make_unique<NearPairs>(a, b, REACH * cutoff)), skin_(cutoff) {
    const auto json = nlohmann::json::parse(options);
    stiffness_ = json.at("stiffness_n_per_m").get<double>();
    steps_ = json.at("steps").get<int>();
    const double count = static_cast<double>(near_->a.vertices.size());
    for (const Point& v : near_->a.vertices) centre_ = centre_ + (1.0 / count) * v;
    double sum = 0.0;
    for (const Point& v : near_->a.vertices) sum += dot(v - centre_, v - centre_) / count;
    radius_ = std::sqrt(sum * 2.0 / 3.0);
  }

  void search(const double* X_BA, std::vector<lmdbench_contact>& /*contacts*/) {
    const Transform device{X_BA};
    const Point centre = device(centre_);
    Motion motion;
    constexpr double ENOUGH = 1e-6;  // skins
    for (int step = 0; step < steps_; ++step) {
      const std::array<double, 12> X = moved(X_BA, centre, motion);
      near_->find(Transform{X.data()}, false);
      const Motion before = motion;
      take_step(centre + motion.way, motion);
      if (norm(motion.way - before.way) + radius_ * norm(motion.turn - before.turn) < ENOUGH * skin_) break;
    }
    const Point force = stiffness_ * motion.way, torque = (stiffness_ * radius_ * radius_) * motion.turn;
    wrench_ = {device.origin(), force, torque + cross(centre - device.origin(), force)};
  }

  void force(double* wrench) const { wrench_.to(wrench); }

 private:
  /// A pair that must not come nearer than the skin.
  struct Constraint {
    Point normal, arm;  // away from B; times the radius of gyration: arm x normal
    double least, length, multiplier = 0.0;
  };

  static std::array<double, 12> moved(const double* X, const Point& centre, const Motion& motion) {
    const Rotation turn = turn_of(motion.turn);
    std::array<double, 12> result{};
    const Point arm = Transform{X}.origin() - centre;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k) result[4 * r + c] += turn[r][k] * X[4 * k + c];
      result[4 * r + 3] = centre[r] + motion.way[r] + dot(turn[r], arm);
    }
    return result;
  }

  /// Turns are small, so they add up. In the metric of energy they are lengths, times the radius.
  void take_step(const Point& centre, Motion& motion) const {
    std::vector<Constraint> all;
    near_->for_each([&](NearPairs::Kind, std::int32_t, std::int32_t, const Found& pair) {
      if (!(pair.distance < REACH * skin_) || pair.distance == 0.0) return;
      const auto& [p, q] = std::pair(pair.contact.point_a, pair.contact.point_b);
      const Point on_a{p[0], p[1], p[2]}, on_b{q[0], q[1], q[2]};
      const Point normal = (1.0 / pair.distance) * (on_a - on_b);
      const Point arm = (1.0 / radius_) * cross(on_a - centre, normal);
      all.push_back({normal, arm, skin_ - pair.distance, 1.0 + dot(arm, arm)});
    });
    // Wanted: back to the device.
    Point way = -1.0 * motion.way, turn = (-radius_) * motion.turn;
    constexpr int SWEEPS = 200;
    constexpr double ENOUGH = 1e-9;  // skins
    for (int sweep = 0; sweep < SWEEPS; ++sweep) {
      double most = 0.0;
      for (Constraint& c : all) {
        const double lacks = c.least - dot(c.normal, way) - dot(c.arm, turn);
        const double change = std::max(-c.multiplier, lacks / c.length);
        c.multiplier += change;
        way = way + change * c.normal;
        turn = turn + change * c.arm;
        most = std::max(most, std::abs(change));
      }
      if (most < ENOUGH * skin_) break;
    }
    // No farther than pairs were searched for.
    const double length = norm(way) + norm(turn), share = std::min(1.0, skin_ / std::max(length, 1e-300));
    motion.way = motion.way + share * way;
    motion.turn = motion.turn + (share / radius_) * turn;
  }

  /// Range of constraining pairs, in skins: a step towards the device moves by up to one.
  static constexpr double REACH = 2.0;

  std::unique_ptr<NearPairs> near_;
  double skin_, stiffness_ = 0.0, radius_ = 0.0;
  int steps_ = 0;
  Point centre_{};  ///< In A's frame.
  Wrench wrench_;
};

constexpr lmdbench_method METHOD = plugin::Functions<Proxy>::with_force(plugin::Functions<Proxy>::described(
    "proxy", "1", "a god object that keeps a cutoff away from the surface, over a virtual coupling",
    LMDBENCH_PROMISE_FORCE_ONLY,
    R"({"stiffness_n_per_m": {"type": "number", "exclusiveMinimum": 0, "default": 1000,
        "description": "of the virtual coupling"},
        "steps": {"type": "integer", "minimum": 1, "default": 6,
        "description": "steps of the proxy from the device's pose, each with the pairs at hand"}})"));

}  // namespace

const lmdbench_method_entry_type lmdbench_method_entry = plugin::entry_of<METHOD>();
