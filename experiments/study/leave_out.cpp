// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/run_program.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/comparison/exact_differences.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/result_file/result_reader.h>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <study/studies.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

/// What each rule of the plan saves, and whether it changes a result. Every scene is run as a user
/// would, in its own process: with all rules on auto, with one off, and with all off. Settings
/// alternate in random order, round by round; a ratio compares two processes of the same round.
namespace lmdbench::study {
namespace {

constexpr const char* AUTO = "auto";
constexpr const char* NONE = "none";

struct LeaveOutChoice {
  std::vector<std::string> experiments;
  std::int64_t processes = 5;
  std::int64_t frames = 0;
};

/// The cost of one process.
struct Cost {
  double seconds = 0.0;  ///< Processor time.
  double wall_seconds = 0.0;
  double megabytes = 0.0;  ///< Peak of resident memory.
};
using Costs = std::vector<Cost>;  // one per round

std::filesystem::path program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "lmdbench";
}

/// Runs the program without output.
Cost run_once(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child < 0) throw EnvironmentError("", "fork", "no further process", "end others");
  if (child == 0) {
    const int nothing = ::open("/dev/null", O_WRONLY);
    ::dup2(nothing, STDOUT_FILENO);
    ::execv(argv.front(), argv.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  if (::wait4(child, &status, 0, &usage) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw EnvironmentError("", fmt::format("{}", fmt::join(arguments, " ")), "did not end well",
                           "run it by hand");
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime),
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
          static_cast<double>(usage.ru_maxrss) / 1024.0};
}

/// @param setting AUTO, NONE or the rule that is off
/// @param frames  0: the whole path
Cost run_scene(const std::string& experiment, const std::string& setting, std::int64_t frames,
               const std::filesystem::path& out) {
  std::vector<std::string> arguments{
      program().string(), "run", experiment, "-q", "--out", out.string(), "--set", "/driver/repetitions=1"};
  const auto set = [&](const std::string& entry) { arguments.insert(arguments.end(), {"--set", entry}); };
  if (frames > 0) set(fmt::format("/frames={}", frames));
  for (const RuleDescription& rule : rule_descriptions())
    if (setting == NONE || setting == rule.name) set(fmt::format("/plan/{}=off", rule.name));
  return run_once(arguments);
}

/// Median over the rounds.
double median_of(const Costs& costs, double Cost::*member) {
  std::vector<double> values;
  for (const Cost& cost : costs) values.push_back(cost.*member);
  return median(values);
}

/// Saved share of `without` [%], round by round: "30 (28 to 33)" is the median, least and most.
struct Saving {
  double median = 0.0, least = 0.0, most = 0.0;
  std::string text() const { return fmt::format("{:.0f} ({:.0f} to {:.0f})", median, least, most); }
};
Saving saving(const Costs& without, const Costs& with, double Cost::*member) {
  std::vector<double> percent;
  for (std::size_t i = 0; i < with.size(); ++i)
    percent.push_back(100.0 * (1.0 - with[i].*member / (without[i].*member)));
  const auto [least, most] = std::minmax_element(percent.begin(), percent.end());
  return {median(percent), *least, *most};
}

/// Names of counters, else datasets, that differ between two results; times are ignored.
std::set<std::string> differences(const std::filesystem::path& without, const std::filesystem::path& with) {
  const ResultReader base(without), candidate(with);
  std::set<std::string> names;
  for (const Difference& difference : exact_differences(base, candidate, {}))
    names.insert(difference.dataset);
  for (const char* group : {"/path", "/reference", "/crosscheck"})
    for (const Difference& difference : group_differences(base, candidate, group))
      names.insert(difference.dataset);
  return names;
}

bool is_counter(const std::string& dataset) {
  return dataset.find("counters/") != std::string::npos;
}

std::string changes(const std::set<std::string>& changed, bool& equal) {
  if (changed.empty()) return "none";
  const bool only_counters = std::all_of(changed.begin(), changed.end(), is_counter);
  equal = equal && only_counters;
  return only_counters ? fmt::format("{} counters", changed.size())
                       : fmt::format("{}", fmt::join(changed, ", "));
}

int compare_rules(const LeaveOutChoice& choice) {
  constexpr std::int64_t FEW_FRAMES = 10;
  const TemporaryFolder folder(std::filesystem::temp_directory_path(), "lmdbench-leave-out-");
  const auto file = [&](std::string_view setting) { return folder.path() / fmt::format("{}.h5", setting); };
  std::vector<std::string> settings{AUTO, NONE};
  for (const RuleDescription& rule : rule_descriptions()) settings.emplace_back(rule.name);
  std::map<std::string, std::string> rows, idle;  // by rule
  std::map<std::string, int> pays;
  std::string scenes;
  bool equal = true;
  std::mt19937 shuffled(1);
  for (const std::string& experiment : choice.experiments) {
    const std::string name = std::filesystem::path(experiment).stem().string();
    std::map<std::string, Costs> costs, starts;
    for (std::int64_t round = 0; round < choice.processes; ++round) {
      std::shuffle(settings.begin(), settings.end(), shuffled);
      for (const std::string& setting : settings)
        costs[setting].push_back(run_scene(experiment, setting, choice.frames, file(setting)));
      for (const char* setting : {AUTO, NONE})
        starts[setting].push_back(run_scene(experiment, setting, FEW_FRAMES, file("few")));
    }
    const ResultReader result(file(AUTO));
    const Costs& with = costs[AUTO];
    scenes +=
        fmt::format("| {} | {} | {:.0f} | {:.0f} | {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {} |\n",
                    name, result.shape("/path/time").front(), 1e3 * median_of(costs[NONE], &Cost::seconds),
                    1e3 * median_of(with, &Cost::seconds), saving(costs[NONE], with, &Cost::seconds).text(),
                    median_of(costs[NONE], &Cost::megabytes), median_of(with, &Cost::megabytes),
                    1e3 * median_of(starts[NONE], &Cost::wall_seconds),
                    1e3 * median_of(starts[AUTO], &Cost::wall_seconds),
                    static_cast<double>(std::filesystem::file_size(file(AUTO))) / 1024.0,
                    changes(differences(file(NONE), file(AUTO)), equal));
    const auto plan = nlohmann::json::parse(result.texts("/provenance/plan").front());
    for (const auto& decision : plan["rules"]) {
      const std::string rule = decision["name"], reason = decision["reason"];
      const std::string changed = changes(differences(file(rule), file(AUTO)), equal);
      if (!decision["on"].get<bool>()) {
        idle[rule] += fmt::format("{}{} ({})", idle[rule].empty() ? "" : "; ", name, reason);
        continue;
      }
      const Saving time = saving(costs[rule], with, &Cost::seconds);
      const Saving memory = saving(costs[rule], with, &Cost::megabytes);
      // Required in every round: noise alone cannot look like a saving.
      if (time.least > 0.0 && time.median > 1.0) ++pays[rule];
      rows[rule] +=
          fmt::format("| {} | {:.0f} | {:.0f} | {} | {} | {} | {} |\n", name,
                      1e3 * median_of(costs[rule], &Cost::seconds), 1e3 * median_of(with, &Cost::seconds),
                      time.text(), memory.text(), changed, reason);
    }
  }
  fmt::print(
      "| scene | frames | processor time, no rule [ms] | all rules [ms] | saved [%] | memory, no rule [MB] | "
      "all "
      "[MB] | start to end of {} frames, no rule [ms] | all [ms] | file [kB] | differences |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n{}\n",
      FEW_FRAMES, scenes);
  for (const RuleDescription& rule : rule_descriptions()) {
    const std::string key(rule.name);
    fmt::print(
        "## {}\n\n{}; saves {}. Pays (more than 1 % of processor time, and in every round) on {} of {} "
        "scenes.\n\n",
        key, rule.effect, rule.saving, pays[key], choice.experiments.size());
    if (!rows[key].empty())
      fmt::print(
          "| scene | processor time without [ms] | with [ms] | saved [%] | memory saved [%] | differences | "
          "why "
          "|\n|---|---|---|---|---|---|---|\n{}\n",
          rows[key]);
    if (!idle[key].empty()) fmt::print("Off: {}.\n\n", idle[key]);
  }
  fmt::print("{}\n", equal ? "Results are the same bits with every rule and without it."
                           : "RESULTS DIFFER: see above.");
  return equal ? 0 : static_cast<int>(ExitCode::CHECK_FAILED);
}

}  // namespace

void add_leave_out(CLI::App& app, Run& chosen) {
  auto* command =
      app.add_subcommand("leave-out", "What each rule of the plan saves, and that it changes no result");
  const auto choice = std::make_shared<LeaveOutChoice>();
  command->option_defaults()->always_capture_default(false);
  command->add_option("EXPERIMENT", choice->experiments, "experiment files")->required();
  command->add_option("--processes", choice->processes, "processes a setting; medians of all")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--frames", choice->frames, "frames of each path; all without it");
  command->callback([choice, &chosen] { chosen.work = [choice] { return compare_rules(*choice); }; });
}

}  // namespace lmdbench::study
