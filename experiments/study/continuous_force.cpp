// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <study/continuous_force/measures.h>
#include <study/studies.h>
#include <support/context.h>
#include <support/program.h>

#include <algorithm>
#include <cmath>
#include <memory>

/// What becomes of the summed force where contacts are born and die, under every law: indices, jumps, work, tessellation, cost.
/// Exit code 1 where sums of indices or minima are wrong, a continuous law jumps, or differs from the sum where nothing is near a saddle.
namespace lmdbench::study {

namespace {

using namespace continuous_force;

struct ForceStudy {
  std::vector<std::string> parts{"sums",       "paths", "events",  "loops", "cuts",
                                 "decimation", "cups",  "notches", "cost"};
  std::vector<std::string> scenes{"shapes", "bunny-hard", "bunny-soft"};
  std::filesystem::path meshes = "meshes", paths = "paths";
  std::size_t poses = 1000, frames = 6000, refined = 20, events = 100, loops = 20, cost_poses = 300;
  std::uint64_t seed = 1;
  bool exhaustive = true;
  std::string json;

  bool asks(const std::string& part) const { return std::ranges::find(parts, part) != parts.end(); }
};

/// Bars of results/reference/continuous-force.md.
/// Of the path of that name.
constexpr std::size_t SHAPES_FRAMES = 800;
constexpr double LARGEST_SEPARATED_DIFFERENCE = 1e-12, LARGEST_EVENT = 1e-6, LARGEST_DECAY = 0.22,
                 SHORTEST_STEP = 1e-9;

std::string laws_header(const std::string& before) {
  std::string head = before, rule = "|---";
  for (std::size_t i = 2; i < static_cast<std::size_t>(std::ranges::count(before, '|')); ++i) rule += "|---";
  for (const Aggregation& law : aggregations()) {
    head += fmt::format(" {} |", law.name);
    rule += "|---";
  }
  return head + "\n" + rule + "|\n";
}

template <class Value>
std::string law_cells(Value&& value) {
  std::string cells;
  for (std::size_t law = 0; law < LAWS; ++law) cells += fmt::format(" {:.2g} |", value(law));
  return cells + "\n";
}

class Report {
 public:
  explicit Report(const ForceStudy& choice)
      : choice_(choice), json_{{"context", experiments::run_context()}} {}

  int run() {
    if (choice_.asks("sums")) sums();
    for (const std::string& name : choice_.scenes) {
      const bool needs_path =
          choice_.asks("paths") || choice_.asks("events") || choice_.asks("loops") || choice_.asks("cost");
      if (!needs_path) break;
      const std::size_t stride = name == "bunny-hard" ? 1 : name == "shapes" ? 1 : 4;
      const std::size_t frames =
          name == "shapes" ? std::min<std::size_t>(choice_.frames, SHAPES_FRAMES) : choice_.frames / stride;
      along(load_path_scene(name, choice_.meshes, choice_.paths, frames, stride));
    }
    if (choice_.asks("cuts")) cuts();
    if (choice_.asks("decimation")) decimation();
    if (choice_.asks("cups")) cups();
    if (choice_.asks("notches")) notches();
    experiments::write_report(choice_.json, json_);
    return right_ ? 0 : 1;
  }

 private:
  void sums() {
    fmt::print(
        "\n## Sums of indices\n\n| moving | fixed | method | poses | product of Euler characteristics | "
        "wrong sums | other minima "
        "than the LMD set | most critical pairs |\n|---|---|---|---|---|---|---|---|\n");
    for (const SumRow& row : measure_sums(choice_.poses, choice_.seed, choice_.exhaustive)) {
      fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} |\n", row.moving, row.fixed, row.method, row.poses,
                 row.expected, row.wrong_sums, row.other_minima, row.most_pairs);
      std::fflush(stdout);
      right_ = right_ && row.wrong_sums == 0 && row.other_minima == 0;
      json_["sums"].push_back({{"moving", row.moving},
                               {"fixed", row.fixed},
                               {"method", row.method},
                               {"poses", row.poses},
                               {"wrong_sums", row.wrong_sums},
                               {"other_minima", row.other_minima}});
    }
  }

  void along(const PathScene& scene) {
    if (choice_.asks("paths")) path(measure_path(scene, choice_.refined));
    if (choice_.asks("events")) {
      const EventRow row = measure_events(scene, choice_.events, SHORTEST_STEP);
      fmt::print(
          "\n{}: {} births and deaths bisected to {:g} of a frame; largest change left, in F_max:\n\n{}|",
          row.scene, row.events, SHORTEST_STEP, laws_header("|"));
      fmt::print("{}", law_cells([&](std::size_t law) { return row.largest[law].x(); }));
      right_ = right_ && row.largest[SIGNED].x() <= LARGEST_EVENT && row.largest[SHARED].x() <= LARGEST_EVENT;
      json_["events"][row.scene] = {{"events", row.events},
                                    {"sum", row.largest[SUM].x()},
                                    {"signed", row.largest[SIGNED].x()},
                                    {"shared", row.largest[SHARED].x()}};
    }
    if (choice_.asks("loops"))
      for (const std::size_t steps : {400U, 800U, 1600U}) {
        const LoopRow row = measure_loops(scene, choice_.loops, steps, choice_.seed);
        fmt::print(
            "\n{}: work of {} closed loops of {} steps, radius one cutoff, in F_max c; largest and "
            "mean\n\n{}| largest |",
            row.scene, row.loops, row.steps, laws_header("| |"));
        fmt::print("{}| mean |{}", law_cells([&](std::size_t law) { return row.largest[law]; }),
                   law_cells([&](std::size_t law) { return row.mean[law]; }));
        json_["loops"][row.scene].push_back(
            {{"steps", row.steps}, {"largest", row.largest}, {"mean", row.mean}});
      }
    if (choice_.asks("cost")) {
      fmt::print(
          "\n{}: processor time a pose, medians, interleaved\n\n| way | poses | certified and sum [us] | "
          "critical pairs and signed | "
          "ratio | with merges and shared | ratio |\n|---|---|---|---|---|---|---|\n",
          scene.name);
      for (const CostRow& row : measure_cost(scene, choice_.cost_poses, 5)) {
        fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.2f} | {:.1f} | {:.2f} |\n", row.way, row.poses,
                   1e6 * row.certified, 1e6 * row.critical, row.critical / row.certified,
                   1e6 * row.with_merges, row.with_merges / row.certified);
        json_["cost"][row.scene][row.way] = {
            {"certified_s", row.certified}, {"critical_s", row.critical}, {"with_merges_s", row.with_merges}};
      }
    }
    std::fflush(stdout);
  }

  void path(const PathRow& row) {
    fmt::print(
        "\n## Path {}\n\n{} frames, {} in contact, {} of them separated (no saddle within the cutoff); a "
        "pose in contact has {:.2f} "
        "LMDs, {:.2f} critical pairs, {:.2f} merges\n\n{}",
        row.scene, row.frames, row.in_contact, row.separated, row.minima, row.pairs, row.merges,
        laws_header("| largest step [F_max] |"));
    const std::array<const char*, 5> names{"at the frames", "x 10", "x 100", "x 1,000", "x 10,000"};
    for (std::size_t k = 0; k < names.size(); ++k)
      fmt::print("| {} |{}", names[k], law_cells([&](std::size_t law) { return row.laws[law].largest[k]; }));
    const auto line = [&](const char* name, auto value) {
      fmt::print("| {} |{}", name,
                 law_cells([&](std::size_t law) { return static_cast<double>(value(row.laws[law])); }));
    };
    line("steps above 0.25", [](const PathRow::Law& law) { return law.above_quarter; });
    line("difference from the sum where separated",
         [](const PathRow::Law& law) { return law.separated_difference; });
    line("RMS difference from the sum", [](const PathRow::Law& law) { return law.rms_from_sum; });
    line("frames with a force outside the cone of pushes",
         [](const PathRow::Law& law) { return law.outside_cone; });
    line("frames with a force against every LMD", [](const PathRow::Law& law) { return law.against_all; });
    for (const std::size_t law : {SIGNED, SHARED}) {
      const PathRow::Law& own = row.laws[law];
      right_ = right_ && own.largest[4] <= LARGEST_DECAY * own.largest[3] &&
               own.separated_difference <= LARGEST_SEPARATED_DIFFERENCE;
    }
    right_ = right_ && row.laws[SHARED].outside_cone == 0;
    for (std::size_t law = 0; law < LAWS; ++law) {
      nlohmann::json& entry = json_["paths"][row.scene][std::string(aggregations()[law].name)];
      entry = {{"largest_step", row.laws[law].largest},
               {"steps_above_quarter", row.laws[law].above_quarter},
               {"separated_difference", row.laws[law].separated_difference},
               {"rms_from_sum", row.laws[law].rms_from_sum},
               {"outside_cone", row.laws[law].outside_cone},
               {"force", nlohmann::json::array()}};
      for (const Forces& forces : row.forces)
        entry["force"].push_back({forces[law].x(), forces[law].y(), forces[law].z()});
    }
  }

  void cuts() {
    fmt::print("\n## Tessellation and rounding\n\nLargest change of the force, blob past torus\n\n{}",
               laws_header("| change | poses |"));
    for (const CutRow& row : measure_cuts(200, choice_.seed)) {
      fmt::print("| {} | {} |{}", row.change, row.poses,
                 law_cells([&](std::size_t law) { return row.largest[law]; }));
      json_["cuts"].push_back({{"change", row.change}, {"largest", row.largest}});
    }
  }

  void decimation() {
    const std::size_t stride = 20, frames = choice_.frames / stride;
    const auto fine =
                   load_path_scene("bunny-soft", choice_.meshes, choice_.paths, frames, stride, "bunny-16k"),
               coarse =
                   load_path_scene("bunny-soft", choice_.meshes, choice_.paths, frames, stride, "bunny-5k");
    const auto apart = measure_decimation(fine, coarse);
    fmt::print(
        "\nbunny-5k in place of bunny-16k, every {}th frame of the soft path: RMS difference over RMS "
        "force\n\n{}|{}",
        stride, laws_header("|"), law_cells([&](std::size_t law) { return apart[law]; }));
    json_["decimation"] = apart;
  }

  void cups() {
    fmt::print("\n## Sphere in a spherical cup\n\nMean force over that of smooth surfaces, which is 1\n\n{}",
               laws_header("| cup radius / sphere radius | triangles each |"));
    for (const CupRow& row : measure_cups(choice_.seed)) {
      fmt::print("| {:g} | {} |{}", row.cup_radius, row.triangles,
                 law_cells([&](std::size_t law) { return row.mean[law]; }));
      json_["cups"].push_back({{"ratio", row.cup_radius}, {"triangles", row.triangles}, {"mean", row.mean}});
    }
  }

  void notches() {
    fmt::print(
        "\n## Tip in a notch\n\nForce out of it, 0.02 c from either wall, in F_max (below 0: it pulls "
        "in)\n\n{}",
        laws_header("| half angle [degrees] |"));
    for (const NotchRow& row : measure_notches()) {
      fmt::print("| {:g} |{}", row.half_angle_degrees,
                 law_cells([&](std::size_t law) { return row.outwards[law]; }));
      json_["notches"].push_back(
          {{"half_angle_degrees", row.half_angle_degrees}, {"outwards", row.outwards}});
    }
  }

  const ForceStudy& choice_;
  nlohmann::json json_;
  bool right_ = true;
};

}  // namespace

void add_continuous_force(CLI::App& app, Run& chosen) {
  const auto choice = std::make_shared<ForceStudy>();
  CLI::App* command = app.add_subcommand(
      "continuous-force", "Is the force continuous where contacts are born and die, and at what cost?");
  command->add_option("--part", choice->parts, "Parts to measure")->capture_default_str();
  command->add_option("--scene", choice->scenes, "Of shapes, bunny-hard, bunny-soft")->capture_default_str();
  command->add_option("--meshes", choice->meshes, "Folder of the built meshes")->capture_default_str();
  command->add_option("--paths", choice->paths, "Folder of the recorded paths")->capture_default_str();
  command->add_option("--poses", choice->poses, "Random poses a pair of solids")->capture_default_str();
  command->add_option("--frames", choice->frames, "Frames of each path, of 1 kHz; soft: every fourth")
      ->capture_default_str();
  command->add_option("--refined", choice->refined, "Largest steps of each law that are divided")
      ->capture_default_str();
  command->add_option("--events", choice->events, "Births and deaths that are bisected, at most")
      ->capture_default_str();
  command->add_option("--loops", choice->loops, "Closed loops")->capture_default_str();
  command->add_option("--cost-poses", choice->cost_poses, "Poses that are timed")->capture_default_str();
  command->add_option("--seed", choice->seed, "Of poses and loops")->capture_default_str();
  command->add_flag("!--no-exhaustive", choice->exhaustive, "Sums of indices of certified alone");
  command->add_option("--json", choice->json, "Also write the tables to this file");
  command->callback([choice, &chosen] { chosen.work = [choice] { return Report(*choice).run(); }; });
}

}  // namespace lmdbench::study
