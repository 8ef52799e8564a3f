// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/thread_use.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace lmdbench {

ThreadUse ThreadUse::now() {
  ThreadUse use;
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  use.processor_ns = std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  rusage counts{};
  ::getrusage(RUSAGE_THREAD, &counts);
  use.minor_faults = counts.ru_minflt;
  use.major_faults = counts.ru_majflt;
  use.involuntary_switches = counts.ru_nivcsw;
  return use;
}

ThreadUse ThreadUse::operator-(const ThreadUse& earlier) const {
  return {processor_ns - earlier.processor_ns, minor_faults - earlier.minor_faults,
          major_faults - earlier.major_faults, involuntary_switches - earlier.involuntary_switches};
}

double stolen_seconds(const std::vector<int>& cores) {
  // proc(5): "cpuN user nice system idle iowait irq softirq steal ..." in ticks.
  constexpr int STEAL = 7;
  std::ifstream stream("/proc/stat");
  double ticks = 0.0;
  std::size_t found = 0;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (std::none_of(cores.begin(), cores.end(),
                     [&](int core) { return name == "cpu" + std::to_string(core); }))
      continue;
    double value = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i <= STEAL; ++i) words >> value;
    ticks += words ? value : std::numeric_limits<double>::quiet_NaN();
    ++found;
  }
  if (found != cores.size()) return std::numeric_limits<double>::quiet_NaN();
  return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

}  // namespace lmdbench
