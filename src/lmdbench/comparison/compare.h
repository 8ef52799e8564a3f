// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/exact_differences.h>
#include <lmdbench/comparison/stage_times.h>
#include <lmdbench/comparison/timing_verdict.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// Compares the results of two builds on one experiment, or of two settings of it: first the exact
/// part, then times.
namespace lmdbench {

struct CompareOptions {
  ExactOptions exact;
  double least_effect = 0.05;  ///< Relative change of a time that matters
  double false_alarm = 0.01;   ///< Probability of any false "slower" over all stages and methods
};

/// Facts about the machines and builds behind the two sides.
struct MachineComparison {
  bool comparable = true;                ///< Whether absolute times were compared
  std::vector<std::string> reasons;      ///< Why not
  std::vector<std::string> build_notes;  ///< Compiler, flags, libraries that differ
  std::vector<std::pair<std::string, std::string>> base;
  std::vector<std::pair<std::string, std::string>> candidate;
};

struct Comparison {
  Verdict verdict = Verdict::UNSURE;  ///< The worst of all: changed, slower, unsure, faster, same
  std::vector<Difference> differences;
  std::string agreement = "are the same bits";  ///< What results do that do not differ
  std::vector<Timing> timings;                  ///< By method, then in the order of `stages()`
  MachineComparison machine;
  std::vector<std::string> notes;  ///< Plain sentences that a reader must know
  std::size_t repetitions = 0;     ///< Measured repetitions used of every process
  std::vector<StageTimes> base;    ///< One a process
  std::vector<StageTimes> candidate;
};

/// Compares results; several files a side are replicates by process. Times are compared by stage
/// and method if the machines are alike; else the times of methods relative to each other within
/// every file, with a least effect of at least CROSS_MACHINE_EFFECT: same, or unsure, since a ratio
/// that moved does not say which of the two did. Experiments with the same frames but other
/// settings (force, methods, searches) are `changed`, settings first. Where one experiment made
/// different scenes, that is `changed`, and no times are compared; nor are they between files that
/// warm up and files that do not.
/// @throws InputError  when a file is no result, or replicates of one side have different results
/// @throws UsageError when a side has no file or a sweep's file, if several files are not all
///   different, if the sides' frames or inputs differ (DIFFERENT_EXPERIMENTS), or for an unknown
///   allowed counter
Comparison compare_results(const std::vector<std::filesystem::path>& base,
                           const std::vector<std::filesystem::path>& candidate,
                           const CompareOptions& options);

/// Start of a refusal of different experiments; the regression gate recognises it by this.
inline constexpr const char* DIFFERENT_EXPERIMENTS = "is of another experiment than";

/// Caches and vector units alone change methods' relative speeds by this much. Our estimate, to
/// keep a change of machine from looking like one of the program.
inline constexpr double CROSS_MACHINE_EFFECT = 0.5;

/// 0 for same and faster, 1 for slower and changed, 4 for unsure.
int exit_code(Verdict verdict);

}  // namespace lmdbench
