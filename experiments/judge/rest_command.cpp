// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/methods/registry.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <judge/judges.h>
#include <judge/rest_judge.h>
#include <support/scene_files.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

/// lmdbench-judge rest [--poses N] [--seed S] [--fit NAME]... [--out DIR]: judges `exhaustive` and
/// `certified` on parts at rest. Table and errors are printed. Exit code 1 where there is one.
namespace lmdbench::exact {
namespace {

struct RestChoice {
  std::size_t poses = 100, first = 0;
  std::uint64_t seed = 1;
  std::vector<std::string> fits;
  std::size_t complaints = 5;
  std::string out;
};

/// Upper limits of the classes of poses: the pose's least gap over its size.
constexpr std::array<double, 4> CLASSES = {1e-14, 2e-12, 2e-9, std::numeric_limits<double>::infinity()};
constexpr std::array CLASS_NAMES = {"touching", "rounding", "tolerance", "apart"};

/// Results of one fit and method.
struct RestCounts {
  std::array<std::size_t, CLASSES.size()> poses{}, faulty{};
  std::array<std::size_t, REST_FAULT_NAMES.size()> faults{};
  std::size_t places = 0, demanded = 0, located = 0;  ///< As in RestVerdict.

  void add(const RestCounts& other) {
    for (std::size_t i = 0; i < CLASSES.size(); ++i) {
      poses[i] += other.poses[i];
      faulty[i] += other.faulty[i];
    }
    for (std::size_t i = 0; i < faults.size(); ++i) faults[i] += other.faults[i];
    places += other.places;
    demanded += other.demanded;
    located += other.located;
  }
};

std::size_t class_of(const parts::RestScene& scene) {
  double least = std::numeric_limits<double>::infinity();
  for (const parts::RestPlace& place : scene.places) least = std::min(least, place.gap / scene.size);
  return static_cast<std::size_t>(std::ranges::lower_bound(CLASSES, least) - CLASSES.begin());
}

void print_row(const std::string& fit, const char* method, const RestCounts& c) {
  fmt::print("| {} | {} |", fit, method);
  for (std::size_t i = 0; i < CLASSES.size(); ++i) fmt::print(" {} of {} |", c.faulty[i], c.poses[i]);
  for (const std::size_t count : c.faults) fmt::print(" {} |", count);
  fmt::print(" {} of {} | {} |", c.demanded, c.places, c.located);
  fmt::print("\n");
  std::fflush(stdout);
}

int judge_rest(const RestChoice& choice) {
  std::size_t told = 0;
  std::size_t judged = 0, wrong = 0;
  std::array<RestCounts, JUDGED_METHODS.size()> all;
  fmt::print("At fault, of the poses whose least gap is that:\n\n| fit | method |");
  for (const char* name : CLASS_NAMES) fmt::print(" {} |", name);
  for (const char* name : REST_FAULT_NAMES) fmt::print(" {} |", name);
  fmt::print(" places demanded | points located |\n|---|---|---|---|{}\n", [] {
    std::string rule;
    for (std::size_t i = 0; i < CLASS_NAMES.size() + REST_FAULT_NAMES.size(); ++i) rule += "---|";
    return rule;
  }());
  for (const std::string& name : choice.fits) {
    std::array<RestCounts, JUDGED_METHODS.size()> counts;
    for (std::size_t index = choice.first; index < choice.first + choice.poses; ++index) {
      const parts::RestScene scene = parts::make_rest_scene(parts::rest_fit(name), choice.seed, index);
      const RestTruth truth(scene);
      const std::size_t gap_class = class_of(scene);
      bool faulty = false;
      ++judged;
      for (std::size_t m = 0; m < JUDGED_METHODS.size(); ++m) {
        const LmdSet lmds = lmds_at(*make_method(JUDGED_METHODS[m], scene.scene), scene.X_WM);
        const RestVerdict verdict = truth.judge(lmds);
        ++counts[m].poses[gap_class];
        for (std::size_t i = 0; i < verdict.faults.size(); ++i) counts[m].faults[i] += verdict.faults[i];
        counts[m].places += verdict.places;
        counts[m].demanded += verdict.demanded;
        counts[m].located += verdict.located;
        if (!verdict.is_faulty()) continue;
        ++counts[m].faulty[gap_class];
        if (wrong == 0 && !faulty && !choice.out.empty())
          fmt::print(stderr, "The first scene at fault:\n  {}\n",
                     experiments::write_scene(scene.scene, scene.X_WM, JUDGED_METHODS[m], choice.out));
        faulty = true;
        if (++told <= choice.complaints)
          fmt::print(stderr, "{}: {}{}\n{}", JUDGED_METHODS[m], scene.text,
                     truth.intersecting() ? ", intersecting" : "", verdict.objections);
      }
      wrong += faulty;
    }
    for (std::size_t m = 0; m < JUDGED_METHODS.size(); ++m) {
      all[m].add(counts[m]);
      print_row(name, JUDGED_METHODS[m], counts[m]);
    }
  }
  for (std::size_t m = 0; m < JUDGED_METHODS.size(); ++m) print_row("all", JUDGED_METHODS[m], all[m]);
  fmt::print(
      "\n{} of {} poses are at fault; of each method {} of {} places were demanded and the points of {} "
      "LMDs\n",
      wrong, judged, all[0].demanded, all[0].places, all[0].located);
  return static_cast<int>(wrong > 0 ? ExitCode::CHECK_FAILED : ExitCode::DONE);
}

}  // namespace

void add_rest(CLI::App& app, Run& chosen) {
  CLI::App* command = app.add_subcommand(
      "rest", "Judges contacts of parts that rest in each other, gaps of 0 to what is seen");
  const auto choice = std::make_shared<RestChoice>();
  command->add_option("--poses", choice->poses, "Of each fit, each of parts of its own")
      ->capture_default_str();
  command->add_option("--first", choice->first, "Number of the first of them")->capture_default_str();
  command->add_option("--seed", choice->seed, "Of the random numbers")->capture_default_str();
  command->add_option("--fit", choice->fits, "Such as 'box in corner', may be repeated; all without it");
  command->add_option("--complaints", choice->complaints, "Poses at fault that are told")
      ->capture_default_str();
  command->add_option("--out", choice->out, "Folder for the meshes and the pose of the first scene at fault");
  command->callback([&chosen, choice] {
    for (const std::string& fit : choice->fits) parts::rest_fit(fit);
    if (choice->fits.empty())
      for (const parts::RestFit& fit : parts::rest_fits()) choice->fits.emplace_back(fit.name);
    chosen = [choice] { return judge_rest(*choice); };
  });
}

}  // namespace lmdbench::exact
