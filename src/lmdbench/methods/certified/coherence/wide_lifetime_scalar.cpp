// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/coherence/wide_lifetime.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {

namespace {

/// A criterion of one lane, as in the vector form.
struct LaneCriterion {
  float slack, loss, value;
  LaneCriterion(float slack_of, float loss_of)
      : slack(slack_of),
        loss(loss_of),
        value(slack_of > 0.0F ? slack_of - loss_of * CHOICE_FRAMES : slack_of - NO_CHOICE) {}
};

LaneCriterion better(const LaneCriterion& a, const LaneCriterion& b) {
  return b.value > a.value ? b : a;
}

}  // namespace

WideLifetimes test_lanes_lifetime_scalar(const WideNode& node, const WideProbe& probe,
                                         const WideLimits& limits, const WideForecast& forecast,
                                         const WideLifetimeTest& test) {
  WideLifetimes result;
  const float angle_loss = std::max(forecast.spin * forecast.reach, LEAST_LENGTH);
  const WideTransform& X = forecast.in_moving;
  for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
    if (node.child[lane] == 0) continue;
    const std::uint32_t bit = 1u << lane;
    result.used |= bit;
    const LaneBounds bounds(node, lane, probe, limits.rounding);
    float ex = -test.probe_velocity[0], ey = -test.probe_velocity[1], ez = -test.probe_velocity[2];
    float lever_arm = probe.radius + 2.0F * forecast.cutoff;
    if (test.moving_lanes) {
      const auto row = [&](int i) {
        return ((X.columns[0][i] * node.centre[0][lane] + X.columns[1][i] * node.centre[1][lane]) +
                X.columns[2][i] * node.centre[2][lane]) +
               X.translation[i];
      };
      ex = row(0);
      ey = row(1);
      ez = row(2);
      lever_arm = bounds.radius + 2.0F * forecast.cutoff;
    }
    const float extra = forecast.spin * lever_arm + forecast.creep;

    const float z_probe = bounds.z_probe, z_lane = bounds.z_lane;
    const float* const axis = probe.axis;
    const float growth = LaneBounds::dot(bounds.dx, bounds.dy, bounds.dz, ex, ey, ez);
    const float rise_probe = LaneBounds::dot(ex, ey, ez, axis[0], axis[1], axis[2]);
    const float rise_lane = -LaneBounds::dot(ex, ey, ez, bounds.ux, bounds.uy, bounds.uz);
    const float least_squared_distance = bounds.squared_distance * (1.0F - DIRECTION_ROUNDING);
    const float distance = std::sqrt(least_squared_distance);
    const float reach_probe = z_probe + bounds.slab_probe, reach_lane = z_lane + bounds.slab_lane;

    const auto lost = [&](float loss) { return std::max(loss + extra, LEAST_LENGTH); };
    const LaneCriterion apart(distance - bounds.radii, lost(-(growth / std::max(distance, LEAST_LENGTH))));
    const LaneCriterion above_probe(z_probe - bounds.slab_probe, lost(-rise_probe));
    const LaneCriterion above_lane(z_lane - bounds.slab_lane, lost(-rise_lane));
    const LaneCriterion below_probe(-reach_probe, lost(rise_probe));
    const LaneCriterion below_lane(-reach_lane, lost(rise_lane));
    const LaneCriterion below = better(below_probe, below_lane);

    const auto beside = [&](float z, float rise, float reached, float cosine_of, float sine_of) {
      const float lateral = std::sqrt(std::max(least_squared_distance - z * z, 0.0F));
      const float lateral_growth = (growth - z * rise) / std::max(lateral, LEAST_LENGTH);
      const float limit = limits.cutoff * cosine_of;
      const float side = bounds.radii * cosine_of + sine_of * std::min(reached, limit);
      const float side_growth = reached < limit ? sine_of * rise : 0.0F;
      return LaneCriterion((lateral * cosine_of - side) * HALF_DIAGONAL,
                           lost((side_growth - lateral_growth * cosine_of) * HALF_DIAGONAL));
    };
    LaneCriterion length = better(beside(z_probe, rise_probe, reach_probe, probe.cosine, probe.sine),
                                  beside(z_lane, rise_lane, reach_lane, bounds.cosine, bounds.sine));
    length = better(length, below);
    const auto past = [](const LaneCriterion& criterion, float limit) {
      return LaneCriterion(criterion.slack - limit, criterion.loss);
    };
    const auto farther_than = [&](float limit) {
      return better(better(past(apart, limit), past(above_probe, limit)), past(above_lane, limit));
    };
    length = better(length, farther_than(limits.cutoff));
    const LaneCriterion touching = better(
        farther_than(limits.touch), better(past(below_probe, limits.touch), past(below_lane, limits.touch)));

    const float g2_cosines =
        ((bounds.cosine * probe.cosine - bounds.sine * probe.sine) - DIRECTION_ROUNDING) + bounds.between;
    const float angle_slack = (g2_cosines / (bounds.between <= 0.0F ? bounds.across : 1.0F)) * forecast.reach;

    const auto frames = [&](float slack, float loss) {
      return (slack * (1.0F - DEVIATION_SHARE) - forecast.base) / (loss + forecast.drift);
    };
    const float length_frames = frames(length.slack, length.loss);
    const float angle_frames = frames(angle_slack, angle_loss);
    const float touch_frames = frames(touching.slack, touching.loss);
    const float lmd_frames = std::max(length_frames, angle_frames);
    const float lmd_slack = length_frames >= angle_frames ? length.slack : angle_slack;

    const auto soon = [&](float slack, float loss) { return slack <= loss * forecast.horizon; };
    const auto stands = [&](float for_frames, float slack) {
      result.frames = std::min(result.frames, for_frames);
      result.deviation_budget = std::min(
          result.deviation_budget, (slack * DEVIATION_SHARE + forecast.base) + forecast.drift * for_frames);
    };
    if (soon(length.slack, length.loss) && soon(angle_slack, angle_loss)) {
      result.lmd |= bit;
    } else {
      stands(lmd_frames, lmd_slack);
    }
    if ((test.touch_lanes >> lane & 1u) == 0) continue;
    if (soon(touching.slack, touching.loss)) {
      result.touch |= bit;
    } else {
      stands(touch_frames, touching.slack);
    }
  }
  return result;
}

}  // namespace lmdbench
