// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shapes.h>

#include "support/message_of.h"
#include "support/scratch_directory.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/source_directory.h>

#include <functional>
#include <string>

namespace lmdbench {
namespace {

using testing::message_of;
using testing::ScratchDirectory;

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

json small_manifest() {
  return json::parse(R"({
    "format": "lmdbench-mesh-manifest", "format_version": 1,
    "sources": {"thing": {"package": "some-package", "archive": "a/b.tar.gz", "path": "data/thing.off",
                          "sha256": "0000000000000000000000000000000000000000000000000000000000000000",
                          "licence": "none", "credit": "nobody"}},
    "meshes": {"thing-1k": {"description": "d", "source": "thing", "target_triangles": 1000, "triangles": 1000},
               "block": {"description": "d", "shape": {"kind": "l-block", "size": 1.0}, "triangles": 20}}
  })");
}

TEST(ManifestTest, ReadsEntriesWithTheirSources) {
  const ScratchDirectory folder;
  const Manifest manifest = load_manifest(folder.write("manifest.json", small_manifest().dump()));
  ASSERT_EQ(manifest.entries.size(), 2u);
  const ManifestEntry* thing = manifest.find("thing-1k");
  ASSERT_NE(thing, nullptr);
  ASSERT_TRUE(thing->source);
  EXPECT_EQ(thing->source->package, "some-package");
  EXPECT_EQ(thing->source->path, "data/thing.off");
  EXPECT_EQ(thing->target_triangles, 1000);
  EXPECT_EQ(manifest.built_file(*thing), folder.path() / "thing-1k.off");
  EXPECT_EQ(manifest.find("nothing"), nullptr);
  EXPECT_TRUE(manifest.find("block")->shape);
}

TEST(ManifestTest, ReadsNpmSourcesAndOptionalMeshes) {
  const ScratchDirectory folder;
  json document = small_manifest();
  json& source = document["sources"]["thing"];
  source.erase("archive");
  source["registry"] = "npm";
  source["version"] = "1.1.1";
  document["meshes"]["thing-1k"]["optional"] = true;
  const Manifest manifest = load_manifest(folder.write("manifest.json", document.dump()));
  const ManifestEntry* thing = manifest.find("thing-1k");
  EXPECT_TRUE(thing->optional);
  EXPECT_FALSE(manifest.find("block")->optional);
  EXPECT_EQ(thing->source->registry, MeshRegistry::NPM);
  EXPECT_EQ(thing->source->version, "1.1.1");
}

struct BadManifest {
  std::string name;
  std::function<void(json&)> spoil;
  std::string place;
};

class BadManifestTest : public ::testing::TestWithParam<BadManifest> {};

TEST_P(BadManifestTest, IsRefusedWithItsPlace) {
  const ScratchDirectory folder;
  json document = small_manifest();
  GetParam().spoil(document);
  const std::filesystem::path file = folder.write("manifest.json", document.dump());
  EXPECT_THAT(message_of<InputError>([&] { load_manifest(file); }),
              AllOf(HasSubstr(file.string()), HasSubstr(GetParam().place), HasSubstr("remedy")));
}

INSTANTIATE_TEST_SUITE_P(
    Documents, BadManifestTest,
    ::testing::Values(
        BadManifest{"format", [](json& d) { d["format"] = "x"; }, "/format"},
        BadManifest{"version", [](json& d) { d["format_version"] = 2; }, "/format_version"},
        BadManifest{"no_meshes", [](json& d) { d.erase("meshes"); }, "meshes"},
        BadManifest{"hash", [](json& d) { d["sources"]["thing"]["sha256"] = "abc"; },
                    "/sources/thing/sha256"},
        BadManifest{"absolute", [](json& d) { d["sources"]["thing"]["path"] = "/etc/passwd"; },
                    "/sources/thing/path"},
        BadManifest{"option", [](json& d) { d["sources"]["thing"]["archive"] = "--x"; },
                    "/sources/thing/archive"},
        BadManifest{"registry", [](json& d) { d["sources"]["thing"]["registry"] = "attic"; },
                    "/sources/thing/registry"},
        BadManifest{"npm_without_version", [](json& d) { d["sources"]["thing"]["registry"] = "npm"; },
                    "/sources/thing"},
        BadManifest{"debian_without_archive", [](json& d) { d["sources"]["thing"].erase("archive"); },
                    "/sources/thing"},
        BadManifest{"package", [](json& d) { d["sources"]["thing"]["package"] = "-o x"; },
                    "/sources/thing/package"},
        BadManifest{"no_licence", [](json& d) { d["sources"]["thing"].erase("licence"); }, "/sources/thing"},
        BadManifest{"count", [](json& d) { d["meshes"]["block"]["triangles"] = -1; },
                    "/meshes/block/triangles"},
        BadManifest{"unknown_key", [](json& d) { d["meshes"]["block"]["colour"] = 1; },
                    "/meshes/block/colour"},
        BadManifest{"both", [](json& d) { d["meshes"]["block"]["source"] = "thing"; }, "/meshes/block"},
        BadManifest{"neither", [](json& d) { d["meshes"]["block"].erase("shape"); }, "/meshes/block"},
        BadManifest{"unknown_source", [](json& d) { d["meshes"]["thing-1k"]["source"] = "gone"; }, "'gone'"},
        BadManifest{"shape_target", [](json& d) { d["meshes"]["block"]["target_triangles"] = 9; },
                    "/meshes/block"},
        BadManifest{"name", [](json& d) { d["meshes"]["../x"] = d["meshes"]["block"]; }, "no mesh name"}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(ManifestTest, RefusesWhatIsNoJson) {
  const ScratchDirectory folder;
  EXPECT_THAT(message_of<InputError>([&] { load_manifest(folder.write("m.json", "{\"a\": }")); }),
              HasSubstr("line 1, column 7"));
  EXPECT_THAT(message_of<InputError>([&] { load_manifest(folder.path() / "none.json"); }),
              HasSubstr("none.json"));
}

TEST(ResolveMeshTest, MakesShapesInMemoryWithTheHashOfTheirFile) {
  const ScratchDirectory folder;
  folder.write("manifest.json", small_manifest().dump());
  const ResolvedMesh resolved = resolve_mesh("block", folder.path());
  EXPECT_EQ(resolved.mesh.triangles, make_l_block(1.0).triangles);
  EXPECT_FALSE(resolved.file);
  write_off(folder.path() / "written.off", make_l_block(1.0));
  EXPECT_EQ(resolved.sha256, sha256_of_file(folder.path() / "written.off"));
}

TEST(ResolveMeshTest, ReadsBuiltMeshesAndTellsHowToBuildMissingOnes) {
  const ScratchDirectory folder;
  folder.write("manifest.json", small_manifest().dump());
  EXPECT_THAT(message_of<InputError>([&] { resolve_mesh("thing-1k", folder.path()); }),
              HasSubstr("run 'lmdbench mesh build thing-1k --dir " + folder.path().string() + "'"));
  write_off(folder.path() / "thing-1k.off", make_box({1, 1, 1}));
  const ResolvedMesh resolved = resolve_mesh("thing-1k", folder.path());
  EXPECT_EQ(resolved.mesh.triangles.size(), 12u);
  EXPECT_EQ(resolved.file, folder.path() / "thing-1k.off");
  EXPECT_EQ(resolved.sha256, sha256_of_file(folder.path() / "thing-1k.off"));
}

TEST(DefaultMeshFolderTest, IsTheNearOneAndElseTheProgramsOwn) {
  const ScratchDirectory folder;
  EXPECT_EQ(default_mesh_folder(folder.path()), data_folder() / "meshes");
  folder.write("manifest.json", small_manifest().dump());
  EXPECT_EQ(default_mesh_folder(folder.path()), folder.path());
}

TEST(DefaultMeshFolderTest, RemediesNameTheFolderWhereCommandsWouldNotFindIt) {
  const Manifest own = load_manifest(data_folder() / "meshes" / "manifest.json");
  EXPECT_EQ(mesh_command(own, "list"), "lmdbench mesh list");
  const ScratchDirectory folder;
  const Manifest other = load_manifest(folder.write("my meshes/manifest.json", small_manifest().dump()));
  EXPECT_EQ(mesh_command(other, "list"),
            "lmdbench mesh list --dir \"" + (folder.path() / "my meshes").string() + "\"");
}

TEST(ResolveMeshTest, TakesPathsWithoutAManifest) {
  const ScratchDirectory folder;
  write_off(folder.path() / "own.off", make_box({1, 1, 1}));
  const std::string path = (folder.path() / "own.off").string();
  EXPECT_EQ(resolve_mesh(path, folder.path() / "nowhere").mesh.triangles.size(), 12u);
  EXPECT_EQ(resolve_mesh(path, folder.path() / "nowhere").name, path);
}

TEST(ResolveMeshTest, NamesTheKnownMeshesForAnUnknownOne) {
  const ScratchDirectory folder;
  folder.write("manifest.json", small_manifest().dump());
  EXPECT_THAT(message_of<InputError>([&] { resolve_mesh("blok", folder.path()); }),
              AllOf(HasSubstr("'blok'"), HasSubstr("thing-1k"), HasSubstr("block")));
  EXPECT_THAT(message_of<InputError>([&] { resolve_mesh("block", folder.path() / "nowhere"); }),
              HasSubstr("cannot read the mesh manifest"));
}

// The committed manifest itself.
TEST(CommittedManifestTest, IsSoundAndItsShapesAreWhatItRecords) {
  const Manifest manifest =
      load_manifest(std::filesystem::path(LMDBENCH_SOURCE_DIR) / "meshes" / "manifest.json");
  for (const char* name : {"bunny-5k", "bunny-10k", "bunny-16k", "bunny-40k", "bunny-75k", "armadillo",
                           "chinese-dragon", "camel", "fandisk", "elephant-with-holes"})
    EXPECT_NE(manifest.find(name), nullptr) << name;
  int shapes = 0;
  for (const ManifestEntry& entry : manifest.entries) {
    EXPECT_EQ(entry.sha256.size(), 64u) << entry.name;
    if (!entry.shape) continue;
    ++shapes;
    const ResolvedMesh resolved = resolve_mesh(entry.name, manifest);
    EXPECT_EQ(static_cast<std::int64_t>(resolved.mesh.triangles.size()), entry.triangles) << entry.name;
    EXPECT_EQ(resolved.sha256, entry.sha256) << entry.name;
  }
  EXPECT_GE(shapes, 7);
}

}  // namespace
}  // namespace lmdbench
