// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace lmdbench {

namespace {

constexpr double PI = std::numbers::pi;
constexpr double PRESSURE_ANGLE = PI / 9.0;
/// Outward lean of a flank at the root, in parts of the gap between two teeth at the base circle.
constexpr double FLANK_LEAN = 0.05;

Vec2 direction(int i, int n) {
  const auto [x, y] = circle_point(i, n);
  return {x, y};
}

/// Vertices in rows of `around`.
struct Rows {
  std::int32_t first;
  int around;

  std::int32_t at(int row, int i) const { return first + row * around + i % around; }
};

/// Two triangles between neighbours of two rows; seen from outside the second row is to the left.
void add_square(TriangleMesh& mesh, std::int32_t a, std::int32_t b, std::int32_t next_b,
                std::int32_t next_a) {
  mesh.triangles.push_back({a, b, next_b});
  mesh.triangles.push_back({a, next_b, next_a});
}

/// Involute function: angle between an involute's start and its point at the pressure angle.
double involute(double angle) {
  return std::tan(angle) - angle;
}

}  // namespace

Outline circle_outline(double radius, const Outline& under) {
  return [radius, under](int count, double height) {
    std::vector<Vec2> points;
    if (under) {
      for (const Vec2& p : under(count, height)) points.push_back(radius / p.norm() * p);
      return points;
    }
    for (int i = 0; i < count; ++i) points.push_back(radius * direction(i, count));
    return points;
  };
}

Outline polygon_outline(int sides, double inradius) {
  assert(sides >= 3);
  const double radius = inradius / direction(1, 2 * sides).x();
  return [sides, radius](int count, double) {
    assert(count % sides == 0);
    const int cells = count / sides;
    std::vector<Vec2> points;
    for (int side = 0; side < sides; ++side) {
      // Corners half a side before and after the axis of the side.
      const Vec2 from = radius * direction(2 * side + 2 * sides - 1, 2 * sides);
      const Vec2 to = radius * direction(2 * side + 1, 2 * sides);
      for (int i = 0; i < cells; ++i) {
        const double t = static_cast<double>(i) / cells;
        points.push_back(from + t * (to - from));
      }
    }
    return points;
  };
}

Outline gear_outline(int teeth, double module, double backlash) {
  assert(teeth >= 5);
  const double pitch_radius = 0.5 * teeth * module;
  return [=](int count, double) {
    assert(count % (2 * teeth) == 0);
    const int flank = count / (2 * teeth);
    const double base = pitch_radius * std::cos(PRESSURE_ANGLE), root = pitch_radius - 1.25 * module;
    const double tip = pitch_radius + module;
    const auto half_width = [&](double r) {
      const double at_base = 0.5 * PI / teeth - 0.5 * backlash / pitch_radius + involute(PRESSURE_ANGLE);
      if (r > base) return at_base - involute(std::acos(base / r));
      return at_base + FLANK_LEAN * (PI / teeth - at_base) * (base - r) / (base - root);
    };
    std::vector<Vec2> points;
    for (int tooth = 0; tooth < teeth; ++tooth) {
      const double middle = 2.0 * PI * tooth / teeth;
      for (int i = 0; i < 2 * flank; ++i) {
        const bool rises = i < flank;
        const double t = static_cast<double>(rises ? i : 2 * flank - 1 - i) / (flank - 1);
        const double r = root + t * (tip - root);
        const double angle = middle + (rises ? -half_width(r) : half_width(r));
        points.emplace_back(r * rounded_to_grid(std::cos(angle)), r * rounded_to_grid(std::sin(angle)));
      }
    }
    return points;
  };
}

Outline thread_outline(double radius, double depth, double pitch) {
  return [=](int count, double height) {
    std::vector<Vec2> points;
    for (int i = 0; i < count; ++i) {
      const double turns = static_cast<double>(i) / count - height / pitch;
      // 0 in the middle of a crest, 1 in that of a root; the ends of the wave are cut off.
      const double wave = 2.0 * std::abs(turns - std::floor(turns) - 0.5);
      const double r = radius - depth * std::clamp(1.5 * wave - 0.25, 0.0, 1.0);
      points.push_back(r * direction(i, count));
    }
    return points;
  };
}

TriangleMesh make_sleeve(const Outline& outline, const Outline& bore, const SleeveChoice& choice) {
  // Own names: clang before 16 captures no structured bindings.
  const double height = choice.height;
  const int around = choice.around, layers = choice.layers, rings = choice.rings;
  assert(around >= 3 && layers >= 1 && rings >= 1);
  TriangleMesh mesh;
  const auto z_of = [&](int layer) { return height * (static_cast<double>(layer) / layers - 0.5); };
  const auto wall = [&](const Outline& shape) {
    const Rows rows{static_cast<std::int32_t>(mesh.vertices.size()), around};
    for (int layer = 0; layer <= layers; ++layer)
      for (const Vec2& p : shape(around, z_of(layer))) mesh.vertices.emplace_back(p.x(), p.y(), z_of(layer));
    return rows;
  };
  const Rows outside = wall(outline);
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < around; ++i)
      add_square(mesh, outside.at(layer, i), outside.at(layer, i + 1), outside.at(layer + 1, i + 1),
                 outside.at(layer + 1, i));
  Rows inside = outside;
  if (bore) {
    inside = wall(bore);
    for (int layer = 0; layer < layers; ++layer)
      for (int i = 0; i < around; ++i)
        add_square(mesh, inside.at(layer, i + 1), inside.at(layer, i), inside.at(layer + 1, i),
                   inside.at(layer + 1, i + 1));
  }
  for (const int layer : {0, layers}) {
    const std::vector<Vec2> outer = outline(around, z_of(layer));
    const std::vector<Vec2> inner =
        bore ? bore(around, z_of(layer)) : std::vector<Vec2>(static_cast<std::size_t>(around), Vec2::Zero());
    const Rows between{static_cast<std::int32_t>(mesh.vertices.size()), around};
    for (int ring = 1; ring < rings; ++ring) {
      const double t = static_cast<double>(ring) / rings;
      for (std::size_t i = 0; i < outer.size(); ++i) {
        const Vec2 p = outer[i] + t * (inner[i] - outer[i]);
        mesh.vertices.emplace_back(p.x(), p.y(), z_of(layer));
      }
    }
    const auto centre = static_cast<std::int32_t>(mesh.vertices.size());
    if (!bore) mesh.vertices.emplace_back(0.0, 0.0, z_of(layer));
    const auto vertex = [&](int ring, int i) {
      if (ring == 0) return outside.at(layer, i);
      if (ring < rings) return between.at(ring - 1, i);
      return bore ? inside.at(layer, i) : centre;
    };
    for (int ring = 0; ring < rings; ++ring) {
      for (int i = 0; i < around; ++i) {
        const std::int32_t a = vertex(ring, i), b = vertex(ring, i + 1), c = vertex(ring + 1, i + 1),
                           d = vertex(ring + 1, i);
        // The upper end faces up, the lower one down.
        if (c == d) {
          mesh.triangles.push_back(layer > 0 ? std::array{a, b, c} : std::array{b, a, c});
        } else if (layer > 0) {
          add_square(mesh, a, b, c, d);
        } else {
          add_square(mesh, b, a, d, c);
        }
      }
    }
  }
  return mesh;
}

}  // namespace lmdbench
