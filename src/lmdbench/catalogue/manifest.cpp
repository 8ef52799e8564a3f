// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/json_document.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shape_recipe.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace lmdbench {

const std::string& manifest_schema_text();  // manifest.schema.json, compiled in

namespace {

constexpr const char* MANIFEST_FILE = "manifest.json";
constexpr const char* MANIFEST_REMEDY = "correct the manifest; its keys are explained in meshes/README.md";

/// Whether a relative path stays in its folder.
bool stays_inside(std::string_view path) {
  for (;;) {
    const std::size_t end = path.find('/');
    const std::string_view part = path.substr(0, end);
    if (part.empty() || part == "." || part == ".." || part.find('\0') != std::string_view::npos)
      return false;
    if (end == std::string_view::npos) return true;
    path.remove_prefix(end + 1);
  }
}

MeshSource read_source(const std::string& name, const nlohmann::json& source, const JsonDocument& document) {
  MeshSource result;
  result.name = name;
  result.registry = source.at("registry") == "npm" ? MeshRegistry::NPM : MeshRegistry::DEBIAN;
  const bool npm = result.registry == MeshRegistry::NPM;
  if (npm != source.contains("version") || npm == source.contains("archive"))
    document.fail("/sources/" + name,
                  npm ? "is of npm: it needs 'version' and has no 'archive'"
                      : "is of Debian: it needs 'archive' and has no 'version'",
                  MANIFEST_REMEDY);
  for (const char* key : {"archive", "path"})
    if (source.contains(key) && !stays_inside(source.at(key).get<std::string>()))
      document.fail(fmt::format("/sources/{}/{}", name, key), "leads out of its archive, or is no plain path",
                    "name it by its parts, without '.', '..' and empty ones");
  result.package = source.at("package");
  result.version = source.value("version", "");
  result.archive = source.value("archive", "");
  result.path = source.at("path");
  result.sha256 = source.at("sha256");
  result.licence = source.at("licence");
  result.credit = source.at("credit");
  return result;
}

ManifestEntry read_entry(const std::string& name, const JsonDocument& document) {
  const nlohmann::json& mesh = document.json().at("meshes").at(name);
  const nlohmann::json& sources = document.json().at("sources");
  const auto fail = [&](const std::string& problem) {
    document.fail("/meshes/" + name, problem, MANIFEST_REMEDY);
  };
  if (!is_mesh_name(name)) fail("is no mesh name: lower-case letters, digits and dashes only");
  if (mesh.contains("source") == mesh.contains("shape")) fail("needs either 'source' or 'shape'");
  ManifestEntry entry;
  entry.name = name;
  entry.description = mesh.at("description");
  entry.triangles = mesh.at("triangles");
  entry.sha256 = mesh.value("sha256", "");
  entry.optional = mesh.at("optional");
  if (mesh.contains("target_triangles")) entry.target_triangles = mesh.at("target_triangles");
  if (mesh.contains("shape")) {
    if (entry.target_triangles) fail("is a shape: 'target_triangles' is for sources");
    entry.shape = mesh.at("shape");
    return entry;
  }
  const std::string key = mesh.at("source");
  if (!sources.contains(key)) fail(fmt::format("names the source '{}', which is not in /sources", key));
  entry.source = read_source(key, sources.at(key), document);
  return entry;
}

ResolvedMesh resolve_entry(const ManifestEntry& entry, const Manifest& manifest) {
  ResolvedMesh resolved;
  resolved.name = entry.name;
  if (entry.shape) {
    resolved.mesh = make_shape(*entry.shape, manifest.file.string(), "/meshes/" + entry.name + "/shape");
    resolved.sha256 = sha256_of_text(to_off_text(resolved.mesh));
    return resolved;
  }
  const auto file = manifest.built_file(entry);
  if (!std::filesystem::exists(file))
    throw InputError(file.string(), "", fmt::format("mesh '{}' is not built yet", entry.name),
                     fmt::format("run '{}'", mesh_command(manifest, "build " + entry.name)));
  const FileContent content = read_mesh_file(file);
  resolved.mesh = import_mesh(content);
  resolved.sha256 = content.sha256;
  resolved.size = static_cast<std::int64_t>(content.bytes.size());
  resolved.file = file;
  return resolved;
}

ResolvedMesh resolve_path(const std::string& path) {
  const FileContent content = read_mesh_file(path);
  return {path, import_mesh(content), std::filesystem::path(path), content.sha256,
          static_cast<std::int64_t>(content.bytes.size())};
}

}  // namespace

const ManifestEntry* Manifest::find(std::string_view name) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

std::filesystem::path Manifest::built_file(const ManifestEntry& entry) const {
  return built_mesh_file(file.parent_path(), entry.name);
}

std::filesystem::path default_mesh_folder(const std::filesystem::path& near) {
  const std::filesystem::path own = data_folder() / "meshes";
  std::error_code none;
  const auto has_one = [&](const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / MANIFEST_FILE, none);
  };
  return has_one(near) || !has_one(own) ? near : own;
}

std::filesystem::path built_mesh_folder(const std::filesystem::path& folder) {
  if (::access(folder.empty() ? "." : folder.c_str(), W_OK) == 0 || errno == ENOENT) return folder;
  const char* data = std::getenv("XDG_DATA_HOME");
  const char* home = std::getenv("HOME");
  const std::filesystem::path below = std::filesystem::path("lmdbench") / "meshes";
  if (data != nullptr && *data == '/') return data / below;
  return home != nullptr && *home == '/' ? std::filesystem::path(home) / ".local" / "share" / below : folder;
}

std::filesystem::path built_mesh_file(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path built = built_mesh_folder(folder) / (name + ".off"),
                              beside = folder / (name + ".off");
  std::error_code none;
  return std::filesystem::exists(built, none) || !std::filesystem::exists(beside, none) ? built : beside;
}

std::string mesh_command(const Manifest& manifest, const std::string& words) {
  const std::filesystem::path folder = manifest.file.parent_path();
  std::error_code none;
  if (std::filesystem::equivalent(default_mesh_folder(), folder.empty() ? "." : folder, none))
    return "lmdbench mesh " + words;
  const char* quote = folder.native().find_first_of(" '") == std::string::npos ? "" : "\"";
  return fmt::format("lmdbench mesh {} --dir {}{}{}", words, quote, folder.string(), quote);
}

Manifest load_manifest(const std::filesystem::path& file) {
  const InputKind kind{.what = "mesh manifest",
                       .most_bytes = Limit::JSON_BYTES,
                       .remedy =
                           "name the folder of a manifest (--dir, in an experiment \"mesh_folder\"), or a "
                           "mesh file by its path "
                           "(with a / or a .)"};
  return parse_manifest(read_input_file(file, kind).bytes, file);
}

Manifest parse_manifest(const std::string& text, const std::filesystem::path& file) {
  static const nlohmann::json schema = nlohmann::json::parse(manifest_schema_text());
  const JsonDocument document(text, file.string(), schema, ExitCode::INPUT_DATA);
  Manifest manifest;
  manifest.file = file;
  // Meshes keep the file's order.
  const auto in_order = nlohmann::ordered_json::parse(document.text());
  for (const auto& mesh : in_order.at("meshes").items())
    manifest.entries.push_back(read_entry(mesh.key(), document));
  return manifest;
}

bool is_mesh_name(std::string_view text) {
  const auto is_plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  return !text.empty() && is_plain(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return is_plain(c) || c == '-'; });
}

ResolvedMesh resolve_mesh(const std::string& name_or_path, const std::filesystem::path& folder) {
  if (!is_mesh_name(name_or_path)) return resolve_path(name_or_path);
  return resolve_mesh(name_or_path, load_manifest(folder / MANIFEST_FILE));
}

ResolvedMesh resolve_mesh(const std::string& name_or_path, const Manifest& manifest) {
  if (!is_mesh_name(name_or_path)) return resolve_path(name_or_path);
  if (const ManifestEntry* entry = manifest.find(name_or_path)) return resolve_entry(*entry, manifest);
  std::vector<std::string> names;
  for (const ManifestEntry& entry : manifest.entries) names.push_back(entry.name);
  throw InputError(
      manifest.file.string(), "", fmt::format("knows no mesh '{}'", name_or_path),
      fmt::format("choose one of {}; or name a file by its path (with a / or a .)", fmt::join(names, ", ")));
}

}  // namespace lmdbench
