// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/json_text.h>
#include <lmdbench/base/printable_text.h>
#include <lmdbench/catalogue/build_mesh.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/mesh/self_intersections.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/shape/flatten.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench {

namespace {

struct MeshArguments {
  std::vector<std::string> names;
  std::string folder;
  std::string planar_tolerance = "auto";
  bool json = false;
};

void print_info(const MeshArguments& arguments) {
  const PlanarTolerance tolerance =
      parse_planar_tolerance(arguments.planar_tolerance, "", "--planar-tolerance");
  for (const std::string& name : arguments.names) {
    ResolvedMesh resolved = resolve_mesh(name, arguments.folder);
    const FlatteningReport flattening = flatten(resolved.mesh, tolerance);
    const SelfIntersections crossings = self_intersections(resolved.mesh);
    const ValidityReport report = check_mesh(build_surface(std::move(resolved.mesh)));
    if (arguments.json) {
      nlohmann::ordered_json line{
          {"mesh", name},
          {"file", resolved.file ? nlohmann::ordered_json(resolved.file->string()) : nullptr},
          {"sha256", resolved.sha256}};
      line.update(to_json(report));
      line["repairs"] = {{"collapsed_triangles", flattening.collapsed_triangles},
                         {"flipped_triangles", flattening.flipped_triangles}};
      line["planes"] = {{"tolerance", flattening.tolerance},
                        {"planes", flattening.planes},
                        {"moved_vertices", flattening.moved_vertices},
                        {"largest_move", flattening.largest_move}};
      line["self_intersections"] = {
          {"pairs", crossings.pairs},
          {"first", crossings.first ? nlohmann::ordered_json(*crossings.first) : nullptr},
          {"complete", crossings.complete}};
      fmt::print("{}\n", json_line(line));
    } else {
      const std::string repairs = repairs_text(flattening);
      fmt::print("mesh          {}\n{}crosses self  {}\nplanes        {}\n{}", printable(name),
                 to_text(report), to_text(crossings), to_text(flattening),
                 repairs.empty() ? "" : fmt::format("repairs       {}\n", repairs));
    }
    std::fflush(stdout);
  }
}

void print_outcome(const BuildOutcome& outcome, bool json) {
  const char* state = outcome.up_to_date ? "up to date" : "built";
  if (json) {
    const nlohmann::ordered_json line{
        {"mesh", outcome.name},     {"file", outcome.file.string()},
        {"state", state},           {"triangles", outcome.triangles},
        {"sha256", outcome.sha256}, {"matches_manifest", outcome.matches_manifest}};
    fmt::print("{}\n", json_line(line));
  } else if (talk_welcome()) {
    fmt::print("{:<20} {:>8} triangles  {:<10}  {}\n", outcome.name, outcome.triangles, state,
               outcome.file.string());
  }
  std::fflush(stdout);
}

const ManifestEntry& entry_of(const Manifest& manifest, const std::string& name) {
  if (const ManifestEntry* entry = manifest.find(name)) return *entry;
  throw UsageError("", "NAME", fmt::format("{} has no mesh '{}'", manifest.file.string(), name),
                   fmt::format("'{}' shows the names", mesh_command(manifest, "list")));
}

void build(const MeshArguments& arguments) {
  const Manifest manifest = load_manifest(std::filesystem::path(arguments.folder) / "manifest.json");
  std::vector<const ManifestEntry*> entries;
  for (const std::string& name : arguments.names) {
    if (is_mesh_name(name))
      entries.push_back(&entry_of(manifest, name));
    else
      spdlog::info("{} is a file: nothing to build", name);
  }
  if (arguments.names.empty())
    for (const ManifestEntry& entry : manifest.entries) {
      if (entry.optional)
        spdlog::info("{} is optional and left out: 'lmdbench mesh build {}' makes it", entry.name,
                     entry.name);
      else
        entries.push_back(&entry);
    }
  for (const ManifestEntry* entry : entries) {
    const BuildOutcome outcome =
        build_mesh(manifest, *entry, [](const std::string& sentence) { spdlog::info("{}", sentence); });
    if (!outcome.matches_manifest)
      spdlog::warn(
          "{} differs from the manifest ({} triangles, wanted {}; SHA-256 {}, wanted {}): another version of "
          "a tool made it. It is usable, but results on it do not compare frame by frame with recorded ones",
          outcome.file.string(), outcome.triangles, entry->triangles, outcome.sha256,
          entry->sha256.empty() ? "any" : entry->sha256);
    print_outcome(outcome, arguments.json);
  }
}

void list(const MeshArguments& arguments) {
  const Manifest manifest = load_manifest(std::filesystem::path(arguments.folder) / "manifest.json");
  for (const ManifestEntry& entry : manifest.entries) {
    if (arguments.json) {
      nlohmann::ordered_json line{{"mesh", entry.name},
                                  {"description", entry.description},
                                  {"generated", entry.shape.has_value()},
                                  {"triangles", entry.triangles}};
      if (entry.source) line.update({{"licence", entry.source->licence}, {"credit", entry.source->credit}});
      fmt::print("{}\n", json_line(line));
    } else {
      fmt::print("{:<20} {:>8} triangles  {}\n", entry.name, entry.triangles, printable(entry.description));
    }
  }
}

}  // namespace

void add_mesh_folder_option(CLI::App& command, std::string& folder) {
  folder = default_mesh_folder().string();
  command.add_option("--dir", folder,
                     "folder of manifest.json; without it meshes/, or where that has none the program's own");
}

void add_mesh_command(CLI::App& app) {
  CLI::App* mesh = app.add_subcommand("mesh", "check meshes, and make those of the manifest");
  mesh->require_subcommand(1);
  const auto arguments = std::make_shared<MeshArguments>();
  const auto add_common = [&](CLI::App* command) {
    add_mesh_folder_option(*command, arguments->folder);
    command->add_flag("--json", arguments->json, "one JSON object a mesh, a line each");
  };

  CLI::App* info = mesh->add_subcommand(
      "info",
      "report what a mesh is like, as a run takes it: closed, manifold, outward, degenerate triangles, "
      "crossings with itself");
  info->add_option("MESH", arguments->names, "names of the manifest or mesh files")->required();
  info->add_option("--planar-tolerance", arguments->planar_tolerance,
                   "as in query: auto, off, metres, or percent of the diagonal")
      ->capture_default_str();
  add_common(info);
  info->callback([arguments] { print_info(*arguments); });

  CLI::App* build_command = mesh->add_subcommand(
      "build", "make meshes of the manifest: fetch their sources out of packages, check, decimate, write");
  build_command->add_option("NAME", arguments->names,
                            "names of the manifest; all but the optional ones when none is given");
  add_common(build_command);
  build_command->callback([arguments] { build(*arguments); });

  CLI::App* list_command = mesh->add_subcommand("list", "show the manifest");
  add_common(list_command);
  list_command->callback([arguments] { list(*arguments); });
}

}  // namespace lmdbench
