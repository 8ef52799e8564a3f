// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/json_text.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/mesh/length_unit.h>
#include <lmdbench/mesh/orientation_choice.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/methods/query.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/plugin/judged_contacts.h>
#include <lmdbench/plugin/outsider_notes.h>
#include <lmdbench/shape/flatten.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

struct QueryOptions {
  std::string moving;
  std::string fixed;
  double cutoff = 0.0;
  std::string method = "certified";
  std::vector<std::string> options;
  std::string poses;
  std::string planar_tolerance = "auto";
  std::string unit = "m";
  std::string orient = "keep";
  std::string folder;
  bool critical = false;
  bool json = false;
};

/// In metres; only rounded planes and wrongly turned triangles are changed.
std::shared_ptr<const Body> load(const std::string& name, const QueryOptions& options, double metres) {
  PlanarTolerance tolerance = parse_planar_tolerance(options.planar_tolerance, "", "--planar-tolerance");
  if (tolerance.kind == PlanarTolerance::Kind::LENGTH) tolerance.value /= metres;
  TriangleMesh mesh = resolve_mesh(name, options.folder).mesh;
  if (parse_orientation(options.orient, "", "--orient") == OrientationChoice::OUTWARD)
    spdlog::info("{}: {}", name, to_text(orient_outward(mesh)));
  FlatteningReport flattening = flatten(mesh, tolerance);
  if (const std::string repairs = repairs_text(flattening); !repairs.empty())
    spdlog::info("{}: {}", name, repairs);
  flattening.tolerance *= metres;
  flattening.largest_move *= metres;
  if (says_something(flattening)) spdlog::info("{}: {}", name, to_text(flattening));
  try {
    mesh = placed(std::move(mesh), {.scale = metres});
  } catch (const InputError& error) {
    throw InputError(name, "--unit " + options.unit, error.what(), "");
  }
  auto body = std::make_shared<const Body>(name, build_surface(std::move(mesh)));
  for (const std::string& finding : findings(check_mesh(body->surface())))
    spdlog::warn("{}: {}", name, finding);
  return body;
}

Path poses_of(const QueryOptions& options) {
  if (options.poses.empty()) return {TimedPose{}};
  if (options.poses == "-") return read_tum(std::cin, "standard input");
  return read_tum(options.poses);
}

/// The method's options with the values of `--option`.
nlohmann::json chosen_options(const QueryOptions& options) {
  nlohmann::json chosen = nlohmann::json::object();
  std::set<std::string> keys;
  for (const std::string& option : options.options) {
    if (option.find('=') == std::string::npos)
      throw UsageError("", "--option " + option, "not of the form key=value", "for example --option key=3");
    if (const std::string key = option.substr(0, option.find('=')); !keys.insert(key).second)
      throw UsageError("", "--option " + option, fmt::format("{} is given twice", key), "give it once");
    apply_override(chosen, "/" + option);
  }
  return complete_options(method_description(options.method, "", "--method"), chosen, "--option");
}

void run_query(const QueryOptions& options, int& exit_status) {
  if (!(options.cutoff > 0.0 && options.cutoff <= LARGEST_COORDINATE))
    throw UsageError(
        "", "--cutoff",
        fmt::format("{} is not a distance above 0 and at most {:g}", options.cutoff, LARGEST_COORDINATE),
        "give metres, for example --cutoff 0.005");
  // First: a misspelt name or option should not wait for the meshes.
  const nlohmann::json method_options = chosen_options(options);
  if (options.critical && !method_description(options.method).finds_critical_pairs)
    throw UsageError("", "--critical", fmt::format("the method \"{}\" finds LMDs alone", options.method),
                     "take certified or exhaustive");
  const Path poses = poses_of(options);
  const auto [of_moving, of_fixed] = metres_of_units(options.unit, "--unit");
  const Scene scene{
      load(options.moving, options, of_moving), {load(options.fixed, options, of_fixed)}, options.cutoff};
  const std::unique_ptr<Method> method = make_method(options.method, scene, method_options);
  WorkCounters all;
  for (const TimedPose& pose : poses) {
    const QueryAnswer answer = options.critical ? query_critical(*method, pose.pose, pose.time)
                                                : query(*method, pose.pose, options.cutoff, pose.time);
    fmt::print("{}{}", options.json ? query_json(answer) : query_text(answer), options.json ? "\n" : "");
    for (std::size_t k = 0; k < answer.counters.size(); ++k)
      all.values[method->description().counters[k].index] += answer.counters[k].second;
  }
  for (const std::string& note : outsider_notes(method->description(), options.method, all))
    spdlog::warn("{}", note);
  // An empty set in place of an answer must not look like an answer.
  if (!method->description().plugin.empty() && all[PluginMark::LOST] > 0)
    exit_status = static_cast<int>(ExitCode::CHECK_FAILED);
}

}  // namespace

void add_query_command(CLI::App& app, int& exit_status) {
  auto* command = app.add_subcommand("query", "Print the LMD set of two meshes at one or many poses");
  const auto options = std::make_shared<QueryOptions>();
  command->add_option("--moving", options->moving, "moving mesh: a name of the manifest or a file")
      ->required();
  command->add_option("--fixed", options->fixed, "fixed mesh, likewise")->required();
  command->add_option("--cutoff", options->cutoff, "LMDs up to this distance [m]")->required();
  command->add_option("--method", options->method, fmt::format("one of {}", fmt::join(method_names(), ", ")))
      ->capture_default_str();
  command->add_option("--option", options->options, "an option of the method: key=value; repeatable")
      ->allow_extra_args(false);
  command->footer(fmt::format("{}\n{}", methods_help(), command->get_footer()));
  command->add_option(
      "--poses", options->poses,
      "TUM trajectory of the moving mesh, - for standard input; one identity pose without it");
  command
      ->add_option(
          "--planar-tolerance", options->planar_tolerance,
          "vertices this near to a common plane are put back into it: auto (what single-precision "
          "coordinates leave, nothing for others), off, metres, or percent of the diagonal (0.0001%)")
      ->capture_default_str();
  command
      ->add_option("--unit", options->unit,
                   "what a unit of the meshes' coordinates is: m, cm, mm, um, in, ft or a number of metres; "
                   "of the moving and "
                   "the fixed mesh with a comma: mm,m. Cutoff, poses and answers are in metres all the same")
      ->capture_default_str();
  command
      ->add_option(
          "--orient", options->orient,
          "keep, or outward: triangles are turned away from the solid, for meshes that are inside out")
      ->capture_default_str();
  add_mesh_folder_option(*command, options->folder);
  command->add_flag(
      "--critical", options->critical,
      "saddles too: all critical pairs of the distance, each with its index; over disjoint solids and an "
      "unlimited cutoff the indices add up to the product of their Euler characteristics");
  command->add_flag("--json", options->json, "one JSON object a pose, a line each");
  command->callback([options, &exit_status] { run_query(*options, exit_status); });
}

}  // namespace lmdbench
