// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/compare.h>

#include <string>
#include <string_view>

namespace lmdbench {

/// {"verdict": "same|faster|slower|changed|unsure",
///  "differences": [{"method", "dataset", "frame", "base", "candidate"}],
///  "timings": [{"method", "stage", "ratio", "low", "high", "verdict", "detectable",
///               "processes_needed"}],
///  "machine": {"comparable", "reasons", "build_notes", "base", "candidate"}, "notes": ["..."]}
/// "method" is null for data of no method, "frame" where a whole dataset differs,
/// "processes_needed" where sure; NaN is null.
std::string comparison_json(const Comparison& comparison);

/// One side's times in Google Benchmark's format (compare.py of libbenchmark-tools, Bencher,
/// github-action-benchmark): a benchmark a method and stage, a repetition a process, real time [ns]
/// @param machine facts of the side, for the context
std::string google_benchmark_json(const std::vector<StageTimes>& processes,
                                  const std::vector<std::pair<std::string, std::string>>& machine);

/// JUnit XML for CI servers: a test case a method and stage and one for the exact part. Slower and
/// changed are failures, unsure is skipped, each with its reasons; so is "times" where none was
/// compared.
std::string comparison_junit(const Comparison& comparison);

/// How both begin: what they may replace.
inline constexpr std::string_view BENCHMARK_BEGINS = "{\n  \"context\": {\n    \"executable\": \"lmdbench\"";
inline constexpr std::string_view JUNIT_BEGINS =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"lmdbench compare\"";

/// For people, as plain text; the first line is the verdict.
std::string comparison_text(const Comparison& comparison);

/// The same as Markdown, for a comment on a change.
std::string comparison_markdown(const Comparison& comparison);

/// "improved: force differs in frame 12 (and 3 more rows): [0,0,1.5] became [0,0,1.25]"
std::string difference_text(const Difference& difference);
/// "improved, search: 1.104 times the base's time (1.087 to 1.121), slower; the same work: ..."
std::string timing_text(const Timing& timing);

}  // namespace lmdbench
