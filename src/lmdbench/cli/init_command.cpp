// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/output_guard.h>
#include <lmdbench/base/plain_name.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/progress_bar.h>
#include <lmdbench/prepare/new_experiment.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>

namespace lmdbench {

void add_init_command(CLI::App& app) {
  struct InitOptions {
    std::string moving;
    std::string fixed;
    std::string out = ".";
    std::string mesh_folder;
    std::string unit;
    std::string orient;
    std::string place;
    bool contact = false;
  };
  auto* command = app.add_subcommand(
      "init", "Write an experiment for two meshes, with a path that grazes: ready to run and to edit");
  const auto options = std::make_shared<InitOptions>();
  command->add_option("MOVING", options->moving, "mesh that moves: a file, or a name of the manifest")
      ->required();
  command->add_option("FIXED", options->fixed, "mesh that stands")->required();
  command->add_option("--out,-o", options->out, "folder of the new files")->capture_default_str();
  add_mesh_folder_option(*command, options->mesh_folder);
  command->add_option(
      "--unit", options->unit,
      "what a unit of the files' coordinates is: m, cm, mm, um, in, ft or a number of "
      "metres; of the moving and the "
      "fixed mesh with a comma: mm,m. Without it metres for glTF; for other files millimetres "
      "where one of them spans more than 10, else metres");
  command->add_option("--orient", options->orient,
                      "keep, or outward: triangles are turned away from the solid; without it outward for "
                      "meshes that need it");
  command
      ->add_option("--place", options->place,
                   "keep: parts stay where their files have them, so that the identity as a pose is their "
                   "place in an assembly; "
                   "centre: each about its own middle. Without it keep for files of one unit that place them "
                   "in or next to each other")
      ->check(CLI::IsMember({"keep", "centre"}));
  command->add_flag(
      "--contact", options->contact,
      "begin at rest in contact, in a closed loop: for `lmdbench stability`; no path that grazes");
  command->callback([options] {
    refuse_no_folder(options->out, "--out");
    InitChoices chosen;
    if (!options->unit.empty()) chosen.unit = options->unit;
    if (!options->orient.empty()) chosen.orientation = parse_orientation(options->orient, "", "--orient");
    if (!options->place.empty()) chosen.keep_place = options->place == "keep";
    chosen.contact = options->contact;
    ProgressBar bar(talk_welcome());
    const NewExperiment made = new_experiment(
        options->moving, options->fixed, options->out, options->mesh_folder,
        [&bar, phase = std::string(chosen.contact ? "resting pose" : "path")](
            std::int64_t done, std::int64_t total) { return bar(phase, done, total); },
        chosen);
    bar.wipe();
    write_new_experiment(made);
    for (const std::string& warning : made.warnings) spdlog::warn("{}", warning);
    if (!talk_welcome()) return;
    fmt::print("{}\n", made.experiment_file.string());
    if (!made.specification_text.empty()) fmt::print("{}\n", made.specification_file.string());
    fmt::print("{}\n", made.path_file.string());
    for (const DefaultNote& choice : made.choices)
      fmt::print("  {:<24} {} ({})\n", choice.key, choice.value, choice.from);
    if (chosen.contact)
      fmt::print(
          "edit them, then: lmdbench stability {0}\nor let the hand press it there: lmdbench run {0} --set "
          "'{1}'\n",
          shell_word(made.experiment_file.string()), made.press);
    else
      fmt::print("edit them, then: lmdbench run {}\nanother path: lmdbench path generate {} --out {}\n",
                 shell_word(made.experiment_file.string()), shell_word(made.specification_file.string()),
                 shell_word(made.path_file.string()));
  });
}

}  // namespace lmdbench
