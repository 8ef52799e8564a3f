// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/real_range.h>
#include <lmdbench/comparison/compare.h>
#include <lmdbench/comparison/comparison_text.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

struct CompareArguments {
  std::vector<std::string> files;
  std::vector<std::string> base;
  std::vector<std::string> candidate;
  CompareOptions options;
  bool json = false;
  bool markdown = false;
  std::string junit;
  std::string benchmark;
  std::string benchmark_base;
};

void sort_out_files(CompareArguments& arguments) {
  const bool named = !arguments.base.empty() || !arguments.candidate.empty();
  if (!arguments.files.empty() && (named || arguments.files.size() != 2))
    throw UsageError("", "files", fmt::format("{} without --base and --candidate", arguments.files.size()),
                     "give BASE.h5 CANDIDATE.h5, or --base A.h5... --candidate B.h5...");
  if (arguments.files.size() == 2) {
    arguments.base = {arguments.files[0]};
    arguments.candidate = {arguments.files[1]};
  }
  if (arguments.base.empty() || arguments.candidate.empty())
    throw UsageError("", arguments.base.empty() ? "--base" : "--candidate", "no result file",
                     "give BASE.h5 CANDIDATE.h5, or --base A.h5... --candidate B.h5...");
}

/// Before anything is compared: what is written replaces its own kind alone.
void refuse_unsafe_outputs(const CompareArguments& arguments) {
  std::vector<std::filesystem::path> inputs(arguments.base.begin(), arguments.base.end());
  inputs.insert(inputs.end(), arguments.candidate.begin(), arguments.candidate.end());
  const OutputKind junit{"JUnit report",
                         [](const auto& file) { return file_begins_with(file, JUNIT_BEGINS); }};
  const OutputKind benchmark{"Google Benchmark file",
                             [](const auto& file) { return file_begins_with(file, BENCHMARK_BEGINS); }};
  std::set<std::filesystem::path> outputs;
  const auto check = [&](const std::string& output, const OutputKind& kind, const char* option) {
    if (output.empty()) return;
    refuse_unsafe_output(output, kind, inputs, option);
    if (!outputs.insert(std::filesystem::weakly_canonical(std::filesystem::absolute(output))).second)
      throw UsageError(output, "", "is named for two outputs, of which one would be lost",
                       "give each of --junit, --benchmark and --benchmark-base a file of its own");
  };
  check(arguments.junit, junit, "--junit");
  check(arguments.benchmark, benchmark, "--benchmark");
  check(arguments.benchmark_base, benchmark, "--benchmark-base");
}

int compare(CompareArguments& arguments) {
  sort_out_files(arguments);
  refuse_unsafe_outputs(arguments);
  const Comparison comparison =
      compare_results({arguments.base.begin(), arguments.base.end()},
                      {arguments.candidate.begin(), arguments.candidate.end()}, arguments.options);
  if (!arguments.junit.empty()) write_file_atomically(arguments.junit, comparison_junit(comparison));
  if (!arguments.benchmark.empty())
    write_file_atomically(arguments.benchmark,
                          google_benchmark_json(comparison.candidate, comparison.machine.candidate));
  if (!arguments.benchmark_base.empty())
    write_file_atomically(arguments.benchmark_base,
                          google_benchmark_json(comparison.base, comparison.machine.base));
  if (arguments.json)
    fmt::print("{}\n", comparison_json(comparison));
  else
    fmt::print("{}", arguments.markdown ? comparison_markdown(comparison) : comparison_text(comparison));
  return exit_code(comparison.verdict);
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_status) {
  auto* command = app.add_subcommand("compare",
                                     "Compare results of two builds, or of two settings on the same meshes "
                                     "and path: exactly what is deterministic, "
                                     "statistically what is timed");
  command->footer(
      "Exit code: 0 same or faster, 1 slower, changed or other settings, 2 other meshes or path, 3 no result "
      "file, 4 "
      "unsure (one process a side always is, unless results differ).");
  const auto arguments = std::make_shared<CompareArguments>();
  command->add_option("files", arguments->files, "BASE.h5 CANDIDATE.h5, one process a side");
  command->add_option("--base", arguments->base, "results of the base, one a process");
  command->add_option("--candidate", arguments->candidate, "results of the candidate, one a process");
  command
      ->add_option("--threshold", arguments->options.least_effect,
                   "least relative change of a time that matters")
      ->check(real_range(CLI::Range(0.0001, 10.0)))
      ->capture_default_str();
  command
      ->add_option("--false-alarm", arguments->options.false_alarm,
                   "probability of a false \"slower\" over all stages together")
      ->check(real_range(CLI::Range(1e-6, INTERVAL_ERROR)))
      ->capture_default_str();
  command
      ->add_option("--tolerance", arguments->options.exact.tolerance_relative,
                   "real numbers may differ by this share of their row's largest; 0: the same bits")
      ->check(real_range(CLI::Range(0.0, 1.0)))
      ->capture_default_str();
  command->add_option("--allow", arguments->options.exact.allowed_counters, "counters that may differ");
  auto* json = command->add_flag("--json", arguments->json, "the comparison as JSON");
  command->add_flag("--markdown", arguments->markdown, "as Markdown, for a comment on a change")
      ->excludes(json);
  command->add_option("--junit", arguments->junit, "write a JUnit report to this file, too");
  command->add_option("--benchmark", arguments->benchmark,
                      "write the candidate's times as Google Benchmark JSON to this file, too");
  command->add_option("--benchmark-base", arguments->benchmark_base, "write the base's times likewise");
  command->callback([arguments, &exit_status] { exit_status = compare(*arguments); });
}

}  // namespace lmdbench
