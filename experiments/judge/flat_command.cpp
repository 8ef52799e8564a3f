// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/methods/registry.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <judge/flat_judge.h>
#include <judge/judges.h>
#include <support/parts/parts_scenes.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

/// lmdbench-judge flat [--poses N] [--seed S] [--kind K]...: judges `exhaustive` and `certified` on
/// machine parts flush on and in each other. A table on standard output, errors on standard error.
/// Exit code 1 where there is one.
namespace lmdbench::exact {
namespace {

struct FlatChoice {
  std::size_t poses = 1000;
  std::uint64_t seed = 1;
  std::vector<std::string> kinds;
  std::size_t complaints = 20;
};

using CountsOfMethods = std::array<FlatCounts, JUDGED_METHODS.size()>;

std::string pose_text(const Pose& X_WM) {
  const Vec3& p = X_WM.translation;
  const Eigen::Quaterniond& q = X_WM.rotation;
  return fmt::format(
      "{{Vec3({:.17g}, {:.17g}, {:.17g}), Eigen::Quaterniond({:.17g}, {:.17g}, {:.17g}, {:.17g})}}", p.x(),
      p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}

template <typename Complain>
void judge_scene(const parts::PartsChoice& choice, std::size_t poses, CountsOfMethods& counts,
                 const Complain& complain) {
  const parts::PartsScene parts = make_parts_scene(choice);
  std::vector<std::unique_ptr<Method>> methods;
  for (const char* const name : JUDGED_METHODS) methods.push_back(make_method(name, parts.scene));
  for (std::size_t i = 0; i < std::min(poses, parts.poses.size()); ++i) {
    const Pose& X_WM = parts.poses[i];
    const FlatTruth truth(parts.scene.moving->surface(), parts.scene.fixed[0]->surface(), X_WM,
                          parts.scene.cutoff);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const LmdSet lmds = lmds_at(*methods[m], X_WM);
      std::string objections;
      counts[m] += truth.judge(lmds, objections);
      if (!objections.empty())
        complain(fmt::format("{}: {}, {}, seed {}, scene {}, pose {}: {}\n{}", JUDGED_METHODS[m], choice.kind,
                             name_of(choice.coordinates), choice.seed, choice.index, i, pose_text(X_WM),
                             objections));
    }
  }
}

void print_row(const std::string& kind, const char* method, const FlatCounts& c) {
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", kind, method,
             c.poses, c.touching_poses, c.tolerance_poses, c.faulty_poses, c.basins, c.areas, c.right,
             c.with_way_down, c.missed, c.doubled, c.untrue, c.misplaced);
  std::fflush(stdout);
}

int judge_flat(const FlatChoice& choice) {
  std::size_t told = 0;
  const auto complain = [&](const std::string& what) {
    if (++told <= choice.complaints) fmt::print(stderr, "{}", what);
  };
  fmt::print(
      "| kind | method | poses | touching | left to tolerance | at fault | basins | with an area | right | "
      "with a way "
      "down | missed | doubled | untrue | misplaced "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  CountsOfMethods all;
  for (std::size_t k = 0; k < choice.kinds.size(); ++k) {
    CountsOfMethods counts;
    std::size_t left = choice.poses / choice.kinds.size() + (k < choice.poses % choice.kinds.size());
    for (std::size_t index = 0; left > 0; ++index) {
      const parts::Coordinates coordinates =
          index % 2 == 0 ? parts::Coordinates::EXACT : parts::Coordinates::RECUT;
      judge_scene({choice.kinds[k], coordinates, choice.seed, index, parts::PoseFamily::FLUSH}, left, counts,
                  complain);
      left -= std::min(left, parts::POSES_A_SCENE);
    }
    for (std::size_t m = 0; m < JUDGED_METHODS.size(); ++m) {
      all[m] += counts[m];
      print_row(choice.kinds[k], JUDGED_METHODS[m], counts[m]);
    }
  }
  bool wrong = false;
  for (std::size_t m = 0; m < JUDGED_METHODS.size(); ++m) {
    print_row("all", JUDGED_METHODS[m], all[m]);
    wrong = wrong || all[m].faulty_poses > 0;
  }
  return static_cast<int>(wrong ? ExitCode::CHECK_FAILED : ExitCode::DONE);
}

}  // namespace

void add_flat(CLI::App& app, Run& chosen) {
  CLI::App* command =
      app.add_subcommand("flat", "Judges flat contact of generated machine parts, triangle by triangle");
  const auto choice = std::make_shared<FlatChoice>();
  command->add_option("--poses", choice->poses, "Poses of all kinds of parts together")
      ->capture_default_str();
  command->add_option("--seed", choice->seed, "Of the random numbers")->capture_default_str();
  command->add_option("--kind", choice->kinds, "Such as 'ring on ring', may be repeated; all without it");
  command->add_option("--complaints", choice->complaints, "Poses at fault that are told")
      ->capture_default_str();
  command->callback([&chosen, choice] {
    for (const std::string& kind : choice->kinds) parts::parts_kind(kind);
    if (choice->kinds.empty())
      for (const parts::PartsKind& kind : parts::parts_kinds()) choice->kinds.emplace_back(kind.name);
    chosen = [choice] { return judge_flat(*choice); };
  });
}

}  // namespace lmdbench::exact
