// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/studies.h>
#include <study/worlds/broad_phases.h>
#include <study/worlds/completeness.h>
#include <study/worlds/cost.h>
#include <study/worlds/pile.h>
#include <support/bodies.h>
#include <support/context.h>
#include <support/poses.h>
#include <support/program.h>
#include <support/timing.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <numeric>

/// Cost and completeness of `certified` in a world of many instances: frames among 1 to 10,000 of
/// one mesh at the same contact, memory and preparation, ten kinds of worlds against `exhaustive`,
/// several broad phases, piles of moving spheres. Exit code 1 when a set is wrong.
namespace lmdbench::study {
namespace {

struct WorldsChoice {
  std::string mesh = "bunny-16k", path = "paths/bunny-hard.tum";
  std::filesystem::path meshes = "meshes";
  double diagonal = 0.15, cutoff = 0.005;
  std::size_t frames = 1500, world_frames = 1000, phase_frames = 2000;
  std::vector<std::string> worlds;  ///< Whose completeness is judged; empty: all.
  std::vector<double> world_cutoffs = {0.005, 0.05, 0.3}, slacks = {0.05, 0.1, 0.25, 0.5, 1.0};
  worlds::CostChoice cost;
  worlds::PileChoice pile;
  std::vector<double> swing_speeds = {0.0, 0.002, 0.02};
  std::vector<double> pile_slacks = {0.05, 0.1, 0.25, 0.5}, pack_shares = {0.0, 0.05, 0.1, 0.25, 1.0};
  std::vector<std::string> parts = {"cost", "completeness", "broad-phase", "slack", "pile", "pile-slack"};
  std::string json;
};

nlohmann::json cost_json(const worlds::CostRow& row) {
  return {{"instances", row.instances},
          {"median_s", median(row.seconds)},
          {"p99_s", quantile(row.seconds, P99)},
          {"largest_s", maximum(row.seconds)},
          {"queries_per_frame", row.queries},
          {"touched_per_frame", row.touched},
          {"searched_per_frame", row.searched},
          {"node_pairs_per_frame", row.node_pairs},
          {"idle_frames", row.idle_frames},
          {"frames", row.frames},
          {"frames_with_other_sets", row.other_sets}};
}

void study_cost(const WorldsChoice& choice, nlohmann::json& report) {
  const auto body = experiments::load_body(choice.mesh, choice.meshes, choice.diagonal);
  const double cutoff = choice.cutoff * choice.diagonal;
  const std::vector<Pose> poses = experiments::path_poses(choice.path, 0, choice.frames);
  fmt::print(
      "{} past instances of itself, {} triangles each, {:g} diagonals apart, cutoff {:g} % of the diagonal, "
      "{} frames of {}, "
      "the least of {} passes, sizes in turns frame by frame. Instance 1 alone is the scene without a "
      "world.\n\n",
      choice.mesh, body->surface().mesh.triangles.size(), choice.cost.spacing, 100.0 * choice.cutoff,
      poses.size(), choice.path, choice.cost.passes);
  for (const worlds::Frames frames :
       {worlds::Frames::COHERENT, worlds::Frames::FROM_SCRATCH, worlds::Frames::TELEPORT}) {
    const auto rows = measure_frames(body, body, cutoff, poses, frames, choice.cost);
    fmt::print("Frames {}:\n\n", to_string(frames));
    fmt::print(
        "| instances | median [us] | p99 [us] | median over one's | p99 over one's | queries a frame | "
        "touched | "
        "searched | node pairs |\n|---|---|---|---|---|---|---|---|---|\n");
    std::vector<double> counts, medians;
    for (const worlds::CostRow& row : rows) {
      const double middle = median(row.seconds), high = quantile(row.seconds, P99);
      fmt::print("| {} | {:.2f} | {:.2f} | {:.3f} | {:.3f} | {:.4f} | {:.3f} | {:.3f} | {:.1f} |\n",
                 row.instances, 1e6 * middle, 1e6 * high, middle / median(rows.front().seconds),
                 high / quantile(rows.front().seconds, P99), row.queries, row.touched, row.searched,
                 row.node_pairs);
      if (row.instances >= 10) {
        counts.push_back(static_cast<double>(row.instances));
        medians.push_back(middle);
      }
      report["cost"][to_string(frames)].push_back(cost_json(row));
    }
    fmt::print("\n{} frames of {} have the same set in all sizes and are timed.", rows.front().seconds.size(),
               poses.size());
    if (counts.size() > 1) {
      const double slope = experiments::log_slope(counts, medians);
      fmt::print(" Slope of the median over {:g} to {:g} instances: {:.4f}.", counts.front(), counts.back(),
                 slope);
      report["slope"][to_string(frames)] = slope;
    }
    fmt::print("\n\n");
    std::fflush(stdout);
  }
  const auto prepared = measure_preparation(body, body, cutoff, choice.cost);
  fmt::print(
      "| instances | preparation beyond the mesh [ms] | bytes an instance beyond the first "
      "|\n|---|---|---|\n");
  for (const worlds::PreparationRow& row : prepared) {
    const double more = static_cast<double>(row.instances) - static_cast<double>(prepared.front().instances);
    const double bytes = more > 0.0 ? (row.bytes - prepared.front().bytes) / more : 0.0;
    fmt::print("| {} | {:.2f} | {} |\n", row.instances, 1e3 * row.seconds,
               more > 0.0 ? fmt::format("{:.0f}", bytes) : "-");
    report["preparation"].push_back({{"instances", row.instances},
                                     {"seconds", row.seconds},
                                     {"bytes", row.bytes},
                                     {"bytes_each", bytes}});
  }
  fmt::print("\n");
  std::fflush(stdout);
}

std::size_t study_completeness(const WorldsChoice& choice, nlohmann::json& report) {
  fmt::print(
      "| world | movers | instances | cutoff [m] | frames | true LMDs | missed | wrong | wrong frames | "
      "distance off "
      "[m] |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  std::size_t wrong = 0;
  const auto judge_all = [&](const auto& scene, std::size_t movers, std::size_t instances, auto&& judge) {
    if (!choice.worlds.empty() && std::ranges::find(choice.worlds, scene.name) == choice.worlds.end()) return;
    for (const double cutoff : choice.world_cutoffs) {
      std::size_t complaints = 0;
      const auto judgement = judge(scene, cutoff, [&](const std::string& what) {
        if (++complaints <= 5) fmt::print(stderr, "wrong: {}, cutoff {:g}: {}\n", scene.name, cutoff, what);
      });
      wrong += judgement.wrong_poses;
      fmt::print("| {} | {} | {} | {:g} | {} | {} | {} | {} | {} | {:.1e} |\n", scene.name, movers, instances,
                 cutoff, judgement.poses, judgement.same.true_lmds, judgement.same.missed(),
                 judgement.same.wrong(), judgement.wrong_poses, judgement.worst_distance_difference);
      std::fflush(stdout);
      report["completeness"].push_back(
          {{"world", scene.name},
           {"movers", movers},
           {"instances", instances},
           {"cutoff_m", cutoff},
           {"frames", judgement.poses},
           {"wrong_frames", judgement.wrong_poses},
           {"set", experiments::error_json(judgement.same, judgement.neighbours)}});
    }
  };
  for (const worlds::World& world : worlds::small_worlds(choice.world_frames, choice.cost.seed))
    judge_all(world, 1, world.scene.fixed.size(), worlds::judge_world);
  for (const worlds::Play& play : worlds::small_plays(choice.world_frames, choice.cost.seed))
    judge_all(play, play.movers.size(), play.standing.size(), worlds::judge_play);
  fmt::print("\n");
  return wrong;
}

std::size_t study_broad_phases(const WorldsChoice& choice, nlohmann::json& report) {
  fmt::print(
      "Boxes at random, one turned cube moves among them: a way of steps of 0.2 % of its diagonal, and "
      "jumps.\n\n"
      "| instances | broad phase | build [ms] | bytes each | way: median [us] | p99 | mean | jumps: median "
      "[us] | p99 | "
      "frames with one missing |\n|---|---|---|---|---|---|---|---|---|---|\n");
  std::size_t wrong = 0;
  for (const std::size_t count : choice.cost.counts) {
    if (count < 10) continue;
    for (const worlds::BroadPhaseRow& row :
         worlds::compare_broad_phases(count, choice.phase_frames, choice.cost.passes, choice.cost.seed)) {
      wrong += row.wrong;
      fmt::print("| {} | {} | {:.3f} | {:.0f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {} |\n", count,
                 row.name, 1e3 * row.build_seconds, row.bytes, 1e6 * median(row.seconds),
                 1e6 * quantile(row.seconds, P99), 1e6 * mean(row.seconds), 1e6 * median(row.jump_seconds),
                 1e6 * quantile(row.jump_seconds, P99), row.wrong);
      report["broad_phases"].push_back({{"instances", count},
                                        {"name", row.name},
                                        {"build_s", row.build_seconds},
                                        {"bytes_each", row.bytes},
                                        {"way_median_s", median(row.seconds)},
                                        {"way_p99_s", quantile(row.seconds, P99)},
                                        {"way_mean_s", mean(row.seconds)},
                                        {"jump_median_s", median(row.jump_seconds)},
                                        {"jump_p99_s", quantile(row.jump_seconds, P99)},
                                        {"wrong", row.wrong}});
    }
    std::fflush(stdout);
  }
  fmt::print("\n");
  return wrong;
}

void study_slack(const WorldsChoice& choice, nlohmann::json& report) {
  const std::size_t most = *std::max_element(choice.cost.counts.begin(), choice.cost.counts.end());
  fmt::print(
      "Slack of the broad phase among {} boxes:\n\n| slack, radii | queries a frame | instances touched a "
      "frame | mean [us] |\n"
      "|---|---|---|---|\n",
      most);
  for (const double slack : choice.slacks) {
    const worlds::SlackRow row =
        worlds::measure_slack(slack, most, choice.phase_frames, choice.cost.passes, choice.cost.seed);
    fmt::print("| {:g} | {:.4f} | {:.3f} | {:.3f} |\n", slack, row.queries, row.touched, 1e6 * row.seconds);
    report["slack"].push_back({{"slack_radii", slack},
                               {"queries_per_frame", row.queries},
                               {"touched_per_frame", row.touched},
                               {"mean_s", row.seconds}});
  }
  fmt::print("\n");
}

nlohmann::json pile_json(const worlds::PileRow& row, double swing_speed, double pairs) {
  return {{"motion", to_string(row.motion)},
          {"swing_speed_m_s", swing_speed},
          {"movers", row.movers},
          {"triangles", row.triangles},
          {"contact_pairs_per_frame", pairs},
          {"lmds_per_frame", row.lmds},
          {"seconds_per_contact_pair", row.seconds_per_contact_pair()},
          {"median_s", median(row.seconds)},
          {"p99_s", quantile(row.seconds, P99)},
          {"largest_s", maximum(row.seconds)},
          {"first_s", row.first_seconds},
          {"frames_above_1ms", row.frames_above(1e-3)},
          {"frames", row.seconds.size()},
          {"searched_per_frame", row.searched},
          {"touched_per_frame", row.touched},
          {"anchored_per_frame", row.anchored},
          {"node_pairs_per_frame", row.node_pairs},
          {"candidates", row.candidates},
          {"methods", row.methods},
          {"bytes", row.bytes}};
}

void study_piles(const WorldsChoice& choice, nlohmann::json& report) {
  worlds::PileChoice pile = choice.pile;
  fmt::print(
      "Piles of spheres of radius {:g} m, {:g} m apart, cutoff {:g} m, {} frames of a millisecond, the least "
      "of {} "
      "passes, sizes in turns pass by pass; one thread. Settling from {:g} % farther apart; stirred at {:g} "
      "m/s.\n\n"
      "| motion | swing [mm/s] | spheres | contact pairs a frame | us a contact pair | median [ms] | p99 "
      "[ms] | worst "
      "[ms] | above 1 ms | first frame [ms] | searched | touched | anchored | node pairs a search | "
      "candidates | "
      "methods | kB a method |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      pile.radius, 0.5 * pile.cutoff, pile.cutoff, pile.frames, pile.passes, 100.0 * pile.looseness,
      pile.stirring_speed);
  std::string slopes;
  const auto study = [&](worlds::PileMotion motion, double swing_speed) {
    pile.swing_speed = swing_speed;
    std::vector<double> counts, costs;
    for (const worlds::PileRow& row : worlds::measure_piles(motion, pile)) {
      const double pairs = std::accumulate(row.contact_pairs.begin(), row.contact_pairs.end(), 0.0) /
                           static_cast<double>(row.contact_pairs.size());
      const double each = row.seconds_per_contact_pair();
      fmt::print(
          "| {} | {:g} | {} | {:.1f} | {:.2f} | {:.3f} | {:.3f} | {:.3f} | {} of {} | {:.2f} | {:.1f} | "
          "{:.1f} | "
          "{:.2f} | {:.1f} | {} | {} | {:.0f} |\n",
          to_string(motion), 1e3 * swing_speed, row.movers, pairs, 1e6 * each, 1e3 * median(row.seconds),
          1e3 * quantile(row.seconds, P99), 1e3 * maximum(row.seconds), row.frames_above(1e-3),
          row.seconds.size(), 1e3 * row.first_seconds, row.searched, row.touched, row.anchored,
          row.searched > 0.0 ? row.node_pairs / row.searched : 0.0, row.candidates, row.methods,
          1e-3 * row.bytes / std::max<double>(1.0, static_cast<double>(row.methods)));
      std::fflush(stdout);
      report["pile"].push_back(pile_json(row, swing_speed, pairs));
      if (!(each > 0.0)) continue;
      counts.push_back(static_cast<double>(row.movers));
      costs.push_back(each);
    }
    if (counts.size() < 2) return;
    slopes +=
        fmt::format("Slope of the time a contact pair over {:g} to {:g} spheres, {}, {:g} mm/s: {:.3f}.\n",
                    counts.front(), counts.back(), to_string(motion), 1e3 * swing_speed,
                    experiments::log_slope(counts, costs));
  };
  for (const double speed : choice.swing_speeds) study(worlds::PileMotion::JOSTLING, speed);
  study(worlds::PileMotion::SETTLING, choice.pile.swing_speed);
  study(worlds::PileMotion::STIRRED, choice.pile.swing_speed);
  fmt::print("\n{}\n", slopes);
}

void study_pile_slack(const WorldsChoice& choice, nlohmann::json& report) {
  worlds::PileChoice pile = choice.pile;
  pile.counts = {*std::max_element(pile.counts.begin(), pile.counts.end())};
  fmt::print(
      "Slack of movers, and the share of them that leave theirs in a frame above which the tree is packed "
      "anew; {} "
      "spheres, stirred:\n\n| slack, radii | share | anchored a frame | touched a frame | candidates | "
      "median [ms] | "
      "p99 [ms] |\n|---|---|---|---|---|---|---|\n",
      pile.counts[0]);
  const auto print = [&](double slack, double share) {
    const worlds::PileRow row =
        measure_piles(worlds::PileMotion::STIRRED, pile, {.slack = slack, .pack_share = share}).front();
    fmt::print("| {:g} | {:g} | {:.2f} | {:.1f} | {} | {:.3f} | {:.3f} |\n", slack, share, row.anchored,
               row.touched, row.candidates, 1e3 * median(row.seconds), 1e3 * quantile(row.seconds, P99));
    std::fflush(stdout);
    report["pile_slack"].push_back({{"slack_radii", slack},
                                    {"pack_share", share},
                                    {"anchored_per_frame", row.anchored},
                                    {"touched_per_frame", row.touched},
                                    {"median_s", median(row.seconds)},
                                    {"p99_s", quantile(row.seconds, P99)}});
  };
  for (const double slack : choice.pile_slacks) print(slack, BroadPhase::Tuning{}.pack_share);
  for (const double share : choice.pack_shares) print(BroadPhase::Tuning{}.slack, share);
  fmt::print("\n");
}

int study_worlds(const WorldsChoice& choice) {
  nlohmann::json report = {
      {"format", "lmdbench-worlds"}, {"format_version", 1}, {"context", experiments::run_context()}};
  const auto asked = [&](const char* part) {
    return std::find(choice.parts.begin(), choice.parts.end(), part) != choice.parts.end();
  };
  std::size_t wrong = 0;
  if (asked("cost")) study_cost(choice, report);
  if (asked("completeness")) wrong += study_completeness(choice, report);
  if (asked("broad-phase")) wrong += study_broad_phases(choice, report);
  if (asked("slack")) study_slack(choice, report);
  if (asked("pile")) study_piles(choice, report);
  if (asked("pile-slack")) study_pile_slack(choice, report);
  report["wrong"] = wrong;
  experiments::write_report(choice.json, report);
  return wrong == 0 ? 0 : 1;
}

}  // namespace

void add_worlds(CLI::App& app, Run& chosen) {
  const auto choice = std::make_shared<WorldsChoice>();
  CLI::App* command = app.add_subcommand(
      "worlds", "What do thousands of instances of a mesh cost, and is every set complete?");
  command->add_option("--part", choice->parts, "cost, completeness, broad-phase, slack, pile or pile-slack")
      ->check(CLI::IsMember({"cost", "completeness", "broad-phase", "slack", "pile", "pile-slack"}))
      ->default_str("");
  command->add_option("--mesh", choice->mesh, "What moves and what stands");
  command->add_option("--meshes", choice->meshes, "Folder of the manifest");
  command->add_option("--path", choice->path, "Path along the instance in the middle");
  command->add_option("--diagonal", choice->diagonal, "Of the mesh [m]");
  command->add_option("--cutoff", choice->cutoff, "Share of the diagonal");
  command->add_option("--instances", choice->cost.counts, "Sizes of the worlds; ratios are to the first")
      ->check(CLI::PositiveNumber);
  command->add_option("--spacing", choice->cost.spacing, "Of the instances, in diagonals");
  command->add_option("--frames", choice->frames, "Of the path");
  command->add_option("--world-frames", choice->world_frames, "Of each world whose completeness is judged")
      ->check(CLI::PositiveNumber);
  command->add_option("--world", choice->worlds, "Only this one is judged, by its name in the table");
  command->add_option("--world-cutoff", choice->world_cutoffs, "There [m]; meshes are about 1 m large");
  command->add_option("--spheres", choice->pile.counts, "Sizes of the piles")->check(CLI::PositiveNumber);
  command->add_option("--swing-speed", choice->swing_speeds, "Of the spheres where they jostle [m/s]");
  command->add_option("--pile-frames", choice->pile.frames, "Of each motion of a pile")
      ->check(CLI::PositiveNumber);
  command->add_option("--pile-passes", choice->pile.passes, "Times that they are run")
      ->check(CLI::PositiveNumber);
  command->add_option("--pile-slack", choice->pile_slacks, "Slacks of movers, in their radii");
  command->add_option("--pack-share", choice->pack_shares, "Shares of the movers");
  command->add_option("--passes", choice->cost.passes, "Times that frames are run")
      ->check(CLI::PositiveNumber);
  command->add_option("--slack", choice->slacks, "Slacks of the broad phase, in radii of what moves");
  command->add_option("--seed", choice->cost.seed, "Of all that is random");
  command->add_option("--json", choice->json, "Also write the tables to this file");
  command->callback([choice, &chosen] { chosen.work = [choice] { return study_worlds(*choice); }; });
}

}  // namespace lmdbench::study
