// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

#include <Eigen/LU>
#include <study/continuous_force/measures.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lmdbench::continuous_force {

namespace {

/// Rounding error of a force that is a sum of pushes.
constexpr double CONE_ROUNDING = 1e-9;
constexpr int DIVISION = 10, DIVISIONS = 6;
/// Divisions by 10 that make steps of a thousandth of a frame.
constexpr std::size_t STEEP_DIVISION = 3;
constexpr double UNSET = std::numeric_limits<double>::quiet_NaN();

/// Whether a force is a sum of pushes along -direction of minima; three suffice (Caratheodory).
bool lies_in_cone(const Vec3& force, const CriticalSet& critical) {
  if (force.norm() <= CONE_ROUNDING) return true;
  std::vector<Vec3> pushes;
  for (const CriticalPair& c : critical)
    if (c.is_basin) pushes.push_back(-c.pair.direction);
  const auto fits = [&](const Vec3& rest) {
    return rest.norm() <= CONE_ROUNDING * std::max(1.0, force.norm());
  };
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    if (fits(force - std::max(0.0, force.dot(pushes[i])) * pushes[i])) return true;
    for (std::size_t j = i + 1; j < pushes.size(); ++j) {
      Eigen::Matrix<double, 3, 2> two;
      two << pushes[i], pushes[j];
      const Eigen::Vector2d x = (two.transpose() * two).fullPivLu().solve(two.transpose() * force);
      if (x.minCoeff() >= -CONE_ROUNDING && fits(force - two * x)) return true;
      for (std::size_t k = j + 1; k < pushes.size(); ++k) {
        Mat3 three;
        three << pushes[i], pushes[j], pushes[k];
        const Vec3 y = three.fullPivLu().solve(force);
        if (y.minCoeff() >= -CONE_ROUNDING && fits(force - three * y)) return true;
      }
    }
  }
  return false;
}

double step_of(const Forces& a, const Forces& b, std::size_t law) {
  return (b[law] - a[law]).norm();
}

/// Change of each critical pair in a step, largest first; its force if it is at one end alone.
std::vector<PairChange> changes_of_pairs(const CriticalSet& before, const CriticalSet& after,
                                         const ForceProfile& profile) {
  const auto force_of = [&](const CriticalPair& c) -> Vec3 {
    return c.index * force_magnitude(profile, c.pair.distance) / profile.maximum_force * c.pair.direction;
  };
  std::vector<PairChange> changes;
  std::vector<bool> met(after.size(), false);
  for (const CriticalPair& a : before) {
    PairChange change{a.index, a.pair.distance / profile.cutoff, UNSET, UNSET, force_of(a).norm()};
    for (std::size_t k = 0; k < after.size(); ++k) {
      if (met[k] || !same_feature_pair(a.pair, after[k].pair) || a.index != after[k].index) continue;
      met[k] = true;
      change.after = after[k].pair.distance / profile.cutoff;
      change.turn = std::atan2(a.pair.direction.cross(after[k].pair.direction).norm(),
                               a.pair.direction.dot(after[k].pair.direction));
      change.change = (force_of(after[k]) - force_of(a)).norm();
      break;
    }
    changes.push_back(change);
  }
  for (std::size_t k = 0; k < after.size(); ++k)
    if (!met[k])
      changes.push_back(
          {after[k].index, UNSET, after[k].pair.distance / profile.cutoff, UNSET, force_of(after[k]).norm()});
  std::ranges::stable_sort(changes, std::greater{}, &PairChange::change);
  return changes;
}

/// Divides the path again and again at its largest step; notes each division's largest step.
void refine(Renderer& renderer, const Pose& from, const Pose& to, std::size_t law, int left,
            PathRow::Law& own) {
  if (left == 0) return;
  std::vector<Pose> poses;
  std::vector<Forces> forces;
  for (int k = 0; k <= DIVISION; ++k) {
    poses.push_back(between(from, to, k / double{DIVISION}));
    forces.push_back(renderer.at(poses.back()).force);
  }
  std::size_t worst = 0;
  double step = 0.0;
  for (std::size_t k = 0; k + 1 < forces.size(); ++k)
    if (step_of(forces[k], forces[k + 1], law) > step) {
      step = step_of(forces[k], forces[k + 1], law);
      worst = k;
    }
  const std::size_t division = own.largest.size() - static_cast<std::size_t>(left);
  if (step > own.largest[division]) {
    own.largest[division] = step;
    if (division == STEEP_DIVISION)
      own.steepest = changes_of_pairs(renderer.at(poses[worst]).critical,
                                      renderer.at(poses[worst + 1]).critical, renderer.profile());
  }
  refine(renderer, poses[worst], poses[worst + 1], law, left - 1, own);
}

}  // namespace

PathRow measure_path(const PathScene& scene, std::size_t refined, std::optional<LayeredChoice> layered) {
  PathRow row;
  row.scene = scene.name;
  const std::size_t laws = layered ? LAWS : LAYERED;
  Renderer renderer(scene.scene, scene.profile, layered);
  std::vector<Forces>& forces = row.forces;
  for (const Pose& pose : scene.poses) {
    const Rendered here = renderer.at(pose);
    forces.push_back(here.force);
    ++row.frames;
    if (!here.in_contact()) continue;
    ++row.in_contact;
    row.separated += here.is_separated();
    row.minima += static_cast<double>(minima_of(here.critical).size());
    row.pairs += static_cast<double>(here.critical.size());
    row.merges += static_cast<double>(here.merges);
    for (std::size_t law = 0; law < laws; ++law) {
      PathRow::Law& own = row.laws[law];
      const double apart = (here.force[law] - here.force[SUM]).norm();
      own.rms_from_sum += apart * apart;
      if (here.is_separated()) own.separated_difference = std::max(own.separated_difference, apart);
      own.outside_cone += !lies_in_cone(here.force[law], here.critical);
      own.against_all += std::ranges::all_of(here.critical, [&](const CriticalPair& c) {
        return !c.is_basin || here.force[law].dot(c.pair.direction) > CONE_ROUNDING;
      });
    }
  }
  const double count = std::max<double>(1.0, static_cast<double>(row.in_contact));
  row.minima /= count, row.pairs /= count, row.merges /= count;
  for (std::size_t law = laws; law < LAWS; ++law) {
    row.laws[law].largest.assign(1 + DIVISIONS, UNSET);
    row.laws[law].separated_difference = row.laws[law].rms_from_sum = UNSET;
  }
  for (std::size_t law = 0; law < laws; ++law) {
    PathRow::Law& own = row.laws[law];
    own.rms_from_sum = std::sqrt(own.rms_from_sum / count);
    std::vector<std::size_t> order(forces.size() - 1);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater{},
                             [&](std::size_t i) { return step_of(forces[i], forces[i + 1], law); });
    own.largest.assign(1 + DIVISIONS, 0.0);
    own.largest[0] = step_of(forces[order[0]], forces[order[0] + 1], law);
    for (const std::size_t i : order) own.above_quarter += step_of(forces[i], forces[i + 1], law) > 0.25;
    for (std::size_t k = 0; k < std::min(refined, order.size()); ++k)
      refine(renderer, scene.poses[order[k]], scene.poses[order[k] + 1], law, DIVISIONS, own);
  }
  return row;
}

EventRow measure_events(const PathScene& scene, std::size_t most, double shortest,
                        std::optional<LayeredChoice> layered) {
  EventRow row{scene.name, 0, zeros(layered.has_value())};
  Renderer renderer(scene.scene, scene.profile, layered);
  Forces before = renderer.at(scene.poses.front()).force;
  for (std::size_t i = 0; i + 1 < scene.poses.size() && row.events < most; ++i) {
    const Forces after = renderer.at(scene.poses[i + 1]).force;
    // A step of the plain sum, but not of the continuous law: a birth or a death.
    const bool event = step_of(before, after, SUM) > 0.1 &&
                       step_of(before, after, SIGNED) < 0.5 * step_of(before, after, SUM);
    if (event) {
      double from = 0.0, to = 1.0;
      Forces low = before, high = after;
      while (to - from > shortest) {
        const double middle = 0.5 * (from + to);
        const Forces there = renderer.at(between(scene.poses[i], scene.poses[i + 1], middle)).force;
        if (step_of(low, there, SUM) > step_of(there, high, SUM)) {
          to = middle;
          high = there;
        } else {
          from = middle;
          low = there;
        }
      }
      ++row.events;
      for (std::size_t law = 0; law < LAWS; ++law)
        row.largest[law] = std::max(row.largest[law], step_of(low, high, law));
    }
    before = after;
  }
  return row;
}

}  // namespace lmdbench::continuous_force
