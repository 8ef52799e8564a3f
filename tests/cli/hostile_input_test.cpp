// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/sanitizers.h>

#include "program.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/source_directory.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

/// Hostile files, flags and surroundings, through the real program: each case ends at once with its
/// exit code and a message that names file, place and remedy. Every other file stays as it was.
namespace lmdbench::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string SHORT = SHAPES + "--set /frames=20 --set /driver/repetitions=1 ";

/// Limit of processor time of a case: it does not depend on the load of the machine.
const std::string PROCESSOR_SECONDS = IS_SANITIZED ? "300" : "20";

class HostileInput : public ::testing::Test {
 protected:
  /// The output of a command that must fail with this code and name a remedy.
  std::string refusal(const std::string& arguments, int code) {
    const Outcome outcome = lmdbench(arguments, LMDBENCH_SOURCE_DIR, PROCESSOR_SECONDS);
    EXPECT_EQ(outcome.code, code) << arguments << "\n" << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("remedy: ")) << arguments;
    EXPECT_THAT(outcome.err, Not(HasSubstr("\x1b"))) << arguments;
    return outcome.err;
  }
  std::string path(const std::string& name) const { return "'" + (scratch_ / name).string() + "'"; }
  std::string write(const std::string& name, const std::string& text) const {
    return "'" + scratch_.write(name, text) + "'";
  }
  std::string info(const std::string& name, const std::string& text, const std::string& options = "") {
    return refusal("mesh info " + write(name, text) + " " + options, INPUT_DATA);
  }

  ScratchDirectory scratch_;
};

TEST_F(HostileInput, OutputNeverReplacesAnInput) {
  fs::copy_file(SHAPES_FILE, scratch_ / "own.json");
  const std::string sphere = scratch_.write(
      "mesh.off", "OFF\n4 4 0\n0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const std::string tum = scratch_.write("p.tum", "0 0 0 0.3 0 0 0 1\n0.1 0 0 0.3 0 0 0 1\n");
  const std::string experiment = path("own.json") +
                                 " --set /path/file=p.tum --set /moving/mesh=./mesh.off --set "
                                 "'/mesh_folder=" LMDBENCH_SOURCE_DIR "/meshes' ";
  for (const char* input : {"own.json", "p.tum", "mesh.off"}) {
    const std::string before = read_text(scratch_ / input);
    EXPECT_THAT(refusal("run " + experiment + "--out " + path(input), USAGE), HasSubstr("is also read"))
        << input;
    EXPECT_EQ(read_text(scratch_ / input), before);
  }
  const std::string spec = LMDBENCH_SOURCE_DIR "/paths/shapes.json";
  fs::copy_file(spec, scratch_ / "spec.json");
  EXPECT_THAT(refusal("path generate " + path("spec.json") + " --out " + path("spec.json"), USAGE),
              HasSubstr("is also read"));
  EXPECT_EQ(read_text(scratch_ / "spec.json"), read_text(spec));
}

TEST_F(HostileInput, OutputNeverReplacesAForeignFile) {
  for (const std::string& out : std::vector<std::string>{"'/dev/null'", write("notes.txt", "mine"),
                                                         write("fake.h5", "\x89HDF\r\n\x1a\nmine")}) {
    refusal("run " + SHORT + "--out " + out, USAGE);
    refusal("path generate '" LMDBENCH_SOURCE_DIR "/paths/shapes.json' --out " + out, USAGE);
  }
  EXPECT_EQ(read_text(scratch_ / "notes.txt"), "mine");
  refusal("path generate '" LMDBENCH_SOURCE_DIR "/paths/shapes.json' --out " +
              write("recorded.tum", "0 0 0 0 0 0 0 1\n"),
          USAGE);
  ASSERT_EQ(::mkfifo((scratch_ / "fifo").c_str(), 0600), 0);
  EXPECT_THAT(refusal("run " + SHORT + "--out " + path("fifo"), USAGE), HasSubstr("FIFO"));
}

TEST_F(HostileInput, PartFilesAreNeverLinksOrForeign) {
  scratch_.write("victim", "mine");
  fs::create_symlink(scratch_ / "victim", scratch_ / "r.h5.part");
  refusal("run " + SHORT + "--out " + path("r.h5"), ENVIRONMENT);
  EXPECT_EQ(read_text(scratch_ / "victim"), "mine");
  scratch_.write("s.h5.part", "my notes");
  EXPECT_THAT(refusal("run " + SHORT + "--out " + path("s.h5"), ENVIRONMENT), HasSubstr("no part of a run"));
  EXPECT_EQ(read_text(scratch_ / "s.h5.part"), "my notes");
}

TEST_F(HostileInput, AFullDeviceIsAnErrorForEveryCommand) {
  for (const std::string& command : std::vector<std::string>{
           "mesh info sphere --dir '" LMDBENCH_SOURCE_DIR "/meshes'",
           "mesh list --dir '" LMDBENCH_SOURCE_DIR "/meshes'", "plan " + SHAPES,
           "path info '" LMDBENCH_SOURCE_DIR "/paths/shapes.tum'",
           "query --moving sphere --fixed sphere --cutoff 0.1", "--help", "run --help", "--version"}) {
    const Outcome outcome = lmdbench(command + " >/dev/full ; echo $?");
    EXPECT_EQ(outcome.out, "4\n") << command << outcome.err;
  }
  EXPECT_THAT(lmdbench("plan " + SHAPES + ">/dev/full").err, HasSubstr("standard output"));
}

TEST_F(HostileInput, JsonBombs) {
  EXPECT_THAT(refusal("plan " + write("deep.json", std::string(100'000, '[')), USAGE),
              HasSubstr("json-depth"));
  const std::string shapes = read_text(SHAPES_FILE);
  std::string named = shapes;
  named.insert(named.find('{') + 1, "\"" + std::string(50'000, 'a') + "\": 1,");
  EXPECT_THAT(refusal("plan " + write("key.json", named), USAGE), HasSubstr("json-text"));
  EXPECT_THAT(
      refusal("plan " + SHAPES + "--set '/title=" + std::string(400, '[') + std::string(400, ']') + "'",
              USAGE),
      HasSubstr("json-depth"));
  EXPECT_THAT(refusal("plan " + SHAPES + "--set /methods/0/label=" + std::string(50'000, 'a'), USAGE),
              HasSubstr("json-text"));
  refusal("plan " + SHAPES + "--set /methods/400000000/name=improved", USAGE);
  refusal("plan " + SHAPES + "--set /methods/18446744073709551614=1", USAGE);
  EXPECT_THAT(refusal("plan " + SHAPES + "--set \"/title=$(printf '\\377')\"", USAGE), HasSubstr("UTF-8"));
  EXPECT_THAT(
      refusal("path generate " + write("deep2.json", std::string(100'000, '[')) + " --out " + path("o"),
              USAGE),
      HasSubstr("json-depth"));
  scratch_.write("meshes/manifest.json", std::string(100'000, '['));
  EXPECT_THAT(refusal("mesh list --dir " + path("meshes"), INPUT_DATA), HasSubstr("json-depth"));
}

TEST_F(HostileInput, WhatIsNoRegularFile) {
  ASSERT_EQ(::mkfifo((scratch_ / "fifo").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((scratch_ / "fifo.off").c_str(), 0600), 0);
  for (const std::string& file :
       std::vector<std::string>{path("fifo"), std::string("/dev/zero"), path(".")}) {
    refusal("plan " + file, USAGE);
    refusal("path info " + file, INPUT_DATA);
    refusal("mesh info " + file, INPUT_DATA);
    refusal("path generate " + file + " --out " + path("out"), USAGE);
  }
  EXPECT_THAT(refusal("mesh info " + path("fifo.off"), INPUT_DATA), HasSubstr("FIFO"));
}

TEST_F(HostileInput, TerminalEscapesAndNul) {
  const std::string message = info("e.off", std::string("OFF\n3 1 0\n0 0 \x1b[2J\0zero", 24));
  EXPECT_THAT(message, AllOf(HasSubstr("\\x1b[2J\\x00"), HasSubstr("remedy: ")));
}

TEST_F(HostileInput, PlyThatIsCutOrLies) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face FACES\nproperty list uchar int vertex_indices\nend_header\n";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = head + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n";
    text.replace(text.find("FACES"), 5, "1");
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    return text;
  };
  EXPECT_EQ(lmdbench("mesh info " + write("good.ply", with("", ""))).code, 0);
  for (std::size_t cut = 1; cut + 11 < head.size(); cut += 7) info("cut.ply", head.substr(0, cut));
  EXPECT_THAT(info("more.ply", with("face 1", "face 4")), HasSubstr("face 1 of 4"));
  EXPECT_THAT(info("fewer.ply", with("vertex 4", "vertex 3")), HasSubstr("remedy"));
  EXPECT_THAT(info("many.ply", with("face 1", "face 99999999999")), HasSubstr("--limit triangles="));
  EXPECT_THAT(info("type.ply", with("list uchar int", "list uchar potato")),
              HasSubstr("'potato' is no type"));
  EXPECT_THAT(info("noend.ply", with("end_header", "")), HasSubstr("line 9"));
}

TEST_F(HostileInput, FormatsThatAreNotRead) {
  for (const char* name :
       {"zeros.ase", "zeros.lws", "zeros.mot", "x.x3d", "x.3mf", "x.smd", "x.ogex", "none"})
    EXPECT_THAT(info(name, std::string(2000, '\0')), HasSubstr("no extension of a mesh format")) << name;
  info("zeros.stl", std::string(2000, '\0'));
  info("zeros.ply", std::string(2000, '\0'));
  info("zeros.obj", std::string(2000, '\0'));
  info("deep.gltf", "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(200'000, '['));
}

TEST_F(HostileInput, PolygonsAndLinesWithoutEnd) {
  std::string corners;
  for (int i = 0; i < 1'000'000; ++i) corners += " 1";
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  EXPECT_THAT(info("polygon.obj", square + "f" + corners + "\n"), HasSubstr("--limit polygon-corners="));
  EXPECT_EQ(
      lmdbench("mesh info " + write("line.obj", square + "f 1 2 3\n# " + std::string(3'000'000, 'x'))).code,
      0);
  EXPECT_THAT(info("polygon.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1000000" + corners + "\n"),
              HasSubstr("--limit polygon-corners="));
}

TEST_F(HostileInput, CrowdsAtOneEdgeOrVertex) {
  std::string copies = "OFF\n3 20000 0\n0 0 0\n1 0 0\n0 1 0\n", hub = "OFF\n20002 20000 0\n0 0 0\n0 0 1\n";
  for (int i = 0; i < 20'000; ++i) {
    copies += "3 0 1 2\n";
    hub += std::to_string(i % 141) + " " + std::to_string(i / 141) + " 2\n";
  }
  for (int i = 0; i < 20'000; ++i) hub += "3 0 1 " + std::to_string(i + 2) + "\n";
  EXPECT_THAT(info("copies.off", copies),
              AllOf(HasSubstr("vertices 0 and 1"), HasSubstr("--limit edge-triangles=")));
  EXPECT_THAT(info("hub.off", hub), HasSubstr("--limit edge-triangles="));
  EXPECT_THAT(info("hub.off", hub, "--limit edge-triangles=10000 --limit vertex-triangles=300"),
              HasSubstr("vertex 0 is in 20000 triangles"));
}

TEST_F(HostileInput, CoordinatesWhoseSquaresOverflowOrVanish) {
  const auto tetrahedron = [](const std::string& a) {
    return "OFF\n4 4 0\n0 0 0\n" + a + " 0 0\n0 " + a + " 0\n0 0 " + a +
           "\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  };
  for (const char* size : {"1e308", "1.1e18"})
    EXPECT_THAT(info("huge.off", tetrahedron(size)), HasSubstr("overflow")) << size;
  for (const char* size : {"1e-310", "5e-16"})
    EXPECT_THAT(info("tiny.off", tetrahedron(size)), HasSubstr("vanish")) << size;
  const std::string pose = write("huge.tum", "0 1e308 0 0 0 0 0 1\n");
  EXPECT_THAT(refusal("query --moving sphere --fixed sphere --cutoff 0.1 --poses " + pose, INPUT_DATA),
              HasSubstr("line 1"));
  refusal("query --moving sphere --fixed sphere --cutoff 1e308", USAGE);
  refusal("run " + SHORT + "--set /moving/diagonal_m=1e308 --out " + path("r.h5"), INPUT_DATA);
  refusal("run " + SHORT + "--set /moving/diagonal_m=1e-310 --out " + path("r.h5"), INPUT_DATA);
  refusal("run " + SHORT + "--set '/fixed/0/pose={\"translation_m\":[1e308,0,0]}' --out " + path("r.h5"),
          INPUT_DATA);
}

TEST_F(HostileInput, PathsThatLastForEver) {
  const std::string tum = write("long.tum", "0 0 0 1 0 0 0 1\n90000 0 0 1 0 0 0 1\n");
  EXPECT_THAT(refusal("path info " + tum, INPUT_DATA), HasSubstr("--limit frames="));
  EXPECT_THAT(refusal("run " + SHAPES + "--set '/path/file=" + (scratch_ / "long.tum").string() + "' --out " +
                          path("r.h5"),
                      INPUT_DATA),
              AllOf(HasSubstr("long.tum: lasts 90000 s"), HasSubstr("--limit frames=")));
  const std::string spec =
      R"({"moving": {"mesh": "sphere", "diagonal_m": 0.1}, "seed": 1, "slide_rate_deg_per_s": 1,
    "fixed": {"mesh": "sphere", "diagonal_m": 0.1}, "frame_rate_hz": 1e300, "turn_rate_deg_per_s": 1,
    "radial_speed_m_per_s": 0.1, "radial_acceleration_m_per_s2": 1, "gap_floor": 0.001,
    "gaps": [{"time_s": 0, "gap": 0.1}, {"time_s": 1, "gap": 0.1}]})";
  EXPECT_THAT(refusal("path generate " + write("fast.json", spec) + " --out " + path("o.tum"), USAGE),
              AllOf(HasSubstr("/frame_rate_hz"), HasSubstr("100000"), HasSubstr("remedy")));
}

/// Every method but `exhaustive` answers on a mesh that may have this many triangles at one vertex.
TEST_F(HostileInput, HubsAndLargePolygonsAreAnswered) {
  const auto cone = [](int around) {
    std::string text = "OFF\n" + std::to_string(around + 1) + " " + std::to_string(around) + " 0\n0 0 0\n";
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * M_PI * i / around;
      text += std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " -1\n";
    }
    for (int i = 0; i < around; ++i)
      text += "3 0 " + std::to_string(1 + i) + " " + std::to_string(1 + (i + 1) % around) + "\n";
    return text;
  };
  std::string polygon = "OFF\n1000 1 0\n", corners = "1000";
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2.0 * M_PI * i / 1000;
    polygon += std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    corners += " " + std::to_string(i);
  }
  const std::string pose = write("near.tum", "0 0 0 -0.99 0 0 0 1\n");
  for (const std::string& mesh :
       {write("hub.off", cone(20'000)), write("polygon.off", polygon + corners + "\n")}) {
    for (const char* method : {"improved", "certified", "original", "nearest"}) {
      const Outcome outcome = lmdbench("query --moving sphere --fixed " + mesh + " --cutoff 0.1 --method " +
                                           method + " --poses " + pose + " --json",
                                       LMDBENCH_SOURCE_DIR, PROCESSOR_SECONDS);
      EXPECT_EQ(outcome.code, 0) << method << mesh << outcome.err;
    }
  }
  // At two hubs the number of triangle pairs is the product of their numbers of triangles.
  EXPECT_THAT(refusal("query --moving " + path("hub.off") + " --fixed " + path("hub.off") + " --cutoff 0.1",
                      INPUT_DATA),
              AllOf(HasSubstr("vertex 0"), HasSubstr("--limit vertex-pairs=")));
}

TEST_F(HostileInput, PathsThatTakeForEverEndAtTheirLimit) {
  // The gap is far larger than the meshes: all pairs of triangles are about equally near.
  const std::string spec = write(
      "far.json",
      R"({"moving": {"mesh": "sphere", "diagonal_m": 1e-6}, "fixed": {"mesh": "sphere", "diagonal_m": 1e-6},
          "turn_rate_deg_per_s": 90, "frame_rate_hz": 1000,
          "gaps": [{"time_s": 0, "gap": 1e6}, {"time_s": 100, "gap": 1e6}]})");
  EXPECT_THAT(refusal("--limit path-seconds=1 path generate " + spec + " --out " + path("o.tum"), USAGE),
              AllOf(HasSubstr("frames are through"), HasSubstr("--limit path-seconds=")));
}

}  // namespace
}  // namespace lmdbench::testing
