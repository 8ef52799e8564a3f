// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/experiment/contact.h>
#include <lmdbench/experiment/errors.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/record/own_result.h>
#include <lmdbench/record/provenance.h>
#include <lmdbench/record/result_writer.h>
#include <lmdbench/sweep/run_sweep.h>
#include <lmdbench/sweep/step_numbers.h>
#include <lmdbench/sweep/sweep_truth.h>
#include <lmdbench/sweep/time_numbers.h>
#include <lmdbench/sweep/write_sweep.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

/// What points must share to have one truth and to take turns: all but the method, the driver and the probes.
std::string scene_key(const Experiment& experiment) {
  Json json = Json::parse(experiment.resolved_json);
  for (const char* other :
       {"$schema", "name", "title", "methods", "driver", "probes", "record", "acceptance"})
    json.erase(other);
  json["folder"] = experiment.file.parent_path().string();
  return json.dump();
}

/// An input is not what it was when the sweep began: its points cannot be told apart any more.
class InputChanged : public InputError {
 public:
  explicit InputChanged(const std::filesystem::path& file)
      : InputError(file.string(), "", "has changed since the sweep began",
                   "run the sweep again: points of what it held before are kept and not mixed in") {}
};

/// Content of inputs when the sweep began, each read once.
class InputHashes {
 public:
  std::string of(const std::filesystem::path& file) {
    const auto [entry, is_new] = files_.try_emplace(file.lexically_normal().string());
    std::error_code ignored;
    if (is_new && std::filesystem::exists(file, ignored)) {
      const FileContent content = read_input_file(file, {.what = "file"});
      entry->second = {"sweep", file, content.sha256, static_cast<std::int64_t>(content.bytes.size())};
    }
    return entry->second.sha256;
  }
  /// @throws InputChanged where a run was prepared from other bytes
  void check(const PreparedRun& run) {
    for (const MeshNote& mesh : run.meshes)
      if (mesh.file && of(*mesh.file) != mesh.sha256) throw InputChanged(*mesh.file);
    for (const InputFile& file : run.files)
      if (!file.file.empty() && of(file.file) != file.sha256) throw InputChanged(file.file);
  }
  /// Those that exist, but for the program.
  std::vector<InputFile> files() const {
    std::vector<InputFile> result;
    for (const auto& [name, file] : files_)
      if (!file.sha256.empty() && name != program().string()) result.push_back(file);
    return result;
  }
  static std::filesystem::path program() { return std::filesystem::canonical("/proc/self/exe"); }

 private:
  std::map<std::string, InputFile> files_;
};

/// Names a point by all that its numbers depend on.
std::string point_key(const Sweep& sweep, const SweepPoint& point, InputHashes& hashes) {
  Json json{{"program", hashes.of(InputHashes::program())},
            {"experiment", scene_key(point.experiment)},
            {"method", Json::parse(point.experiment.methods.front().options_json)},
            {"driver", Json::parse(point.experiment.resolved_json)["driver"]},
            {"truth", scene_key(point.truth)},
            {"truth_check_frames", sweep.truth_check_frames},
            {"from_frame", sweep.from_frame},
            {"inputs", Json::array()}};
  for (const Experiment* experiment : {&point.experiment, &point.truth}) {
    for (const std::filesystem::path& file : input_files(*experiment)) {
      const std::string hash = hashes.of(file);
      if (file != experiment->file) json["inputs"].push_back(hash);
    }
  }
  return sha256_of_text(json.dump());
}

/// The points of one scene, path and force, with what they share. Made when the first of them has to run.
class SharedScene {
 public:
  SharedScene(const Sweep& sweep, const SweepPoint& point, InputHashes& hashes)
      : run_(prepare(point.experiment)),
        in_contact_(frames_in_contact(run_.scene(), run_.input.poses)),
        hashes_(hashes) {
    hashes_.check(run_);
    for (std::int64_t frame = 0; frame < std::min<std::int64_t>(sweep.from_frame, std::ssize(in_contact_));
         ++frame)
      in_contact_[static_cast<std::size_t>(frame)] = false;
  }

  struct Truth {
    std::unique_ptr<PreparedRun> other;  ///< Unset where truth is of the same meshes.
    SweepTruth sets;
    std::vector<TruthFrame> frames;
  };

  /// Of the meshes that the point names for it.
  const Truth& truth_of(const Sweep& sweep, const SweepPoint& point, const Progress& progress) {
    const std::string key = scene_key(point.truth);
    const auto [entry, is_new] = truths_.try_emplace(key);
    Truth& truth = entry->second;
    if (!is_new) return truth;
    try {
      if (key != scene_key(point.experiment))
        truth.other = std::make_unique<PreparedRun>(prepare(point.truth));
      if (truth.other) hashes_.check(*truth.other);
      const PreparedRun& run = truth.other ? *truth.other : run_;
      if (run.input.poses.size() != run_.input.poses.size())
        throw UsageError(sweep.file.string(), "/series", "truth has another number of frames than the point",
                         "let truth differ from its series in meshes only");
      truth.sets = true_sets(run, sweep.truth_check_frames, progress);
      truth.frames = truth_frames(truth.sets, run, sweep.from_frame);
    } catch (...) {
      truths_.erase(entry);
      throw;
    }
    return truth;
  }

  const PreparedRun& run() const { return run_; }
  const PreparedRun& run_of(const Truth& truth) const { return truth.other ? *truth.other : run_; }
  const std::vector<bool>& in_contact() const { return in_contact_; }

 private:
  PreparedRun run_;
  std::vector<bool> in_contact_;
  InputHashes& hashes_;
  std::map<std::string, Truth> truths_;
};

void erase_feature_numbers(MethodSummary& summary) {
  for (double MethodSummary::*number :
       {&MethodSummary::recall, &MethodSummary::recall_adjacent, &MethodSummary::precision,
        &MethodSummary::precision_adjacent, &MethodSummary::frames_wrong})
    summary.*number = UNSET;
}

std::map<std::string, std::int64_t> summed_counters(const MethodRecord& record,
                                                    const MethodDescription& method) {
  WorkCounters sum;
  for (const FrameRecord& frame : record.frames) sum += frame.counters;
  for (const SearchRecord& search : record.searches) sum += search.counters;
  std::map<std::string, std::int64_t> counters;
  for (const CounterDescription& counter : method.counters)
    counters[counter.name] = static_cast<std::int64_t>(sum.values[counter.index]);
  return counters;
}

/// What the first traversal of a path by a point is worth.
PointErrors judge(const MethodRecord& record, const SweepPoint& point, const SharedScene& scene,
                  const SharedScene::Truth& truth) {
  const MethodChoice& choice = point.experiment.methods.front();
  const RunFrames frames{scene.in_contact(), scene.run().input.frame_rate_hz,
                         scene.run().profiles.front().force.maximum_force};
  const std::vector<TruthComparison> rows =
      compare_with_truth(truth.frames, record, choice.force_law, scene.run_of(truth).scene());
  MethodSummary summary;
  summarise_counts(summary, record, frames);
  summarise_errors(summary, choice.force_law, truth.frames, rows, frames);
  if (truth.other) erase_feature_numbers(summary);
  const StepNumbers steps = count_steps(record, choice.force_law, truth.frames, rows, scene.run(),
                                        scene.run_of(truth), scene.in_contact());
  const auto events = [&](double count) {
    return count_events(static_cast<std::int64_t>(count), steps.seconds_in_contact);
  };
  set_jumps(summary, events(steps.jumps));
  set_true_jumps(summary, events(steps.true_jumps),
                 std::count(frames.in_contact.begin(), frames.in_contact.end(), true));
  PointErrors errors;
  for (const SummaryNumber& number : summary_numbers())
    if (const double value = summary.*number.value; !std::isnan(value))
      errors.numbers[std::string(number.name)] = value;
  for (const StepNumber& number : step_numbers())
    if (const double value = steps.*number.value; !std::isnan(value))
      errors.numbers[std::string(number.name)] = value;
  errors.counters = summed_counters(record, method_description(choice.name));
  errors.counts = scene.in_contact();
  for (const FrameRecord& frame : record.frames) {
    errors.tracked.push_back(frame.tracked_count);
    errors.force.push_back(frame.force.norm());
  }
  for (const SearchRecord& search : record.searches) errors.search_frames.push_back(search.frame);
  errors.truth_checked_frames = truth.sets.checked_frames;
  errors.truth_wrong_frames = truth.sets.wrong_frames;
  return errors;
}

/// A point and repetition that is still to be run.
struct Unit {
  std::size_t point;
  std::int64_t repetition;
};

/// One traversal, as a line of the journal.
Json run_unit(const Sweep& sweep, const Unit& unit, SharedScene& scene, const Progress& truth_progress) {
  const SweepPoint& point = sweep.points[unit.point];
  LockstepInput input = scene.run().input;
  const bool judged = unit.repetition == 0;
  input.keep_lmds = [judged](std::int64_t) { return judged; };
  const SharedScene::Truth* truth = judged ? &scene.truth_of(sweep, point, truth_progress) : nullptr;
  DriverChoice driver = point.experiment.driver;
  driver.repetitions = 1;
  std::vector<MethodRecord> records =
      run_lockstep(lockstep_methods(point.experiment, scene.run()), input, driver, {});
  const MethodRecord& record = records.front();
  PointRun run;
  run.result_hash = fmt::format("{:016x}", record.result_hash);
  run.work_hash = fmt::format("{:016x}", record.work_hash);
  run.times = record.repetitions.front();
  Json line = run.to_json();
  if (judged) line["errors"] = judge(record, point, scene, *truth).to_json();
  return line;
}

/// @throws InputError for a line that is none of ours although its key is
PointResult finished_point(const SweepPoint& point, const std::string& key, std::int64_t repetitions,
                           const Journal& journal) {
  try {
    const PointErrors errors = PointErrors::from_json(journal.find(key, 0)->at("errors"));
    std::vector<PointRun> runs;
    for (std::int64_t repetition = 0; repetition < repetitions; ++repetition) {
      runs.push_back(PointRun::from_json(*journal.find(key, repetition)));
      if (!errors.fits(runs.back())) throw std::out_of_range("unlike numbers of frames or searches");
    }
    return finish_point(errors, runs, point.experiment.frame_rate_hz);
  } catch (const std::exception& error) {  // of the JSON library, or numbers that do not fit
    throw InputError(journal.file().string(), "key " + key, std::string("a line is damaged: ") + error.what(),
                     "remove the file and run again");
  }
}

}  // namespace

std::filesystem::path journal_of(const std::filesystem::path& file) {
  return file.string() + ".points.jsonl";
}

SweepResult run_sweep(const Sweep& sweep, Journal& journal, const RunProgress& progress) {
  SweepResult result;
  result.points.resize(sweep.points.size());
  result.clock_overhead_s = clock_overhead();
  InputHashes hashes;
  hashes.of(sweep.file);
  std::vector<std::string> keys;
  std::vector<std::string> scenes;                          // in order of appearance
  std::map<std::string, std::vector<std::size_t>> members;  // points of a scene
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    keys.push_back(point_key(sweep, sweep.points[i], hashes));
    std::vector<std::size_t>& points = members[scene_key(sweep.points[i].experiment)];
    if (points.empty()) scenes.push_back(scene_key(sweep.points[i].experiment));
    points.push_back(i);
  }
  const auto total = std::ssize(sweep.points) * sweep.repetitions;
  std::int64_t done = 0;
  std::mt19937 shuffled(0);
  for (const std::string& key : scenes) {
    std::unique_ptr<SharedScene> scene;
    std::vector<std::size_t> order = members[key];
    for (std::int64_t repetition = 0; repetition < sweep.repetitions; ++repetition) {
      std::shuffle(order.begin(), order.end(), shuffled);
      for (const std::size_t point : order) {
        if (progress && !progress("points", done++, total)) throw Interrupted();
        if (journal.find(keys[point], repetition) != nullptr) {
          ++result.resumed_runs;
          continue;
        }
        if (!result.points[point].failure.empty()) continue;
        try {
          if (!scene) scene = std::make_unique<SharedScene>(sweep, sweep.points[point], hashes);
          Json line = run_unit(sweep, {point, repetition}, *scene, [&](std::int64_t at, std::int64_t frames) {
            return !progress || progress("truth", at, frames);
          });
          line["key"] = keys[point];
          line["repetition"] = repetition;
          journal.append(std::move(line));
        } catch (const EnvironmentError&) {
          throw;  // a full disk is no property of a point
        } catch (const InputChanged&) {
          throw;
        } catch (const Error& error) {
          result.points[point].failure = error.what();
        }
      }
    }
  }
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
    if (result.points[i].failure.empty())
      result.points[i] = finished_point(sweep.points[i], keys[i], sweep.repetitions, journal);
  result.inputs = hashes.files();
  return result;
}

SweepResult run_sweep_to_file(const Sweep& sweep, const std::filesystem::path& file,
                              const std::vector<std::string>& argv, const RunProgress& progress) {
  std::vector<std::filesystem::path> inputs{sweep.file};
  for (const SweepPoint& point : sweep.points)
    for (const Experiment* experiment : {&point.experiment, &point.truth})
      for (const std::filesystem::path& input : input_files(*experiment))
        if (std::find(inputs.begin(), inputs.end(), input) == inputs.end()) inputs.push_back(input);
  refuse_unsafe_output(file, {.what = "result file", .is_ours = &is_own_result}, inputs, "--out");
  refuse_unsafe_output(journal_of(file), {.what = "journal", .is_ours = &is_own_journal}, inputs, "--out");
  ResultWriter writer(file);
  struct RemovePart {
    std::filesystem::path part;
    ~RemovePart() {
      std::error_code ignored;
      std::filesystem::remove(part, ignored);
    }
  } remove_part{file.string() + ".part"};
  Journal journal(journal_of(file));
  SweepResult result = run_sweep(sweep, journal, progress);
  write_provenance(writer, argv, sweep.resolved_json, "{}", result.inputs);
  write_sweep(writer, sweep, result);
  writer.commit();
  return result;
}

}  // namespace lmdbench
