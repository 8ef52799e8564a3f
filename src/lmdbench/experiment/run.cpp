// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/output_guard.h>
#include <lmdbench/experiment/contact.h>
#include <lmdbench/experiment/run.h>
#include <lmdbench/experiment/write_result.h>
#include <lmdbench/record/own_result.h>
#include <lmdbench/record/provenance.h>
#include <lmdbench/record/result_writer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <system_error>
#include <utility>

namespace lmdbench {
namespace {

/// What the run itself found out that a reader must know.
void note_findings(const Experiment& experiment, RunResult& result) {
  std::map<std::string, std::ptrdiff_t>
      in_contact;  // by label: notes must not depend on the order of methods
  for (const MethodRecord& record : result.records)
    in_contact[record.label] =
        std::count_if(record.frames.begin(), record.frames.end(),
                      [](const FrameRecord& frame) { return frame.contact_without_direction > 0; });
  for (const auto& [label, count] : in_contact) {
    if (count > 0)
      result.warnings.push_back(
          fmt::format("{}: touching triangles in {} of {} frames; there an LMD keeps its last direction",
                      label, count, result.prepared.times.size()));
  }
  if (experiment.driver.repetitions == 1)
    result.warnings.push_back("a single repetition: its times include the warm-up");
  if (result.fcl) {
    std::map<std::string, std::int64_t> exceptions;
    for (const FclException& exception : result.fcl->exceptions) ++exceptions[exception.who];
    for (const auto& [who, count] : exceptions)
      result.warnings.push_back(
          fmt::format("{}: minimum distance differs from FCL's in {} of {} frames, listed in "
                      "/crosscheck/fcl/exceptions",
                      who, count, result.fcl->frames.size()));
  }
}

}  // namespace

RunResult run_experiment(const Experiment& experiment, const RunProgress& progress) {
  const auto phase = [&](const std::string& name) -> Progress {
    if (!progress) return {};
    return [&progress, name](std::int64_t done, std::int64_t total) { return progress(name, done, total); };
  };
  RunResult result{make_plan(experiment), prepare(experiment), {}, {}, {}, {}, {}, {}, std::nullopt, {}};
  PreparedRun& prepared = result.prepared;
  result.in_contact = frames_in_contact(prepared.scene, prepared.input.poses);
  result.warnings = prepared.warnings;
  const auto frame_count = static_cast<std::int64_t>(prepared.input.poses.size());
  const std::vector<LockstepMethod> methods = lockstep_methods(experiment, prepared);

  const std::vector<std::int64_t> truth_frames =
      probed_frames(frame_count, experiment.truth_stride_frames, experiment.driver.search_latency_frames);
  if (result.plan.needs(Part::LMD_LISTS)) {
    prepared.input.keep_lmds = [](std::int64_t) { return true; };
  } else {
    const std::set<std::int64_t> kept(truth_frames.begin(), truth_frames.end());
    prepared.input.keep_lmds = [kept](std::int64_t frame) { return kept.count(frame) > 0; };
  }
  result.records = run_lockstep(methods, prepared.input, experiment.driver, phase("run"));
  if (experiment.loop.closed)
    for (const MethodRecord& record : result.records)
      result.in_contact_of_device.push_back(frames_in_contact(prepared.scene, record.poses));

  if (result.plan.needs(Part::TRUTH_PROBE)) {
    if (experiment.loop.closed) {
      for (const MethodRecord& record : result.records) {
        LockstepInput replay = prepared.input;
        replay.poses = record.poses;
        replay.make_poses = nullptr;
        result.truth_of_device.push_back(
            probe_truth(prepared.scene, replay, prepared.profile, truth_frames, phase("truth")));
      }
    } else {
      result.truth =
          probe_truth(prepared.scene, prepared.input, prepared.profile, truth_frames, phase("truth"));
    }
    for (std::size_t i = 0; i < methods.size(); ++i)
      result.comparisons.push_back(
          compare_with_truth(result.truth_of(i), result.records[i], methods[i].profile.law, prepared.scene));
  }
  if (result.plan.needs(Part::FCL))
    result.fcl = probe_fcl(prepared.scene, prepared.input, methods,
                           probed_frames(frame_count, experiment.fcl_stride_frames),
                           experiment.fcl_tolerance_relative, phase("fcl"));
  note_findings(experiment, result);
  return result;
}

RunResult run_experiment_to_file(const Experiment& experiment, const std::filesystem::path& file,
                                 const std::vector<std::string>& argv, const RunProgress& progress) {
  refuse_unsafe_output(file, {.what = "result file", .is_ours = &is_own_result}, input_files(experiment),
                       "--out");
  ResultWriter writer(file);
  // The data goes to disk after the run, so what an aborted run leaves there holds nothing worth keeping.
  // Declared after the writer: the file of another run with the same output, which the writer refuses, must
  // not be removed.
  struct RemovePart {
    std::filesystem::path part;
    ~RemovePart() {
      std::error_code ignored;
      std::filesystem::remove(part, ignored);
    }
  } remove_part{file.string() + ".part"};
  RunResult result = run_experiment(experiment, progress);
  write_provenance(writer, argv, experiment.resolved_json, plan_json(result.plan, experiment),
                   result.prepared.files);
  // Relative names of the experiment are relative to its folder.
  writer.attribute("/provenance", "experiment_file", experiment.file.string());
  write_result(writer, experiment, result);
  writer.commit();
  return result;
}

}  // namespace lmdbench
