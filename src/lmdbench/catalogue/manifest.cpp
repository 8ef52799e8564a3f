// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/json_text.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/catalogue/manifest_schema.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shape_recipe.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include <algorithm>

namespace lmdbench {

namespace {

constexpr const char* MANIFEST_REMEDY = "correct the manifest; its keys are explained in meshes/README.md";

// Ordered, so that meshes keep the file's order.
nlohmann::ordered_json parse(const std::filesystem::path& file) {
  const InputKind kind{
      .what = "mesh manifest",
      .most_bytes = Limit::JSON_BYTES,
      .remedy = "run in the folder that holds meshes/, or name a mesh file by its path (with a / or a .)"};
  const std::string text = read_input_file(file, kind).bytes;
  try {
    static_cast<void>(parse_json(text, file.string()));
  } catch (const UsageError& error) {
    throw InputError("", "", error.what(), "");
  }
  return nlohmann::ordered_json::parse(text);
}

std::string pointer_of(const std::vector<std::string>& context) {
  std::string pointer;
  // The first item is "<root>"; the others are "[key]".
  for (std::size_t i = 1; i < context.size(); ++i) {
    std::string_view item = context[i];
    if (item.size() > 2 && item.front() == '[' && item.back() == ']') item = item.substr(1, item.size() - 2);
    pointer += fmt::format("/{}", item);
  }
  return pointer;
}

void validate(const nlohmann::json& document, const std::filesystem::path& file) {
  const nlohmann::json schema_json = nlohmann::json::parse(MANIFEST_SCHEMA);
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::ValidationResults results;
  if (valijson::Validator().validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &results))
    return;
  // The error deepest in the document says most.
  const auto deepest = std::max_element(results.begin(), results.end(), [](const auto& a, const auto& b) {
    return a.context.size() < b.context.size();
  });
  throw InputError(file.string(), pointer_of(deepest->context), deepest->description, MANIFEST_REMEDY);
}

/// Whether a relative path has only plain parts.
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

MeshSource read_source(const std::string& name, const nlohmann::ordered_json& source,
                       const std::string& file) {
  MeshSource result;
  result.name = name;
  result.registry = source.value("registry", "debian") == "npm" ? MeshRegistry::NPM : MeshRegistry::DEBIAN;
  const bool npm = result.registry == MeshRegistry::NPM;
  if (npm != source.contains("version") || npm == source.contains("archive"))
    throw InputError(file, "/sources/" + name,
                     npm ? "is of npm: it needs 'version' and has no 'archive'"
                         : "is of Debian: it needs 'archive' and has no 'version'",
                     MANIFEST_REMEDY);
  for (const char* key : {"archive", "path"})
    if (source.contains(key) && !stays_inside(source.at(key).get<std::string>()))
      throw InputError(file, fmt::format("/sources/{}/{}", name, key),
                       "leads out of its archive, or is no plain path",
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

ManifestEntry read_entry(const std::string& name, const nlohmann::ordered_json& mesh,
                         const nlohmann::ordered_json& sources, const std::string& file) {
  const std::string pointer = "/meshes/" + name;
  const auto fail = [&](const std::string& problem) {
    throw InputError(file, pointer, problem, MANIFEST_REMEDY);
  };
  if (!is_mesh_name(name)) fail("is no mesh name: lower-case letters, digits and dashes only");
  if (mesh.contains("source") == mesh.contains("shape")) fail("needs either 'source' or 'shape'");
  ManifestEntry entry;
  entry.name = name;
  entry.description = mesh.at("description");
  entry.triangles = mesh.at("triangles");
  entry.sha256 = mesh.value("sha256", "");
  entry.optional = mesh.value("optional", false);
  if (mesh.contains("target_triangles")) entry.target_triangles = mesh.at("target_triangles");
  if (mesh.contains("shape")) {
    if (entry.target_triangles) fail("is a shape: 'target_triangles' is for sources");
    entry.shape = mesh.at("shape");
    return entry;
  }
  const std::string key = mesh.at("source");
  if (!sources.contains(key)) fail(fmt::format("names the source '{}', which is not in /sources", key));
  entry.source = read_source(key, sources.at(key), file);
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
                     fmt::format("run 'lmdbench mesh build {}'", entry.name));
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
  return file.parent_path() / (entry.name + ".off");
}

Manifest load_manifest(const std::filesystem::path& file) {
  const nlohmann::ordered_json document = parse(file);
  validate(nlohmann::json(document), file);
  Manifest manifest;
  manifest.file = file;
  for (const auto& [name, mesh] : document.at("meshes").items())
    manifest.entries.push_back(read_entry(name, mesh, document.at("sources"), file.string()));
  return manifest;
}

bool is_mesh_name(std::string_view text) {
  const auto is_plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  return !text.empty() && is_plain(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return is_plain(c) || c == '-'; });
}

ResolvedMesh resolve_mesh(const std::string& name_or_path, const std::filesystem::path& folder) {
  if (!is_mesh_name(name_or_path)) return resolve_path(name_or_path);
  return resolve_mesh(name_or_path, load_manifest(folder / "manifest.json"));
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
