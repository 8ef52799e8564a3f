// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result_file/node_watch.h>

#include <nlohmann/json.hpp>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

constexpr double LEAST_PROCESSORS = 0.02;
constexpr std::size_t MOST_NEIGHBOURS = 5;

double seconds_of_ticks(double ticks) {
  return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

/// /proc/PID/stat: "PID (command) state ..."; the command may contain anything, so fields are
/// counted from its last parenthesis (proc(5)).
std::optional<ProcessTime> process_time(const std::filesystem::path& stat) {
  std::ifstream stream(stat);
  std::string line;
  if (!std::getline(stream, line)) return std::nullopt;  // ended meanwhile
  const std::size_t open = line.find('('), close = line.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close < open) return std::nullopt;
  ProcessTime process;
  process.command = line.substr(open + 1, close - open - 1);
  std::istringstream fields(line.substr(close + 1));
  constexpr int USER_TIME = 14, SYSTEM_TIME = 15, START_TIME = 22, FIRST = 3;
  std::string field;
  double ticks = 0.0;
  for (int number = FIRST; number <= START_TIME && fields >> field; ++number) {
    if (number == USER_TIME || number == SYSTEM_TIME) ticks += std::strtod(field.c_str(), nullptr);
    if (number == START_TIME) process.started = std::strtoull(field.c_str(), nullptr, 10);
  }
  process.seconds = seconds_of_ticks(ticks);
  return process;
}

std::map<int, ProcessTime> all_processes() {
  std::map<int, ProcessTime> result;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", none)) {
    const std::string name = entry.path().filename();
    int number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error != std::errc() || end != name.data() + name.size()) continue;
    if (const auto process = process_time(entry.path() / "stat")) result[number] = *process;
  }
  return result;
}

/// Of all processes, ended ones included [s]; NaN where the system gives none.
double machine_seconds() {
  std::ifstream stream("/proc/stat");
  std::string name;
  double user = 0.0, nice = 0.0, system = 0.0;
  if (!(stream >> name >> user >> nice >> system) || name != "cpu")
    return std::numeric_limits<double>::quiet_NaN();
  return seconds_of_ticks(user + nice + system);
}

double own_seconds() {
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Rounded to hundredths: the system's ticks tell no more.
double to_hundredths(double value) {
  return std::round(value * 100.0) / 100.0;
}

std::optional<long> number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr) return std::nullopt;
  char* end = nullptr;
  const long value = std::strtol(text, &end, 10);
  return end != text && *end == '\0' ? std::optional<long>(value) : std::nullopt;
}

}  // namespace

nlohmann::json describe_node(bool by_name) {
  Json where = Json::object();
  const long processors = ::sysconf(_SC_NPROCESSORS_CONF);
  where["processors"] = processors;
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) where["allowed"] = CPU_COUNT(&allowed);
  if (!by_name) return where;
  char name[256] = "";
  if (const char* slurm = std::getenv("SLURMD_NODENAME"))
    where["node"] = slurm;
  else if (::gethostname(name, sizeof name - 1) == 0)
    where["node"] = name;
  if (const auto job = number_in_environment("SLURM_JOB_ID")) {
    where["job"] = *job;
    where["restarts"] = number_in_environment("SLURM_RESTART_COUNT").value_or(0);
    if (const auto ours = number_in_environment("SLURM_CPUS_ON_NODE"))
      where["exclusive"] = *ours >= processors;
  }
  return where;
}

std::vector<Neighbour> neighbours_between(const std::map<int, ProcessTime>& before,
                                          const std::map<int, ProcessTime>& after, double seconds, int own) {
  std::map<std::string, double> worked;
  for (const auto& [number, process] : after) {
    if (number == own) continue;
    const auto earlier = before.find(number);
    const bool same = earlier != before.end() && earlier->second.started == process.started;
    worked[process.command] += process.seconds - (same ? earlier->second.seconds : 0.0);
  }
  std::vector<Neighbour> neighbours;
  for (const auto& [command, time] : worked)
    if (time >= LEAST_PROCESSORS * seconds) neighbours.push_back({command, time / seconds});
  std::stable_sort(neighbours.begin(), neighbours.end(),
                   [](const Neighbour& a, const Neighbour& b) { return a.processors > b.processors; });
  if (neighbours.size() > MOST_NEIGHBOURS) neighbours.resize(MOST_NEIGHBOURS);
  return neighbours;
}

NodeWatch::Look NodeWatch::look(bool by_name) {
  return {std::chrono::steady_clock::now(), by_name ? all_processes() : std::map<int, ProcessTime>(),
          machine_seconds(), own_seconds()};
}

NodeWatch::NodeWatch(bool by_name) : by_name_(by_name), before_(look(by_name)) {}

nlohmann::json NodeWatch::finish() const {
  const Look after = look(by_name_);
  const double seconds = std::chrono::duration<double>(after.time - before_.time).count();
  Json result = describe_node(by_name_);
  const double others =
      after.machine_seconds - before_.machine_seconds - (after.own_seconds - before_.own_seconds);
  if (std::isfinite(others)) result["elsewhere"] = to_hundredths(std::max(0.0, others / seconds));
  if (!by_name_) return result;
  result["neighbours"] = Json::array();
  for (const Neighbour& neighbour :
       neighbours_between(before_.processes, after.processes, seconds, ::getpid()))
    result["neighbours"].push_back(
        {{"command", neighbour.command}, {"processors", to_hundredths(neighbour.processors)}});
  return result;
}

}  // namespace lmdbench
