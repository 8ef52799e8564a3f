// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>

#include <support/parts/chances.h>
#include <support/parts/formed_shapes.h>
#include <support/parts/prism_complex.h>
#include <support/parts/random_solids.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace lmdbench::parts {
namespace {

using experiments::Random;

/// Radius and height of each point.
using Profile = std::vector<Point>;

double sixty_fourths(std::size_t low, std::size_t high, Random& random) {
  return static_cast<double>(low + random.index(high - low + 1)) / 64.0;
}

/// Turns a profile about the z axis; the solid is on its left. Points of radius 0 are on the axis.
TriangleMesh turned(const Profile& profile, int sides, bool closed) {
  TriangleMesh mesh;
  std::vector<std::int32_t> first;
  for (const Point& p : profile) {
    first.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
    for (int i = 0; i < (p.x() > 0.0 ? sides : 1); ++i) {
      const auto [x, y] = circle_point(i, sides);
      mesh.vertices.emplace_back(p.x() * x, p.x() * y, p.y());
    }
  }
  const std::size_t ways = profile.size() - (closed ? 0 : 1);
  for (std::size_t k = 0; k < ways; ++k) {
    const std::size_t next = (k + 1) % profile.size();
    const auto at = [&](std::size_t point, int i) {
      return first[point] + (profile[point].x() > 0.0 ? i % sides : 0);
    };
    for (int i = 0; i < sides; ++i) {
      if (profile[k].x() > 0.0) mesh.triangles.push_back({at(k, i), at(k, i + 1), at(next, i + 1)});
      if (profile[next].x() > 0.0) mesh.triangles.push_back({at(k, i), at(next, i + 1), at(next, i)});
    }
  }
  return mesh;
}

/// The outer side of a turned part, from the bottom up; radii from a quarter to a half.
Profile outer_profile(Random& random) {
  double z = -0.5, r = sixty_fourths(20, 32, random);
  Profile profile = {{r, z}};
  const auto go = [&](double new_r, double up) {
    r = new_r, z += up;
    profile.emplace_back(r, z);
  };
  for (std::size_t section = 1 + random.index(4); section > 0; --section) {
    const double step = sixty_fourths(2, 8, random), deep = r - sixty_fourths(1, 4, random);
    go(r, step);
    switch (random.index(6)) {
      case 0:  // A shoulder.
        go(sixty_fourths(18, 32, random), 0.0);
        break;
      case 1:  // A cone.
        go(sixty_fourths(18, 32, random), step);
        break;
      case 2:  // A groove with a sharp bottom.
        go(deep, 0.5 * step), go(profile[profile.size() - 2].x(), 0.5 * step);
        break;
      case 3: {  // A square groove.
        const double rim = r;
        go(deep, 0.0), go(deep, step), go(rim, 0.0);
        break;
      }
      case 4: {  // One that is wider at its bottom.
        const double rim = r;
        go(deep, -1.0 / 64.0), go(deep, step + 2.0 / 64.0), go(rim, -1.0 / 64.0);
        break;
      }
      default: {  // A rib.
        const double foot = r;
        go(r + sixty_fourths(1, 6, random), 0.0), go(r, 1.0 / 64.0), go(foot, 0.0);
        break;
      }
    }
    if (r == profile[profile.size() - 2].x() && z == profile[profile.size() - 2].y()) profile.pop_back();
  }
  go(r, sixty_fourths(2, 8, random));
  return profile;
}

int some_sides(std::size_t points, Random& random) {
  constexpr int SIDES[] = {3, 4, 5, 6, 7, 8, 12, 16, 24};
  int sides = SIDES[random.index(std::size(SIDES))];
  while (static_cast<std::size_t>(sides) * points > 200) sides = (sides + 1) / 2;
  return std::max(sides, 3);
}

TriangleMesh random_turned_part(Random& random) {
  Profile profile = outer_profile(random);
  const int sides = some_sides(profile.size() + 3, random);
  const double low = profile.front().y(), high = profile.back().y(), bore = sixty_fourths(2, 12, random);
  const std::size_t kind = random.index(4);
  const double middle = 0.5 * (low + high);
  if (kind >= 2) {  // A bore through the part, with or without a step.
    profile.emplace_back(bore, high);
    if (kind == 3) profile.insert(profile.end(), {Point(bore, middle), Point(bore + 1.0 / 64.0, middle)});
    profile.emplace_back(profile.back().x(), low);
    return turned(profile, sides, true);
  }
  profile.insert(profile.begin(), Point(0.0, low));
  if (kind == 1) profile.insert(profile.end(), {Point(bore, high), Point(bore, middle)});
  profile.emplace_back(0.0, profile.back().y());
  return turned(profile, sides, false);
}

/// Sweeps a convex polygon (radius, height; counter-clockwise) around z, outwards and upwards.
TriangleMesh swept(const Profile& section, int around, int steps, double outwards, double up) {
  TriangleMesh mesh;
  const auto corners = static_cast<std::int32_t>(section.size());
  for (int i = 0; i <= steps; ++i) {
    const auto [x, y] = circle_point(i, around);
    const double share = static_cast<double>(i) / around;
    for (const Point& p : section)
      mesh.vertices.emplace_back((p.x() + outwards * share) * x, (p.x() + outwards * share) * y,
                                 p.y() + up * share);
  }
  for (std::int32_t i = 0; i < steps; ++i)
    for (std::int32_t k = 0; k < corners; ++k) {
      const std::int32_t next = (k + 1) % corners, a = corners * i, b = a + corners;
      mesh.triangles.push_back({a + k, b + k, b + next});
      mesh.triangles.push_back({a + k, b + next, a + next});
    }
  for (std::int32_t k = 1; k + 1 < corners; ++k) {
    mesh.triangles.push_back({0, k, k + 1});
    mesh.triangles.push_back({corners * steps, corners * steps + k + 1, corners * steps + k});
  }
  return mesh;
}

TriangleMesh random_coil(Random& random) {
  const double r = sixty_fourths(8, 16, random), w = sixty_fourths(2, 8, random),
               h = sixty_fourths(2, 8, random);
  const double taper = chance(0.5, random) ? 0.0 : 0.25 * h;
  Profile section = {{r, 0.0}, {r + w, taper}, {r + w, h - taper}, {r, h}};
  if (chance(0.2, random)) section = {{r, 0.0}, {r + w, 0.5 * h}, {r, h}};
  const int around = 4 + 2 * static_cast<int>(random.index(5));
  const int steps = around + static_cast<int>(random.index(static_cast<std::size_t>(around)));
  // Turns that touch, nearly touch, are apart, or overlap.
  const double kind = random.uniform();
  const double pitch = kind < 0.4   ? 1.0
                       : kind < 0.6 ? 1.0 + power_of_ten(-12.0, -2.0, random)
                       : kind < 0.9 ? 1.0 + random.uniform()
                                    : 0.75;
  const std::size_t way = random.index(3);
  return swept(section, around, steps, way > 0 ? pitch * w : 0.0, way < 2 ? pitch * h : 0.0);
}

TriangleMesh random_slit_block(Random& random) {
  Outline line = {{-0.5, 0.0}}, ground;
  double z = 0.0;
  const double pitch = sixty_fourths(8, 20, random);
  for (double x = -0.5 + 0.5 * pitch; x + 0.5 * pitch <= 0.5; x += pitch) {
    const double half =
        chance(0.3, random) ? 0.25 * pitch : std::min(0.3 * pitch, power_of_ten(-9.0, -1.0, random));
    const double tip =
        z + (chance(0.5, random) ? -1.0 : 1.0) * (chance(0.3, random) ? half : sixty_fourths(1, 12, random));
    line.emplace_back(x - half, z);
    line.emplace_back(x, tip);
    if (chance(0.2, random)) z += sixty_fourths(0, 4, random) - 2.0 / 64.0;
    line.emplace_back(x + half, z);
  }
  line.emplace_back(0.5, z);
  for (const Point& p : line) ground.emplace_back(p.x(), -0.625);
  return between(ground, line, 0.75);
}

TriangleMesh random_thin_plate(Random& random) {
  for (;;) {
    std::vector<double> xs = {-0.5}, ys = {-0.5};
    for (std::vector<double>* lines : {&xs, &ys})
      while (lines->back() < 0.25) lines->push_back(lines->back() + sixty_fourths(4, 24, random));
    PrismComplex solid(
        {0.0, chance(0.5, random) ? power_of_ten(-9.0, -2.0, random) : sixty_fourths(1, 2, random)});
    solid.add_grid(xs, ys,
                   [&](std::size_t, std::size_t) { return chance(0.85, random) ? ALL_LAYERS : NO_LAYER; });
    TriangleMesh mesh = solid.mesh();
    if (is_sound(mesh)) return mesh;
  }
}

/// Tips over the corners of a star, or between two polygons turned by half a side to each other.
TriangleMesh random_stellated_solid(Random& random) {
  const int sides = 3 + static_cast<int>(random.index(8));
  const double r = sixty_fourths(16, 32, random), h = sixty_fourths(4, 32, random);
  TriangleMesh mesh;
  const auto ring = [&](double radius, double z, int turn) {
    for (int i = 0; i < sides; ++i) {
      const auto [x, y] = circle_point(2 * i + turn, 2 * sides);
      mesh.vertices.emplace_back(radius * x, radius * y, z);
    }
  };
  const auto fan = [&](std::int32_t tip, const std::vector<std::int32_t>& border) {
    for (std::size_t i = 0; i < border.size(); ++i)
      mesh.triangles.push_back({tip, border[i], border[(i + 1) % border.size()]});
  };
  const bool is_antiprism = chance(0.5, random);
  const double inner = is_antiprism ? r : r * sixty_fourths(16, 64, random);
  ring(r, is_antiprism ? -0.5 * h : 0.0, 0);
  ring(inner, is_antiprism ? 0.5 * h : 0.0, 1);
  const std::int32_t n = sides;
  const double tips = is_antiprism && chance(0.7, random) ? 0.0 : sixty_fourths(2, 32, random);
  mesh.vertices.emplace_back(0.0, 0.0, (is_antiprism ? -0.5 * h : 0.0) - tips);
  mesh.vertices.emplace_back(0.0, 0.0, (is_antiprism ? 0.5 * h : 0.0) + tips);
  std::vector<std::int32_t> low, high;
  for (std::int32_t i = 0; i < n; ++i) {
    high.push_back(is_antiprism ? n + i : i);
    if (!is_antiprism) high.push_back(n + i);
    low.push_back(i);
    if (!is_antiprism) low.push_back(n + i);
    if (!is_antiprism) continue;
    mesh.triangles.push_back({i, (i + 1) % n, n + i});
    mesh.triangles.push_back({n + i, (i + 1) % n, n + (i + 1) % n});
  }
  std::reverse(low.begin(), low.end());
  fan(2 * n, low);
  fan(2 * n + 1, high);
  return mesh;
}

/// Heights over a grid of square cells about the middle.
struct Relief {
  int cells = 0;
  double side = 0.0;
  std::vector<double> heights;

  double& at(int i, int j) { return heights[static_cast<std::size_t>(j * (cells + 1) + i)]; }
};

Relief random_relief(Random& random) {
  Relief relief;
  relief.cells = 2 * (2 + static_cast<int>(random.index(3)));
  relief.side = 1.0 / 8.0;
  const std::size_t kind = random.index(4);
  std::vector<Vec3> planes;  // slopes and height
  for (std::size_t i = 2 + random.index(5); i > 0; --i)
    planes.emplace_back(sixty_fourths(0, 64, random) - 0.5, sixty_fourths(0, 64, random) - 0.5,
                        sixty_fourths(0, 8, random));
  for (int j = 0; j <= relief.cells; ++j)
    for (int i = 0; i <= relief.cells; ++i) {
      const double x = relief.side * (i - relief.cells / 2), y = relief.side * (j - relief.cells / 2);
      double z = sixty_fourths(0, 12, random);               // anything
      if (kind == 0) z = sixty_fourths(0, 2, random) * 2.0;  // steps: plateaus of equal height
      if (kind == 1) {                                       // facets
        z = -1.0;
        for (const Vec3& plane : planes) z = std::max(z, plane.x() * x + plane.y() * y + plane.z());
      }
      if (kind == 2) z = dyadic(0.1 * circle_point(3 * i + 5 * j, 32)[0], 20);  // waves
      relief.heights.push_back(z);
    }
  return relief;
}

/// The upper side of a relief, or the lower side of its cast; with a body to `ground`, or open.
/// @param step cells that are merged into one, 1 or 2
TriangleMesh relief_mesh(Relief& relief, bool up, bool open, double ground, int step, double holes,
                         Random& random) {
  TriangleMesh mesh;
  const int n = relief.cells / step;
  const auto number = [n](int i, int j, int level) {
    return static_cast<std::int32_t>(level * (n + 1) * (n + 1) + j * (n + 1) + i);
  };
  for (int level = 0; level < (open ? 1 : 2); ++level)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.vertices.emplace_back(relief.side * (step * i - relief.cells / 2),
                                   relief.side * (step * j - relief.cells / 2),
                                   level == 0 ? relief.at(step * i, step * j) : ground);
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    if (up)
      mesh.triangles.push_back({a, b, c});
    else
      mesh.triangles.push_back({a, c, b});
  };
  const auto quad = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    if (random.index(2) == 0)
      add(a, b, c), add(a, c, d);
    else
      add(b, c, d), add(b, d, a);
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if (open && chance(holes, random)) continue;
      quad(number(i, j, 0), number(i + 1, j, 0), number(i + 1, j + 1, 0), number(i, j + 1, 0));
      if (!open) quad(number(i, j, 1), number(i, j + 1, 1), number(i + 1, j + 1, 1), number(i + 1, j, 1));
    }
  for (int k = 0; k < (open ? 0 : n); ++k) {
    quad(number(k, 0, 1), number(k + 1, 0, 1), number(k + 1, 0, 0), number(k, 0, 0));
    quad(number(n, k, 1), number(n, k + 1, 1), number(n, k + 1, 0), number(n, k, 0));
    quad(number(k + 1, n, 1), number(k, n, 1), number(k, n, 0), number(k + 1, n, 0));
    quad(number(0, k + 1, 1), number(0, k, 1), number(0, k, 0), number(0, k + 1, 0));
  }
  return mesh;
}

TriangleMesh random_scan(Random& random) {
  TriangleMesh mesh;
  while (mesh.triangles.empty()) {  // Holes may leave nothing of a small one.
    Relief relief = random_relief(random);
    mesh = relief_mesh(relief, chance(0.5, random), true, 0.0, chance(0.3, random) ? 2 : 1, 0.15, random);
  }
  return mesh;
}

TriangleMesh random_truss(Random& random) {
  TriangleMesh mesh;
  const auto node = [&] {
    Vec3 p;
    for (double& x : p) x = 0.5 * static_cast<double>(random.index(3)) - 0.5;
    return p;
  };
  const double half = 1.0 / 32.0;
  for (std::size_t bars = 3 + random.index(8); bars > 0;) {
    const Vec3 a = node(), b = node();
    if (a == b) continue;
    --bars;
    const Vec3 way = (b - a).normalized();
    const Vec3 side =
        (std::abs(way.z()) < 0.9 ? way.cross(Vec3::UnitZ()) : way.cross(Vec3::UnitX())).normalized();
    const Vec3 other = way.cross(side);
    TriangleMesh bar = make_box({1.0, 1.0, 1.0});
    for (Vec3& p : bar.vertices)
      p = 0.5 * (a + b) + p.x() * 2.0 * half * side + p.y() * 2.0 * half * other + p.z() * (b - a);
    mesh = merged(std::move(mesh), bar);
  }
  return mesh;
}

TriangleMesh random_bricks(Random& random) {
  TriangleMesh mesh;
  const double joint = chance(0.6, random) ? 0.0 : power_of_ten(-12.0, -2.0, random);
  const std::size_t courses = 1 + random.index(3);
  for (std::size_t course = 0; course < courses; ++course)
    for (std::size_t i = 0; i < 2 + course % 2; ++i) {
      TriangleMesh brick = make_box({0.375, 0.25, 0.125}, 1 + static_cast<int>(random.index(2)));
      mesh = merged(std::move(mesh),
                    translated(brick, {(0.375 + joint) * (static_cast<double>(i) -
                                                          0.5 * static_cast<double>(1 + course % 2)),
                                       0.0, (0.125 + joint) * static_cast<double>(course)}));
    }
  return mesh;
}

constexpr std::array FORMED_SHAPES = {
    FormedShape{"turned part", random_turned_part},
    FormedShape{"coil", random_coil},
    FormedShape{"slit block", random_slit_block},
    FormedShape{"thin plate", random_thin_plate},
    FormedShape{"stellated solid", random_stellated_solid},
    FormedShape{"scan", random_scan},
    FormedShape{"truss", random_truss},
    FormedShape{"bricks", random_bricks},
};

}  // namespace

std::span<const FormedShape> formed_shapes() {
  return FORMED_SHAPES;
}

Mates random_turned_mates(Random& random) {
  Profile profile = outer_profile(random);
  const int sides = some_sides(profile.size() + 2, random);
  const double low = profile.front().y(), high = profile.back().y();
  Profile bore(profile.rbegin(), profile.rend());
  bore.insert(bore.end(), {Point(0.75, low), Point(0.75, high)});
  profile.insert(profile.begin(), Point(0.0, low));
  profile.emplace_back(0.0, high);
  return {turned(profile, sides, false), turned(bore, sides, true)};
}

Mates random_relief_mates(Random& random) {
  Relief relief = random_relief(random);
  Mates mates;
  mates.outer = relief_mesh(relief, true, false, -0.75, 1, 0.0, random);
  mates.inner = relief_mesh(relief, false, false, 1.0, chance(0.3, random) ? 2 : 1, 0.0, random);
  return mates;
}

}  // namespace lmdbench::parts
