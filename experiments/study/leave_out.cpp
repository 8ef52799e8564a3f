// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/temporary_folder.h>
#include <lmdbench/comparison/exact_differences.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/record/result_reader.h>

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
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

/// What each rule of the plan saves, and that it changes no result: every scene is run as a user would run it, in a
/// process of its own, with all rules on auto and with one of them off.
namespace lmdbench::study {
namespace {

struct LeaveOutChoice {
  std::vector<std::string> experiments;
  std::int64_t processes = 3;
};

/// What one process cost.
struct Cost {
  double seconds =
      std::numeric_limits<double>::infinity();  ///< Of the processor; the least of several processes.
  double megabytes = std::numeric_limits<double>::infinity();
  double kilobytes_written = 0.0;
};

std::filesystem::path program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "lmdbench";
}

/// Runs the program in silence.
/// @return its processor time and largest resident memory
rusage run_once(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
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
  return usage;
}

/// @param switches e.g. {"/plan/shared_mesh=off"}
void run_scene(const std::string& experiment, const std::vector<std::string>& switches,
               const std::filesystem::path& out, Cost& cost) {
  std::vector<std::string> arguments{
      program().string(), "run", experiment, "-q", "--out", out.string(), "--set", "/driver/repetitions=1"};
  for (const std::string& entry : switches) arguments.insert(arguments.end(), {"--set", entry});
  const rusage usage = run_once(arguments);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  cost.seconds = std::min(cost.seconds, seconds(usage.ru_utime) + seconds(usage.ru_stime));
  cost.megabytes = std::min(cost.megabytes, static_cast<double>(usage.ru_maxrss) / 1024.0);
  cost.kilobytes_written = static_cast<double>(std::filesystem::file_size(out)) / 1024.0;
}

/// What differs between two results, times apart: names of counters for those, else datasets.
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

int compare_rules(const LeaveOutChoice& choice) {
  const TemporaryFolder folder(std::filesystem::temp_directory_path(), "lmdbench-leave-out-");
  std::map<std::string, std::string> rows;  // by rule
  std::map<std::string, int> pays;
  bool equal = true;
  for (const std::string& experiment : choice.experiments) {
    const std::string name = std::filesystem::path(experiment).stem().string();
    const auto file = [&](std::string_view what) { return folder.path() / fmt::format("{}.h5", what); };
    std::map<std::string, Cost> costs;
    // In turns, so that a busy moment of the machine meets all alike.
    for (std::int64_t process = 0; process < choice.processes; ++process) {
      run_scene(experiment, {}, file("auto"), costs["auto"]);
      for (const RuleDescription& rule : rule_descriptions())
        run_scene(experiment, {fmt::format("/plan/{}=off", rule.name)}, file(rule.name),
                  costs[std::string(rule.name)]);
    }
    const auto plan = nlohmann::json::parse(ResultReader(file("auto")).texts("/provenance/plan").front());
    for (const auto& decision : plan["rules"]) {
      const std::string rule = decision["name"];
      const bool on = decision["on"];
      const Cost& with = costs["auto"];
      const Cost& without = costs[rule];
      const std::set<std::string> changed = differences(file(rule), file("auto"));
      const bool only_counters = std::all_of(changed.begin(), changed.end(), is_counter);
      equal = equal && only_counters;
      const double saved = 1.0 - with.seconds / without.seconds;
      const double saved_memory = 1.0 - with.megabytes / without.megabytes;
      if (on && (saved > 0.03 || saved_memory > 0.03)) ++pays[rule];
      rows[rule] += fmt::format(
          "| {} | {} | {:.0f} | {:.0f} | {:.0f} % | {:.0f} | {:.0f} | {:.0f} / {:.0f} | {} | {} |\n", name,
          on ? "on" : "off", 1e3 * without.seconds, 1e3 * with.seconds, 100.0 * saved, without.megabytes,
          with.megabytes, without.kilobytes_written, with.kilobytes_written,
          changed.empty() ? "none"
          : only_counters ? fmt::format("{} counters", changed.size())
                          : fmt::format("{}", fmt::join(changed, ", ")),
          decision["reason"].get<std::string>());
    }
  }
  fmt::print("# What the rules of the plan leave out\n\n");
  for (const RuleDescription& rule : rule_descriptions()) {
    const std::string key(rule.name);
    fmt::print("## {}\n\n{}; saves {}. Pays (3 % of time or memory) on {} of {} scenes.\n\n", key,
               rule.effect, rule.saving, pays[key], choice.experiments.size());
    fmt::print(
        "| scene | rule | processor time without [ms] | with [ms] | saved | memory without [MB] | with [MB] "
        "| file [kB] | differences | why |\n");
    fmt::print("|---|---|---|---|---|---|---|---|---|---|\n{}\n", rows[key]);
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
  command->add_option("EXPERIMENT", choice->experiments, "experiment files")->required();
  command->add_option("--processes", choice->processes, "processes a setting; the least time counts")
      ->capture_default_str();
  command->callback([choice, &chosen] { chosen = [choice] { return compare_rules(*choice); }; });
}

}  // namespace lmdbench::study
