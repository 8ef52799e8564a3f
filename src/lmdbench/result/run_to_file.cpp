// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/result/write_result.h>
#include <lmdbench/result_file/own_result.h>
#include <lmdbench/result_file/provenance.h>
#include <lmdbench/result_file/result_writer.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using Machine = std::vector<std::pair<std::string, std::string>>;

/// Hash of all that decides a run's results and times: the program's bytes, too, as a version says
/// nothing of local changes.
std::string fingerprint_of(const Experiment& experiment, const PreparedRun& prepared,
                           const Machine& machine) {
  std::string text = version_text() + "\n" + program_sha256() + "\n" + experiment.resolved_json;
  for (const auto& [name, value] : machine)
    if (name.starts_with("processor")) text += "\n" + value;
  for (const InputFile& file : prepared.files) text += "\n" + file.sha256;
  for (const MeshNote& mesh : prepared.meshes) text += "\n" + mesh.sha256;
  return sha256_of_text(text);
}

}  // namespace

RunResult run_experiment_to_file(const Experiment& experiment, const std::filesystem::path& file,
                                 const std::vector<std::string>& argv, const RunProgress& progress,
                                 Leftover leftover) {
  refuse_unsafe_output(file, {.what = "result file", .is_ours = &is_own_result}, input_files(experiment),
                       "--out");
  const Machine machine = machine_info();  // before the run loads it
  ResultWriter writer(file);
  PartFile& part = writer.part();
  if (leftover == Leftover::REFUSE && RunKeeper::measured_frames(part) > 0)
    throw EnvironmentError(part.part_name().string(), "", "holds what an interrupted run measured",
                           experiment.realtime
                               ? "a run on the clock cannot be taken up again: remove the file"
                               : "go on with it by --resume, or remove the file to start again");
  if (leftover == Leftover::RESUME && experiment.realtime)
    throw UsageError(experiment.file.string(), "/driver/kind", "a run on the clock cannot be taken up again",
                     "run it without --resume");
  RunKeeper::prepare(part);
  // A run that ends before it measured anything leaves no file.
  struct RemoveEmptyPart {
    PartFile& part;
    ~RemoveEmptyPart() {
      try {
        if (!part.is_removed() && RunKeeper::measured_frames(part) == 0) part.remove();
      } catch (const Error&) {
        // An unreadable part is left for the user.
      }
    }
  } remove_empty_part{part};
  // Relative to the result, so both folders can move together. Empty without a working folder.
  std::error_code none;
  const std::filesystem::path run_folder = std::filesystem::relative(
      std::filesystem::current_path(none), std::filesystem::absolute(file, none).parent_path(), none);
  const auto write_head = [&](ResultWriter& to, const RunResult& result) {
    write_provenance(to, argv, experiment.resolved_json, plan_json(result.plan, experiment),
                     result.prepared.files, machine);
    // Names in the experiment are relative to its folder, its own and the inputs' to the run's.
    to.attribute("/provenance", "experiment_file", experiment.file.string());
    to.attribute("/provenance", "run_folder", run_folder.generic_string());
  };
  const auto make_keeper = [&](const RunResult& result, std::int64_t frames) {
    const auto write = [&](ResultWriter& to) {
      write_head(to, result);
      write_path(to, result);
    };
    return std::make_unique<RunKeeper>(part, experiment, frames,
                                       fingerprint_of(experiment, result.prepared, machine), write);
  };
  RunResult result = run_experiment(experiment, progress, make_keeper);
  write_head(writer, result);
  writer.attribute("/provenance", "resumed_frames", result.resumed_frames);
  write_result(writer, experiment, result);
  writer.commit();
  return result;
}

}  // namespace lmdbench
