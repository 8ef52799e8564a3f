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
#include <optional>

/// The force at births and deaths of contacts under every law: indices, jumps, work, cuts, cost.
/// Exit code 1: wrong indices or minima; a continuous law jumps or, off saddles, is not the sum.
namespace lmdbench::study {

namespace {

using namespace continuous_force;

struct ForceStudy {
  std::vector<std::string> parts{"sums", "paths",   "events", "loops", "cuts", "decimation",
                                 "cups", "notches", "bores",  "drag",  "cost"};
  std::vector<std::string> scenes{"shapes", "bunny-hard", "bunny-soft"};
  std::filesystem::path meshes = "meshes", paths = "paths";
  std::filesystem::path device = "experiments/bunny-closed.json";
  std::size_t poses = 1000, frames = 6000, refined = 20, events = 100, loops = 20, cost_poses = 300,
              rolls = 8, spots = 8, slope_steps = 80;
  LayeredChoice layered;
  bool layered_too = false;
  std::uint64_t seed = 1;
  bool exhaustive = true;
  std::string json;

  bool asks(const std::string& part) const { return std::ranges::find(parts, part) != parts.end(); }
};

/// Frames of the path "shapes".
constexpr std::size_t SHAPES_FRAMES = 800;
/// Limits of results/reference/continuous-force.md.
constexpr double LARGEST_SEPARATED_DIFFERENCE = 1e-12, LARGEST_EVENT = 1e-6, LARGEST_DECAY = 0.12,
                 SHORTEST_STEP = 1e-9;

/// Number of a step's pairs that are printed.
constexpr std::size_t MOST_CHANGES = 8;

std::string laws_header(const std::string& before) {
  std::string head = before, rule = "|---";
  for (std::size_t i = 2; i < static_cast<std::size_t>(std::ranges::count(before, '|')); ++i) rule += "|---";
  for (const Aggregation& law : aggregations()) {
    head += fmt::format(" {} |", law.name);
    rule += "|---";
  }
  return head + "\n" + rule + "|\n";
}

std::string law_cells(const std::array<double, LAWS>& values) {
  std::string cells;
  for (const double value : values) cells += std::isnan(value) ? " - |" : fmt::format(" {:.2g} |", value);
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
    if (choice_.asks("bores")) bores();
    if (choice_.asks("drag")) drag();
    experiments::write_report(choice_.json, json_);
    return right_ ? 0 : 1;
  }

 private:
  std::optional<LayeredChoice> layered() const {
    return choice_.layered_too ? std::optional(choice_.layered) : std::nullopt;
  }

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
    if (choice_.asks("paths")) path(measure_path(scene, choice_.refined, layered()));
    if (choice_.asks("events")) {
      const EventRow row = measure_events(scene, choice_.events, SHORTEST_STEP, layered());
      fmt::print(
          "\n{}: {} births and deaths bisected to {:g} of a frame; largest change left, in F_max:\n\n{}|",
          row.scene, row.events, SHORTEST_STEP, laws_header("|"));
      fmt::print("{}", law_cells(row.largest));
      right_ = right_ && row.largest[SIGNED] <= LARGEST_EVENT && row.largest[SHARED] <= LARGEST_EVENT;
      json_["events"][row.scene] = {{"events", row.events},
                                    {"sum", row.largest[SUM]},
                                    {"signed", row.largest[SIGNED]},
                                    {"shared", row.largest[SHARED]}};
    }
    if (choice_.asks("loops"))
      for (const std::size_t steps : {400U, 800U, 1600U}) {
        const LoopRow row = measure_loops(scene, choice_.loops, steps, choice_.seed, layered());
        fmt::print(
            "\n{}: work of {} closed loops of {} steps, radius one cutoff, in F_max c; largest and "
            "mean\n\n{}| largest |",
            row.scene, row.loops, row.steps, laws_header("| |"));
        fmt::print("{}| mean |{}", law_cells(row.largest), law_cells(row.mean));
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
    const auto line = [&](const std::string& name, auto value) {
      std::array<double, LAWS> values{};
      for (std::size_t law = 0; law < LAWS; ++law)
        values[law] = row.is_measured(law) ? static_cast<double>(value(row.laws[law])) : std::nan("");
      fmt::print("| {} |{}", name, law_cells(values));
    };
    for (std::size_t k = 0; k < row.laws[SUM].largest.size(); ++k)
      line(k == 0 ? "at the frames" : fmt::format("x 1e{}", k),
           [k](const PathRow::Law& law) { return law.largest[k]; });
    line("steps above 0.25", [](const PathRow::Law& law) { return law.above_quarter; });
    line("difference from the sum where separated",
         [](const PathRow::Law& law) { return law.separated_difference; });
    line("RMS difference from the sum", [](const PathRow::Law& law) { return law.rms_from_sum; });
    line("frames with a force outside the cone of pushes",
         [](const PathRow::Law& law) { return law.outside_cone; });
    line("frames with a force against every LMD", [](const PathRow::Law& law) { return law.against_all; });
    for (const std::size_t law : {SIGNED, SHARED}) {
      const PathRow::Law& own = row.laws[law];
      const std::size_t last = own.largest.size() - 1;
      right_ = right_ && own.largest[last] <= LARGEST_DECAY * own.largest[last - 1] &&
               own.separated_difference <= LARGEST_SEPARATED_DIFFERENCE;
      fmt::print(
          "\nThe largest step of {} at x 1e3, pair by pair: index, d / c before and after, turn [rad], "
          "change of index f(d) u\n",
          aggregations()[law].name);
      for (std::size_t k = 0; k < std::min(MOST_CHANGES, own.steepest.size()); ++k) {
        const PairChange& pair = own.steepest[k];
        fmt::print("{:+d}, {:.9f}, {:.9f}, {:.2g}, {:.2g}\n", pair.index, pair.before, pair.after, pair.turn,
                   pair.change);
      }
    }
    right_ = right_ && row.laws[SHARED].outside_cone == 0;
    for (std::size_t law = 0; law < LAWS && row.is_measured(law); ++law) {
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
      fmt::print("| {} | {} |{}", row.change, row.poses, law_cells(row.largest));
      json_["cuts"].push_back({{"change", row.change}, {"largest", row.largest}});
    }
  }

  void decimation() {
    const std::size_t stride = 20, frames = choice_.frames / stride;
    const auto fine =
                   load_path_scene("bunny-soft", choice_.meshes, choice_.paths, frames, stride, "bunny-16k"),
               coarse =
                   load_path_scene("bunny-soft", choice_.meshes, choice_.paths, frames, stride, "bunny-5k");
    const auto apart = measure_decimation(fine, coarse, layered());
    fmt::print(
        "\nbunny-5k in place of bunny-16k, every {}th frame of the soft path: RMS difference over RMS "
        "force\n\n{}|{}",
        stride, laws_header("|"), law_cells(apart));
    json_["decimation"] = apart;
  }

  void cups() {
    fmt::print("\n## Sphere in a spherical cup\n\nMean force over that of smooth surfaces, which is 1\n\n{}",
               laws_header("| cup radius / sphere radius | triangles each |"));
    for (const CupRow& row : measure_cups(choice_.seed)) {
      fmt::print("| {:g} | {} |{}", row.cup_radius, row.triangles, law_cells(row.mean));
      json_["cups"].push_back({{"ratio", row.cup_radius}, {"triangles", row.triangles}, {"mean", row.mean}});
    }
  }

  void notches() {
    fmt::print(
        "\n## Tip in a notch\n\nForce out of it, 0.02 c from either wall, in F_max (below 0: it pulls "
        "in)\n\n{}",
        laws_header("| half angle [degrees] |"));
    for (const NotchRow& row : measure_notches()) {
      fmt::print("| {:g} |{}", row.half_angle_degrees, law_cells(row.outwards));
      json_["notches"].push_back(
          {{"half_angle_degrees", row.half_angle_degrees}, {"outwards", row.outwards}});
    }
  }

  void bores() {
    fmt::print(
        "\n## Rod in a bore\n\nMean force, its deviation over rolls, and the steepest slope across the "
        "middle [F_max a "
        "cutoff]\n\n{}",
        laws_header("| facets of rod and bore | |"));
    for (const BoreRow& row : measure_bores(choice_.rolls, choice_.slope_steps, choice_.layered)) {
      const auto line = [&](const char* name, const std::array<double, LAWS>& values) {
        fmt::print("| {}, {} | {} |", row.rod, row.bore, name);
        for (const double value : values) fmt::print(" {:.3f} |", value);
        fmt::print("\n");
      };
      line("mean", row.mean);
      line("deviation", row.deviation);
      line("slope", row.slope);
      std::fflush(stdout);
      json_["bores"].push_back({{"rod", row.rod},
                                {"bore", row.bore},
                                {"mean", row.mean},
                                {"deviation", row.deviation},
                                {"slope", row.slope}});
    }
  }

  void drag() {
    fmt::print(
        "\n## Drag by a hand\n\n{}, pushed by 1 N, 30 mm/s along: force above 30 Hz (RMS), and the largest "
        "change a "
        "frame, over the mean force\n\n{}",
        choice_.device.string(), laws_header("| K of one contact [N/m] | spots | |"));
    for (const DragRow& row :
         measure_drag(choice_.device, choice_.spots, choice_.seed, choice_.layered_too)) {
      const auto line = [&](const char* name, const std::array<double, LAWS>& values) {
        fmt::print("| {:g} | {} | {} |{}", row.stiffness_n_per_m, row.spots - row.through, name,
                   law_cells(values));
      };
      line("above 30 Hz", row.above_30_hz);
      line("largest change", row.largest_jump);
      std::fflush(stdout);
      json_["drag"].push_back({{"stiffness_n_per_m", row.stiffness_n_per_m},
                               {"spots", row.spots},
                               {"through", row.through},
                               {"above_30_hz", row.above_30_hz},
                               {"largest_jump", row.largest_jump}});
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
  command->add_option("--part", choice->parts, "Parts to measure");
  command->add_option("--scene", choice->scenes, "Of shapes, bunny-hard, bunny-soft");
  command->add_option("--meshes", choice->meshes, "Folder of the built meshes");
  command->add_option("--paths", choice->paths, "Folder of the recorded paths");
  command->add_option("--poses", choice->poses, "Random poses a pair of solids");
  command->add_option("--frames", choice->frames, "Frames of each path, of 1 kHz; soft: every fourth");
  command->add_option("--refined", choice->refined, "Largest steps of each law that are divided");
  command->add_option("--events", choice->events, "Births and deaths that are bisected, at most");
  command->add_option("--loops", choice->loops, "Closed loops");
  command->add_option("--cost-poses", choice->cost_poses, "Poses that are timed");
  command->add_option("--rolls", choice->rolls, "Rolls of the rod in its bore");
  command->add_option("--slope-steps", choice->slope_steps, "Steps across the middle of the bore");
  command->add_option("--patch", choice->layered.patch_cutoff,
                      "Of layered: longest edge of a patch, over the cutoff");
  command->add_option("--minimum-area", choice->layered.minimum_area_share,
                      "Of layered: area of a minimum, over cutoff and diagonal");
  command->add_flag("--layered", choice->layered_too,
                    "Measure layered also along paths and in the drag: slow");
  command->add_option("--spots", choice->spots, "Spots of the drag");
  command->add_option("--device", choice->device, "Experiment whose scene, device and hand the drag takes");
  command->add_option("--seed", choice->seed, "Of poses and loops");
  command->add_flag("!--no-exhaustive", choice->exhaustive, "Sums of indices of certified alone");
  command->add_option("--json", choice->json, "Also write the tables to this file");
  command->callback([choice, &chosen] { chosen.work = [choice] { return Report(*choice).run(); }; });
}

}  // namespace lmdbench::study
