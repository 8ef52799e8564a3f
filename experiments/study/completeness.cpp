// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/motion/tum_file.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/completeness/far_scenes.h>
#include <study/completeness/parts_study.h>
#include <study/completeness/rounded_plates.h>
#include <study/completeness/study.h>
#include <study/pieces.h>
#include <study/studies.h>
#include <support/context.h>
#include <support/poses.h>
#include <support/program.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

/// Is `certified` complete and exact? Its LMDs, distances and points are compared with `exhaustive`
/// at random grazing poses of many mesh pairs, and frame coherence with searches from scratch along
/// recorded paths. Markdown on standard output, JSON in a file. Exit code 1 when anything was
/// wrong. Each wrong pose is printed as a TUM line for `--poses-file`, of flat shapes as a line for
/// completeness/tests/parts_study_test.cpp. The generator of `parts` (CLEAR_SHAPES) makes the flat
/// shapes: one seed gives other poses than in tables made before 2026-11-25.
namespace lmdbench::completeness {
namespace {

/// Detailed scans, CAD, holes, few and large triangles, parallel faces, extreme shapes; every mesh
/// of the manifest that is no variant of another one appears.
const std::vector<std::string> DEFAULT_PAIRS = {"bunny-5k:bunny-5k",
                                                "bunny-10k:bunny-5k",
                                                "bunny-16k:bunny-16k",
                                                "bunny-5k:bunny-40k",
                                                "bunny-75k:bunny-5k",
                                                "armadillo:bunny-5k",
                                                "chinese-dragon:bunny-5k",
                                                "camel:bunny-5k",
                                                "fandisk:bunny-5k",
                                                "fandisk:fandisk",
                                                "elephant-with-holes:bunny-5k",
                                                "elephant-with-holes:patch",
                                                "box:box",
                                                "box:bunny-5k",
                                                "unequal:bunny-5k",
                                                "unequal:unequal",
                                                "needles-few:needles-few",
                                                "needles-few:torus",
                                                "blob:torus",
                                                "sphere:box",
                                                "wedge:l-block",
                                                "two-boxes:patch"};

struct CompletenessChoice : experiments::StudyChoice {
  CompletenessChoice() { seed = 3; }
  std::vector<std::string> pairs = DEFAULT_PAIRS;
  std::vector<std::string> experiments;
  std::string poses_file;
  std::size_t truth_stride = 50;
  std::size_t far_poses = 20000, flat_poses = 1000, rounded_poses = 1000;
};

constexpr std::size_t MAXIMUM_COMPLAINTS = 20;

/// Prints the first complaints in full and counts all of them.
class Complaints {
 public:
  Complain about(const std::string& subject) {
    return [this, subject](const std::string& what) {
      if (++count_ <= MAXIMUM_COMPLAINTS) fmt::print(stderr, "wrong: {}: {}\n", subject, what);
    };
  }
  std::size_t count() const { return count_; }
  void add_searches(std::size_t searches) { searches_ += searches; }
  std::size_t searches() const { return searches_; }

 private:
  std::size_t count_ = 0, searches_ = 0;
};

void choose_pair(const std::string& pair, experiments::SceneChoice& scene) {
  const std::size_t colon = pair.find(':');
  if (colon == std::string::npos)
    throw UsageError("", "--pair", "'" + pair + "' has no colon", "write MOVING:FIXED");
  scene.moving = pair.substr(0, colon);
  scene.fixed = pair.substr(colon + 1);
}

std::string numbers(const Judgement& judgement) {
  return fmt::format("{} | {} | {} | {} | {} | {:.1e} | {:.1e}", judgement.same.true_lmds,
                     judgement.same.missed(), judgement.same.wrong(), judgement.duplicates,
                     judgement.wrong_poses, judgement.worst_distance_difference,
                     judgement.worst_point_difference);
}

constexpr const char* NUMBER_HEADS =
    "true LMDs | missed | wrong | duplicates | wrong poses | distance off, diagonals | points off, diagonals";

std::vector<Pose> choose_poses(const Scene& scene, const CompletenessChoice& choice) {
  if (choice.poses_file.empty())
    return experiments::grazing_poses(*scene.moving, *scene.fixed.at(0),
                                      choice.scene.gap * choice.scene.diagonal, choice.poses, choice.seed);
  std::vector<Pose> poses;
  for (const TimedPose& timed : read_tum(choice.poses_file)) poses.push_back(timed.pose);
  return poses;
}

nlohmann::json run_pair(const std::string& pair, CompletenessChoice choice, Complaints& complaints) {
  choose_pair(pair, choice.scene);
  const Scene scene = load_scene(choice.scene);
  const std::size_t moving_triangles = scene.moving->surface().mesh.triangles.size();
  const std::size_t fixed_triangles = scene.fixed.at(0)->surface().mesh.triangles.size();
  fmt::print(stderr, "{}: {} and {} triangles\n", pair, moving_triangles, fixed_triangles);
  const auto results = judge_poses(scene, choice.scene.diagonal, choice.cutoffs, choose_poses(scene, choice),
                                   complaints.about(pair));
  nlohmann::json entry = {{"moving", choice.scene.moving},
                          {"fixed", choice.scene.fixed},
                          {"moving_triangles", moving_triangles},
                          {"fixed_triangles", fixed_triangles}};
  for (const CutoffResult& result : results) {
    const Judgement all = sum_of(result.judgements);
    complaints.add_searches(all.poses);
    entry["cutoffs"].push_back({{"cutoff", result.cutoff}, {"variants", variants_json(result.judgements)}});
    fmt::print("| {} on {} | {:g} | {} | {} |\n", choice.scene.moving, choice.scene.fixed,
               100.0 * result.cutoff, all.poses, numbers(all));
    std::fflush(stdout);
  }
  return entry;
}

nlohmann::json run_path(const std::string& experiment, const CompletenessChoice& choice,
                        Complaints& complaints) {
  fmt::print(stderr, "{}\n", experiment);
  const PathResult result =
      judge_path(experiment, choice.scene.meshes, choice.truth_stride, complaints.about(experiment));
  fmt::print("| {} | coherent against from scratch | {} | {} |\n", result.experiment,
             result.against_scratch.poses, numbers(result.against_scratch));
  fmt::print("| {} | coherent against exhaustive | {} | {} |\n", result.experiment,
             result.against_truth.poses, numbers(result.against_truth));
  std::fflush(stdout);
  complaints.add_searches(result.against_scratch.poses + result.against_truth.poses);
  nlohmann::json entry = {{"experiment", result.experiment},
                          {"frames", result.frames},
                          {"coherent_against_scratch", to_json(result.against_scratch)},
                          {"coherent_against_exhaustive", to_json(result.against_truth)}};
  for (const CounterDescription& counter : method_description("certified").counters)
    entry["work"][counter.name] = {{"coherent", result.coherent_work.values[counter.index]},
                                   {"from_scratch", result.scratch_work.values[counter.index]}};
  return entry;
}

nlohmann::json run_far_scenes(const CompletenessChoice& choice, Complaints& complaints) {
  fmt::print(stderr, "{} poses far from the origin\n", choice.far_poses);
  nlohmann::json rows = nlohmann::json::array();
  for (const FarResult& result :
       judge_far_scenes(choice.seed, choice.far_poses, complaints.about("far from the origin"))) {
    const Judgement all = sum_of(result.judgements);
    complaints.add_searches(all.poses);
    rows.push_back({{"smallest_size_offsets", std::pow(10.0, result.decade)},
                    {"variants", variants_json(result.judgements)}});
    fmt::print("| 1e{} to 1e{} | {} | {} |\n", result.decade, result.decade + 1, all.poses, numbers(all));
  }
  return rows;
}

nlohmann::json run_flat_scenes(const CompletenessChoice& choice, Complaints& complaints) {
  fmt::print(stderr, "{} poses of each pair of flat shapes\n", choice.flat_poses);
  nlohmann::json rows = nlohmann::json::array();
  PartsStudy study;
  study.poses = choice.flat_poses;
  study.seed = choice.seed;
  for (const parts::PartsKind& kind : parts::parts_kinds(parts::Generator::CLEAR_SHAPES)) {
    for (const parts::Coordinates coordinates :
         {parts::Coordinates::EXACT, parts::Coordinates::TURNED, parts::Coordinates::ROUNDED}) {
      const PartsResult result = judge_parts(study, kind.name, coordinates, complaints.about("flat"));
      const Judgement all = sum_of(result.judgements);
      complaints.add_searches(all.poses);
      rows.push_back({{"pair", result.kind},
                      {"coordinates", name_of(coordinates)},
                      {"variants", variants_json(result.judgements)}});
      fmt::print("| {} | {} | {} | {} |\n", result.kind, name_of(coordinates), all.poses, numbers(all));
      std::fflush(stdout);
    }
  }
  return rows;
}

nlohmann::json run_rounded_plates(const CompletenessChoice& choice, Complaints& complaints) {
  nlohmann::json rows = nlohmann::json::array();
  for (const int cells : ROUNDED_PLATE_CELLS) {
    const RoundedPlates plates =
        judge_rounded_plates(cells, choice.seed, choice.rounded_poses, complaints.about("rounded plates"));
    const double largest = *std::max_element(plates.seconds.begin(), plates.seconds.end());
    fmt::print(
        "| {} | {} | {} | {:.1e} | {:.1e} | {:.1f} | {:.1f} | {:.1f} | {} |\n", plates.triangles,
        plates.poses, plates.one_lmd, 100.0 * plates.worst_point, plates.worst_direction,
        1e6 * median(plates.seconds), 1e6 * quantile(plates.seconds, 0.99), 1e6 * largest,
        std::count_if(plates.seconds.begin(), plates.seconds.end(), [](double s) { return s > 1e-3; }));
    std::fflush(stdout);
    complaints.add_searches(plates.poses);
    rows.push_back({{"triangles", plates.triangles},
                    {"poses", plates.poses},
                    {"one_lmd", plates.one_lmd},
                    {"worst_point_overlaps", plates.worst_point},
                    {"worst_direction_rad", plates.worst_direction},
                    {"seconds", plates.seconds}});
  }
  return rows;
}

int judge_completeness(const CompletenessChoice& choice) {
  Complaints complaints;
  nlohmann::json report = {{"format", "lmdbench-completeness"},
                           {"format_version", 1},
                           {"context", experiments::run_context()},
                           {"diagonal_m", choice.scene.diagonal},
                           {"gap", choice.scene.gap},
                           {"seed", choice.seed},
                           {"poses_file", choice.poses_file},
                           {"position_tolerance_diagonals", POSITION_TOLERANCE},
                           {"pairs", nlohmann::json::array()},
                           {"paths", nlohmann::json::array()}};
  const auto save = [&] {
    report["wrong_poses"] = complaints.count();
    experiments::write_report(choice.json, report);
  };
  if (!choice.pairs.empty()) {
    fmt::print("## certified against exhaustive\n\n");
    if (choice.poses_file.empty())
      fmt::print("Random poses at gap {:g} % of the diagonal, seed {}; ", 100.0 * choice.scene.gap,
                 choice.seed);
    else
      fmt::print("Poses of {}; ", choice.poses_file);
    fmt::print("each searched by {} variants of certified, which the counts add up.\n\n", variants().size());
    fmt::print("| meshes | cutoff [%] | searches | {} |\n|---|---|---|---|---|---|---|---|---|---|\n",
               NUMBER_HEADS);
  }
  for (const std::string& pair : choice.pairs) {
    report["pairs"].push_back(run_pair(pair, choice, complaints));
    save();
  }
  if (choice.far_poses > 0) {
    fmt::print(
        "\n## Far from the origin\n\nGenerated shapes; sizes as shares of their distance from the origin, "
        "on whose scale points are compared.\n\n");
    fmt::print("| size | searches | {} |\n|---|---|---|---|---|---|---|---|---|\n", NUMBER_HEADS);
    report["far"] = run_far_scenes(choice, complaints);
    save();
  }
  if (choice.flat_poses > 0) {
    fmt::print(
        "\n## Flat faces\n\nA side of one shape lies over the other one, {:g} poses a pair and kind of "
        "coordinates: exact, "
        "turned, and turned and rounded to floats, each mesh apart.\n\n",
        static_cast<double>(choice.flat_poses));
    fmt::print("| shapes | coordinates | searches | {} |\n|---|---|---|---|---|---|---|---|---|---|\n",
               NUMBER_HEADS);
    report["flat"] = run_flat_scenes(choice, complaints);
    save();
  }
  if (choice.rounded_poses > 0) {
    fmt::print(
        "\n## Rounded plates\n\nPlates rounded to floats, turned apart at random, against their design; from "
        "scratch, "
        "processor time.\n\n");
    fmt::print(
        "| triangles of each | poses | with one LMD | point off, % of the overlap | direction off [rad] | "
        "median [us] | "
        "p99 | largest | above 1 ms |\n|---|---|---|---|---|---|---|---|---|\n");
    report["rounded_plates"] = run_rounded_plates(choice, complaints);
    save();
  }
  if (!choice.experiments.empty()) {
    fmt::print("\n## Along recorded paths\n\n| path | comparison | frames | {} |\n", NUMBER_HEADS);
    fmt::print("|---|---|---|---|---|---|---|---|---|---|\n");
  }
  for (const std::string& experiment : choice.experiments) {
    report["paths"].push_back(run_path(experiment, choice, complaints));
    save();
  }
  fmt::print("\n{} of {} searches are wrong.\n", complaints.count(), complaints.searches());
  if (complaints.count() == 0) return static_cast<int>(ExitCode::DONE);
  fmt::print(stderr,
             "error: {} searches are wrong; to see one again, put its line into a file and give that "
             "with --pair and --poses-file\n",
             complaints.count());
  return static_cast<int>(ExitCode::CHECK_FAILED);
}

/// A piece for each mesh pair, kind of generated scene and path, in the order of the report.
std::vector<study::Arguments> pieces(const CLI::App& command, const CompletenessChoice& choice) {
  const std::vector<std::string> kinds = {"--far-poses", "--flat-poses", "--rounded-poses"};
  study::Arguments common = study::arguments_without(
      command, {"--pair", "--no-pairs", "--experiment", kinds[0], kinds[1], kinds[2]});
  const auto piece = [&](const study::Arguments& what) {
    study::Arguments arguments = common;
    for (const std::string& kind : kinds)
      if (!what.front().starts_with(kind)) arguments.push_back(kind + "=0");
    if (!what.front().starts_with("--pair")) arguments.emplace_back("--no-pairs");
    arguments.insert(arguments.end(), what.begin(), what.end());
    return arguments;
  };
  std::vector<study::Arguments> result;
  for (const std::string& pair : choice.pairs) result.push_back(piece({"--pair=" + pair}));
  const std::array<std::size_t, 3> poses = {choice.far_poses, choice.flat_poses, choice.rounded_poses};
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    if (poses[kind] > 0) result.push_back(piece({fmt::format("{}={}", kinds[kind], poses[kind])}));
  for (const std::string& experiment : choice.experiments)
    result.push_back(piece({"--experiment=" + experiment}));
  return result;
}

}  // namespace
}  // namespace lmdbench::completeness

void lmdbench::study::add_completeness(CLI::App& app, Run& chosen) {
  CLI::App* command = app.add_subcommand("completeness", "Is certified complete and exact?");
  const auto choice = std::make_shared<completeness::CompletenessChoice>();
  const auto no_pairs = std::make_shared<bool>(false);
  command->add_option("--pair", choice->pairs, "MOVING:FIXED meshes, may be repeated")->default_str("");
  command->add_flag("--no-pairs", *no_pairs, "Only the experiments");
  command->add_option("--experiment", choice->experiments,
                      "Experiment file whose path is followed, may be repeated");
  command->add_option("--far-poses", choice->far_poses,
                      "Poses of generated scenes far from the origin, 1e-10 to 1e-5 of it large; 0: none");
  command->add_option("--flat-poses", choice->flat_poses,
                      "Poses of each pair of generated flat shapes, for each kind of coordinates; 0: none");
  command->add_option("--rounded-poses", choice->rounded_poses,
                      "Poses of plates rounded to single precision, for each number of triangles; 0: none");
  experiments::add_study_options(*command, *choice);
  command->add_option("--poses-file", choice->poses_file, "Poses of this TUM file instead of random ones");
  command->add_option("--truth-stride", choice->truth_stride,
                      "Compare every so many frames of a path with exhaustive; 0: none");
  command->callback([&chosen, command, choice, no_pairs] {
    if (*no_pairs) choice->pairs.clear();
    chosen.work = [choice] { return completeness::judge_completeness(*choice); };
    chosen.pieces = [command, choice] { return completeness::pieces(*command, *choice); };
  });
}
