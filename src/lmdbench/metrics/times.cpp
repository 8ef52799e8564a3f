// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/metrics/times.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>

namespace lmdbench {
namespace {

constexpr double HAPTIC_FRAME_S = 1e-3;  ///< 1 kHz, at any rate of the experiment.

std::size_t first_measured(const MethodRecord& record) {
  return record.repetitions.size() > 1 ? 1 : 0;
}

double zero_where_unset(double value) {
  return std::isnan(value) ? 0.0 : value;
}

/// Medians over the measured repetitions, of the columns that count.
/// @param sample  takes a RepetitionTimes and a column
template <typename Sample>
std::vector<double> medians(const MethodRecord& record, const std::vector<bool>& counts,
                            const Sample& sample) {
  std::vector<double> result, repetitions;
  for (std::size_t column = 0; column < counts.size(); ++column) {
    if (!counts[column]) continue;
    repetitions.clear();
    for (std::size_t i = first_measured(record); i < record.repetitions.size(); ++i)
      repetitions.push_back(sample(record.repetitions[i], column));
    result.push_back(median(repetitions));
  }
  return result;
}

}  // namespace

std::vector<std::vector<double>> time_per_frame(const MethodRecord& record) {
  std::vector<std::vector<double>> rows;
  for (std::size_t i = first_measured(record); i < record.repetitions.size(); ++i) {
    const RepetitionTimes& times = record.repetitions[i];
    std::vector<double> row = times.local_update;
    for (std::size_t s = 0; s < record.searches.size(); ++s) {
      const auto begin = static_cast<std::size_t>(record.searches[s].frame);
      const std::size_t end = s + 1 < record.searches.size()
                                  ? static_cast<std::size_t>(record.searches[s + 1].frame)
                                  : row.size();
      const double search = times.global_search[s] + zero_where_unset(times.first_reduction[s]) +
                            zero_where_unset(times.second_tracking[s]);
      LMDBENCH_EXPECTS(end >= begin && end <= row.size(), "searches in another order than their frames");
      // The path may end soon after the last one.
      const std::size_t before = s > 0 && s + 1 == record.searches.size()
                                     ? begin - static_cast<std::size_t>(record.searches[s - 1].frame)
                                     : 0;
      for (std::size_t frame = begin; frame < end; ++frame)
        row[frame] += search / static_cast<double>(std::max(end - begin, before));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

void summarise_times(MethodSummary& summary, const MethodRecord& record,
                     const std::vector<bool>& in_contact) {
  std::vector<bool> searches;
  LMDBENCH_EXPECTS(in_contact.size() == record.frames.size(), "contact of other frames than the record's");
  for (const SearchRecord& search : record.searches)
    searches.push_back(in_contact[static_cast<std::size_t>(search.frame)]);
  const auto of_searches = [&](std::vector<double> RepetitionTimes::*times) {
    return medians(record, searches, [times](const RepetitionTimes& repetition, std::size_t i) {
      return (repetition.*times)[i];
    });
  };

  const std::vector<double> local =
      medians(record, in_contact,
              [](const RepetitionTimes& repetition, std::size_t i) { return repetition.local_update[i]; });
  summary.local_update_median_s = median(local);
  summary.local_update_p99_s = quantile(local, P99);
  summary.local_update_maximum_s = maximum(local);

  const std::vector<double> search = of_searches(&RepetitionTimes::global_search);
  summary.global_search_median_s = median(search);
  summary.global_search_p99_s = quantile(search, P99);
  summary.first_reduction_median_s = median(of_searches(&RepetitionTimes::first_reduction));
  summary.second_tracking_median_s = median(of_searches(&RepetitionTimes::second_tracking));
  const std::vector<double> both =
      medians(record, searches, [](const RepetitionTimes& repetition, std::size_t i) {
        return repetition.global_search[i] + zero_where_unset(repetition.first_reduction[i]);
      });
  summary.search_with_reduction_median_s = median(both);
  summary.search_with_reduction_p99_s = quantile(both, P99);

  const std::vector<std::vector<double>> rows = time_per_frame(record);
  std::vector<double> frame_times, repetitions;
  for (std::size_t frame = 0; frame < in_contact.size(); ++frame) {
    if (!in_contact[frame]) continue;
    repetitions.clear();
    for (const std::vector<double>& row : rows) repetitions.push_back(row[frame]);
    frame_times.push_back(median(repetitions));
  }
  summary.frame_time_median_s = median(frame_times);
  summary.frame_time_p99_s = quantile(frame_times, P99);
  summary.frame_time_maximum_s = maximum(frame_times);
  if (!frame_times.empty())
    // A frame that a plugin lost, or that had no tick, has no time: it was not punctual.
    summary.frames_late = static_cast<double>(std::count_if(
        frame_times.begin(), frame_times.end(), [](double time) { return !(time <= HAPTIC_FRAME_S); }));
}

namespace {

constexpr std::array TIME_NUMBERS = {
#define NUMBER(name, units, ...) TimeNumber{#name, units, &TimeNumbers::name, __VA_ARGS__},
#include <lmdbench/metrics/time_numbers.def>
#undef NUMBER
};

/// Median over the measured repetitions of a frame.
template <typename Sample>
double median_of(std::size_t repetitions, const Sample& sample) {
  std::vector<double> values;
  for (std::size_t i = repetitions > 1 ? 1 : 0; i < repetitions; ++i) values.push_back(sample(i));
  return median(values);
}

}  // namespace

std::span<const TimeNumber> time_numbers() {
  return TIME_NUMBERS;
}

TimeNumbers measure_times(const MethodRecord& record, const std::vector<bool>& counts, double frame_rate_hz) {
  TimeNumbers numbers;
  const std::vector<std::vector<double>> all = time_per_frame(record);
  std::vector<double> local, empty, filled;
  double processor = 0.0, local_sum = 0.0, filled_sum = 0.0, carried = 0.0;
  for (std::size_t frame = 0; frame < counts.size(); ++frame) {
    if (!counts[frame]) continue;
    std::vector<double> whole;
    for (const std::vector<double>& row : all) whole.push_back(row[frame]);
    processor += median(whole);
    const double update = median_of(record.repetitions.size(),
                                    [&](std::size_t i) { return record.repetitions[i].local_update[frame]; });
    local.push_back(update);
    local_sum += update;
    const std::int64_t tracked = record.frames[frame].tracked_count;
    (tracked > 0 ? filled : empty).push_back(update);
    if (tracked > 0) filled_sum += update;
    carried += static_cast<double>(tracked);
  }
  if (local.empty()) return numbers;
  numbers.processor_share = processor / (static_cast<double>(local.size()) / frame_rate_hz);
  numbers.local_update_mean_s = mean(local);
  numbers.local_update_empty_median_s = median(empty);
  numbers.local_update_filled_median_s = median(filled);
  numbers.local_update_filled_mean_s = mean(filled);
  if (carried > 0.0) numbers.local_update_per_tracked_s = filled_sum / carried;
  if (processor > 0.0) numbers.search_share = std::max(0.0, 1.0 - local_sum / processor);
  return numbers;
}

double clock_overhead() {
  constexpr int READINGS = 10'001;
  std::vector<double> seconds;
  for (int i = 0; i < READINGS; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return median(seconds);
}

}  // namespace lmdbench
