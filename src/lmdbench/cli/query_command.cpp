// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/experiment/query.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/motion/tum_file.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

namespace lmdbench {
namespace {

struct QueryOptions {
  std::string moving;
  std::string fixed;
  double cutoff = 0.0;
  std::string method = "certified";
  std::string poses;
  std::string folder = DEFAULT_MESH_FOLDER;
  bool json = false;
};

/// Coordinates are metres, taken as they are.
std::shared_ptr<const Body> load(const std::string& name, const std::string& folder) {
  auto body = std::make_shared<const Body>(name, build_surface(resolve_mesh(name, folder).mesh));
  for (const std::string& finding : findings(check_mesh(body->surface())))
    spdlog::warn("{}: {}", name, finding);
  return body;
}

Path poses_of(const QueryOptions& options) {
  if (options.poses.empty()) return {TimedPose{}};
  if (options.poses == "-") return read_tum(std::cin, "standard input");
  return read_tum(options.poses);
}

void run(const QueryOptions& options) {
  if (!(options.cutoff > 0.0 && options.cutoff <= LARGEST_COORDINATE))
    throw UsageError(
        "", "--cutoff",
        fmt::format("{} is not a distance above 0 and at most {:g}", options.cutoff, LARGEST_COORDINATE),
        "give metres, for example --cutoff 0.005");
  const auto& names = method_names();
  if (std::find(names.begin(), names.end(), options.method) == names.end())
    make_method(options.method, Scene{});  // throws; an unknown name should not wait for the meshes
  const Path poses = poses_of(options);
  const Scene scene{
      load(options.moving, options.folder), {load(options.fixed, options.folder)}, options.cutoff};
  const std::unique_ptr<Method> method = make_method(options.method, scene);
  for (const TimedPose& pose : poses) {
    const QueryAnswer answer = query(*method, pose, options.cutoff);
    fmt::print("{}{}", options.json ? query_json(answer) : query_text(answer), options.json ? "\n" : "");
  }
}

}  // namespace

void add_query_command(CLI::App& app) {
  auto* command = app.add_subcommand("query", "Print the LMD set of two meshes at one or many poses");
  const auto options = std::make_shared<QueryOptions>();
  command->add_option("--moving", options->moving, "moving mesh: a name of the manifest or a file; metres")
      ->required();
  command->add_option("--fixed", options->fixed, "fixed mesh, likewise")->required();
  command->add_option("--cutoff", options->cutoff, "LMDs up to this distance [m]")->required();
  std::string names;
  for (const std::string_view name : method_names()) names += (names.empty() ? "" : ", ") + std::string(name);
  command->add_option("--method", options->method, "one of " + names)->capture_default_str();
  command->add_option(
      "--poses", options->poses,
      "TUM trajectory of the moving mesh, - for standard input; one identity pose without it");
  command->add_option("--dir", options->folder, "folder of manifest.json and of the built meshes")
      ->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object a pose, a line each");
  command->callback([options] { run(*options); });
}

}  // namespace lmdbench
