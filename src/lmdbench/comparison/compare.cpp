// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/json_schema.h>
#include <lmdbench/comparison/compare.h>
#include <lmdbench/comparison/comparison_text.h>
#include <lmdbench/comparison/experiment_differences.h>
#include <lmdbench/comparison/stage_times.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>

namespace lmdbench {
namespace {

using Files = std::vector<ResultReader>;

/// Real-time runs differ in every frame, whatever the programs.
void refuse_realtime(const ResultReader& file) {
  if (file.has("/realtime"))
    throw UsageError(file.file().string(), "/realtime", "a run on the clock, no two of which are the same",
                     "compare runs of the driver lockstep; scripts/figures/realtime.py puts runs on the "
                     "clock beside each other");
}

/// @param seen files of both sides by their content
Files open_side(const std::vector<std::filesystem::path>& names, const std::string& side,
                std::map<std::string, std::string>& seen) {
  if (names.empty()) throw UsageError("", "--" + side, "no result file", "give at least one");
  Files files;
  for (const std::filesystem::path& name : names) {
    refuse_sweep(files.emplace_back(name));
    refuse_realtime(files.back());
    const auto [found, fresh] =
        seen.emplace(sha256_of_file(name), fmt::format("{} of --{}", name.string(), side));
    if (!fresh)
      throw UsageError(name.string(), "--" + side, "the same file as " + found->second,
                       "give every process' result once: a copy is no replicate");
  }
  return files;
}

/// Replicates are runs of one program on one experiment: their deterministic part is the same bits.
void check_replicates(const Files& files) {
  for (std::size_t i = 1; i < files.size(); ++i) {
    std::vector<Difference> differences = experiment_differences(files.front(), files[i]);
    if (differences.empty()) differences = scene_differences(files.front(), files[i]);
    if (differences.empty()) differences = exact_differences(files.front(), files[i], {});
    if (!differences.empty())
      throw InputError(files[i].file().string(),
                       differences.front().method + " " + differences.front().dataset,
                       "differs from " + files.front().file().string() + ", so the two are no replicates",
                       "give each side results of one program on one experiment");
  }
}

/// Different settings for the same frames. Results of other frames cannot be compared.
std::vector<Difference> setting_differences(const ResultReader& base, const ResultReader& candidate) {
  std::vector<Difference> differences = experiment_differences(base, candidate);
  const std::vector<std::string> methods = base.groups("/methods");
  const bool in_common = std::any_of(methods.begin(), methods.end(), [&](const std::string& label) {
    return candidate.has("/methods/" + label);
  });
  if (!methods.empty() && !in_common)
    throw UsageError(
        candidate.file().string(), "/methods",
        fmt::format("{} {}: it has no method of the base", DIFFERENT_EXPERIMENTS, base.file().string()),
        "compare results of one experiment file");
  const auto first = std::ranges::find_if(differences, is_of_frames);
  if (first == differences.end()) return differences;
  const std::ptrdiff_t others = std::ranges::count_if(differences, is_of_frames) - 1;
  throw UsageError(
      candidate.file().string(), "",
      fmt::format("{} {}: {}{}", DIFFERENT_EXPERIMENTS, base.file().string(), difference_text(*first),
                  others == 0 ? "" : fmt::format(" (and {} more)", others)),
      "compare results on the same meshes and path; lmdbench report shows any results beside each other");
}

void check_allowed(const std::vector<std::string>& names, const ResultReader& base,
                   const ResultReader& candidate) {
  std::vector<std::string> known = counters_of(base);
  const std::vector<std::string> other = counters_of(candidate);
  known.insert(known.end(), other.begin(), other.end());
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string nearest = nearest_word(name, known);
    throw UsageError("", "--allow", "no counter '" + name + "' in these files",
                     nearest.empty() ? "take a name of the group counters" : "did you mean " + nearest + "?");
  }
}

MachineComparison compare_machines(const Files& base, const Files& candidate) {
  MachineComparison machine;
  machine.base = machine_of(base.front());
  machine.candidate = machine_of(candidate.front());
  machine.build_notes = build_differences(base.front(), candidate.front());
  for (const Files* side : {&base, &candidate}) {
    for (const ResultReader& file : *side) {
      for (const std::string& reason : machine_differences(base.front(), file))
        if (std::find(machine.reasons.begin(), machine.reasons.end(), reason) == machine.reasons.end())
          machine.reasons.push_back(reason);
    }
  }
  machine.comparable = machine.reasons.empty();
  return machine;
}

/// Times to compare: (method, stage) in the order of reports, one value a process on each side.
struct Sample {
  std::string method;
  std::string stage;
  std::vector<double> base;
  std::vector<double> candidate;
};

/// Values of one stage, where every process has it.
std::vector<double> column(const std::vector<StageTimes>& processes, const std::string& method,
                           const std::string& stage) {
  std::vector<double> values;
  for (const StageTimes& process : processes) {
    const auto of_method = process.find(method);
    if (of_method == process.end()) return {};
    const auto of_stage = of_method->second.find(stage);
    if (of_stage == of_method->second.end()) return {};
    values.push_back(of_stage->second);
  }
  return values;
}

std::vector<Sample> stage_samples(const Comparison& comparison) {
  std::vector<Sample> samples;
  for (const auto& [method, times] : comparison.base.front()) {
    for (const TimedStage& stage : stages()) {
      const std::string name(stage.name);
      Sample sample{method, name, column(comparison.base, method, name),
                    column(comparison.candidate, method, name)};
      if (!sample.base.empty() && !sample.candidate.empty()) samples.push_back(std::move(sample));
    }
  }
  return samples;
}

/// Total time of every method over that of the one before it, for each process.
std::vector<Sample> ratio_samples(const Comparison& comparison, const std::vector<std::string>& methods) {
  const auto totals = [](const std::vector<StageTimes>& processes, const std::string& method) {
    std::vector<double> values;
    for (const StageTimes& process : processes) {
      double sum = 0.0;
      for (const auto& [stage, seconds] : process.at(method)) sum += seconds;
      values.push_back(sum);
    }
    return values;
  };
  const auto over = [&](const std::vector<StageTimes>& processes, const std::string& a,
                        const std::string& b) {
    std::vector<double> values = totals(processes, a);
    const std::vector<double> divisors = totals(processes, b);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] /= divisors[i];
    return values;
  };
  std::vector<Sample> samples;
  for (std::size_t i = 1; i < methods.size(); ++i)
    samples.push_back({methods[i] + " / " + methods[i - 1], "all stages",
                       over(comparison.base, methods[i], methods[i - 1]),
                       over(comparison.candidate, methods[i], methods[i - 1])});
  return samples;
}

/// Labels timed in every process, in the order of a result's reports.
std::vector<std::string> common_methods(const Comparison& comparison, const ResultReader& result) {
  std::vector<std::string> methods;
  const auto in_all = [](const std::vector<StageTimes>& processes, const std::string& method) {
    return std::ranges::all_of(processes, [&](const StageTimes& times) { return times.contains(method); });
  };
  for (const std::string& method : result.groups("/methods"))
    if (in_all(comparison.base, method) && in_all(comparison.candidate, method)) methods.push_back(method);
  const auto rank = [&](const std::string& label) {
    return result.integer_attribute("/methods/" + label, "method_order")
        .value_or(std::numeric_limits<std::int64_t>::max());
  };
  std::stable_sort(methods.begin(), methods.end(),
                   [&](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
  return methods;
}

using StagesTimed = std::map<std::string, std::set<std::string>>;

/// Names stages that another process timed and one of these did not: they are not compared.
void note_missing_times(const Files& files, const std::vector<StageTimes>& processes,
                        const StagesTimed& timed, std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (const auto& [method, names] : timed) {
      const std::string group = "/methods/" + method;
      const auto found = processes[i].find(method);
      if (!files[i].has(group)) continue;
      for (const TimedStage& stage : stages()) {
        const std::string name(stage.name);
        if (!names.contains(name) || (found != processes[i].end() && found->second.contains(name))) continue;
        notes.push_back(fmt::format("{}, {}: not compared, {} holds no time in {}/{}", method, name,
                                    files[i].file().string(), group, stage.dataset));
      }
    }
  }
}

/// A file of one repetition has no warm-up: its times are those of a cold process.
bool warm_alike(const Files& base, const Files& candidate, std::vector<std::string>& notes) {
  for (const Files* side : {&base, &candidate})
    for (const ResultReader& file : *side)
      if (warm_up_repetitions(file) != warm_up_repetitions(base.front())) {
        notes.push_back(
            fmt::format("times are not compared: {} leaves out {} repetitions to warm up, {} leaves out {}; "
                        "run both with /driver/repetitions of 2 or more",
                        base.front().file().string(), warm_up_repetitions(base.front()), file.file().string(),
                        warm_up_repetitions(file)));
        return false;
      }
  return true;
}

void compare_times(const Files& base, const Files& candidate, const CompareOptions& options,
                   Comparison& comparison) {
  std::size_t repetitions = measured_repetitions(base.front());
  for (const Files* side : {&base, &candidate})
    for (const ResultReader& file : *side) repetitions = std::min(repetitions, measured_repetitions(file));
  comparison.repetitions = repetitions;
  for (const ResultReader& file : base) comparison.base.push_back(stage_times(file, repetitions));
  for (const ResultReader& file : candidate) comparison.candidate.push_back(stage_times(file, repetitions));
  if (!warm_alike(base, candidate, comparison.notes)) return;
  StagesTimed timed;
  for (const auto* side : {&comparison.base, &comparison.candidate})
    for (const StageTimes& process : *side)
      for (const auto& [method, times] : process)
        for (const auto& [stage, seconds] : times) timed[method].insert(stage);
  note_missing_times(base, comparison.base, timed, comparison.notes);
  note_missing_times(candidate, comparison.candidate, timed, comparison.notes);

  const bool absolute = comparison.machine.comparable;
  const std::vector<Sample> samples =
      absolute ? stage_samples(comparison)
               : ratio_samples(comparison, common_methods(comparison, base.front()));
  const double least_effect =
      absolute ? options.least_effect : std::max(options.least_effect, CROSS_MACHINE_EFFECT);
  // Bonferroni: the chance of a false alarm is shared out among the stages.
  const double error = options.false_alarm / static_cast<double>(std::max<std::size_t>(samples.size(), 1));
  for (const Sample& sample : samples) {
    Timing timing = judge_timing(sample.base, sample.candidate, least_effect, error);
    timing.method = sample.method;
    timing.stage = sample.stage;
    if (!absolute && timing.verdict != Verdict::SAME) timing.verdict = Verdict::UNSURE;
    if (absolute && (timing.verdict == Verdict::SLOWER || timing.verdict == Verdict::FASTER))
      timing.work = work_of_stage(base.front(), candidate.front(), sample.method, sample.stage);
    comparison.timings.push_back(std::move(timing));
  }
}

void note_limits(Comparison& comparison) {
  if (!comparison.machine.comparable)
    comparison.notes.push_back(fmt::format(
        "absolute times are not compared, the machines differ; methods are compared with each other within "
        "each file, changes under {:.0f} % are taken for the machine's, and of larger ones only one machine "
        "can "
        "tell which of the two is slower",
        100.0 * CROSS_MACHINE_EFFECT));
  if (comparison.timings.empty()) {
    if (!comparison.machine.comparable)
      comparison.notes.emplace_back("no time was compared: on two machines that takes two methods");
    return;
  }
  const std::size_t base = comparison.base.size(), candidate = comparison.candidate.size();
  std::size_t needed = 0;
  for (const Timing& timing : comparison.timings)
    needed = std::max(needed, timing.processes_needed.value_or(0));
  if (std::min(base, candidate) == 1) {
    comparison.notes.push_back(fmt::format(
        "one process a side cannot judge times: its frames and repetitions share its luck; give at least {} "
        "files a side "
        "(--base A1.h5 A2.h5... --candidate B1.h5 B2.h5...), or let scripts/ci_regression.sh run them",
        needed));
    return;
  }
  if (needed > 0)
    comparison.notes.push_back(
        fmt::format("unsure at {} and {} processes; with this noise about {} a side would decide", base,
                    candidate, needed));
}

Verdict overall(const Comparison& comparison) {
  if (!comparison.differences.empty()) return Verdict::CHANGED;
  if (comparison.timings.empty()) return Verdict::UNSURE;
  const auto any = [&](Verdict verdict) {
    return std::any_of(comparison.timings.begin(), comparison.timings.end(),
                       [&](const Timing& timing) { return timing.verdict == verdict; });
  };
  for (const Verdict verdict : {Verdict::SLOWER, Verdict::UNSURE, Verdict::FASTER})
    if (any(verdict)) return verdict;
  return Verdict::SAME;
}

}  // namespace

Comparison compare_results(const std::vector<std::filesystem::path>& base_names,
                           const std::vector<std::filesystem::path>& candidate_names,
                           const CompareOptions& options) {
  std::map<std::string, std::string> seen;
  const Files base = open_side(base_names, "base", seen);
  if (base_names.size() == 1 && candidate_names.size() == 1) seen.clear();  // a file with itself
  const Files candidate = open_side(candidate_names, "candidate", seen);
  check_allowed(options.exact.allowed_counters, base.front(), candidate.front());
  check_replicates(base);
  check_replicates(candidate);
  Comparison comparison;
  comparison.machine = compare_machines(base, candidate);
  comparison.differences = setting_differences(base.front(), candidate.front());
  std::vector<Difference> of_scenes = scene_differences(base.front(), candidate.front());
  if (!comparison.differences.empty()) {
    comparison.notes.emplace_back(
        "the experiments differ in the settings named first: what else differs, times included, may come "
        "from them");
    // So do force constants, which are attributes of the group itself.
    std::erase_if(of_scenes, [](const Difference& d) { return d.dataset.starts_with("/scene:"); });
  }
  const bool same_scene = of_scenes.empty();
  std::ranges::move(of_scenes, std::back_inserter(comparison.differences));
  std::ranges::move(exact_differences(base.front(), candidate.front(), options.exact),
                    std::back_inserter(comparison.differences));
  std::string kept;
  for (const Difference& difference : kept_differences(base.front(), candidate.front()))
    kept += (kept.empty() ? "" : "; ") + difference_text(difference);
  if (!kept.empty())
    comparison.notes.push_back("only what both were asked to probe and record is compared: " + kept);
  const ExactOptions& exact = options.exact;
  comparison.agreement = exact.tolerance_relative > 0.0 ? "agree within the tolerance" : "are the same bits";
  if (!exact.allowed_counters.empty()) comparison.agreement += " but for the allowed counters";
  if (!same_true_steps(base.front(), candidate.front()))
    comparison.notes.emplace_back(
        "the true force is known in every frame of one side alone: numbers of its jumps are not compared");
  for (const std::string& name : additions(base.front(), candidate.front()))
    comparison.notes.push_back("only the candidate has " + name);
  if (same_scene) {
    compare_times(base, candidate, options, comparison);
    note_limits(comparison);
  } else {
    comparison.notes.emplace_back("the scenes differ, so times are not compared");
  }
  comparison.verdict = overall(comparison);
  return comparison;
}

int exit_code(Verdict verdict) {
  switch (verdict) {
    case Verdict::SAME:
    case Verdict::FASTER:
      return static_cast<int>(ExitCode::DONE);
    case Verdict::SLOWER:
    case Verdict::CHANGED:
      return static_cast<int>(ExitCode::CHECK_FAILED);
    case Verdict::UNSURE:
      break;
  }
  return static_cast<int>(ExitCode::ENVIRONMENT);
}

}  // namespace lmdbench
