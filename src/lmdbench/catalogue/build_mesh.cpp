// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/catalogue/build_mesh.h>
#include <lmdbench/catalogue/decimate.h>
#include <lmdbench/catalogue/fetch_source.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shape_recipe.h>

#include <fmt/format.h>

namespace lmdbench {

namespace {

TriangleMesh realise(const Manifest& manifest, const ManifestEntry& entry, const Tell& tell) {
  if (entry.shape)
    return make_shape(*entry.shape, manifest.file.string(), "/meshes/" + entry.name + "/shape");
  const auto source = fetch_source(*entry.source, manifest.file.parent_path() / "sources", tell);
  const FileContent content = read_mesh_file(source);
  if (content.sha256 != entry.source->sha256)
    throw InputError(source.string(), "", "has changed since it was checked", "build the mesh again");
  TriangleMesh mesh = import_mesh(content);
  if (!entry.target_triangles) return mesh;
  tell(fmt::format("decimating {} from {} to {} triangles", entry.name, mesh.triangles.size(),
                   *entry.target_triangles));
  return decimate(mesh, *entry.target_triangles, entry.name).mesh;
}

}  // namespace

BuildOutcome build_mesh(const Manifest& manifest, const ManifestEntry& entry, const Tell& tell) {
  BuildOutcome outcome;
  outcome.name = entry.name;
  outcome.file = manifest.built_file(entry);
  if (!entry.sha256.empty() && std::filesystem::exists(outcome.file) &&
      sha256_of_file(outcome.file) == entry.sha256) {
    outcome.up_to_date = true;
    outcome.matches_manifest = true;
    outcome.sha256 = entry.sha256;
    outcome.triangles = entry.triangles;
    return outcome;
  }
  const OutputKind built{"built mesh",
                         [](const std::filesystem::path& file) { return file_begins_with(file, "OFF\n"); }};
  refuse_unsafe_output(outcome.file, built, {manifest.file}, "--dir");
  const TriangleMesh mesh = realise(manifest, entry, tell);
  write_off(outcome.file, mesh);
  outcome.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  outcome.sha256 = sha256_of_file(outcome.file);
  outcome.matches_manifest =
      outcome.triangles == entry.triangles && (entry.sha256.empty() || outcome.sha256 == entry.sha256);
  return outcome;
}

}  // namespace lmdbench
