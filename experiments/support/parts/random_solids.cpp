// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/validity.h>

#include <support/parts/chances.h>
#include <support/parts/prism_complex.h>
#include <support/parts/random_solids.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lmdbench::parts {
namespace {

using experiments::Random;

constexpr std::size_t CELLS = 5;

/// Uneven steps from a 128th to a quarter, about the middle.
std::vector<double> uneven_lines(std::size_t steps, Random& random) {
  std::vector<double> lines = {-0.5};
  for (std::size_t i = 0; i < steps; ++i)
    lines.push_back(lines.back() + std::ldexp(1.0 + static_cast<double>(random.index(3)),
                                              -2 - static_cast<int>(random.index(6))));
  return lines;
}

/// Steps `begin` up to `end`.
struct Range {
  std::size_t begin, end;
  bool has(std::size_t i) const { return begin <= i && i < end; }
};

Range random_range(Random& random) {
  const std::size_t a = random.index(CELLS), b = random.index(CELLS);
  return {std::min(a, b), std::max(a, b) + 1};
}

}  // namespace

bool is_sound(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return false;
  const ValidityReport report = check_mesh(build_surface(mesh));
  return report.closed && report.manifold && report.components == 1;
}

TriangleMesh random_polycube(Random& random) {
  for (;;) {
    std::array<std::array<Layers, CELLS>, CELLS> filled{};
    const std::size_t boxes = 3 + random.index(6);
    for (std::size_t n = 0; n < boxes; ++n) {
      const Range x = random_range(random), y = random_range(random), z = random_range(random);
      const Layers layers = (Layers{1} << z.end) - (Layers{1} << z.begin);
      const bool adds = n == 0 || random.uniform() < 0.5;
      for (std::size_t i = x.begin; i < x.end; ++i)
        for (std::size_t j = y.begin; j < y.end; ++j)
          filled[i][j] = adds ? filled[i][j] | layers : filled[i][j] & ~layers;
    }
    PrismComplex solid(uneven_lines(CELLS, random));
    solid.add_grid(uneven_lines(CELLS, random), uneven_lines(CELLS, random),
                   [&](std::size_t i, std::size_t j) { return filled[i][j]; });
    TriangleMesh mesh = solid.mesh();
    if (is_sound(mesh)) return mesh;
  }
}

TriangleMesh random_star_prism(Random& random) {
  for (;;) {
    const std::size_t sides = 5 + random.index(12), layers = 1 + random.index(3);
    Outline outer, inner;
    const double bore =
        random.uniform() < 0.5 ? 0.0 : std::ldexp(1.0, -1 - static_cast<int>(random.index(3)));
    for (std::size_t i = 0; i < sides; ++i) {
      const auto [x, y] = circle_point(static_cast<int>(i), static_cast<int>(sides));
      const double radius = random.uniform() < 0.4 ? 0.5 : random.uniform(0.2, 0.6);
      outer.emplace_back(dyadic(radius * x, 12), dyadic(radius * y, 12));
      inner.emplace_back(bore * outer.back());
    }
    std::vector<Layers> of_sector(sides);
    for (Layers& each : of_sector) each = random.uniform() < 0.6 ? ALL_LAYERS : Layers{random.index(8)};
    PrismComplex solid(uneven_lines(layers, random));
    if (bore > 0.0)
      solid.add_ring(inner, outer, [&](std::size_t i) { return of_sector[i]; });
    else
      for (std::size_t i = 0; i < sides; ++i)
        solid.add_cell({Point::Zero(), outer[i], outer[(i + 1) % sides]}, of_sector[i]);
    const double lean = random.uniform() < 0.3 ? dyadic(random.uniform(-0.5, 0.5), 4) : 0.0;
    TriangleMesh mesh =
        solid.mesh([lean](const Vec3& p) { return Vec3(p.x() + lean * p.z(), p.y(), p.z()); });
    if (is_sound(mesh)) return mesh;
  }
}

}  // namespace lmdbench::parts
