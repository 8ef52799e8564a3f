// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/metrics/time_numbers.h>
#include <lmdbench/metrics/times.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>

namespace lmdbench {
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
