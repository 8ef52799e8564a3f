// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/drivers/run_keeper.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/metrics/errors.h>
#include <lmdbench/metrics/step_numbers.h>
#include <lmdbench/metrics/times.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/probes/truth_probe.h>
#include <lmdbench/result_file/node_watch.h>
#include <lmdbench/result_file/own_result.h>
#include <lmdbench/result_file/provenance.h>
#include <lmdbench/result_file/result_writer.h>
#include <lmdbench/sweep/point_key.h>
#include <lmdbench/sweep/run_sweep.h>
#include <lmdbench/sweep/sweep_parts.h>
#include <lmdbench/sweep/write_sweep.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

/// What points of one scene, path and force share. Made when the first of them has to run.
class SharedScene {
 public:
  SharedScene(const Sweep& sweep, const SweepPoint& point, InputHashes& hashes)
      : run_(prepare(point.experiment, {}, Deforming::FOLLOWED)),
        in_contact_(frames_in_contact(run_.scene(), run_.input.motion, run_.input.poses)),
        hashes_(hashes) {
    hashes_.check(run_);
    const std::int64_t frames = std::ssize(run_.input.poses);
    if (sweep.from_frame + 1 >= frames)  // each counts with its next one
      throw UsageError(sweep.file.string(), "/from_frame",
                       fmt::format("no frame counts: of {} the first {} and the last are left out", frames,
                                   sweep.from_frame),
                       "give more frames, or less: /from_frame is the largest search_latency_frames of all "
                       "series without it");
    for (std::int64_t frame = 0; frame < std::min<std::int64_t>(sweep.from_frame, std::ssize(in_contact_));
         ++frame)
      in_contact_[static_cast<std::size_t>(frame)] = false;
  }

  struct Truth {
    std::unique_ptr<PreparedRun> other;  ///< Unset where truth is of the same meshes.
    TrueSets sets;
  };

  /// True sets of the meshes that the point names for truth.
  const Truth& truth_of(const Sweep& sweep, const SweepPoint& point, const Progress& progress) {
    const std::string key = scene_key(point.truth);
    const auto [entry, is_new] = truths_.try_emplace(key);
    Truth& truth = entry->second;
    if (!is_new) return truth;
    try {
      if (key != scene_key(point.experiment))
        truth.other = std::make_unique<PreparedRun>(prepare(point.truth, {}, Deforming::FOLLOWED));
      if (truth.other) hashes_.check(*truth.other);
      const PreparedRun& run = truth.other ? *truth.other : run_;
      if (run.input.poses.size() != run_.input.poses.size())
        throw UsageError(sweep.file.string(), "/series", "truth has another number of frames than the point",
                         "let truth differ from its series in meshes only");
      truth.sets = true_sets(run, sweep.truth_check_frames, progress);
      // Those that count; each is compared with its next one.
      std::vector<TruthFrame>& frames = truth.sets.frames;
      frames.pop_back();
      frames.erase(frames.begin(), frames.begin() + std::min(sweep.from_frame, std::ssize(frames)));
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

/// Errors of a point, from its first traversal.
PointErrors judge(const MethodRecord& record, const SweepPoint& point, const SharedScene& scene,
                  const SharedScene::Truth& truth) {
  const MethodChoice& choice = point.experiment.methods.front();
  const RunFrames frames{scene.in_contact(), scene.run().input.frame_rate_hz,
                         scene.run().profiles.front().force.maximum_force, contact_ports(scene.run().input)};
  const std::vector<TruthComparison> rows = compare_with_truth(truth.sets.frames, record, choice.force_law,
                                                               truth.other ? nullptr : &scene.run().scene());
  MethodSummary summary;
  summarise_counts(summary, record, frames);
  summarise_rendering(summary, record, frames);
  summarise_errors(summary, choice.force_law, truth.sets.frames, rows, frames);
  if (truth.other) erase_feature_numbers(summary);
  const StepNumbers steps = count_steps(record, choice.force_law, truth.sets.frames, rows, scene.run(),
                                        scene.run_of(truth), scene.in_contact());
  set_jumps(summary, count_events(static_cast<std::int64_t>(steps.jumps),
                                  summary.frames_in_contact / frames.frame_rate_hz));
  // Steps into contact count, too.
  if (const double known = summary.true_jump_frames; known > 0.0)
    set_true_jumps(summary,
                   count_events(static_cast<std::int64_t>(steps.true_jumps), known / frames.frame_rate_hz),
                   static_cast<std::int64_t>(known));
  PointErrors errors;
  add_known(errors.numbers, summary, summary_numbers());
  add_known(errors.numbers, steps, step_numbers());
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

/// A point and repetition still to run.
struct Unit {
  std::size_t point;
  std::int64_t repetition;
};

/// One traversal, as a line of the journal.
Json run_unit(const Sweep& sweep, const Unit& unit, SharedScene& scene, bool by_name,
              const Progress& truth_progress) {
  const SweepPoint& point = sweep.points[unit.point];
  DriverInput input = scene.run().input;
  const bool judged = unit.repetition == 0;
  input.keep_lmds = [judged](std::int64_t) { return judged; };
  const SharedScene::Truth* truth = judged ? &scene.truth_of(sweep, point, truth_progress) : nullptr;
  DriverChoice driver = point.experiment.driver;
  driver.repetitions = 1;
  const NodeWatch watch(by_name);
  std::vector<MethodRecord> records =
      run_lockstep(driven_methods(point.experiment, scene.run()), input, driver, {});
  const MethodRecord& record = records.front();
  PointRun run;
  run.result_hash = fmt::format("{:016x}", record.result_hash);
  run.work_hash = fmt::format("{:016x}", record.work_hash);
  run.times = record.repetitions.front();
  Json line = run.to_json();
  line["where"] = watch.finish();
  if (judged) line["errors"] = judge(record, point, scene, *truth).to_json();
  return line;
}

/// Whether repetitions of a point contradict each other.
bool repetitions_differ(const Journal& journal, const std::string& key, std::int64_t repetitions) {
  const Json* first = nullptr;
  for (std::int64_t repetition = 0; repetition < repetitions; ++repetition) {
    const Json* const entry = journal.find(key, repetition);
    if (entry == nullptr) continue;
    if (first == nullptr) first = entry;
    for (const char* hash : {"result_hash", "work_hash"})
      if (entry->value(hash, Json()) != first->value(hash, Json())) return true;
  }
  return false;
}

/// @throws InputError for a damaged line with the point's key
PointResult finished_point(const SweepPoint& point, const std::string& key, std::int64_t repetitions,
                           const Journal& journal) {
  std::int64_t repetition = 0;
  try {
    const PointErrors errors = PointErrors::from_json(journal.find(key, 0)->at("errors"));
    std::vector<PointRun> runs;
    std::vector<Json> where;
    std::int64_t begun = 0;
    for (; repetition < repetitions; ++repetition) {
      const Json& entry = *journal.find(key, repetition);
      runs.push_back(PointRun::from_json(entry));
      if (!errors.fits(runs.back())) throw std::out_of_range("unlike numbers of frames or searches");
      where.push_back(entry.value("where", Json::object()));
      begun += std::max<std::int64_t>(1, std::ssize(journal.begun(key, repetition)));
    }
    PointResult result = finish_point(errors, runs, point.experiment.frame_rate_hz);
    result.where_json = Json(where).dump();
    result.begun = begun;
    return result;
  } catch (const std::exception& error) {  // of JSON, or numbers that do not fit
    throw InputError(journal.file_of(key, std::min(repetition, repetitions - 1)).string(), "key " + key,
                     std::string("a line is damaged: ") + error.what(), "remove the line and run again");
  }
}

}  // namespace

std::filesystem::path journal_of(const std::filesystem::path& file) {
  return file.string() + ".points.jsonl";
}

bool is_finished(const Journal& journal, const std::string& key, std::int64_t repetitions) {
  for (std::int64_t repetition = 0; repetition < repetitions; ++repetition)
    if (journal.find(key, repetition) == nullptr) return false;
  return !repetitions_differ(journal, key, repetitions);
}

std::vector<std::filesystem::path> inputs_of(const Sweep& sweep) {
  std::vector<std::filesystem::path> inputs{sweep.file};
  for (const SweepPoint& point : sweep.points)
    for (const Experiment* experiment : {&point.experiment, &point.truth})
      for (const std::filesystem::path& input : input_files(*experiment))
        if (std::find(inputs.begin(), inputs.end(), input) == inputs.end()) inputs.push_back(input);
  return inputs;
}

SweepWork run_points(const Sweep& sweep, const std::vector<std::size_t>& points, Journal& journal,
                     InputHashes& hashes, bool by_name, const RunProgress& progress) {
  SweepWork work;
  const std::vector<std::string> keys = point_keys(sweep, hashes);
  std::vector<std::string> scenes;                          // in order of appearance
  std::map<std::string, std::vector<std::size_t>> members;  // points of a scene
  for (const std::size_t i : points) {
    if (repetitions_differ(journal, keys[i], sweep.repetitions)) journal.discard(keys[i]);
    std::vector<std::size_t>& of_scene = members[scene_key(sweep.points[i].experiment)];
    if (of_scene.empty()) scenes.push_back(scene_key(sweep.points[i].experiment));
    of_scene.push_back(i);
  }
  const auto total = std::ssize(points) * sweep.repetitions;
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
          ++work.resumed_runs;
          continue;
        }
        if (work.failures.contains(point)) continue;
        try {
          journal.begin(keys[point], repetition, describe_node(by_name));
          if (!scene) scene = std::make_unique<SharedScene>(sweep, sweep.points[point], hashes);
          Json line = run_unit(sweep, {point, repetition}, *scene, by_name,
                               [&](std::int64_t at, std::int64_t frames) {
                                 return !progress || progress("truth", at, frames);
                               });
          line["key"] = keys[point];
          line["repetition"] = repetition;
          journal.append(std::move(line));
          if (repetitions_differ(journal, keys[point], sweep.repetitions))
            throw InputError("", "", "two repetitions differ in forces, LMDs or counters",
                             "report it: a run depends on something that it must not depend on");
        } catch (const EnvironmentError&) {
          throw;  // a full disk is not the point's fault
        } catch (const InputChanged&) {
          throw;
        } catch (const Error& error) {
          work.failures[point] = error.what();
          journal.fail(keys[point], error.what());
        }
      }
    }
  }
  return work;
}

SweepResult collect_points(const Sweep& sweep, const Journal& journal, InputHashes& hashes) {
  SweepResult result;
  result.clock_overhead_s = clock_overhead();
  result.points.resize(sweep.points.size());
  const std::vector<std::string> keys = point_keys(sweep, hashes);
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const std::string* failure = journal.failure(keys[i]);
    if (is_finished(journal, keys[i], sweep.repetitions))
      result.points[i] = finished_point(sweep.points[i], keys[i], sweep.repetitions, journal);
    else if (failure != nullptr)
      result.points[i].failure = *failure;
    else
      missing.push_back(i);
  }
  if (!missing.empty())
    throw InputError(journal.file().string(), "",
                     fmt::format("{} of {} points are not measured: {}", missing.size(), sweep.points.size(),
                                 point_numbers_text(missing)),
                     "measure them with --points, or leave --collect out and they are measured here");
  result.inputs = hashes.files();
  return result;
}

namespace {

/// @param measure called before the journal is collected
SweepResult sweep_to_file(const Sweep& sweep, const std::filesystem::path& file,
                          const std::vector<std::string>& argv,
                          const std::function<SweepWork(Journal&, InputHashes&)>& measure) {
  const std::vector<std::filesystem::path> inputs = inputs_of(sweep);
  refuse_unsafe_output(file, {.what = "result file", .is_ours = &is_own_result}, inputs, "--out");
  refuse_unsafe_output(journal_of(file), {.what = "journal", .is_ours = &is_own_journal}, inputs, "--out");
  const auto machine = machine_info();  // before the sweep loads it
  ResultWriter writer(file);
  if (RunKeeper::measured_frames(writer.part()) > 0)
    throw EnvironmentError(writer.part().part_name().string(), "", "holds what an interrupted run measured",
                           "go on with it by `lmdbench run --resume`, or remove the file");
  // Once committed, the name may be another run's.
  struct RemovePart {
    PartFile& part;
    ~RemovePart() {
      if (!part.is_removed()) part.remove();
    }
  } remove_part{writer.part()};
  Journal journal = journal_with_parts(journal_of(file), file);
  InputHashes hashes;
  hashes.of(sweep.file);
  const SweepWork work = measure(journal, hashes);
  SweepResult result = collect_points(sweep, journal, hashes);
  result.resumed_runs = work.resumed_runs;
  write_provenance(writer, argv, sweep.resolved_json, "{}", result.inputs, machine);
  write_sweep(writer, sweep, result);
  writer.commit();
  return result;
}

}  // namespace

SweepResult run_sweep_to_file(const Sweep& sweep, const std::filesystem::path& file,
                              const std::vector<std::string>& argv, const RunProgress& progress) {
  return sweep_to_file(sweep, file, argv, [&](Journal& journal, InputHashes& hashes) {
    std::vector<std::size_t> all(sweep.points.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return run_points(sweep, all, journal, hashes, false, progress);
  });
}

SweepResult collect_sweep_to_file(const Sweep& sweep, const std::filesystem::path& file,
                                  const std::vector<std::string>& argv) {
  return sweep_to_file(sweep, file, argv, [](Journal&, InputHashes&) { return SweepWork(); });
}

}  // namespace lmdbench
