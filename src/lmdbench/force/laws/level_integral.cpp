// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/force/laws/level_integral.h>
#include <lmdbench/force/wrench_sum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lmdbench {

namespace {

/// Over the cutoff: on longer intervals the mean of few patches bends too much for three nodes.
constexpr double LONGEST_PIECE = 1.0 / 32.0;

/// A unit force and its torque.
struct Push {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();

  Push& operator+=(const Push& other) {
    force += other.force, torque += other.torque;
    return *this;
  }
  friend Push operator*(double weight, const Push& push) {
    return {weight * push.force, weight * push.torque};
  }
};

/// One component of {distance <= t} while t rises.
struct Component {
  double level = 0.0;         ///< t up to which it has pushed.
  double length = 0.0;        ///< Of its branches up to there.
  Push of_minima;             ///< Weighted by their shares.
  double minimum_area = 0.0;  ///< All of its minima weigh as this one: they are of one pair.
  // Sums over its patches: that of area (t - distance) is t * area - area_distance; so of pushes.
  double area = 0.0, area_distance = 0.0;
  Push push, push_distance;
};

class LevelIntegral {
 public:
  LevelIntegral(const ForceInput& input, std::span<const SurfaceSample> samples, const ForceProfile& profile,
                const Vec3& reference_W)
      : input_(input),
        samples_(samples),
        profile_(profile),
        reference_W_(reference_W),
        sum_(reference_W),
        component_of_(input.critical.size(), NONE) {}

  Wrench run() {
    const CriticalSet& critical = input_.critical;
    LMDBENCH_EXPECTS(input_.minimum_areas.empty() || input_.minimum_areas.size() == critical.size(),
                     "parallel arrays of unlike lengths");
    LMDBENCH_EXPECTS(std::ranges::is_sorted(input_.merges, {},
                                            [&](const Merge& m) { return critical[m.saddle].pair.distance; }),
                     "merges that are not sorted by the distance of their saddles");
    for (std::size_t i = 0; i < critical.size(); ++i) {
      const Lmd& lmd = critical[i].pair;
      if (!critical[i].is_basin || !WrenchSum::acts(lmd, profile_)) continue;
      component_of_[i] = components_.size();
      components_.push_back({lmd.distance,
                             0.0,
                             push_of(lmd.direction, lmd.point_moving),
                             input_.minimum_areas.empty() ? 0.0 : input_.minimum_areas[i],
                             0.0,
                             0.0,
                             {},
                             {}});
      parent_.push_back(parent_.size());
      sum_.stiffen(lmd.direction, lmd.direction, force_stiffness(profile_, lmd.distance));
    }
    std::vector<std::size_t> order(samples_.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return samples_[k].distance; });
    auto next = order.begin();
    const auto add_samples_below = [&](double level) {
      for (; next != order.end() && samples_[*next].distance < level; ++next) add(samples_[*next]);
    };
    for (const Merge& merge : input_.merges) {
      const Lmd& saddle = critical[merge.saddle].pair;
      if (!(saddle.distance < profile_.cutoff)) break;
      add_samples_below(saddle.distance);
      join(root_of(component_of_[merge.first]), root_of(component_of_[merge.second]), saddle);
    }
    add_samples_below(profile_.cutoff);
    for (std::size_t c = 0; c < components_.size(); ++c)
      if (parent_[c] == c) advance(components_[c], profile_.cutoff);
    return sum_.wrench();
  }

 private:
  static constexpr std::size_t NONE = static_cast<std::size_t>(-1);

  Push push_of(const Vec3& direction, const Vec3& point_W) const {
    return {-direction, -(point_W - reference_W_).cross(direction)};
  }

  std::size_t root_of(std::size_t component) {
    while (component != NONE && parent_[component] != component)
      component = parent_[component] = parent_[parent_[component]];
    return component;
  }

  /// Mean push at a level not below the component's.
  Push mean_at(const Component& c, double level) const {
    const double of_minima = c.minimum_area * (c.length + (level - c.level));
    const double weight = level * c.area - c.area_distance + of_minima;
    // No patch within the level yet, or of a law without patches.
    if (!(c.area > 0.0) || !(weight > 0.0)) return c.of_minima;
    Push mean = level / weight * c.push;
    mean += -1.0 / weight * c.push_distance;
    mean += of_minima / weight * c.of_minima;
    return mean;
  }

  /// On an interval in which no patch begins weights are linear in t, so their mean is smooth.
  void advance(Component& c, double level) {
    if (!(level > c.level)) return;
    if (!(c.area > 0.0)) {
      push(c.of_minima, force_magnitude(profile_, c.level) - force_magnitude(profile_, level));
    } else {
      const double from = std::max(c.level, profile_.saturation_distance);
      const auto pieces = static_cast<int>(std::ceil((level - from) / (LONGEST_PIECE * profile_.cutoff)));
      for (int k = 0; k < pieces; ++k)
        integrate(c, from + k * (level - from) / pieces, from + (k + 1) * (level - from) / pieces);
    }
    c.length += level - c.level;
    c.level = level;
  }

  /// Gauss-Legendre with weights whose sum is exact for a single direction.
  void integrate(const Component& c, double from, double to) {
    static const double AWAY = std::sqrt(0.6);
    const std::array<double, 3> place{0.5 - 0.5 * AWAY, 0.5, 0.5 + 0.5 * AWAY},
        gauss{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    std::array<double, 3> at{}, weight{};
    double total = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = from + place[k] * (to - from);
      weight[k] = gauss[k] * force_stiffness(profile_, at[k]);
      total += weight[k];
    }
    if (!(total > 0.0)) return;
    const double length = force_magnitude(profile_, from) - force_magnitude(profile_, to);
    for (std::size_t k = 0; k < 3; ++k) push(mean_at(c, at[k]), length * (weight[k] / total));
  }

  void push(const Push& push, double length) { sum_.add(length * push.force, length * push.torque); }

  void add(const SurfaceSample& sample) {
    const std::size_t index = root_of(component_of_[sample.minimum]);
    if (index == NONE) return;
    Component& c = components_[index];
    advance(c, sample.distance);
    const Push push = push_of(sample.direction, sample.point_moving);
    c.area += sample.area;
    c.area_distance += sample.area * sample.distance;
    c.push += sample.area * push;
    c.push_distance += sample.area * sample.distance * push;
  }

  void join(std::size_t a, std::size_t b, const Lmd& saddle) {
    if (a == NONE || b == NONE || a == b) return;
    Component &first = components_[a], &second = components_[b];
    advance(first, saddle.distance);
    advance(second, saddle.distance);
    const Vec3 before = mean_at(first, saddle.distance).force + mean_at(second, saddle.distance).force;
    const double length = first.length + second.length;
    // Of two that are born at the saddle itself neither is longer.
    const double part = length > 0.0 ? first.length / length : 0.5;
    first.of_minima = part * first.of_minima;
    first.of_minima += (1.0 - part) * second.of_minima;
    first.length = length;
    first.area += second.area;
    first.area_distance += second.area_distance;
    first.push += second.push;
    first.push_distance += second.push_distance;
    parent_[b] = a;
    // K_eff with weights held: two voices become one where the saddle is.
    sum_.stiffen(mean_at(first, saddle.distance).force - before, saddle.direction,
                 -force_stiffness(profile_, saddle.distance));
  }

  const ForceInput& input_;
  const std::span<const SurfaceSample> samples_;
  const ForceProfile& profile_;
  const Vec3 reference_W_;
  WrenchSum sum_;
  std::vector<Component> components_;
  std::vector<std::size_t> component_of_;  ///< Of minima.
  std::vector<std::size_t> parent_;        ///< Of components that were joined; else itself.
};

}  // namespace

Wrench integrate_levels(const ForceInput& input, std::span<const SurfaceSample> samples,
                        const ForceProfile& profile, const Vec3& reference_W) {
  return LevelIntegral(input, samples, profile, reference_W).run();
}

}  // namespace lmdbench
