// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/shape/flatten.h>

#include <study/completeness/hostile_meshes.h>
#include <support/parts/chances.h>

#include <array>
#include <utility>

namespace lmdbench::completeness {
namespace {

using experiments::Random;
using parts::power_of_ten;

/// A random integer from `low` to `high`, both included.
int between(int low, int high, Random& random) {
  return low + static_cast<int>(random.index(static_cast<std::size_t>(high - low + 1)));
}

/// Triangles between few points of a coarse lattice: many share points, cross or have no area.
TriangleMesh soup(Random& random) {
  TriangleMesh mesh;
  const int vertices = between(3, 14, random), bits = between(1, 4, random);
  const bool is_flat = random.index(4) == 0;
  for (int i = 0; i < vertices; ++i) {
    Vec3 p;
    for (double& x : p) x = parts::dyadic(random.uniform(-0.5, 0.5), bits);
    if (is_flat) p.z() = 0.0;
    mesh.vertices.push_back(p);
  }
  for (int i = between(1, 24, random); i > 0; --i)
    mesh.triangles.push_back({between(0, vertices - 1, random), between(0, vertices - 1, random),
                              between(0, vertices - 1, random)});
  return mesh;
}

struct HostileShape {
  const char* name;
  TriangleMesh (*make)(Random& random);
};

constexpr std::array<HostileShape, 13> HOSTILE_SHAPES = {{
    {"blob", [](Random& random) { return make_blob(0.5, 0.2 * random.uniform(), 1); }},
    {"sphere", [](Random& random) { return make_sphere(0.5, between(0, 1, random)); }},
    {"box",
     [](Random&) {
       return make_box({0.75, 0.5, 0.25});
     }},
    {"gridded box",
     [](Random& random) {
       return make_box({1.0, 0.75, 0.5}, between(2, 3, random));
     }},
    {"plate",
     [](Random& random) {
       return make_box({1.0, 1.0, power_of_ten(-9.0, -1.0, random)},
                       {between(1, 4, random), between(1, 4, random), 1});
     }},
    {"torus",
     [](Random& random) { return make_torus(0.35, 0.15, between(4, 9, random), between(3, 6, random)); }},
    {"needles",
     [](Random& random) {
       return make_needles(power_of_ten(-4.0, -0.5, random), 1.0, between(3, 8, random));
     }},
    {"caps",
     [](Random& random) { return make_caps(0.4, power_of_ten(-4.0, -0.3, random), between(5, 10, random)); }},
    {"unequal",
     [](Random& random) { return make_unequal(0.5, between(2, 3, random), power_of_ten(0.5, 6.0, random)); }},
    {"patch",
     [](Random& random) {
       return make_patch(1.0, between(2, 5, random), random.index(3) == 0 ? 0.0 : 0.2 * random.uniform());
     }},
    {"l-block", [](Random&) { return make_l_block(0.7); }},
    {"two boxes",
     [](Random& random) {
       return make_two_boxes({0.4, 0.5, 0.5}, random.index(3) == 0 ? 0.0 : power_of_ten(-9.0, -1.0, random));
     }},
    {"soup", soup},
}};

std::int32_t some_vertex(const TriangleMesh& mesh, Random& random) {
  return static_cast<std::int32_t>(random.index(mesh.vertices.size()));
}

std::size_t some_triangle(const TriangleMesh& mesh, Random& random) {
  return random.index(mesh.triangles.size());
}

Vec3& point(TriangleMesh& mesh, std::int32_t vertex) {
  return mesh.vertices[static_cast<std::size_t>(vertex)];
}

/// A change that breaks a mesh.
struct Mishap {
  const char* name;
  void (*happen)(TriangleMesh& mesh, Random& random);
};

constexpr std::array<Mishap, 16> MISHAPS = {{
    {"jittered",
     [](TriangleMesh& mesh, Random& random) {
       const double size = power_of_ten(-17.0, -2.0, random);
       for (Vec3& p : mesh.vertices) p += size * random.uniform() * random.direction();
     }},
    {"squashed",
     [](TriangleMesh& mesh, Random& random) {
       Vec3 way = Vec3::Unit(static_cast<Eigen::Index>(random.index(3)));
       if (random.index(2) == 0) way = random.direction();
       const double left = random.index(4) == 0 ? 0.0 : power_of_ten(-12.0, -0.5, random);
       for (Vec3& p : mesh.vertices) p -= (1.0 - left) * p.dot(way) * way;
     }},
    {"turned",
     [](TriangleMesh& mesh, Random& random) {
       const Mat3 turn = random.rotation().toRotationMatrix();
       for (Vec3& p : mesh.vertices) p = turn * p;
     }},
    {"in floats", [](TriangleMesh& mesh,
                     Random&) { mesh = turned_to_floats(std::move(mesh), Eigen::Quaterniond::Identity()); }},
    {"in flattened floats",
     [](TriangleMesh& mesh, Random& random) {
       mesh = turned_to_floats(std::move(mesh), random.rotation());
       flatten(mesh);
     }},
    {"on a lattice",
     [](TriangleMesh& mesh, Random& random) {
       const int bits = between(2, 20, random);
       for (Vec3& p : mesh.vertices)
         for (double& x : p) x = parts::dyadic(x, bits);
     }},
    {"with triangles there twice",
     [](TriangleMesh& mesh, Random& random) {
       for (int i = between(1, 4, random); i > 0; --i)
         mesh.triangles.push_back(mesh.triangles[some_triangle(mesh, random)]);
     }},
    {"with triangles turned over",
     [](TriangleMesh& mesh, Random& random) {
       for (int i = between(1, 4, random); i > 0; --i) {
         auto& corners = mesh.triangles[some_triangle(mesh, random)];
         std::swap(corners[0], corners[1]);
       }
     }},
    {"with holes",
     [](TriangleMesh& mesh, Random& random) {
       for (int i = between(1, 6, random); i > 0 && mesh.triangles.size() > 1; --i) {
         std::swap(mesh.triangles[some_triangle(mesh, random)], mesh.triangles.back());
         mesh.triangles.pop_back();
       }
     }},
    {"with edges of no length",
     [](TriangleMesh& mesh, Random& random) {
       for (int i = between(1, 3, random); i > 0; --i)
         point(mesh, some_vertex(mesh, random)) = point(mesh, some_vertex(mesh, random));
     }},
    {"with short edges",
     [](TriangleMesh& mesh, Random& random) {
       const double left = power_of_ten(-15.0, -2.0, random);
       for (int i = between(1, 4, random); i > 0; --i) {
         const auto& corners = mesh.triangles[some_triangle(mesh, random)];
         Vec3& p = point(mesh, corners[0]);
         p += (1.0 - left) * (point(mesh, corners[1]) - p);
       }
     }},
    {"taken apart",
     [](TriangleMesh& mesh, Random& random) {
       // Some triangles get corners of their own, at the same places.
       const double share = random.index(2) == 0 ? 1.0 : 0.3;
       for (auto& corners : mesh.triangles) {
         if (!(random.uniform() < share)) continue;
         for (std::int32_t& corner : corners) {
           const Vec3 p = point(mesh, corner);
           corner = static_cast<std::int32_t>(mesh.vertices.size());
           mesh.vertices.push_back(p);
         }
       }
     }},
    {"with T-junctions",
     [](TriangleMesh& mesh, Random& random) {
       for (int i = between(1, 4, random); i > 0; --i) {
         const std::size_t t = some_triangle(mesh, random);
         const auto [a, b, c] = mesh.triangles[t];
         const auto middle = static_cast<std::int32_t>(mesh.vertices.size());
         mesh.vertices.emplace_back(0.5 * (point(mesh, a) + point(mesh, b)));
         mesh.triangles[t] = {a, middle, c};
         mesh.triangles.push_back({middle, b, c});
       }
     }},
    {"with fins",
     [](TriangleMesh& mesh, Random& random) {
       for (int i = between(1, 3, random); i > 0; --i) {
         const auto corners = mesh.triangles[some_triangle(mesh, random)];
         mesh.vertices.emplace_back(point(mesh, corners[0]) + 0.3 * random.uniform() * random.direction());
         mesh.triangles.push_back(
             {corners[0], corners[1], static_cast<std::int32_t>(mesh.vertices.size() - 1)});
       }
     }},
    {"with spikes",
     [](TriangleMesh& mesh, Random& random) {
       for (int i = between(1, 2, random); i > 0; --i)
         point(mesh, some_vertex(mesh, random)) += power_of_ten(-3.0, 1.0, random) * random.direction();
     }},
    {"with its own copy",
     [](TriangleMesh& mesh, Random& random) {
       if (mesh.triangles.size() > 100) return;
       const Vec3 away =
           random.index(2) == 0 ? Vec3::Zero() : Vec3(power_of_ten(-16.0, 0.0, random) * random.direction());
       mesh = merged(mesh, translated(mesh, away));
     }},
}};

}  // namespace

HostileMesh make_hostile_mesh(Random& random) {
  const HostileShape& shape = HOSTILE_SHAPES[random.index(HOSTILE_SHAPES.size())];
  HostileMesh result{shape.make(random), shape.name};
  for (int i = between(0, 3, random); i > 0; --i) {
    const Mishap& mishap = MISHAPS[random.index(MISHAPS.size())];
    mishap.happen(result.mesh, random);
    result.history += std::string(" ") + mishap.name;
  }
  return result;
}

}  // namespace lmdbench::completeness
