// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/force/wrench_sum.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lmdbench {

namespace {

/// One component of {distance <= t} while t rises.
struct Component {
  double level = 0.0;  ///< t up to which it has pushed.
  double mass = 0.0;   ///< Length of its branches up to there.
  std::vector<std::size_t> members;
};

/// F = integral over t of -f'(t) times the sum over components of {distance <= t} of the component's mean direction. A minimum alone in
/// its component up to the cutoff has its whole force; one that meets an older one at a saddle has its own voice only up to there, and
/// beyond a share: its part of the total length of the branches. So it vanishes where it dies, no force ever pulls, and the order of
/// merges does not matter.
class Sharing {
 public:
  Sharing(const ForceInput& input, const ForceProfile& profile, const Vec3& reference_W)
      : input_(input), profile_(profile), sum_(reference_W) {}

  Wrench run() {
    const CriticalSet& critical = input_.critical;
    LMDBENCH_EXPECTS(std::ranges::is_sorted(input_.merges, {},
                                            [&](const Merge& m) { return critical[m.saddle].pair.distance; }),
                     "merges that are not sorted by the distance of their saddles");
    component_of_.assign(critical.size(), NONE);
    share_.assign(critical.size(), 1.0);
    for (std::size_t i = 0; i < critical.size(); ++i) {
      if (!critical[i].is_basin || !WrenchSum::acts(critical[i].pair, profile_)) continue;
      component_of_[i] = components_.size();
      components_.push_back({critical[i].pair.distance, 0.0, {i}});
      sum_.stiffen(critical[i].pair.direction, critical[i].pair.direction,
                   force_stiffness(profile_, critical[i].pair.distance));
    }
    for (const Merge& merge : input_.merges) {
      const Lmd& saddle = critical[merge.saddle].pair;
      if (!(saddle.distance < profile_.cutoff)) break;
      join(component_of_[merge.first], component_of_[merge.second], saddle);
    }
    for (Component& component : components_) advance(component, profile_.cutoff);
    return sum_.wrench();
  }

 private:
  static constexpr std::size_t NONE = static_cast<std::size_t>(-1);

  void advance(Component& component, double level) {
    if (component.members.empty() || !(level > component.level)) return;
    const double length = force_magnitude(profile_, component.level) - force_magnitude(profile_, level);
    for (const std::size_t i : component.members) sum_.push(input_.critical[i].pair, share_[i] * length);
    component.mass += level - component.level;
    component.level = level;
  }

  Vec3 direction_of(const Component& component) const {
    Vec3 direction = Vec3::Zero();
    for (const std::size_t i : component.members) direction += share_[i] * input_.critical[i].pair.direction;
    return direction;
  }

  void join(std::size_t a, std::size_t b, const Lmd& saddle) {
    if (a == NONE || b == NONE || a == b) return;
    Component &first = components_[a], &second = components_[b];
    advance(first, saddle.distance);
    advance(second, saddle.distance);
    const double mass = first.mass + second.mass;
    LMDBENCH_EXPECTS(mass >= 0.0, "merges that are not sorted by the distance of their saddles");
    // Of two that are born at the saddle itself neither is longer.
    const double part = mass > 0.0 ? first.mass / mass : 0.5;
    const Vec3 before = direction_of(first) + direction_of(second);
    for (const std::size_t i : first.members) share_[i] *= part;
    for (const std::size_t i : second.members) {
      share_[i] *= 1.0 - part;
      component_of_[i] = a;
      first.members.push_back(i);
    }
    second.members.clear();
    first.mass = mass;
    // K_eff with shares held: two voices become one where the saddle is.
    sum_.stiffen(before - direction_of(first), saddle.direction, -force_stiffness(profile_, saddle.distance));
  }

  const ForceInput& input_;
  const ForceProfile& profile_;
  WrenchSum sum_;
  std::vector<Component> components_;
  std::vector<std::size_t> component_of_;
  std::vector<double> share_;
};

Wrench share_forces(const ForceInput& input, const ForceProfile& profile, const Vec3& reference_W) {
  return Sharing(input, profile, reference_W).run();
}

}  // namespace

const Aggregation& shared_law() {
  static const Aggregation law{
      .name = "shared",
      .summary = "LMDs that a saddle joins below the cutoff share one force: continuous, never pulls",
      .needs = AggregationNeeds::MERGES,
      .combine = share_forces};
  return law;
}

}  // namespace lmdbench
