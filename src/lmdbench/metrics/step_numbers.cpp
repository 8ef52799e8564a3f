// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/metrics/errors.h>
#include <lmdbench/metrics/step_numbers.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lmdbench {
namespace {

constexpr std::array STEP_NUMBERS = {
#define NUMBER(name, units, ...) StepNumber{#name, units, &StepNumbers::name, __VA_ARGS__},
#include <lmdbench/metrics/step_numbers.def>
#undef NUMBER
};

/// Accumulates a root mean square.
class RootMeanSquare {
 public:
  void add(double value) {
    sum_ += value * value;
    largest_ = std::max(largest_, std::abs(value));
    ++count_;
  }
  double value() const { return count_ > 0 ? std::sqrt(sum_ / static_cast<double>(count_)) : UNSET; }
  double largest() const { return count_ > 0 ? largest_ : UNSET; }

 private:
  double sum_ = 0.0;
  double largest_ = 0.0;
  std::int64_t count_ = 0;
};

bool is_switch(const Vec3& before, const Vec3& after, double maximum_force) {
  const double low = std::min(before.norm(), after.norm());
  const double high = std::max(before.norm(), after.norm());
  return low < ZERO_SHARE * maximum_force && high > STRONG_SHARE * maximum_force;
}

void add_changes(double& births, double& deaths, const LmdSet& before, const LmdSet& after,
                 const Scene& scene) {
  const Agreement step = agreement(before, after, Match::NEIGHBOURING_FEATURES, scene);
  deaths += static_cast<double>(step.missed());
  births += static_cast<double>(step.wrong());
}

}  // namespace

std::span<const StepNumber> step_numbers() {
  return STEP_NUMBERS;
}

StepNumbers count_steps(const MethodRecord& record, ForceLaw law, const std::vector<TruthFrame>& truth,
                        const std::vector<TruthComparison>& rows, const PreparedRun& run,
                        const PreparedRun& truth_run, const std::vector<bool>& in_contact) {
  StepNumbers numbers{.jumps = 0.0, .true_jumps = 0.0};
  LMDBENCH_EXPECTS(rows.size() == truth.size() && in_contact.size() == record.frames.size(),
                   "parallel arrays of unlike lengths");
  for (const StepNumber& number : STEP_NUMBERS) {
    // Counts begin at 0; means and quantiles are unset until known.
    if (number.units == "1") numbers.*number.value = 0.0;
  }
  const auto index = static_cast<std::size_t>(law);
  const double maximum_force = run.profiles.front().force.maximum_force;
  RootMeanSquare magnitude, torque;
  std::vector<double> angle, distance, force, true_force, count, true_count;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const TruthFrame& here = truth[i];
    const auto frame = static_cast<std::size_t>(here.frame);
    const FrameRecord& now = record.frames[frame];
    if (frame + 1 < record.frames.size()) {
      const FrameRecord& next = record.frames[frame + 1];
      const bool jumps = (next.force - now.force).norm() > JUMP_SHARE * maximum_force;
      const bool truly = here.force_jump[index] > JUMP_SHARE * maximum_force;
      const bool step_is_known = !std::isnan(here.force_jump[index]);
      numbers.jumps += jumps ? 1.0 : 0.0;
      numbers.true_jumps += truly ? 1.0 : 0.0;
      numbers.false_jumps += jumps && step_is_known && !truly ? 1.0 : 0.0;
      numbers.missed_jumps += truly && !jumps ? 1.0 : 0.0;
      // Steps into contact and out of it count; the last one has no true end.
      if ((in_contact[frame] || in_contact[frame + 1]) && i + 1 < truth.size()) {
        numbers.switches += is_switch(now.force, next.force, maximum_force) ? 1.0 : 0.0;
        numbers.true_switches +=
            step_is_known && is_switch(here.force[index], truth[i + 1].force[index], maximum_force) ? 1.0
                                                                                                    : 0.0;
        add_changes(numbers.births, numbers.deaths, record.lmds.at(here.frame),
                    record.lmds.at(here.frame + 1), run.scene());
        add_changes(numbers.true_births, numbers.true_deaths, here.lmds, truth[i + 1].lmds,
                    truth_run.scene());
      }
    }
    if (!in_contact[frame]) continue;
    const double true_length = here.force[index].norm();
    const bool is_known = !std::isnan(true_length);
    force.push_back(now.force.norm());
    if (is_known) true_force.push_back(true_length);
    count.push_back(static_cast<double>(now.lmd_count));
    true_count.push_back(static_cast<double>(here.lmds.size()));
    numbers.frames_clipped += now.force_clipped ? 1.0 : 0.0;
    numbers.frames_empty += now.lmd_count == 0 ? 1.0 : 0.0;
    distance.push_back(std::abs(rows[i].minimum_distance_error));
    if (is_known) {
      magnitude.add(now.force.norm() - true_length);
      angle.push_back(rows[i].force_angle_error);
      torque.add((now.torque - here.torque[index]).norm());
    }
  }
  for (const SearchRecord& search : record.searches) {
    numbers.candidates += static_cast<double>(search.candidates);
    numbers.kept += static_cast<double>(search.kept_after_reduction);
  }
  numbers.seconds_in_contact = static_cast<double>(force.size()) / run.input.frame_rate_hz;
  numbers.lmd_count_mean = mean(count);
  numbers.true_lmd_count_mean = mean(true_count);
  numbers.force_mean_n = mean(force);
  numbers.true_force_mean_n = mean(true_force);
  numbers.force_magnitude_error_rms_n = magnitude.value();
  numbers.force_angle_error_p99_rad = quantile(angle, P99);
  numbers.minimum_distance_error_p99_m = quantile(distance, P99);
  numbers.torque_error_rms_n_m = torque.value();
  numbers.torque_error_maximum_n_m = torque.largest();
  return numbers;
}

}  // namespace lmdbench
