// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/shape/flatten.h>
#include <lmdbench/shape/planar_faces.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <support/rounded.h>
#include <support/sleeves.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <regex>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using testing::rounded_to_floats;
using testing::turned;

TEST(PlanarTolerance, TellsFloatsAndTheirDecimalsFromDoubles) {
  EXPECT_TRUE(is_single_precision(0.5));
  EXPECT_TRUE(is_single_precision(static_cast<double>(0.1F)));
  EXPECT_TRUE(is_single_precision(0.1));          // shortest decimal of 0.1F
  EXPECT_TRUE(is_single_precision(0.123456791));  // nine digits of 0.12345679F
  EXPECT_FALSE(is_single_precision(0.1 + 1e-12));
  EXPECT_FALSE(is_single_precision(std::sqrt(2.0)));
  EXPECT_FALSE(is_single_precision(1e300));
}

TEST(PlanarTolerance, IsAFewUlpsOfAFloatAtTheExtent) {
  TriangleMesh mesh = make_box(Vec3(3.0, 1.0, 1.0));
  EXPECT_EQ(single_precision_tolerance(mesh), SINGLE_PRECISION_ULPS * 0x1p-23);  // 1.5 m
  mesh.vertices[0].x() += 1e-13;
  EXPECT_EQ(single_precision_tolerance(mesh), 0.0);
}

/// Writers differ: trimesh writes ten decimals.
TEST(PlanarTolerance, TellsFloatsWrittenWithAsManyDigits) {
  TriangleMesh floats = rounded_to_floats(turned(make_box(Vec3(3.0, 1.0, 1.0)), 3));
  const TriangleMesh doubles = turned(make_box(Vec3(3.0, 1.0, 1.0)), 3);
  for (const char* format : {"{:.8g}", "{:.10g}", "{:.17g}", "{:.9f}", "{:.10f}"}) {
    for (const bool is_float : {true, false}) {
      TriangleMesh read = is_float ? floats : doubles;
      for (Vec3& p : read.vertices)
        for (double& x : p) x = std::stod(fmt::format(fmt::runtime(format), x));
      EXPECT_EQ(single_precision_tolerance(read) > 0.0, is_float) << format;
    }
  }
}

TEST(PlanarTolerance, IsNothingWhereItWouldBeMuchOfTheMesh) {
  TriangleMesh mesh = make_box(Vec3(100.0, 100.0, 10.0));
  EXPECT_GT(single_precision_tolerance(translated(mesh, Vec3(1e4, 0.0, 0.0))), 0.0);
  EXPECT_EQ(single_precision_tolerance(translated(mesh, Vec3(4.5e6, 0.0, 2.1e6))), 0.0);
}

TEST(PlanarTolerance, IsReadFromText) {
  using Kind = PlanarTolerance::Kind;
  EXPECT_EQ(parse_planar_tolerance("auto", "", "").kind, Kind::AUTO);
  EXPECT_EQ(parse_planar_tolerance("off", "", ""), (PlanarTolerance{Kind::LENGTH, 0.0}));
  EXPECT_EQ(parse_planar_tolerance("0", "", ""), (PlanarTolerance{Kind::LENGTH, 0.0}));
  EXPECT_EQ(parse_planar_tolerance("1e-6", "", ""), (PlanarTolerance{Kind::LENGTH, 1e-6}));
  EXPECT_EQ(parse_planar_tolerance("0.5%", "", ""), (PlanarTolerance{Kind::DIAGONAL, 0.005}));
  for (const char* wrong : {"", "%", "-1", "1e-6m", "nan", "inf", "on"})
    EXPECT_THROW(parse_planar_tolerance(wrong, "file", "/place"), UsageError) << wrong;
}

/// Largest distance of a face's vertices from its plane.
double unevenness(const TriangleMesh& mesh, const PlanarFace& face) {
  double result = 0.0;
  for (const std::int32_t v : face.vertices)
    result = std::max(result, std::abs(face.plane.height(mesh.vertices[static_cast<std::size_t>(v)])));
  return result;
}

TEST(Flatten, PutsARoundedBoxBackIntoSixPlanes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriangleMesh exact = turned(make_box(Vec3(1.0, 0.7, 0.2), 6), seed);
    TriangleMesh mesh = rounded_to_floats(exact);
    const TriangleMesh before = mesh;
    const FlatteningReport report = flatten(mesh);
    EXPECT_EQ(report.planes, 6) << "seed " << seed;
    EXPECT_GT(report.moved_vertices, 200) << "seed " << seed;
    EXPECT_EQ(mesh.planar_tolerance, report.tolerance);
    double largest = 0.0, from_exact = 0.0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      largest = std::max(largest, (mesh.vertices[v] - before.vertices[v]).norm());
      from_exact = std::max(from_exact, (mesh.vertices[v] - exact.vertices[v]).norm());
    }
    EXPECT_EQ(largest, report.largest_move);
    EXPECT_LT(largest, 2e-7) << "seed " << seed;
    EXPECT_LT(from_exact, 2e-7) << "seed " << seed;
    const auto faces = planar_faces(build_surface(mesh), 1e-15);
    ASSERT_EQ(faces.size(), 6u) << "seed " << seed;
    for (const PlanarFace& face : faces) {
      EXPECT_EQ(face.triangles.size(), 72u);
      EXPECT_LT(unevenness(mesh, face), 1e-15) << "seed " << seed;
    }
  }
}

/// A corner of three planes moves farther than its distance from each; the reports include that.
TEST(Flatten, SaysHowFarTheFarthestMovedAndMight) {
  const std::regex sentence(
      R"((\d+) vertices put back into (\d+) planes that they were within (\S+) of; the farthest moved by (\S+) \(allowed: (\S+)\))");
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TriangleMesh mesh = rounded_to_floats(turned(make_l_block(0.8), seed));
    const FlatteningReport report = flatten(mesh);
    const std::string text = to_text(report);
    std::smatch said;
    ASSERT_TRUE(std::regex_match(text, said, sentence)) << text;
    EXPECT_EQ(std::stoll(said[1]), report.moved_vertices);
    EXPECT_EQ(std::stoll(said[2]), report.planes);
    EXPECT_NEAR(std::stod(said[3]), report.tolerance, 0.01 * report.tolerance);
    EXPECT_NEAR(std::stod(said[4]), report.largest_move, 0.01 * report.largest_move);
    EXPECT_LE(std::stod(said[4]), std::stod(said[5])) << text;
    EXPECT_GT(std::stod(said[5]), 1.01 * std::stod(said[3])) << "what a corner of two planes may move";
  }
}

/// The same mesh with another order of vertices and triangles, and other first corners.
TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed, std::vector<std::int32_t>& place) {
  std::mt19937_64 random(seed);
  place.resize(mesh.vertices.size());
  std::iota(place.begin(), place.end(), 0);
  std::ranges::shuffle(place, random);
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < place.size(); ++v)
    result.vertices[static_cast<std::size_t>(place[v])] = mesh.vertices[v];
  for (auto& triangle : result.triangles) {
    for (std::int32_t& corner : triangle) corner = place[static_cast<std::size_t>(corner)];
    std::ranges::rotate(triangle, triangle.begin() + static_cast<std::ptrdiff_t>(random() % 3));
  }
  std::ranges::shuffle(result.triangles, random);
  return result;
}

/// Planes at small angles compete for vertices: the order of a file must not matter.
TEST(Flatten, DoesNotDependOnHowTheMeshIsCounted) {
  std::size_t given_up = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TriangleMesh mesh = rounded_to_floats(turned(testing::make_ring(0.5, 0.4, 360, 2), seed));
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      mesh.vertices[v] *= 1.0 + 7e-7 * std::sin(3.0 * static_cast<double>(v));
    const TriangleMesh before = mesh;
    const PlanarTolerance tolerance{PlanarTolerance::Kind::LENGTH, 4e-7};
    std::vector<std::int32_t> place;
    TriangleMesh other = shuffled(mesh, seed, place);
    const FlatteningReport report = flatten(mesh, tolerance), of_other = flatten(other, tolerance);
    EXPECT_GT(report.moved_vertices, 0) << "seed " << seed;
    EXPECT_EQ(report.planes, of_other.planes) << "seed " << seed;
    given_up += report.planes < 722 ? 1 : 0;
    for (std::size_t v = 0; v < place.size(); ++v)
      ASSERT_EQ(mesh.vertices[v], other.vertices[static_cast<std::size_t>(place[v])])
          << "seed " << seed << ", vertex " << v;
  }
  EXPECT_GT(given_up, 5u) << "no plane is given up: the test sees nothing of the order in which they are";
}

TEST(Flatten, PutsTwelveTrianglesBackToo) {
  TriangleMesh mesh = rounded_to_floats(turned(make_box(Vec3(1.0, 0.7, 0.2)), 3));
  EXPECT_EQ(flatten(mesh).planes, 6);
  EXPECT_EQ(planar_faces(build_surface(mesh), 1e-15).size(), 6u);
}

TEST(Flatten, LeavesCurvedShapesAlone) {
  for (TriangleMesh mesh : {make_blob(0.5, 0.1, 5), make_unequal(0.5, 24, 30.0), make_sphere(0.5, 5)}) {
    mesh = rounded_to_floats(turned(std::move(mesh), 5));
    const TriangleMesh before = mesh;
    const FlatteningReport report = flatten(mesh);
    EXPECT_GT(report.tolerance, 0.0);
    EXPECT_EQ(report.moved_vertices, 0);
    EXPECT_EQ(mesh.vertices, before.vertices);
    EXPECT_EQ(mesh.planar_tolerance, 0.0);
    EXPECT_FALSE(says_something(report));
  }
}

TEST(Flatten, SaysWhatAGivenToleranceLeaves) {
  const auto text_of = [](TriangleMesh mesh, double tolerance) {
    const TriangleMesh before = mesh;
    const FlatteningReport report = flatten(mesh, {PlanarTolerance::Kind::LENGTH, tolerance});
    EXPECT_EQ(mesh.vertices, before.vertices);
    EXPECT_TRUE(says_something(report));
    return to_text(report);
  };
  const std::string chance = text_of(turned(make_blob(0.5, 0.1, 4), 5), 2e-4);
  EXPECT_NE(chance.find("as chance explains as many (remedy: a smaller"), std::string::npos) << chance;
  const std::string noise = text_of(turned(make_box({1, 1, 1}, 4), 5), 0.02);
  EXPECT_NE(noise.find("; 192 triangles are lower than 16 tolerances"), std::string::npos) << noise;
  EXPECT_EQ(noise.find("had to be"), std::string::npos) << noise;
}

TEST(Flatten, LeavesFlatFloatsAndDoublesAloneAndSaysSo) {
  TriangleMesh axis_aligned = make_box(Vec3(1.0, 0.5, 0.25), 4);
  const FlatteningReport of_floats = flatten(axis_aligned);
  EXPECT_GT(of_floats.tolerance, 0.0);
  EXPECT_EQ(axis_aligned.planar_tolerance, 0.0);
  EXPECT_EQ(to_text(of_floats).find("no vertex had to be put back into a plane (tolerance "), 0u);
  TriangleMesh doubles = turned(make_box(Vec3(1.0, 0.5, 0.25), 4), 1);
  const TriangleMesh before = doubles;
  const FlatteningReport of_doubles = flatten(doubles);
  EXPECT_EQ(of_doubles.tolerance, 0.0);
  EXPECT_EQ(doubles.vertices, before.vertices);
  EXPECT_EQ(to_text(of_doubles), "taken as they are (planar tolerance 0)");
}

TEST(Flatten, TakesTheUsersTolerance) {
  using Kind = PlanarTolerance::Kind;
  TriangleMesh rough = make_box(Vec3(1.0, 1.0, 1.0), 4);
  for (std::size_t v = 0; v < rough.vertices.size(); ++v)
    rough.vertices[v] +=
        1e-5 * Vec3(std::sin(17.0 * static_cast<double>(v)), std::cos(5.0 * static_cast<double>(v)),
                    std::sin(3.0 * static_cast<double>(v)));
  TriangleMesh off = rough, by_length = rough, by_share = rough;
  EXPECT_EQ(flatten(off, {Kind::LENGTH, 0.0}).moved_vertices, 0);
  EXPECT_EQ(flatten(by_length, {Kind::LENGTH, 5e-5}).planes, 6);
  EXPECT_NEAR(flatten(by_share, {Kind::DIAGONAL, 3e-5}).tolerance, 3e-5 * std::sqrt(3.0), 1e-8);
  EXPECT_EQ(planar_faces(build_surface(by_length), 1e-14).size(), 6u);
}

}  // namespace
}  // namespace lmdbench
