// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/catalogue/deformation.h>
#include <lmdbench/catalogue/shapes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace lmdbench {

namespace {

/// Waves of a crumple, and their lengths as parts of the diagonal.
constexpr std::size_t WAVES = 12;
constexpr double SHORTEST_WAVE = 0.08, LONGEST_WAVE = 0.5;

/// Uniform on the unit sphere, by rejection: no sines.
Vec3 direction_random(std::mt19937_64& random) {
  for (;;) {
    Vec3 v;
    for (int k = 0; k < 3; ++k) v[k] = 2.0 * uniform_number(random) - 1.0;
    const double squared = v.squaredNorm();
    if (squared <= 1.0 && squared > 0.01) return v / std::sqrt(squared);
  }
}

/// From 0 at 0 to 1 at 1, level at both ends.
double smooth_step(double u) {
  return u * u * (3.0 - 2.0 * u);
}

/// v turned about a unit axis.
Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
  const double cosine = rounded_to_grid(std::cos(angle)), sine = rounded_to_grid(std::sin(angle));
  return cosine * v + sine * axis.cross(v) + (1.0 - cosine) * axis.dot(v) * axis;
}

}  // namespace

std::string_view to_string(DeformationKind kind) {
  switch (kind) {
    case DeformationKind::BEND:
      return "bend";
    case DeformationKind::TWIST:
      return "twist";
    case DeformationKind::DENT:
      return "dent";
    case DeformationKind::BREATHE:
      return "breathe";
    case DeformationKind::CRUMPLE:
      break;
  }
  return "crumple";
}

std::span<const DeformationKind> deformation_kinds() {
  static constexpr std::array KINDS{DeformationKind::BEND, DeformationKind::TWIST, DeformationKind::DENT,
                                    DeformationKind::BREATHE, DeformationKind::CRUMPLE};
  return KINDS;
}

double Deformation::wave(double phase) {
  return rounded_to_grid(std::sin(2.0 * std::numbers::pi * (phase - std::floor(phase))));
}

Deformation::Deformation(const TriangleMesh& mesh, const DeformationChoice& choice)
    : choice_(choice), rest_(mesh.vertices), diagonal_(bounding_box_diagonal(mesh)) {
  if (!(choice.share > 0.0 && choice.share <= 1.0))
    throw std::invalid_argument("the share of the vertices that move is not in (0, 1]");
  if (!std::isfinite(choice.amplitude)) throw std::invalid_argument("the amplitude is no number");
  const double length = choice.direction.norm();
  if (!(length > 0.0) || !std::isfinite(length)) throw std::invalid_argument("the direction has no length");
  if (rest_.empty()) return;
  along_ = choice.direction / length;
  int least = 0;
  along_.cwiseAbs().minCoeff(&least);
  across_ = along_.cross(Vec3::Unit(least)).normalized();

  std::vector<double> heights;
  heights.reserve(rest_.size());
  for (const Vec3& p : rest_) heights.push_back(along_.dot(p));
  std::vector<double> sorted = heights;
  std::sort(sorted.begin(), sorted.end());
  const auto count = static_cast<double>(rest_.size());
  const auto first = static_cast<std::size_t>(std::clamp(count * (1.0 - choice.share), 0.0, count - 1.0));
  const double low = sorted[first], high = sorted.back();
  const bool all = choice.share == 1.0;
  Vec3 least_corner = Vec3::Constant(std::numeric_limits<double>::infinity()),
       greatest_corner = -least_corner;
  Vec3 sum_at_hinge = Vec3::Zero();
  double at_hinge = 0.0;
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    if (heights[v] < low) continue;
    const double u = high > low ? (heights[v] - low) / (high - low) : 1.0;
    // A whole mesh that breathes or crumples does so everywhere.
    const bool everywhere =
        all && (choice.kind == DeformationKind::BREATHE || choice.kind == DeformationKind::CRUMPLE);
    const double weight = everywhere                                     ? 1.0
                          : all && choice.kind == DeformationKind::TWIST ? u
                                                                         : smooth_step(u);
    least_corner = least_corner.cwiseMin(rest_[v]);
    greatest_corner = greatest_corner.cwiseMax(rest_[v]);
    if (u <= 0.2) {
      sum_at_hinge += rest_[v];
      at_hinge += 1.0;
    }
    if (weight > 0.0) moving_.push_back({static_cast<std::int32_t>(v), weight});
  }
  middle_ = 0.5 * (least_corner + greatest_corner);
  hinge_ = at_hinge > 0.0 ? Vec3(sum_at_hinge / at_hinge) : middle_;
  if (choice.kind != DeformationKind::CRUMPLE) return;
  struct Wave {
    Vec3 turns_per_metre, direction;
    double offset;
  };
  std::array<Wave, WAVES> waves;
  std::mt19937_64 random(choice.seed);
  for (Wave& wave : waves) {
    const double part = SHORTEST_WAVE + (LONGEST_WAVE - SHORTEST_WAVE) * uniform_number(random);
    wave.turns_per_metre = direction_random(random) / (part * diagonal_);
    wave.direction = direction_random(random);
    wave.offset = uniform_number(random);
  }
  for (const MovingVertex& moving : moving_) {
    Vec3 sum = Vec3::Zero();
    for (const Wave& wave : waves) {
      const double turns =
          wave.turns_per_metre.dot(rest_[static_cast<std::size_t>(moving.vertex)]) + wave.offset;
      sum += rounded_to_grid(std::sin(2.0 * std::numbers::pi * (turns - std::floor(turns)))) * wave.direction;
    }
    crumple_.push_back(moving.weight * choice.amplitude * diagonal_ / std::sqrt(double{WAVES}) * sum);
  }
}

void Deformation::at_strength(double strength, std::vector<Vec3>& vertices) const {
  vertices = rest_;
  const double amount = strength * choice_.amplitude;
  if (amount == 0.0) return;
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    Vec3& p = vertices[static_cast<std::size_t>(moving_[i].vertex)];
    const double weight = moving_[i].weight;
    switch (choice_.kind) {
      case DeformationKind::BEND:
        p = hinge_ + turned(p - hinge_, across_, weight * amount);
        break;
      case DeformationKind::TWIST:
        p = hinge_ + turned(p - hinge_, along_, weight * amount);
        break;
      case DeformationKind::DENT:
        p -= weight * amount * diagonal_ * along_;
        break;
      case DeformationKind::BREATHE:
        p = middle_ + (1.0 + weight * amount) * (p - middle_);
        break;
      case DeformationKind::CRUMPLE:
        p += strength * crumple_[i];
        break;
    }
  }
}

}  // namespace lmdbench
