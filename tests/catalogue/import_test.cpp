// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/base/sanitizers.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/surface.h>

#include "support/message_of.h"
#include "support/scratch_directory.h"
#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>

namespace lmdbench {
namespace {

using testing::message_of;
using testing::ScratchDirectory;

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Corners = std::array<std::int32_t, 3>;

// Single precision, as in the formats below, holds every coordinate of this mesh.
TriangleMesh single_precision_blob() {
  TriangleMesh mesh = make_blob(1.0, 0.3, 2);
  for (Vec3& vertex : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) vertex[axis] = std::round(vertex[axis] * 0x1p20) * 0x1p-20;
  return mesh;
}

void expect_same_triangles(const TriangleMesh& actual, const TriangleMesh& wanted, double tolerance) {
  ASSERT_EQ(actual.triangles.size(), wanted.triangles.size());
  EXPECT_EQ(actual.vertices.size(), wanted.vertices.size()) << "welded";
  for (std::size_t t = 0; t < wanted.triangles.size(); ++t) {
    const auto index = static_cast<std::int32_t>(t);
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_LE((actual.triangle(index)[k] - wanted.triangle(index)[k]).norm(), tolerance)
          << "triangle " << t << " corner " << k;
  }
}

std::string bytes(float value) {
  std::string text(4, '\0');
  std::memcpy(text.data(), &value, 4);
  return text;
}

std::string to_binary_stl(const TriangleMesh& mesh) {
  std::string text(80, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  text.append(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += bytes(0) + bytes(0) + bytes(1);
    for (const Vec3& corner : mesh.triangle(static_cast<std::int32_t>(t)))
      for (int axis = 0; axis < 3; ++axis) text += bytes(static_cast<float>(corner[axis]));
    text += std::string(2, '\0');
  }
  return text;
}

std::string to_binary_ply(const TriangleMesh& mesh) {
  std::ostringstream text;
  text << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& vertex : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) text << bytes(static_cast<float>(vertex[axis]));
  for (const auto& corners : mesh.triangles) {
    text << '\3';
    for (const std::int32_t corner : corners) text.write(reinterpret_cast<const char*>(&corner), 4);
  }
  return text.str();
}

std::string to_obj(const TriangleMesh& mesh) {
  std::ostringstream text;
  text.precision(9);
  for (const Vec3& vertex : mesh.vertices)
    text << "v " << vertex.x() << ' ' << vertex.y() << ' ' << vertex.z() << '\n';
  for (const auto& [a, b, c] : mesh.triangles) text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  return text.str();
}

TEST(ImportTest, ALimitOfMemoryIsToldByItsName) {
  if (IS_SANITIZED)
    GTEST_SKIP() << "sanitizers reserve terabytes of addresses, which is what the limit is on";
  const ScratchDirectory folder;
  const auto file = folder.write(
      "blob.gltf", R"({"asset": {"version": "2.0"}, "extras": ")" + std::string(40'000'000, 'x') + R"("})");
  malloc_trim(0);  // what earlier tests left free is not new memory
  set_limit("import-bytes=1000");
  const std::string message = message_of<Error>([&] { import_mesh(file); });
  set_limit("import-bytes=17179869184");
  EXPECT_THAT(message, AllOf(HasSubstr("blob.gltf"), HasSubstr("--limit import-bytes=")));
}

TEST(ImportTest, KeepsTheTrianglesOfEveryFormatInTheirOrder) {
  const ScratchDirectory folder;
  const TriangleMesh mesh = single_precision_blob();
  write_off(folder.path() / "blob.off", mesh);
  expect_same_triangles(import_mesh(folder.path() / "blob.off"), mesh, 0.0);
  expect_same_triangles(import_mesh(folder.write("blob.stl", to_binary_stl(mesh))), mesh, 0.0);
  expect_same_triangles(import_mesh(folder.write("blob.ply", to_binary_ply(mesh))), mesh, 0.0);
  expect_same_triangles(import_mesh(folder.write("blob.obj", to_obj(mesh))), mesh, 0.0);
}

// The first number of the content may begin with the byte of a line feed.
TEST(ImportTest, ReadsABinaryPlyWhoseFirstByteIsALineFeed) {
  const ScratchDirectory folder;
  TriangleMesh mesh = single_precision_blob();
  mesh.vertices.front().x() = static_cast<double>(std::bit_cast<float>(0x3F80000AU));
  const std::string text = to_binary_ply(mesh);
  const std::size_t content = text.find("end_header\n") + 11;
  ASSERT_EQ(text[content], '\n');
  expect_same_triangles(import_mesh(folder.write("line_feed.ply", text)), mesh, 0.0);
  std::string header = text.substr(0, content);
  for (std::size_t at = header.find('\n'); at != std::string::npos; at = header.find('\n', at + 2))
    header.insert(at, 1, '\r');
  expect_same_triangles(import_mesh(folder.write("dos.ply", header + text.substr(content))), mesh, 0.0);
  // In a text file such a byte is an empty line.
  const std::string ascii =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(import_mesh(folder.write("text.ply", ascii)).vertices[1], Vec3(1, 0, 0));
}

std::string stl_with(const std::string& second_vertex) {
  return "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n" + second_vertex +
         "\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
}

TEST(ImportTest, WeldedStlIsClosed) {
  const ScratchDirectory folder;
  const Surface surface =
      build_surface(import_mesh(folder.write("s.stl", to_binary_stl(single_precision_blob()))));
  EXPECT_EQ(std::count(surface.edge_is_boundary.begin(), surface.edge_is_boundary.end(), true), 0);
}

TEST(ImportTest, IsSilentOnStandardOutput) {
  const ScratchDirectory folder;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  import_mesh(folder.write("s.stl", to_binary_stl(make_box({1, 1, 1}))));
  EXPECT_THROW(import_mesh(folder.write("bad.obj", "v 0 0 0\nf 1 2 9\n")), InputError);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

/// Of a triangle's corners and indices.
std::string gltf_with(const std::string& of_corners, const std::string& of_view = R"("byteOffset": 0)") {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
             "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, )" +
         of_corners + R"(}, {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
             "bufferViews": [{"buffer": 0, "byteLength": 36, )" +
         of_view + R"(}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
             "buffers": [{"byteLength": 42, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"}]})";
}

// A glTF node tree: the same triangle once as it is, once moved, and once mirrored in x, which must
// not turn it inside out.
TEST(ImportTest, MergesNodesWithTheirTransforms) {
  const ScratchDirectory folder;
  const std::filesystem::path file = folder.write("scene.gltf", R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "children": [1, 2]},
              {"mesh": 0, "translation": [10, 20, 30], "scale": [2, 2, 2]},
              {"mesh": 0, "scale": [-1, 1, 1], "translation": [0, 0, 5]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "buffers": [{"byteLength": 42, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"}]
  })");
  const TriangleMesh mesh = import_mesh(file);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_THAT(mesh.triangle(0), ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
  EXPECT_THAT(mesh.triangle(1), ElementsAre(Vec3(10, 20, 30), Vec3(12, 20, 30), Vec3(10, 22, 30)));
  const Triangle mirrored = mesh.triangle(2);
  EXPECT_THAT(mirrored, ::testing::UnorderedElementsAre(Vec3(0, 0, 5), Vec3(-1, 0, 5), Vec3(0, 1, 5)));
  EXPECT_GT((mirrored[1] - mirrored[0]).cross(mirrored[2] - mirrored[0]).z(), 0.0);
}

/// In want of the end of "values".
const std::string SPARSE =
    R"("indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0)";

/// Of sparse corners those that are named stand elsewhere: here all three, in place of themselves.
TEST(ImportTest, SparseCornersOfAGltfAreRead) {
  const ScratchDirectory folder;
  const TriangleMesh mesh = import_mesh(
      folder.write("a.gltf", gltf_with(R"("type": "VEC3", "sparse": {"count": 3, )" + SPARSE + "}}")));
  EXPECT_THAT(mesh.triangle(0), ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
}

/// A mesh that no node shows and one of another scene are none of the file's.
TEST(ImportTest, TheSceneThatAGltfShowsIsRead) {
  const ScratchDirectory folder;
  std::string text = gltf_with(R"("type": "VEC3")");
  EXPECT_EQ(import_mesh(folder.write("one.gltf", text)).triangles.size(), 1u);
  const std::string mesh = R"({"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]})";
  text.replace(text.find(mesh), mesh.size(), mesh + ", " + mesh + ", " + mesh);
  EXPECT_EQ(import_mesh(folder.write("unused.gltf", text)).triangles.size(), 1u);
  const std::string scenes = R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])";
  text.replace(text.find(scenes), scenes.size(),
               R"("scene": 1, "scenes": [{"nodes": [0]}, {"nodes": [1]}],
                  "nodes": [{"mesh": 0}, {"mesh": 1, "children": [2]}, {"mesh": 2, "translation": [0, 0, 1]}])");
  EXPECT_EQ(import_mesh(folder.write("scenes.gltf", text)).triangles.size(), 2u);
}

TEST(ImportTest, CutsPolygonsInPlaceAndSkipsLines) {
  const ScratchDirectory folder;
  const TriangleMesh mesh = import_mesh(folder.write(
      "p.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\nf 1 2 3 4\nl 1 5\nf 2 3 4\n"));
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.triangle(0)[2], Vec3(1, 1, 0));
  EXPECT_EQ(mesh.vertices.size(), 4u) << "the line's end is not on the surface";
}

/// A weight is for free-form curves.
TEST(ImportTest, AFourthNumberOfAnObjChangesNothingAndSixHaveAColour) {
  const ScratchDirectory folder;
  const TriangleMesh mesh =
      import_mesh(folder.write("w.obj", "v 1 0 0 2\nv 0 1 0 4\nv 0 0 1 0.5 0.25 0.125\nf 1 2 3\n"));
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangle(0), (std::array<Vec3, 3>{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}));
}

/// Coordinates have the precision of the format; text is rounded to the nearest number.
TEST(ImportTest, NumbersAreTheNearestOnesOfTheirFormat) {
  const ScratchDirectory folder;
  const auto ply = [](const std::string& type) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty " + type + " x\nproperty " + type +
           " y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0\n0.1 0 0\n0 9.87654321 0\n3 0 1 2\n";
  };
  const TriangleMesh exact = import_mesh(folder.write("d.ply", ply("double")));
  EXPECT_EQ(exact.vertices[1].x(), 0.1);
  EXPECT_EQ(exact.vertices[2].y(), 9.87654321);
  const std::string obj = "v 0 0 0\nv 0.1 0 0\nv 0 9.87654321 0\nf 1 2 3\n";
  for (const TriangleMesh& mesh :
       {import_mesh(folder.write("f.ply", ply("float"))), import_mesh(folder.write("f.obj", obj))}) {
    EXPECT_EQ(mesh.vertices[1].x(), static_cast<double>(0.1F));
    EXPECT_EQ(mesh.vertices[2].y(), static_cast<double>(9.87654321F));
  }
}

/// Just above the middle of two numbers: by way of double precision it would be the lower one.
TEST(ImportTest, TextIsRoundedOnce) {
  const ScratchDirectory folder;
  const std::string obj =
      "v 1.00000005960464477539062500001 -1.00000005960464477539062500001 1e-60\nv 9 0 0\nv 0 9 +7\nf 1 2 "
      "3\n";
  const TriangleMesh mesh = import_mesh(folder.write("a.obj", obj));
  EXPECT_EQ(mesh.vertices[0], Vec3(1.0 + 0x1p-23, -1.0 - 0x1p-23, 0.0));
  EXPECT_EQ(mesh.vertices[2].z(), 7.0);
}

std::string ply_of_a_tetrahedron(const std::string& before, const std::string& between,
                                 const std::string& before_rows, const std::string& between_rows) {
  return "ply\nformat ascii 1.0\n" + before +
         "element vertex 4\nproperty float x\nproperty uchar red\nproperty float y\nproperty float z\n" +
         between +
         "element face 4\nproperty list uchar int vertex_indices\nproperty list uchar float "
         "texcoord\nend_header\n" +
         before_rows + "0 255 0 0\n1 0 0 0\n0 9 1 0\n0 9 0 1\n" + between_rows +
         "3 0 2 1 2 0.5 1\n3 0 1 3 0\n3 0 3 2 0\n3 1 2 3 0\n";
}

TEST(ImportTest, OtherElementsAndPropertiesOfAPlyArePassedOver) {
  const ScratchDirectory folder;
  const std::string camera =
      "element camera 1\nproperty float view_px\nproperty list uchar int vertex_indices\n";
  const TriangleMesh plain = import_mesh(folder.write("a.ply", ply_of_a_tetrahedron("", "", "", "")));
  ASSERT_EQ(plain.triangles.size(), 4u);
  EXPECT_EQ(plain.vertices[2], Vec3(0, 1, 0));
  for (const std::string& text :
       {ply_of_a_tetrahedron(camera, "", "7.5 3 1 2 3\n", ""),
        ply_of_a_tetrahedron("", camera, "", "7.5 0\n"), ply_of_a_tetrahedron("", "", "", " \r\n")}) {
    const TriangleMesh mesh = import_mesh(folder.write("b.ply", text));
    EXPECT_EQ(mesh.vertices, plain.vertices);
    EXPECT_EQ(mesh.triangles, plain.triangles);
  }
}

TEST(ImportTest, StripsOfAPlyAreTrianglesThatTurnOneWay) {
  const ScratchDirectory folder;
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n9 1 0 3 2 -1 3 2 5 4\n";
  const TriangleMesh mesh = import_mesh(folder.write("s.ply", text));
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (std::int32_t t = 0; t < 4; ++t) {
    const Triangle c = mesh.triangle(t);
    EXPECT_GT((c[1] - c[0]).cross(c[2] - c[0]).z(), 0.0) << t;
  }
}

TEST(ImportTest, TextOfAnStlIsReadToTheNearestNumber) {
  const ScratchDirectory folder;
  const TriangleMesh mesh =
      import_mesh(folder.write("n.stl", stl_with("vertex 1.904452e-03 8.0e-3 0.00000000000000797608")));
  EXPECT_EQ(mesh.vertices[1], Vec3(1.904452e-03F, 8.0e-3F, 0.00000000000000797608F));
}

/// Faces of an L begun at each corner: assimp 5.2.5 cuts two of six across the notch.
TEST(ImportTest, PolygonsThatAreNotConvexAreCutInsideOfThemselves) {
  const ScratchDirectory folder;
  for (int start = 0; start < 6; ++start) {
    std::string face;
    for (int k = 0; k < 6; ++k) face += " " + std::to_string((start + k) % 6 + 1);
    const TriangleMesh mesh = import_mesh(
        folder.write("l.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf" + face + "\n"));
    double area = 0.0;
    for (std::int32_t t = 0; t < 4; ++t) {
      const Triangle c = mesh.triangle(t);
      area += 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm();
    }
    EXPECT_NEAR(area, 3.0, 1e-12) << start;
  }
}

TEST(ImportTest, CommentsOfAnObjMayStandBehindData) {
  const ScratchDirectory folder;
  const TriangleMesh mesh = import_mesh(
      folder.write("c.obj", "v 0 0 0 # 4\nv 1 0 0 # five\nv 0 1 0\no part # \\\nf 1 2 3 # 4\nf 1 3 2# x\n"));
  EXPECT_THAT(mesh.triangles, ElementsAre(Corners{0, 1, 2}, Corners{0, 2, 1}));
}

TEST(ImportTest, StlTextEndsWithItsLastLine) {
  const ScratchDirectory folder;
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  EXPECT_EQ(import_mesh(folder.write("a.stl", "solid a\n" + facet + "endsolid a\n")).triangles.size(), 1u);
  EXPECT_EQ(import_mesh(folder.write("b.stl", "solid\n" + facet + facet + "endsolid")).triangles.size(), 2u);
  const std::string name(2000, 'x');
  for (const std::string& one : {name, std::string("vertex_block"), std::string("facet normal")})
    EXPECT_EQ(import_mesh(folder.write("n.stl", "solid " + one + "\n" + facet + "endsolid " + one))
                  .triangles.size(),
              1u)
        << one;
  EXPECT_EQ(import_mesh(
                folder.write("t.stl", "solid a\n" + facet + "endsolid a\nsolid b\n" + facet + "endsolid b\n"))
                .triangles.size(),
            2u);
  // Its header may begin as text does.
  std::string binary = to_binary_stl(single_precision_blob());
  binary.replace(0, 5, "solid");
  EXPECT_GT(import_mesh(folder.write("c.stl", binary)).triangles.size(), 100u);
}

TEST(ImportTest, StlTextMayBeginWithBlanksAndHaveOtherLetters) {
  const ScratchDirectory folder;
  const std::string text =
      "solid \xC3\xA4\n FACET normal 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nvertex +1 0 0\nvertex 0 1E0 "
      "0\nendloop\nendfacet\nENDSOLID\n";
  for (const char* before : {"", "\n  \n", "\xEF\xBB\xBF"})
    EXPECT_EQ(import_mesh(folder.write("a.stl", before + text)).triangles.size(), 1u) << before;
}

TEST(ImportTest, TextMayBeginWithAByteOrderMark) {
  const ScratchDirectory folder;
  const std::string mark = "\xEF\xBB\xBF";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const auto& [name, text] :
       {std::pair<const char*, std::string>{"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"a.ply", ply}})
    EXPECT_EQ(import_mesh(folder.write(name, mark + text)).triangle(0),
              (std::array<Vec3, 3>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}))
        << name;
}

TEST(ImportTest, KeepsTrianglesWithoutArea) {
  const ScratchDirectory folder;
  const TriangleMesh mesh = import_mesh(
      folder.write("d.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n3 1 1 3\n"));
  EXPECT_THAT(mesh.triangles, ElementsAre(Corners{0, 1, 2}, Corners{0, 1, 3}, Corners{1, 1, 3}));
}

struct BrokenMesh {
  std::string name, file, content, says;
};

class BrokenMeshTest : public ::testing::TestWithParam<BrokenMesh> {};

TEST_P(BrokenMeshTest, IsRefused) {
  const ScratchDirectory folder;
  const std::filesystem::path file = folder.write(GetParam().file, GetParam().content);
  const std::string message = message_of<InputError>([&] { import_mesh(file); });
  EXPECT_THAT(message, AllOf(HasSubstr(file.string()), HasSubstr(GetParam().says), HasSubstr("remedy")));
}

const std::string PLY_HEADER =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement "
    "face 1\n"
    "property list uchar int vertex_indices\nend_header\n";

INSTANTIATE_TEST_SUITE_P(
    Files, BrokenMeshTest,
    ::testing::Values(
        BrokenMesh{"empty", "a.off", "", "empty"}, BrokenMesh{"text", "a.ply", "hello", ""},
        BrokenMesh{"unknown_format", "a.xyzzy", "hello", ""},
        BrokenMesh{"no_triangle", "a.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no triangle"},
        BrokenMesh{"line_only", "a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", "no triangle"},
        BrokenMesh{"obj_index", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
                   "line 4: a face names vertex 9, but the file has 3"},
        BrokenMesh{"obj_index_back", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n",
                   "line 4: a face names vertex -4, but 3 vertices stand before it"},
        BrokenMesh{"obj_index_far_back", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9223372036854775808\n",
                   "line 4: a face names vertex -9223372036854775808"},
        BrokenMesh{"obj_index_zero", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "names vertex 0"},
        BrokenMesh{"obj_word", "a.obj", "# made\nv 0 0 0\nv 1 abc 0\nv 0 1 0\nf 1 2 3\n",
                   "line 3: a coordinate 'abc' is not a number"},
        BrokenMesh{"obj_comma", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1,5 0\nf 1 2 3\n",
                   "line 3: a coordinate '1,5'"},
        BrokenMesh{"obj_short", "a.obj", "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n",
                   "line 2: a coordinate is missing"},
        BrokenMesh{"obj_five", "a.obj", "v 0 0 0\nv 1 0 0 0 0\nv 0 1 0\nf 1 2 3\n", "line 2: a vertex of 5"},
        BrokenMesh{"obj_corner", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/x y/2\n",
                   "line 4: a vertex index 'y' is not a whole number"},
        BrokenMesh{
            "stl_text_cut", "a.stl",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
            "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
            "ends without 'endsolid'"},
        BrokenMesh{"stl_dots", "a.stl", stl_with("vertex 1.5.5 0 0"), "line 5: a coordinate '1.5.5'"},
        BrokenMesh{"stl_four", "a.stl", stl_with("vertex 1 0 0 7"), "line 5: a vertex goes on with '7'"},
        BrokenMesh{"stl_two", "a.stl", stl_with("vertex 1 0"), "line 5: a coordinate is missing"},
        BrokenMesh{"stl_word", "a.stl", "\n" + stl_with("vertex abc 0 0"), "line 6: a coordinate 'abc'"},
        BrokenMesh{"stl_of_neither_form", "a.stl", "hello\n", "neither text that begins with 'solid'"},
        BrokenMesh{"stl_binary_long", "a.stl",
                   std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(70, ' '),
                   "remedy: correct the counts"},
        BrokenMesh{"stl_binary_cut", "a.stl",
                   std::string(80, ' ') + std::string("\2\0\0\0", 4) + std::string(70, ' '), "2 triangles"},
        BrokenMesh{"stl_binary_cut_of_solids", "a.stl",
                   "solid" + std::string(75, ' ') + std::string("\2\0\0\0", 4) + std::string(70, '\1'),
                   "2 triangles"},
        BrokenMesh{"gltf_with_a_buffer_beside", "a.gltf",
                   R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "a.bin", "byteLength": 84}],
                       "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
                       "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                                     {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
                       "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                       "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})",
                   "export as .glb"},
        BrokenMesh{
            "gltf_of_an_extension", "a.gltf",
            R"({"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_materials_unlit", "KHR_mesh_quantization"]})",
            "the extension 'KHR_mesh_quantization' is not read"},
        BrokenMesh{"glb_of_an_extension", "a.glb",
                   std::string("glTF\2\0\0\0\x60\0\0\0\x4c\0\0\0JSON", 20) +
                       R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_mesh_gpu_instancing"]})",
                   "the extension 'EXT_mesh_gpu_instancing' is not read"},
        BrokenMesh{"obj_cut", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 2 3",
                   "line 5: a face of 2 corners"},
        BrokenMesh{
            "ply_two_lists", "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
            "z\nelement face 1\nproperty list uchar int vertex_indices\nproperty list uchar int "
            "vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 3 0 2 1\n",
            "two lists of corners"},
        BrokenMesh{
            "ply_other_list", "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
            "z\nelement face 1\nproperty list uchar int vertices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
            "has no list 'vertex_indices'"},
        BrokenMesh{"ply_endless_list", "a.ply", PLY_HEADER + "0 0 0\n1 0 0\n0 1 0\n9223372036854775807\n",
                   "no whole number for the length"},
        BrokenMesh{"stl_two_vertices", "a.stl",
                   "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 "
                   "0\nendloop\nendfacet\nendsolid a\n",
                   "line 7: a facet of 2 vertices"},
        BrokenMesh{"gltf_skin", "a.gltf",
                   R"({"asset": {"version": "2.0"}, "nodes": [{}, {"mesh": 0, "skin": 0}]})",
                   "/nodes/1: is bent by a skin"},
        BrokenMesh{"gltf_morph", "a.gltf",
                   R"({"asset": {"version": "2.0"}, "meshes": [{"weights": [0, 0.5]}]})",
                   "/meshes/0: has weights"},
        BrokenMesh{"gltf_sparse", "a.gltf",
                   gltf_with(R"("sparse": {}, "type": "VEC3")", R"("byteStride": 12)"),
                   "/accessors/0: is sparse over interleaved"},
        BrokenMesh{"gltf_sparse_beyond", "a.gltf",
                   gltf_with(R"("type": "VEC3", "sparse": {"count": 4, )" + SPARSE + "}}"),
                   "/accessors/0/sparse: has fewer numbers than it says"},
        BrokenMesh{
            "gltf_sparse_values_beyond", "a.gltf",
            gltf_with(R"("type": "VEC3", "sparse": {"count": 3, )" + SPARSE + R"(, "byteOffset": 4}})"),
            "/accessors/0/sparse: has fewer numbers than it says"},
        BrokenMesh{"gltf_of_planes", "a.gltf", gltf_with(R"("type": "VEC2")"),
                   "/accessors/0: is not of type VEC3 and component type 5126"},
        BrokenMesh{"gltf_overlaps", "a.gltf", gltf_with(R"("type": "VEC3")", R"("byteStride": 4)"),
                   "/accessors/0: has 12 bytes each, but one every 4"},
        BrokenMesh{"gltf_offset_with_a_point", "a.gltf", gltf_with(R"("type": "VEC3", "byteOffset": 48.0)"),
                   "/accessors/0/byteOffset: is not a whole number from 0 on"},
        BrokenMesh{"gltf_offset_below", "a.gltf", gltf_with(R"("type": "VEC3")", R"("byteOffset": -4)"),
                   "/bufferViews/0/byteOffset: is not a whole number"},
        BrokenMesh{"gltf_matrix_of_15", "a.gltf",
                   R"({"asset": {"version": "2.0"}, "nodes": [{"matrix": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,1]}]})",
                   "/nodes/0/matrix: is not a list of 16 numbers"},
        BrokenMesh{"gltf_turn_of_3", "a.gltf",
                   R"({"asset": {"version": "2.0"}, "nodes": [{}, {"rotation": [0, 0, 1]}]})",
                   "/nodes/1/rotation: is not a list of 4 numbers"},
        BrokenMesh{"gltf_child_with_a_point", "a.gltf",
                   R"({"asset": {"version": "2.0"}, "nodes": [{"children": [1.0]}, {}]})",
                   "/nodes/0/children: is not a list of whole numbers"},
        BrokenMesh{"gltf_mode_with_a_point", "a.gltf",
                   R"({"asset": {"version": "2.0"}, "meshes": [{"primitives": [{"mode": 5.0}]}]})",
                   "/meshes/0/primitives/0/mode: is not a whole number from 0 to 6"},
        BrokenMesh{"gltf_behind_what_is_no_object", "a.gltf",
                   R"({"asset": {"version": "2.0"}, "nodes": [{}, {"children": [0, {"mesh": 1.0}]}]})",
                   "/nodes/1/children: is not a list"},
        BrokenMesh{"gltf_primitive_behind_a_number", "a.gltf",
                   R"({"asset": {"version": "2.0"}, "meshes": [{"primitives": [1, {"mode": 5.0}]}]})",
                   "/meshes/0/primitives/1/mode: is not a whole number"},
        BrokenMesh{"gltf_base64", "a.gltf",
                   R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "data:a/b;base64,AAA!AA=="}]})",
                   "/buffers/0/uri: has the byte 0x21"},
        BrokenMesh{"obj_patch", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nbzp 1 2 3\nf 1 2 3\n",
                   "line 4: 'bzp' is part of a free-form curve"},
        BrokenMesh{"obj_control", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\ff 1 2 3\nf 1 3 2\n",
                   "line 4: a keyword has a control character"},
        BrokenMesh{"obj_infinite", "a.obj", "v 0 0 1.#INF\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                   "line 1: a coordinate '1.#INF'"},
        BrokenMesh{"stl_second_solid_cut", "a.stl",
                   stl_with("vertex 1 0 0") + "solid b\nfacet normal 0 0 1\n", "ends without 'endsolid'"},
        BrokenMesh{"stl_facet_beside_a_name", "a.stl",
                   "solid a facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                   "endloop\nendfacet\nendsolid\n",
                   "line 1: a facet stands on the line of a solid's name"},
        BrokenMesh{"stl_behind_its_end", "a.stl",
                   stl_with("vertex 1 0 0") + "facet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
                   "a vertex behind 'endsolid'"},
        BrokenMesh{
            "ply_two_x", "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float x\nproperty float "
            "y\nproperty float z\nend_header\n",
            "has no property x that is one number"},
        BrokenMesh{"ply_two_formats", "a.ply", "ply\nformat ascii 1.0\nformat binary_little_endian 1.0\n",
                   "line 3: a second format"},
        BrokenMesh{"ply_version_2", "a.ply", "ply\nformat ascii 2.0\n", "line 2: the format is not of"},
        BrokenMesh{"ply_x_is_a_list", "a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty list uchar float x\nproperty float "
                   "y\nproperty float z\nend_header\n",
                   "has no property x that is one number"},
        BrokenMesh{"obj_curve", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ncurv 0 1 1 2\nf 1 2 3\n",
                   "line 4: 'curv' is part of a free-form curve"},
        BrokenMesh{"obj_goes_on", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\", "line 4: the file ends"},
        BrokenMesh{
            "ply_float_index", "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
            "z\nelement face 1\nproperty list uchar float vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 "
            "0\n3 0 1 1.5\n",
            "face 0 of 1: names vertex 1.5"},
        BrokenMesh{"gltf_of_version_1", "a.gltf", R"({"asset": {"version": "1.0"}})",
                   "remedy: check that it"},
        BrokenMesh{"ply_dots", "a.ply", PLY_HEADER + "0 0 0\n1.5.5 0 0\n0 1 0\n3 0 1 2\n",
                   "line 11: x '1.5.5'"},
        BrokenMesh{"ply_fraction", "a.ply", PLY_HEADER + "0 0 0\n1 0 0\n0 1 0\n3 0 1.7 2\n",
                   "line 13: vertex_indices '1.7' is not a whole number"},
        BrokenMesh{"ply_long_line", "a.ply", PLY_HEADER + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 5\n",
                   "line 13: face 0 goes on behind its vertex_indices"},
        BrokenMesh{"ply_two_a_line", "a.ply", PLY_HEADER + "0 0 0 1 0 0\n0 1 0\n3 0 1 2\n",
                   "line 10: vertex 0"},
        BrokenMesh{"ply_on_two_lines", "a.ply", PLY_HEADER + "0 0 0\n1 0 0\n0 1 0\n3\n0 1 2\n",
                   "line 13: vertex_indices is missing"},
        BrokenMesh{"ply_comment", "a.ply", PLY_HEADER + "0 0 0\n# one\n1 0 0\n0 1 0\n3 0 1 2\n",
                   "line 11: '#'"},
        BrokenMesh{"ply_cut", "a.ply", PLY_HEADER + "0 0 0\n1 0 0\n0 1 0\n", "face 0 of 1: is not there"},
        BrokenMesh{"ply_long", "a.ply", PLY_HEADER + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n",
                   "remedy: correct the counts"},
        BrokenMesh{
            "ply_flat", "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nelement face "
            "1\nproperty list uchar int vertex_indices\nend_header\n0 0\n1 0\n0 1\n3 0 1 2\n",
            "has no property z"},
        BrokenMesh{"ply_index", "a.ply", PLY_HEADER + "0 0 0\n1 0 0\n0 1 0\n3 0 1 5\n", "names vertex 5"},
        BrokenMesh{"ply_nan", "a.ply", PLY_HEADER + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "vertex 1"},
        BrokenMesh{"coff_cut_short", "a.off", "COFF\n3 4 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "1 of 4 faces"},
        BrokenMesh{"off_index", "a.OFF", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "line 6"}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(ImportTest, NamesAMissingFileAndAFolder) {
  const ScratchDirectory folder;
  EXPECT_THAT(message_of<InputError>([&] { import_mesh(folder.path() / "none.off"); }),
              HasSubstr("none.off"));
  EXPECT_THAT(message_of<InputError>([&] { import_mesh(folder.path()); }), HasSubstr("directory"));
}

TEST(WeldedTest, JoinsEqualPositionsOnlyAndKeepsTheOrder) {
  TriangleMesh mesh;
  const double almost = 1.0 + 2.3e-16;
  mesh.vertices = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {almost, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}};
  mesh.triangles = {{1, 2, 3}, {4, 5, 6}};
  const TriangleMesh result = welded(mesh);
  EXPECT_THAT(result.vertices, ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(almost, 0, 0)));
  EXPECT_THAT(result.triangles, ElementsAre(Corners{0, 1, 2}, Corners{3, 2, 0}));
}

TEST(ImportTest, AnObjMayCallColoursWeightsAndVerticesToCome) {
  const ScratchDirectory folder;
  const TriangleMesh mesh = import_mesh(folder.write(
      "a.obj",
      "v 0 0 0 1\nf 1 2 3\nv 1 0 0 0.2 0.3 0.4\nv 0 1 \\\n0\nv 9 9 9\nf\\\n-4 -3 \\\r\n-2\nv 8 8 8\n"));
  EXPECT_THAT(mesh.vertices, ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(ImportTest, MaterialsOfAnObjAreNotLookedFor) {
  const ScratchDirectory folder;
  const TriangleMesh mesh = single_precision_blob();
  const std::string plain = to_obj(mesh);
  const std::size_t faces = plain.find("f ");
  for (const char* material : {"mtllib lost.mtl\nusemtl none\n", "mtllib LOST.MTL\r\nusemtl\r\n",
                               "  mtllib\n\tusemtl a\n", "mtllib a b c\nusemtl x \\\n"}) {
    std::string text = material + plain.substr(0, faces);
    text += std::string("usemtl one\n") + plain.substr(faces);
    expect_same_triangles(import_mesh(folder.write("m.obj", text)), mesh, 0.0);
  }
}

}  // namespace
}  // namespace lmdbench
