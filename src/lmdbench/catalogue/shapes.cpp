// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>

#include <Eigen/Geometry>

#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace lmdbench {
namespace {

// Ridges round the spindle of needles.
constexpr std::int32_t NEEDLE_RIDGES = 5;

// Surface of the box spanned by three ascending rows of coordinates, a vertex at every lattice
// point.
TriangleMesh lattice_box(const std::array<std::vector<double>, 3>& coordinates) {
  TriangleMesh mesh;
  std::map<std::array<std::size_t, 3>, std::int32_t> numbers;
  const auto vertex = [&](const std::array<std::size_t, 3>& at) {
    const auto [entry, is_new] = numbers.try_emplace(at, static_cast<std::int32_t>(mesh.vertices.size()));
    if (is_new)
      mesh.vertices.emplace_back(coordinates[0][at[0]], coordinates[1][at[1]], coordinates[2][at[2]]);
    return entry->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool upper : {false, true}) {
      for (std::size_t i = 0; i + 1 < coordinates[u].size(); ++i) {
        for (std::size_t j = 0; j + 1 < coordinates[v].size(); ++j) {
          const auto corner = [&](std::size_t di, std::size_t dj) {
            std::array<std::size_t, 3> at{};
            at[axis] = upper ? coordinates[axis].size() - 1 : 0;
            at[u] = i + di;
            at[v] = j + dj;
            return vertex(at);
          };
          const std::array<std::int32_t, 4> ring{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (upper) {
            mesh.triangles.push_back({ring[0], ring[1], ring[2]});
            mesh.triangles.push_back({ring[0], ring[2], ring[3]});
          } else {
            mesh.triangles.push_back({ring[0], ring[2], ring[1]});
            mesh.triangles.push_back({ring[0], ring[3], ring[2]});
          }
        }
      }
    }
  }
  return mesh;
}

// Smooth bumps on the unit sphere in [-1, 1]: products of polynomials, so that no sine is needed.
double bumps(const Vec3& p) {
  const double a = p.x() * p.y() * (p.x() * p.x() - p.y() * p.y());
  const double b = p.y() * p.z() * (4.0 * p.z() * p.z() - 1.0);
  const double c = p.x() * p.z() * (7.0 * p.y() * p.y() - 1.0);
  return 1.4 * a + 0.5 * b + 0.6 * c;
}

// Prism of a profile in xz, convex or star-shaped from its first corner, counter-clockwise from -y.
TriangleMesh extrude(const std::vector<std::array<double, 2>>& profile, double length) {
  TriangleMesh mesh;
  const auto n = static_cast<std::int32_t>(profile.size());
  for (const double y : {-0.5 * length, 0.5 * length})
    for (const auto& [x, z] : profile) mesh.vertices.emplace_back(x, y, z);
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t next = (i + 1) % n;
    mesh.triangles.push_back({i, i + n, next});
    mesh.triangles.push_back({next, i + n, next + n});
  }
  for (std::int32_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i, i + 1});
    mesh.triangles.push_back({n, n + i + 1, n + i});
  }
  return mesh;
}

}  // namespace

TriangleMesh make_sphere(double radius, int subdivisions) {
  assert(subdivisions >= 0);
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Vec3& vertex : mesh.vertices) vertex.normalize();
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> midpoints;
    const auto midpoint = [&](std::int32_t a, std::int32_t b) {
      const auto number = static_cast<std::int32_t>(mesh.vertices.size());
      const auto [entry, is_new] = midpoints.try_emplace(std::minmax(a, b), number);
      if (is_new)
        mesh.vertices.push_back(
            (mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)])
                .normalized());
      return entry->second;
    };
    std::vector<std::array<std::int32_t, 3>> finer;
    finer.reserve(4 * mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::int32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return scaled(std::move(mesh), radius);
}

TriangleMesh make_box(const Vec3& size, int cells) {
  return make_box(size, std::array{cells, cells, cells});
}

TriangleMesh make_box(const Vec3& size, const std::array<int, 3>& cells) {
  std::array<std::vector<double>, 3> coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    assert(cells[axis] >= 1);
    for (int i = 0; i <= cells[axis]; ++i)
      coordinates[axis].push_back(size[static_cast<int>(axis)] *
                                  (static_cast<double>(i) / cells[axis] - 0.5));
  }
  return lattice_box(coordinates);
}

TriangleMesh make_torus(double ring_radius, double tube_radius, int ring_cells, int tube_cells) {
  assert(ring_cells >= 3 && tube_cells >= 3);
  TriangleMesh mesh;
  const auto vertex = [&](int i, int j) { return (i % ring_cells) * tube_cells + j % tube_cells; };
  for (int i = 0; i < ring_cells; ++i) {
    const auto [ring_x, ring_y] = circle_point(i, ring_cells);
    for (int j = 0; j < tube_cells; ++j) {
      const auto [out, up] = circle_point(j, tube_cells);
      const double r = ring_radius + tube_radius * out;
      mesh.vertices.emplace_back(r * ring_x, r * ring_y, tube_radius * up);
    }
  }
  for (int i = 0; i < ring_cells; ++i) {
    for (int j = 0; j < tube_cells; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh make_blob(double radius, double bump_height, int subdivisions) {
  TriangleMesh mesh = make_sphere(1.0, subdivisions);
  for (Vec3& vertex : mesh.vertices) vertex *= radius + bump_height * bumps(vertex);
  return mesh;
}

TriangleMesh make_unequal(double radius, int cells, double ratio) {
  assert(cells >= 2 && ratio > 1.0);
  // Geometric steps; their factor is rounded like the sines.
  const double growth = rounded_to_grid(std::pow(ratio, 1.0 / (cells - 1)));
  std::vector<double> row{0.0};
  for (double step = 1.0; static_cast<int>(row.size()) <= cells; step *= growth)
    row.push_back(row.back() + step);
  const double length = row.back();
  for (double& coordinate : row) coordinate = 2.0 * coordinate / length - 1.0;
  TriangleMesh mesh = lattice_box({row, row, row});
  for (Vec3& vertex : mesh.vertices) {
    vertex.normalize();
    vertex *= radius * (1.0 + 0.2 * bumps(vertex));
  }
  return mesh;
}

TriangleMesh make_needles(double radius, double height, int count, double groove) {
  assert(count >= 3 && groove >= 0.0 && groove < 1.0);
  TriangleMesh mesh;
  const std::int32_t ring = 2 * count;
  for (std::int32_t i = 0; i < ring; ++i) {
    const auto [x, y] = circle_point(i, ring);
    const double valley = 0.5 * (1.0 - circle_point(NEEDLE_RIDGES * i % ring, ring)[0]);
    const double r = radius * (1.0 - groove * valley);
    mesh.vertices.emplace_back(r * x, r * y, 0.0);
  }
  mesh.vertices.emplace_back(0.0, 0.0, 0.5 * height);
  mesh.vertices.emplace_back(0.0, 0.0, -0.5 * height);
  for (std::int32_t i = 0; i < ring; ++i) {
    const std::int32_t next = (i + 1) % ring;
    mesh.triangles.push_back({i, next, ring});
    mesh.triangles.push_back({next, i, ring + 1});
  }
  return mesh;
}

TriangleMesh make_caps(double radius, double height, int count) {
  assert(count >= 3);
  TriangleMesh mesh;
  for (const bool upper : {false, true}) {
    for (std::int32_t i = 0; i < count; ++i) {
      const auto [x, y] = circle_point(i, count);
      const double z = upper ? 0.5 + 0.125 * (x * x - y * y) : -0.5;
      mesh.vertices.emplace_back(radius * x, radius * y, height * z);
    }
  }
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t next = (i + 1) % count;
    mesh.triangles.push_back({i, next, next + count});
    mesh.triangles.push_back({i, next + count, i + count});
  }
  std::vector<std::int32_t> outline(static_cast<std::size_t>(count));
  std::iota(outline.begin(), outline.end(), 0);
  while (outline.size() > 2) {
    std::vector<std::int32_t> inner;
    for (std::size_t i = 0; i < outline.size(); i += 2) {
      inner.push_back(outline[i]);
      if (i + 1 == outline.size()) break;
      const std::int32_t a = outline[i], b = outline[i + 1], c = outline[(i + 2) % outline.size()];
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({a + count, b + count, c + count});
    }
    outline = std::move(inner);
  }
  return mesh;
}

TriangleMesh make_patch(double size, int cells, double wave_height) {
  assert(cells >= 1);
  TriangleMesh mesh;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double x = static_cast<double>(i) / cells - 0.5, y = static_cast<double>(j) / cells - 0.5;
      // Two hills and two hollows: a saddle's product, zero on the border.
      const double wave = 64.0 * x * y * (1.0 - 4.0 * x * x) * (1.0 - 4.0 * y * y);
      mesh.vertices.emplace_back(size * x, size * y, wave_height * wave);
    }
  }
  const auto vertex = [&](int i, int j) { return i * (cells + 1) + j; };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh make_wedge(double width, double length, double height) {
  return extrude({{-0.5 * width, -0.5 * height}, {0.5 * width, -0.5 * height}, {0.0, 0.5 * height}}, length);
}

TriangleMesh make_l_block(double size) {
  const double h = 0.5 * size;
  // From the reflex corner, which sees the whole profile.
  return extrude({{0, 0}, {0, h}, {-h, h}, {-h, -h}, {h, -h}, {h, 0}}, size);
}

TriangleMesh make_two_boxes(const Vec3& size, double gap) {
  const Vec3 offset(0.5 * (size.x() + gap), 0.0, 0.0);
  return merged(translated(make_box(size), -offset), translated(make_box(size), offset));
}

TriangleMesh turned_to_floats(TriangleMesh mesh, const Eigen::Quaterniond& rotation) {
  const Eigen::Matrix3d turn = rotation.normalized().toRotationMatrix();
  for (Vec3& vertex : mesh.vertices) {
    const Vec3 turned = turn * vertex;
    for (int axis = 0; axis < 3; ++axis) {
      // Through memory: GCC 12 can drop the two conversions of neighbouring coordinates at -O3.
      volatile float rounded = static_cast<float>(turned[axis]);
      vertex[axis] = static_cast<double>(rounded);
    }
  }
  return mesh;
}

TriangleMesh translated(TriangleMesh mesh, const Vec3& offset) {
  for (Vec3& vertex : mesh.vertices) vertex += offset;
  return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (Vec3& vertex : mesh.vertices) vertex *= factor;
  return mesh;
}

TriangleMesh merged(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::int32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + first, j + first, k + first});
  return a;
}

}  // namespace lmdbench
