// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>

#include <CLI/CLI.hpp>
#include <benchmarks/global_search/implementation.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/pieces.h>
#include <study/studies.h>
#include <support/poses.h>
#include <support/program.h>
#include <support/timing.h>

#include <functional>
#include <memory>

/// Times all implementations of the task "global search" at the same poses, interleaved pose by
/// pose, and reports each one's error beside its time. The row of cold caches comes behind all
/// others: filling the caches among them would cost each its own data, the next one most. Exit code
/// 1 when one breaks its promise.
namespace lmdbench::experiments {
namespace {

struct ComparisonChoice : StudyChoice {
  ComparisonChoice() { poses = 40; }
  std::size_t repetitions = 9;
  std::string path;
  std::size_t first_frame = 0;
  bool slow = false;
};

struct Row {
  std::string name;
  LmdError error;
  double median_ms = 0.0, p99_ms = 0.0, ratio_to_fcl = 0.0;
};

/// The caches before a run: data of the task before it, its own of another pose, or unrelated data.
struct Caches {
  const char* name;
  std::function<void(GlobalSearch&, std::size_t pose)> prepare;
  bool is_cold = false;
};

/// What is timed together, a task a row.
struct Interleaved {
  std::vector<Row> rows;
  std::vector<TimedTask> tasks;
};

std::vector<Caches> caches_of(const SearchImplementation& implementation, const std::vector<Pose>& poses) {
  std::vector<Caches> all{{"", {}}};
  if (implementation.name != "certified-from-scratch") return all;
  all.push_back({", own caches", [&poses](GlobalSearch& search, std::size_t pose) {
                   search.run(poses[(pose + 1) % poses.size()]);
                 }});
  all.push_back({", cold caches", [](GlobalSearch&, std::size_t) { fill_caches(); }, true});
  return all;
}

std::vector<Row> measure(const Scene& scene, const std::vector<Pose>& poses, const ComparisonChoice& choice) {
  const Truth truth = exhaustive_truth(scene, poses);
  Interleaved warm, cold;
  std::vector<std::unique_ptr<GlobalSearch>> searches;
  for (const SearchImplementation& implementation : search_implementations()) {
    if (implementation.slow && !choice.slow) continue;
    searches.push_back(implementation.make(scene));
    GlobalSearch* search = searches.back().get();
    const LmdError error = check_search(implementation, *search, scene, poses, truth);
    for (const Caches& caches : caches_of(implementation, poses)) {
      auto& [rows, tasks] = caches.is_cold ? cold : warm;
      rows.push_back({implementation.name + caches.name, error});
      TimedTask& task = tasks.emplace_back();
      task.name = rows.back().name;
      task.run = [search, &poses](std::size_t pose) { search->run(poses[pose]); };
      if (caches.prepare)
        task.prepare = [search, prepare = caches.prepare](std::size_t pose) { prepare(*search, pose); };
    }
  }
  std::vector<Row> all;
  double fcl_ms = 0.0;
  for (auto* together : {&warm, &cold}) {
    const auto seconds = time_interleaved(together->tasks, poses.size(), choice.repetitions);
    for (std::size_t i = 0; i < seconds.size(); ++i) {
      Row& row = all.emplace_back(together->rows[i]);
      row.median_ms = 1e3 * median(seconds[i]);
      row.p99_ms = 1e3 * quantile(seconds[i], P99);
      if (row.name == "fcl-cold") fcl_ms = row.median_ms;
    }
  }
  for (Row& row : all) row.ratio_to_fcl = fcl_ms / row.median_ms;
  return all;
}

void print(const std::vector<Row>& rows, double cutoff) {
  fmt::print("\nCutoff {:g} % of the diagonal\n\n", 100.0 * cutoff);
  fmt::print(
      "| implementation | median [ms] | p99 [ms] | FCL cold / this | recall | recall, adjacent | precision | "
      "precision, adjacent | minimum missed | worst minimum error |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    const auto share = [&](double value) {
      return row.error.same.true_lmds > 0 ? fmt::format("{:.4f}", value) : "-";
    };
    fmt::print(
        "| {} | {:.4f} | {:.4f} | {:.2f} | {} | {} | {} | {} | {} | {:.2g} |{}\n", row.name, row.median_ms,
        row.p99_ms, row.ratio_to_fcl, share(row.error.same.recall()), share(row.error.neighbours.recall()),
        share(row.error.same.precision()), share(row.error.neighbours.precision()), row.error.minimum_missed,
        row.error.worst_minimum_error, row.error.objection.empty() ? "" : " WRONG: " + row.error.objection);
  }
}

nlohmann::json to_json(const Row& row) {
  return {{"name", row.name},
          {"median_ms", row.median_ms},
          {"p99_ms", row.p99_ms},
          {"fcl_cold_ratio", row.ratio_to_fcl},
          {"set", error_json(row.error.same, row.error.neighbours)},
          {"minimum_missed", row.error.minimum_missed},
          {"worst_minimum_error", row.error.worst_minimum_error},
          {"objection", row.error.objection}};
}

std::vector<Pose> comparison_poses(const Scene& scene, const ComparisonChoice& choice) {
  if (!choice.path.empty()) return path_poses(choice.path, choice.first_frame, choice.poses);
  return grazing_poses(*scene.moving, *scene.fixed.at(0), choice.scene.gap * choice.scene.diagonal,
                       choice.poses, choice.seed);
}

std::string describe_poses(const ComparisonChoice& choice) {
  if (!choice.path.empty())
    return fmt::format("{} frames of {} from frame {}", choice.poses, choice.path, choice.first_frame);
  return fmt::format("{} random poses at gap {:g} % of the diagonal, seed {}", choice.poses,
                     100.0 * choice.scene.gap, choice.seed);
}

int compare_times(const ComparisonChoice& choice) {
  Scene scene = load_scene(choice.scene);
  const std::vector<Pose> poses = comparison_poses(scene, choice);
  fmt::print("{} on {}, diagonal {:g} m: {}; median of {} runs a pose, one thread's processor time\n",
             choice.scene.moving, choice.scene.fixed, choice.scene.diagonal, describe_poses(choice),
             choice.repetitions);
  nlohmann::json report = {{"moving", choice.scene.moving},       {"fixed", choice.scene.fixed},
                           {"diagonal_m", choice.scene.diagonal}, {"poses", describe_poses(choice)},
                           {"pose_count", poses.size()},          {"repetitions", choice.repetitions}};
  bool kept_promises = true;
  for (const double cutoff : choice.cutoffs) {
    scene.cutoff = cutoff * choice.scene.diagonal;
    const std::vector<Row> rows = measure(scene, poses, choice);
    print(rows, cutoff);
    nlohmann::json entry = {{"cutoff", cutoff}};
    for (const Row& row : rows) {
      entry["implementations"].push_back(to_json(row));
      kept_promises = kept_promises && row.error.objection.empty();
    }
    report["cutoffs"].push_back(entry);
  }
  write_report(choice.json, report);
  return kept_promises ? 0 : 1;
}

}  // namespace
}  // namespace lmdbench::experiments

void lmdbench::study::add_compare(CLI::App& app, Run& chosen) {
  CLI::App* command =
      app.add_subcommand("compare", "Interleaved comparison of global searches, error beside time");
  const auto choice = std::make_shared<experiments::ComparisonChoice>();
  experiments::add_mesh_options(*command, choice->scene);
  experiments::add_study_options(*command, *choice);
  command->add_option("--repetitions", choice->repetitions, "Timed runs a pose");
  command->add_option("--path", choice->path,
                      "Recorded path (TUM) instead of random poses: consecutive frames at 1 kHz");
  command->add_option("--first-frame", choice->first_frame, "First frame of the path");
  command->add_flag("--slow", choice->slow, "Time slow implementations too");
  command->callback([&chosen, command, choice] {
    chosen.work = [choice] { return experiments::compare_times(*choice); };
    chosen.pieces = [command, choice] { return pieces_by(*command, {{"--cutoff", texts(choice->cutoffs)}}); };
  });
}
