// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>

#include <support/timing.h>

#include <cmath>
#include <ctime>

namespace lmdbench::experiments {

namespace {

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double thread_seconds() {
  return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

double process_seconds() {
  return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

void fill_caches() {
  constexpr std::size_t BYTES = std::size_t{64} << 20, LINE = 64;
  static std::vector<unsigned char> others(BYTES);
  for (std::size_t i = 0; i < BYTES; i += LINE) {
    volatile unsigned char& byte = others[i];
    byte = static_cast<unsigned char>(byte + 1);
  }
}

double log_slope(const std::vector<double>& counts, const std::vector<double>& values) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double a = std::log(counts[i]), b = std::log(values[i]);
    n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

std::vector<std::vector<double>> time_interleaved(const std::vector<TimedTask>& tasks, std::size_t pose_count,
                                                  std::size_t repetitions) {
  const auto prepare = [](const TimedTask& task, std::size_t pose) {
    if (task.prepare) task.prepare(pose);
  };
  for (std::size_t pose = 0; pose < pose_count; ++pose)
    for (const TimedTask& task : tasks) {
      prepare(task, pose);
      task.run(pose);
    }

  std::vector samples(tasks.size(), std::vector(pose_count, std::vector<double>(repetitions)));
  for (std::size_t repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t pose = 0; pose < pose_count; ++pose)
      for (std::size_t k = 0; k < tasks.size(); ++k) {
        const std::size_t t = (k + pose + repetition) % tasks.size();
        prepare(tasks[t], pose);
        const double start = thread_seconds();
        tasks[t].run(pose);
        samples[t][pose][repetition] = thread_seconds() - start;
      }

  std::vector seconds(tasks.size(), std::vector<double>(pose_count));
  for (std::size_t t = 0; t < tasks.size(); ++t)
    for (std::size_t pose = 0; pose < pose_count; ++pose) seconds[t][pose] = median(samples[t][pose]);
  return seconds;
}

}  // namespace lmdbench::experiments
