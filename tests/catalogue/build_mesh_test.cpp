// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/base/run_program.h>
#include <lmdbench/catalogue/build_mesh.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shapes.h>

#include "support/message_of.h"
#include "support/scratch_directory.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using testing::message_of;
using testing::ScratchDirectory;

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

void ignore(const std::string&) {}

// A manifest with one source, and its package, made here with dpkg-deb: no network is needed.
class BuildMeshTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write_off(folder_.path() / "stage" / "data" / "blob.off", make_blob(1.0, 0.3, 3));
    source_hash_ = sha256_of_file(folder_.path() / "stage" / "data" / "blob.off");
    run({"tar", "-czf", "data.tar.gz", "-C", "stage", "data"});
    folder_.write(
        "package/DEBIAN/control",
        "Package: some-package\nVersion: 1.0\nArchitecture: all\nMaintainer: nobody <n@example.org>\n"
        "Description: test\n");
    fs::create_directories(folder_.path() / "package" / "usr" / "share");
    fs::rename(folder_.path() / "data.tar.gz", folder_.path() / "package" / "usr" / "share" / "data.tar.gz");
    fs::create_directories(sources());
    run({"dpkg-deb", "--build", "package", (sources() / "some-package_1.0_all.deb").string()});
    write_manifest();
  }

  void run(const std::vector<std::string>& argv) {
    const ProgramOutcome outcome = run_program(argv, folder_.path(), "");
    ASSERT_EQ(outcome.exit_status, 0) << outcome.output;
  }
  void write_manifest(const std::string& result_hash = "") {
    nlohmann::json document = nlohmann::json::parse(R"({
      "format": "lmdbench-mesh-manifest", "format_version": 1, "sources": {},
      "meshes": {"blob-400": {"description": "d", "source": "blob", "target_triangles": 400, "triangles": 400},
                 "blob": {"description": "d", "source": "blob", "triangles": 1280},
                 "block": {"description": "d", "shape": {"kind": "l-block", "size": 1.0}, "triangles": 20}}})");
    document["sources"]["blob"] = {{"package", "some-package"},
                                   {"archive", "usr/share/data.tar.gz"},
                                   {"path", "data/blob.off"},
                                   {"sha256", source_hash_},
                                   {"licence", "l"},
                                   {"credit", "c"}};
    if (!result_hash.empty()) document["meshes"]["blob-400"]["sha256"] = result_hash;
    manifest_ = load_manifest(folder_.write("meshes/manifest.json", document.dump()));
  }
  fs::path sources() const { return folder_.path() / "meshes" / "sources"; }
  BuildOutcome build(const std::string& name) { return build_mesh(manifest_, *manifest_.find(name), ignore); }

  ScratchDirectory folder_;
  std::string source_hash_;
  Manifest manifest_;
};

TEST_F(BuildMeshTest, UnpacksChecksDecimatesAndWrites) {
  const BuildOutcome outcome = build("blob-400");
  EXPECT_FALSE(outcome.up_to_date);
  EXPECT_TRUE(outcome.matches_manifest);
  EXPECT_EQ(outcome.triangles, 400);
  EXPECT_EQ(outcome.file, folder_.path() / "meshes" / "blob-400.off");
  EXPECT_EQ(import_mesh(outcome.file).triangles.size(), 400u);
  EXPECT_EQ(outcome.sha256, sha256_of_file(outcome.file));
  EXPECT_TRUE(fs::exists(sources() / "blob.off")) << "kept for the next mesh of the same source";
  for (const auto& item : fs::directory_iterator(sources()))
    EXPECT_FALSE(item.path().filename().string().starts_with(".")) << "left over: " << item.path();
}

TEST_F(BuildMeshTest, WholeSourcesKeepEveryBit) {
  const TriangleMesh mesh = import_mesh(build("blob").file), wanted = make_blob(1.0, 0.3, 3);
  EXPECT_EQ(mesh.vertices, wanted.vertices);
  EXPECT_EQ(mesh.triangles, wanted.triangles);
}

TEST_F(BuildMeshTest, LeavesAMatchingFileAloneAndReplacesAnother) {
  const std::string hash = build("blob-400").sha256;
  write_manifest(hash);
  const auto file = folder_.path() / "meshes" / "blob-400.off";
  fs::remove_all(sources());
  EXPECT_TRUE(build("blob-400").up_to_date) << "without its source";
  folder_.write("meshes/blob-400.off", "OFF\ndamaged");
  folder_.write("meshes/sources/blob.off", to_off_text(make_blob(1.0, 0.3, 3)));
  const BuildOutcome again = build("blob-400");
  EXPECT_FALSE(again.up_to_date);
  EXPECT_TRUE(again.matches_manifest);
  EXPECT_EQ(sha256_of_file(file), hash);
}

TEST_F(BuildMeshTest, NoticesAResultThatIsNotTheRecordedOne) {
  write_manifest(std::string(64, 'a'));
  const BuildOutcome outcome = build("blob-400");
  EXPECT_FALSE(outcome.matches_manifest);
  EXPECT_TRUE(fs::exists(outcome.file)) << "usable all the same";
}

TEST_F(BuildMeshTest, RefusesASourceWithAnotherHash) {
  source_hash_ = std::string(64, 'b');
  write_manifest();
  EXPECT_THAT(message_of<InputError>([&] { build("blob"); }),
              AllOf(HasSubstr("SHA-256"), HasSubstr(std::string(64, 'b')), HasSubstr("some-package")));
  EXPECT_FALSE(fs::exists(sources() / "blob.off"));
  EXPECT_FALSE(fs::exists(folder_.path() / "meshes" / "blob.off"));
}

TEST_F(BuildMeshTest, RefusesADamagedPackage) {
  folder_.write("meshes/sources/some-package_1.0_all.deb", "not a package");
  EXPECT_THAT(message_of<EnvironmentError>([&] { build("blob"); }),
              AllOf(HasSubstr("dpkg"), HasSubstr("remedy: delete")));
}

TEST_F(BuildMeshTest, TellsWhatIsMissingWithoutTheTools) {
  fs::remove_all(sources());
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.path().c_str(), 1);
  const std::string message = message_of<EnvironmentError>([&] { build("blob"); });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(message, AllOf(HasSubstr("apt-get"), HasSubstr("cannot be started"), HasSubstr("remedy")));
}

TEST_F(BuildMeshTest, TellsAFailedDownloadAndHowToGoWithoutOne) {
  fs::remove_all(sources());
  // This apt-get fails as the real one does without a network.
  const std::filesystem::path fake = folder_.write(
      "bin/apt-get", "#!/bin/sh\necho 'E: Unable to locate package some-package' >&2\nexit 100\n");
  fs::permissions(fake, fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (fake.parent_path().string() + ":" + path).c_str(), 1);
  const std::string message = message_of<EnvironmentError>([&] { build("blob"); });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(message, AllOf(HasSubstr("status 100"), HasSubstr("Unable to locate package"),
                             HasSubstr("apt-get update"), HasSubstr("some-package_*.deb")));
}

// The same source as an npm package with a compressed mesh.
class BuildNpmMeshTest : public BuildMeshTest {
 protected:
  void SetUp() override {
    BuildMeshTest::SetUp();
    fs::create_directories(folder_.path() / "npm" / "package" / "models");
    write_off(folder_.path() / "npm" / "package" / "models" / "blob.off", make_blob(1.0, 0.3, 3));
    run({"gzip", "npm/package/models/blob.off"});
    run({"tar", "-czf", (sources() / "some-package-1.0.0.tgz").string(), "-C", "npm", "package"});
    nlohmann::json document = nlohmann::json::parse(R"({
      "format": "lmdbench-mesh-manifest", "format_version": 1, "sources": {},
      "meshes": {"blob": {"description": "d", "source": "blob", "triangles": 1280, "optional": true}}})");
    document["sources"]["blob"] = {{"registry", "npm"},      {"package", "some-package"},
                                   {"version", "1.0.0"},     {"path", "package/models/blob.off.gz"},
                                   {"sha256", source_hash_}, {"licence", "l"},
                                   {"credit", "c"}};
    manifest_ = load_manifest(folder_.write("meshes/manifest.json", document.dump()));
  }
};

TEST_F(BuildNpmMeshTest, UnpacksCompressedMeshes) {
  const BuildOutcome outcome = build("blob");
  EXPECT_TRUE(outcome.matches_manifest);
  EXPECT_EQ(import_mesh(outcome.file).vertices, make_blob(1.0, 0.3, 3).vertices);
  EXPECT_TRUE(fs::exists(sources() / "blob.off")) << "kept, without .gz";
}

TEST_F(BuildNpmMeshTest, TellsThatNpmIsMissing) {
  fs::remove_all(sources());
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.path().c_str(), 1);
  const std::string message = message_of<EnvironmentError>([&] { build("blob"); });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(message, AllOf(HasSubstr("npm"), HasSubstr("cannot be started"), HasSubstr("install npm")));
}

/// The package with another archive in it.
class HostilePackageTest : public BuildMeshTest {
 protected:
  void SetUp() override {
    BuildMeshTest::SetUp();
    fs::create_directories(folder_.path() / "elsewhere");
    folder_.write("elsewhere/blob.off", "mine");
  }
  /// Packs the folder "stage" under the archive's name.
  void pack() {
    const fs::path archive = folder_.path() / "package" / "usr" / "share" / "data.tar.gz";
    run({"tar", "-czf", archive.string(), "-C", "stage", "data"});
    run({"dpkg-deb", "--build", "package", (sources() / "some-package_1.0_all.deb").string()});
  }
  void expect_untouched() {
    EXPECT_EQ(sha256_of_file(folder_.path() / "elsewhere" / "blob.off"), sha256_of_text("mine"));
    EXPECT_FALSE(fs::exists(folder_.path() / "meshes" / "blob.off"));
    for (const auto& item : fs::directory_iterator(sources()))
      EXPECT_TRUE(item.path().extension() == ".deb") << "left over: " << item.path();
  }
};

TEST_F(HostilePackageTest, LinksInAnArchiveLeadNowhere) {
  // The archive holds a link to another folder, and then a member below that link.
  const TriangleMesh other = make_box({1, 1, 1});
  fs::remove_all(folder_.path() / "stage");
  fs::create_directories(folder_.path() / "stage");
  fs::create_symlink(folder_.path() / "elsewhere", folder_.path() / "stage" / "data");
  const fs::path tar = folder_.path() / "package" / "usr" / "share" / "data.tar";
  run({"tar", "-cf", tar.string(), "-C", "stage", "data"});
  write_off(folder_.path() / "real" / "data" / "blob.off", other);
  run({"tar", "-rf", tar.string(), "-C", "real", "data/blob.off"});
  fs::rename(tar, tar.string() + ".gz");
  run({"dpkg-deb", "--build", "package", (sources() / "some-package_1.0_all.deb").string()});
  EXPECT_THAT(message_of<InputError>([&] { build("blob"); }), HasSubstr("SHA-256"));
  expect_untouched();
}

TEST_F(HostilePackageTest, AMemberThatIsALinkGivesNothing) {
  fs::remove(folder_.path() / "stage" / "data" / "blob.off");
  fs::create_symlink(folder_.path() / "elsewhere" / "blob.off",
                     folder_.path() / "stage" / "data" / "blob.off");
  pack();
  EXPECT_THAT(message_of<InputError>([&] { build("blob"); }), HasSubstr("SHA-256"));
  expect_untouched();
}

TEST_F(HostilePackageTest, NamesThatLeadOutOrToAnotherComputerAreRefused) {
  for (const std::string path :
       {"../elsewhere/blob.off", "data/../../x.off", "data//blob.off", "./blob.off", "data/.."}) {
    nlohmann::json document = nlohmann::json::parse(R"({
      "format": "lmdbench-mesh-manifest", "format_version": 1, "meshes": {},
      "sources": {"s": {"package": "some-package", "archive": "a.tar", "path": "p", "licence": "l", "credit": "c"}}})");
    document["sources"]["s"]["sha256"] = source_hash_;
    for (const char* key : {"path", "archive"}) {
      nlohmann::json changed = document;
      changed["sources"]["s"][key] = path;
      changed["meshes"]["blob"] = {{"description", "d"}, {"source", "s"}, {"triangles", 1}};
      const std::string file = folder_.write("hostile.json", changed.dump());
      EXPECT_THAT(message_of<InputError>([&] { load_manifest(file); }),
                  HasSubstr(std::string("/sources/s/") + key))
          << path;
    }
  }
  // tar reads the part of a name before a colon as the name of a computer, unless told otherwise.
  nlohmann::json document = nlohmann::json::parse(R"({
    "format": "lmdbench-mesh-manifest", "format_version": 1,
    "meshes": {"blob": {"description": "d", "source": "s", "triangles": 1280}},
    "sources": {"s": {"package": "some-package", "archive": "user@host:f", "path": "data/blob.off", "licence": "l",
                      "credit": "c"}}})");
  document["sources"]["s"]["sha256"] = source_hash_;
  manifest_ = load_manifest(folder_.write("meshes/manifest.json", document.dump()));
  EXPECT_THAT(message_of<EnvironmentError>([&] { build("blob"); }), HasSubstr("Not found in archive"));
}

TEST_F(HostilePackageTest, ALinkedFolderOfSourcesIsRefused) {
  fs::remove_all(sources());
  fs::create_directory_symlink(folder_.path() / "elsewhere", sources());
  EXPECT_THAT(message_of<InputError>([&] { build("blob"); }), HasSubstr("symbolic link"));
}

TEST_F(HostilePackageTest, ABombIsCutOff) {
  set_limit("file-bytes=50000");
  const std::string message = message_of<InputError>([&] { build("blob"); });
  set_limit("file-bytes=4294967296");
  EXPECT_THAT(message, HasSubstr("gives more than 50000 bytes"));
}

TEST_F(HostilePackageTest, ABuiltMeshReplacesNoForeignFile) {
  folder_.write("meshes/block.off", "my notes");
  EXPECT_THAT(message_of<UsageError>([&] { build("block"); }), HasSubstr("no built mesh of lmdbench"));
  EXPECT_EQ(sha256_of_file(folder_.path() / "meshes" / "block.off"), sha256_of_text("my notes"));
}

TEST_F(BuildMeshTest, ShapesNeedNoSource) {
  fs::remove_all(sources());
  EXPECT_TRUE(build("block").matches_manifest);
  EXPECT_FALSE(fs::exists(sources()));
}

TEST(RunProgramTest, CollectsOutputAndStatus) {
  const ProgramOutcome outcome = run_program({"sh", "-c", "pwd; echo oops >&2; cat; exit 7"}, "/", "");
  EXPECT_EQ(outcome.exit_status, 7);
  EXPECT_EQ(outcome.output, "/\noops\n");
  EXPECT_EQ(run_program({"sh", "-c", "kill -9 $$"}, "/", "").exit_status, 137);
  EXPECT_EQ(
      run_program({"sh", "-c", "i=0; while [ $i -lt 20000 ]; do echo 0123456789; i=$((i+1)); done"}, "/", "")
          .output.size(),
      220000u)
      << "more than a pipe holds";
}

TEST(RunProgramTest, PassesArgumentsAsTheyAre) {
  EXPECT_EQ(run_program({"printf", "%s|", "a b", "$HOME", "'\"*"}, "/", "").output, "a b|$HOME|'\"*|");
}

TEST(RunProgramTest, NamesAMissingProgram) {
  EXPECT_THAT(message_of<EnvironmentError>([] { run_program({"no-such-program-here"}, "/", "install it"); }),
              AllOf(HasSubstr("no-such-program-here"), HasSubstr("install it")));
}

}  // namespace
}  // namespace lmdbench
