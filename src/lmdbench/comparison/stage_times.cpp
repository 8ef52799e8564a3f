// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/comparison/stage_times.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace lmdbench {
namespace {

/// Sum of the columns' least values, without those that were never measured. 0 for no columns.
double sum_of_minima(const std::vector<double>& times, std::size_t first_row, std::size_t end_row,
                     std::size_t columns) {
  double sum = 0.0;
  for (std::size_t column = 0; column < columns; ++column) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t row = first_row; row < end_row; ++row) {
      const double time = times[row * columns + column];
      if (time < least) least = time;
    }
    if (std::isfinite(least)) sum += least;
  }
  return sum;
}

}  // namespace

std::size_t warm_up_repetitions(const ResultReader& file) {
  return static_cast<std::size_t>(
      std::max<std::int64_t>(file.integer_attribute("/methods", "warm_up_repetitions").value_or(0), 0));
}

const std::vector<TimedStage>& stages() {
  static const std::vector<TimedStage> ALL{{"search", "global_search_time", "global_counters"},
                                           {"reduction", "first_reduction_time", "global_counters"},
                                           {"second tracking", "second_tracking_time", "global_counters"},
                                           {"local update", "local_update_time", "counters"}};
  return ALL;
}

std::size_t measured_repetitions(const ResultReader& file) {
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string& label : file.groups("/methods")) {
    const std::string dataset = "/methods/" + label + "/local_update_time";
    if (!file.has(dataset))
      throw InputError(file.file().string(), dataset, "is missing: the run kept no times",
                       "run the experiment with /record/timings at true");
    const std::vector<std::size_t> shape = file.shape(dataset);
    if (shape.size() != 2 || shape[0] <= warm_up_repetitions(file))
      throw InputError(file.file().string(), dataset, "holds no measured repetition",
                       "run the experiment with /driver/repetitions of 2 or more");
    least = std::min(least, shape[0] - warm_up_repetitions(file));
  }
  return least;
}

StageTimes stage_times(const ResultReader& file, std::size_t repetitions) {
  StageTimes times;
  for (const std::string& label : file.groups("/methods")) {
    for (const TimedStage& stage : stages()) {
      const std::string dataset = "/methods/" + label + "/" + std::string(stage.dataset);
      if (!file.has(dataset)) continue;
      const std::vector<std::size_t> shape = file.shape(dataset);
      if (shape.size() != 2 || shape[0] < warm_up_repetitions(file) + repetitions)
        throw InputError(file.file().string(), dataset,
                         "has another shape than (repetitions, frames or searches)",
                         "make the file again with lmdbench run");
      const double sum = sum_of_minima(file.reals(dataset), warm_up_repetitions(file),
                                       warm_up_repetitions(file) + repetitions, shape[1]);
      if (sum > 0.0) times[label][std::string(stage.name)] = sum;
    }
  }
  return times;
}

std::string work_of_stage(const ResultReader& base, const ResultReader& candidate, const std::string& method,
                          const std::string& stage) {
  const auto found =
      std::find_if(stages().begin(), stages().end(), [&](const TimedStage& s) { return s.name == stage; });
  if (found == stages().end()) return {};
  const std::string group = fmt::format("/methods/{}/{}", method, found->counter_group);
  const std::vector<std::string> counters = base.datasets(group);
  if (counters.empty()) return "its work is not known: the results hold no counters";
  std::string moved;
  bool more = false;
  for (const std::string& counter : counters) {
    const std::string path = fmt::format("{}/{}", group, counter);
    if (!candidate.has(path)) continue;
    const auto total = [&](const ResultReader& file) {
      const std::vector<std::int64_t> values = file.integers(path);
      return std::accumulate(values.begin(), values.end(), std::int64_t{0});
    };
    const std::int64_t before = total(base), after = total(candidate);
    if (before == after) continue;
    more = more || after > before;
    moved += moved.empty() ? "" : ", ";
    moved += before == 0
                 ? fmt::format("{} from 0 to {}", counter, after)
                 : fmt::format("{} {:+.3g} %", counter,
                               100.0 * static_cast<double>(after - before) / static_cast<double>(before));
  }
  if (moved.empty()) return fmt::format("the same work: none of its {} counters moved", counters.size());
  return (more ? "more work: " : "less work: ") + moved;
}

}  // namespace lmdbench
