// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/metrics/cleanliness.h>
#include <lmdbench/metrics/errors.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace lmdbench {
namespace {

constexpr double TAIL = 0.025;

/// Poisson mean whose counts are on one side of `count` with probability TAIL, by chi-squared.
double limit(double degrees_of_freedom, double probability) {
  return 0.5 * boost::math::quantile(boost::math::chi_squared(degrees_of_freedom), probability);
}

}  // namespace

Events count_events(std::int64_t count, double seconds) {
  LMDBENCH_EXPECTS(count >= 0, "a difference in place of a count");
  Events events;
  if (!(seconds > 0.0)) return events;
  events.count = static_cast<double>(count);
  events.low = count == 0 ? 0.0 : limit(2.0 * events.count, TAIL) / seconds;
  events.high = limit(2.0 * events.count + 2.0, 1.0 - TAIL) / seconds;
  if (count >= LEAST_EVENTS) events.per_second = events.count / seconds;
  return events;
}

std::string events_text(const Events& events, double seconds, const std::string& within) {
  if (std::isnan(events.count)) return "-";
  std::string text = fmt::format("{:.0f} in {:.3g} s{}", events.count, seconds, within);
  if (!std::isnan(events.per_second)) text += fmt::format(", {:.3g} a second", events.per_second);
  return text + fmt::format(" (95 %: {:.3g} to {:.3g} a second)", events.low, events.high);
}

namespace {

double root_mean_square(std::vector<double> values) {
  for (double& value : values) value *= value;
  return std::sqrt(mean(values));
}

double ratio(std::int64_t candidates, std::int64_t kept) {
  return kept > 0 ? static_cast<double>(candidates) / static_cast<double>(kept) : UNSET;
}

std::int64_t frames_in_contact(const RunFrames& frames) {
  return std::count(frames.in_contact.begin(), frames.in_contact.end(), true);
}

double seconds_in_contact(const RunFrames& frames) {
  return static_cast<double>(frames_in_contact(frames)) / frames.frame_rate_hz;
}

std::vector<Vec3> forces_of(const MethodRecord& record) {
  std::vector<Vec3> forces;
  for (const FrameRecord& frame : record.frames) forces.push_back(frame.force);
  return forces;
}

/// Over all frames, in contact or not.
std::int64_t count_jumps(const std::vector<Vec3>& forces, const RunFrames& frames) {
  std::int64_t jumps = 0;
  for (std::size_t i = 0; i + 1 < forces.size(); ++i)
    if ((forces[i + 1] - forces[i]).norm() > JUMP_SHARE * frames.maximum_force) ++jumps;
  return jumps;
}

}  // namespace

void summarise_counts(MethodSummary& summary, const MethodRecord& record, const RunFrames& frames) {
  std::vector<double> counts, candidates, ratios;
  LMDBENCH_EXPECTS(frames.in_contact.size() == record.frames.size(),
                   "contact of other frames than the record's");
  std::int64_t touching = 0, most = 0;
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    const FrameRecord& frame = record.frames[i];
    most = std::max(most, frame.lmd_count);
    if (frame.minimum_distance == 0.0) ++touching;
    if (frames.in_contact[i]) counts.push_back(static_cast<double>(frame.lmd_count));
  }
  std::int64_t all_candidates = 0, all_kept = 0;
  for (const SearchRecord& search : record.searches) {
    all_candidates += search.candidates;
    all_kept += search.kept_after_reduction;
    ratios.push_back(ratio(search.candidates, search.kept_after_reduction));
    if (frames.in_contact[static_cast<std::size_t>(search.frame)])
      candidates.push_back(static_cast<double>(search.candidates));
  }
  summary.frames_in_contact =
      static_cast<double>(std::count(frames.in_contact.begin(), frames.in_contact.end(), true));
  summary.frames_touching = static_cast<double>(touching);
  summary.lmd_count_median = median(counts);
  summary.lmd_count_p99 = quantile(counts, P99);
  summary.lmd_count_maximum = static_cast<double>(most);
  summary.candidates_median = median(candidates);
  summary.reduction_ratio = ratio(all_candidates, all_kept);
  summary.reduction_ratio_maximum = maximum(ratios);
}

void set_jumps(MethodSummary& summary, const Events& events) {
  summary.jumps = events.count;
  summary.jumps_per_second = events.per_second;
  summary.jumps_per_second_low = events.low;
  summary.jumps_per_second_high = events.high;
}

void set_true_jumps(MethodSummary& summary, const Events& events, std::int64_t frames) {
  summary.true_jumps = events.count;
  summary.true_jump_frames = static_cast<double>(frames);
  summary.true_jumps_per_second = events.per_second;
  summary.true_jumps_per_second_low = events.low;
  summary.true_jumps_per_second_high = events.high;
}

void summarise_jumps(MethodSummary& summary, const MethodRecord& record, const RunFrames& frames) {
  set_jumps(summary, count_events(count_jumps(forces_of(record), frames), seconds_in_contact(frames)));
}

void summarise_rendering(MethodSummary& summary, const MethodRecord& record, const RunFrames& frames) {
  std::vector<double> force, stiffness;
  LMDBENCH_EXPECTS(frames.in_contact.size() == record.frames.size() && frames.frame_rate_hz > 0.0,
                   "contact of other frames than the record's");
  std::vector<Vec3> all;
  std::size_t clipped = 0;
  std::int64_t dropouts = 0;
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    const FrameRecord& frame = record.frames[i];
    all.push_back(frame.force);
    if (!frames.in_contact[i]) continue;
    force.push_back(frame.force.norm());
    stiffness.push_back(frame.effective_stiffness);
    if (frame.force_clipped) ++clipped;
    if (i > 0 && frame.force.isZero(0.0) && !record.frames[i - 1].force.isZero(0.0)) ++dropouts;
  }
  if (2.0 * HIGH_PASS_HZ < frames.frame_rate_hz) {
    double sum = 0.0;
    for (const Vec3& high : above_30_hz(all, 1.0 / frames.frame_rate_hz)) sum += high.squaredNorm();
    summary.force_above_30_hz_n = std::sqrt(sum / static_cast<double>(all.size()));
  }
  if (!record.loop.empty()) {
    summary.energy_created_j = maximum(contact_work(record, frames.ports));
    summary.energy_balance_error = record.loop.back().energy.balance_error();
  }
  if (force.empty()) return;
  summary.rendered_force_median_n = median(force);
  summary.rendered_force_p99_n = quantile(force, P99);
  summary.rendered_force_maximum_n = maximum(force);
  summary.effective_stiffness_p99_n_per_m = quantile(stiffness, P99);
  summary.force_clipped_share = static_cast<double>(clipped) / static_cast<double>(force.size());
  const Events lost = count_events(dropouts, static_cast<double>(force.size()) / frames.frame_rate_hz);
  summary.dropouts = lost.count;
  summary.dropouts_per_second = lost.per_second;
  summary.dropouts_per_second_low = lost.low;
  summary.dropouts_per_second_high = lost.high;
}

void summarise_errors(MethodSummary& summary, ForceLaw law, const std::vector<TruthFrame>& truth,
                      const std::vector<TruthComparison>& comparisons, const RunFrames& frames) {
  const auto index = static_cast<std::size_t>(law);
  LMDBENCH_EXPECTS(comparisons.size() == truth.size(), "comparisons with another truth");
  Agreement same, neighbours;
  std::size_t wrong = 0;
  std::int64_t true_jumps = 0, known = 0;
  std::vector<double> distance, force, angle, jump, true_jump;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const TruthComparison& row = comparisons[i];
    same += row.same;
    neighbours += row.neighbours;
    if (!row.same.exact()) ++wrong;
    distance.push_back(std::abs(row.minimum_distance_error));
    if (!frames.in_contact[static_cast<std::size_t>(truth[i].frame)]) continue;
    // The time of the run's last frame counts, too, as in `summarise_true_steps`.
    if (truth[i].frame + 1 == std::ssize(frames.in_contact) && truth[i].contact_without_direction() == 0)
      ++known;
    if (!std::isnan(truth[i].force_jump[index])) {
      ++known;
      jump.push_back(row.force_jump);
      true_jump.push_back(truth[i].force_jump[index]);
      if (truth[i].force_jump[index] > JUMP_SHARE * frames.maximum_force) ++true_jumps;
    }
    if (truth[i].contact_without_direction() > 0) continue;
    force.push_back(row.force_error);
    angle.push_back(row.force_angle_error);
  }
  summary.recall = same.recall();
  summary.precision = same.precision();
  summary.recall_adjacent = neighbours.recall();
  summary.precision_adjacent = neighbours.precision();
  summary.frames_wrong = static_cast<double>(wrong);
  summary.minimum_distance_error_maximum_m = maximum(distance);
  summary.force_error_rms_n = root_mean_square(force);
  summary.force_error_median_n = median(force);
  summary.force_error_p99_n = quantile(force, P99);
  summary.force_error_maximum_n = maximum(force);
  summary.force_angle_error_median_rad = median(angle);
  summary.force_jump_p99_n = quantile(jump, P99);
  summary.force_jump_maximum_n = maximum(jump);
  summary.true_force_jump_p99_n = quantile(true_jump, P99);
  summary.true_force_jump_maximum_n = maximum(true_jump);
  if (known > 0)
    set_true_jumps(summary, count_events(true_jumps, static_cast<double>(known) / frames.frame_rate_hz),
                   known);
}

void summarise_true_steps(MethodSummary& summary, ForceLaw law, const MethodRecord& record,
                          const CompleteTruth& truth, const RunFrames& frames) {
  const std::vector<Vec3>& forces = truth.force[static_cast<std::size_t>(law)];
  std::vector<double> changes, true_changes;
  std::int64_t known = 0;  // in contact
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const std::size_t next = std::min(i + 1, forces.size() - 1);
    if (!frames.in_contact[i] || forces[i].hasNaN() || forces[next].hasNaN()) continue;
    ++known;
    if (next == i) continue;
    changes.push_back((record.frames[next].force - record.frames[i].force).norm());
    true_changes.push_back((forces[next] - forces[i]).norm());
  }
  if (known > 0)
    set_true_jumps(
        summary, count_events(count_jumps(forces, frames), static_cast<double>(known) / frames.frame_rate_hz),
        known);
  summary.force_jump_p99_n = quantile(changes, P99);
  summary.force_jump_maximum_n = maximum(changes);
  summary.true_force_jump_p99_n = quantile(true_changes, P99);
  summary.true_force_jump_maximum_n = maximum(true_changes);
}

}  // namespace lmdbench
