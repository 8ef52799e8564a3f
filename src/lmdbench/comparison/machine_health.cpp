// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/comparison/machine_health.h>
#include <lmdbench/comparison/ratio_estimate.h>
#include <lmdbench/result_file/provenance.h>

#include <fmt/format.h>
#include <linux/perf_event.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>
#include <vector>

namespace lmdbench {
namespace {

constexpr std::size_t REPETITIONS = 3;
constexpr std::size_t PIECES = 50;
/// First number of processes in scripts/ci_regression.sh, and its false alarms over seven stages.
constexpr std::size_t PROCESSES = 6;
constexpr double FALSE_ALARM = 0.05 / 7.0;

/// Some 0.1 ms of dependent arithmetic over a table larger than a usual level 1 cache: a lower
/// frequency slows it, and so does a neighbour in the cache.
class Piece {
 public:
  Piece() : table_(TABLE_SIZE) { std::iota(table_.begin(), table_.end(), 1.0); }

  double run() {
    std::uint64_t state = 88172645463325252ULL;
    double sum = 0.0;
    for (int i = 0; i < STEPS; ++i) {
      state ^= state << 13;  // xorshift64 (Marsaglia 2003)
      state ^= state >> 7;
      state ^= state << 17;
      sum = sum * 0.5 + table_[state % TABLE_SIZE];
    }
    return sum;
  }

 private:
  static constexpr std::size_t TABLE_SIZE = 16384;  // 128 KiB
  static constexpr int STEPS = 20000;
  std::vector<double> table_;
};

/// Detectable change of `lmdbench compare` if consecutive groups were processes of two sides in
/// turns: the median over all such sets of 2 x PROCESSES groups. NaN with fewer.
double median_detectable(const std::vector<double>& groups) {
  std::vector<double> found;
  for (std::size_t first = 0; first + 2 * PROCESSES <= groups.size(); first += 2 * PROCESSES) {
    std::vector<double> base, candidate;
    for (std::size_t i = 0; i < 2 * PROCESSES; ++i)
      (i % 2 == 0 ? base : candidate).push_back(groups[first + i]);
    found.push_back(estimate_ratio(base, candidate, FALSE_ALARM).detectable);
  }
  return found.empty() ? std::numeric_limits<double>::quiet_NaN() : median(found);
}

}  // namespace

NoiseFloor summarise_noise(std::span<const double> times, std::size_t repetitions, std::size_t pieces) {
  const std::size_t group_size = repetitions * pieces, groups = times.size() / group_size;
  const double least = *std::min_element(times.begin(), times.end());
  std::vector<double> excess;
  excess.reserve(times.size());
  for (const double time : times) excess.push_back(time / least - 1.0);
  std::vector<double> sums, logarithms;
  for (std::size_t group = 0; group < groups; ++group) {
    double sum = 0.0;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      double smallest = times[group * group_size + piece];
      for (std::size_t r = 1; r < repetitions; ++r)
        smallest = std::min(smallest, times[group * group_size + r * pieces + piece]);
      sum += smallest;
    }
    sums.push_back(sum);
    logarithms.push_back(std::log(sum));
  }
  const double centre = mean(logarithms);
  double squares = 0.0;
  for (const double value : logarithms) squares += (value - centre) * (value - centre);
  NoiseFloor floor;
  floor.seconds = std::accumulate(times.begin(), times.end(), 0.0);
  floor.piece_seconds = least;
  floor.typical_excess = median(excess);
  floor.slow_excess = quantile(excess, P99);
  floor.spread = std::sqrt(squares / static_cast<double>(groups - 1));
  floor.processes = PROCESSES;
  floor.detectable = median_detectable(sums);
  return floor;
}

NoiseFloor measure_noise_floor(double seconds) {
  using Clock = std::chrono::steady_clock;
  Piece piece;
  volatile double kept = piece.run();  // warms up, and keeps the compiler from dropping the work
  std::vector<double> times;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  for (std::size_t groups = 0; groups < 2 || Clock::now() < end; ++groups) {
    for (std::size_t i = 0; i < REPETITIONS * PIECES; ++i) {
      const auto begin = Clock::now();
      kept = piece.run();
      times.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    }
  }
  static_cast<void>(kept);
  return summarise_noise(times, REPETITIONS, PIECES);
}

namespace {

constexpr const char* UNKNOWN = "unknown";
/// With more waiting programs a processor, a timed one sometimes shares its core.
constexpr double LARGEST_LOAD_PER_PROCESSOR = 0.5;
/// One percent of stolen time already doubles some frames.
constexpr double LARGEST_STOLEN_SHARE = 0.001;

std::string first_line(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line) || line.empty()) return UNKNOWN;
  return line;
}

/// "yes", or why this process may not count its own instructions.
std::string hardware_counters() {
  struct perf_event_attr attributes {};
  attributes.type = PERF_TYPE_HARDWARE;
  attributes.size = sizeof(attributes);
  attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
  attributes.exclude_kernel = 1;
  attributes.exclude_hv = 1;
  const long descriptor = ::syscall(SYS_perf_event_open, &attributes, 0, -1, -1, 0UL);
  if (descriptor < 0) return std::strerror(errno);
  ::close(static_cast<int>(descriptor));
  return "yes";
}

std::string smt_siblings() {
  cpu_set_t usable;
  if (::sched_getaffinity(0, sizeof(usable), &usable) != 0) return UNKNOWN;
  std::string shared;
  bool known = false;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (!CPU_ISSET(i, &usable)) continue;
    const std::string list =
        first_line(fmt::format("/sys/devices/system/cpu/cpu{}/topology/thread_siblings_list", i));
    if (list == UNKNOWN) continue;
    known = true;
    if (list.find_first_of(",-") != std::string::npos) shared += (shared.empty() ? "" : "; ") + list;
  }
  if (!known) return UNKNOWN;
  return shared.empty() ? "none" : shared;
}

/// "max 100000" of version 2 means no limit.
std::string cpu_quota() {
  const std::string limit = first_line("/sys/fs/cgroup/cpu.max");
  if (limit == UNKNOWN) return UNKNOWN;
  return limit.starts_with("max") ? "none" : limit;
}

std::string stolen_share() {
  std::istringstream fields(first_line("/proc/stat"));
  std::string name;
  fields >> name;
  constexpr int STEAL_FIELD = 7;  // user nice system idle iowait irq softirq steal
  double total = 0.0, stolen = 0.0, value = 0.0;
  for (int field = 0; field <= STEAL_FIELD && fields >> value; ++field) {
    total += value;
    if (field == STEAL_FIELD) stolen = value;
  }
  return name == "cpu" && total > 0.0 ? fmt::format("{:.4f}", stolen / total) : UNKNOWN;
}

std::optional<double> number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return std::nullopt;
  return value;
}

std::string fact(const MachineFacts& facts, const std::string& name) {
  const auto found = facts.find(name);
  return found == facts.end() ? UNKNOWN : found->second;
}

}  // namespace

std::string_view health_name(Health health) {
  switch (health) {
    case Health::GOOD:
      return "good";
    case Health::BAD:
      return "bad";
    case Health::UNKNOWN:
      break;
  }
  return "unknown";
}

MachineFacts machine_facts() {
  MachineFacts facts;
  for (const auto& [name, value] : machine_info()) facts[name] = value;
  facts["hardware_counters"] = hardware_counters();
  facts["smt_siblings"] = smt_siblings();
  facts["cpu_quota"] = cpu_quota();
  facts["stolen_share"] = stolen_share();
  return facts;
}

std::vector<HealthFinding> judge_machine(const MachineFacts& facts) {
  std::vector<HealthFinding> findings;
  const auto add = [&](const std::string& name, const std::string& key,
                       const std::function<bool(std::string)>& good, const std::string& why,
                       const std::string& remedy) {
    HealthFinding finding{name, Health::UNKNOWN, fact(facts, key), why, ""};
    if (finding.value != UNKNOWN) finding.health = good(finding.value) ? Health::GOOD : Health::BAD;
    if (finding.health != Health::GOOD) finding.remedy = remedy;
    findings.push_back(std::move(finding));
  };
  const auto equals = [](const std::string& wanted) {
    return [wanted](const std::string& value) { return value == wanted; };
  };
  const double processors = number(fact(facts, "logical_processors")).value_or(1.0);
  add("frequency governor", "frequency_governor", equals("performance"),
      "the processor's frequency follows the load, so the first frames are slower than later ones",
      "cpupower frequency-set -g performance");
  add("frequency boost", "frequency_boost", equals("off"),
      "boost depends on temperature and on what the other cores do",
      "echo 0 > /sys/devices/system/cpu/cpufreq/boost, or 1 > .../intel_pstate/no_turbo");
  add(
      "load", "load_average_1_minute",
      [&](const std::string& value) {
        return number(value).value_or(0.0) <= LARGEST_LOAD_PER_PROCESSOR * processors;
      },
      fmt::format("other programs want the same {:g} processors and caches", processors),
      "wait until they are done, or give lmdbench a machine of its own");
  add("virtual machine", "virtual_machine", equals("no"),
      "neighbours on the same hardware cannot be seen from here",
      "measure on hardware of your own; else use more processes (lmdbench compare --base A1.h5 A2.h5 ...)");
  add(
      "stolen time", "stolen_share",
      [](const std::string& value) { return number(value).value_or(0.0) <= LARGEST_STOLEN_SHARE; },
      "share of the time that the hypervisor gave to other machines", "a machine with dedicated processors");
  add("SMT sibling", "smt_siblings", equals("none"),
      "two processors that share a core slow each other down by up to a half",
      "echo off > /sys/devices/system/cpu/smt/control, or taskset to one processor of each core and leave "
      "the other idle");
  add("processor quota", "cpu_quota", equals("none"),
      "the control group stops the program for the rest of a period when its share is used up",
      "run without the container's processor limit");
  add("hardware counters", "hardware_counters", equals("yes"),
      "instructions cannot be counted, so only work counters and callgrind are free of noise",
      "sysctl kernel.perf_event_paranoid=1; virtual machines often have none");
  add("address randomisation", "address_space_randomisation", equals("off"),
      "every process has another layout in memory and caches, so one process shows little",
      "compare several processes a side, or start them with setarch --addr-no-randomize");
  add("clock", "clock_source", equals("tsc"), "a slow clock makes short stages look longer",
      "echo tsc > /sys/devices/system/clocksource/clocksource0/current_clocksource");
  return findings;
}

}  // namespace lmdbench
