// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <support/parts/chances.h>
#include <support/parts/machine_parts.h>
#include <support/parts/prism_complex.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench::parts {
namespace {

using Lines = std::vector<double>;

bool even(std::size_t i) {
  return i % 2 == 0;
}

/// Holes in the middle row of every other column.
Layers slits(std::size_t i, std::size_t j) {
  return j == 1 && !even(i) ? NO_LAYER : ALL_LAYERS;
}

/// `count` equal steps; exact where the step is dyadic.
Lines steps(int count, double from, double to) {
  Lines result;
  for (int i = 0; i <= count; ++i) result.push_back(from + (to - from) * i / count);
  return result;
}

/// Borders of `count` bars and the gaps between them, about the middle: even steps are bars.
Lines bars(int count, double bar, double gap) {
  Lines result = {0.0};
  for (int i = 0; i < 2 * count - 1; ++i) result.push_back(result.back() + (i % 2 == 0 ? bar : gap));
  const double half = 0.5 * result.back();
  for (double& x : result) x -= half;
  return result;
}

Outline circle(int count, double radius) {
  Outline result;
  for (int i = 0; i < count; ++i) {
    const auto [x, y] = circle_point(i, count);
    result.emplace_back(radius * x, radius * y);
  }
  return result;
}

/// Regular polygon, each side cut into `a_side`, a power of two: points lie on it exactly.
Outline polygon(int sides, double circumradius, int a_side = 1) {
  const Outline corners = circle(sides, circumradius);
  Outline result;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point &a = corners[i], &b = corners[(i + 1) % corners.size()];
    for (int k = 0; k < a_side; ++k) result.emplace_back(a + (b - a) * (static_cast<double>(k) / a_side));
  }
  return result;
}

/// An upright prism of one cell.
TriangleMesh prism(const Outline& outline, Lines levels,
                   const std::function<Vec3(const Vec3&)>& place = nullptr) {
  PrismComplex solid(std::move(levels));
  solid.add_cell(outline);
  return solid.mesh(place);
}

TriangleMesh box(double x, double y, double z) {
  return prism({{-x / 2, -y / 2}, {x / 2, -y / 2}, {x / 2, y / 2}, {-x / 2, y / 2}}, {-z / 2, z / 2});
}

/// Grid of columns; `layers` says which are solid.
TriangleMesh columns(const Lines& xs, const Lines& ys, const Lines& levels,
                     const std::function<Layers(std::size_t, std::size_t)>& layers = nullptr,
                     const std::function<Vec3(const Vec3&)>& place = nullptr) {
  PrismComplex solid(levels);
  solid.add_grid(xs, ys, layers);
  return solid.mesh(place);
}

/// Extrusion along y of a profile drawn in rows from the highest down: '#' is solid.
TriangleMesh drawn(const Lines& xs, const Lines& heights, std::string_view rows, double length = 1.0) {
  return columns(
      xs, heights, {-length / 2, length / 2},
      [&](std::size_t i, std::size_t j) {
        return rows[(heights.size() - 2 - j) * xs.size() + i] == '#' ? ALL_LAYERS : NO_LAYER;
      },
      laid_down);
}

TriangleMesh tube(const Outline& inner, const Outline& outer, Lines levels,
                  const std::function<Layers(std::size_t)>& layers = nullptr,
                  const std::function<Vec3(const Vec3&)>& place = nullptr) {
  PrismComplex solid(std::move(levels));
  solid.add_ring(inner, outer, layers);
  return solid.mesh(place);
}

/// Discs of decreasing radius: the widest in all layers, the next above the first layer, and so on.
TriangleMesh tower(int count, const Lines& radii, Lines levels) {
  PrismComplex solid(std::move(levels));
  for (std::size_t i = 0; i + 1 < radii.size(); ++i)
    solid.add_ring(circle(count, radii[i + 1]), circle(count, radii[i]),
                   [&](std::size_t) { return (Layers{2} << i) - 1; });
  solid.add_cell(circle(count, radii.back()));
  return solid.mesh();
}

/// Straight teeth on a ring or disc: a tooth takes half of its share of the root.
TriangleMesh toothed(int teeth, double bore, double root, double tip, Lines levels) {
  PrismComplex solid(std::move(levels));
  const Outline foot = circle(4 * teeth, root), head = circle(8 * teeth, tip);
  if (bore > 0.0)
    solid.add_ring(circle(4 * teeth, bore), foot);
  else
    solid.add_cell(foot);
  for (std::size_t i = 0; i < foot.size(); i += 4) {
    solid.add_cell({foot[i], head[2 * i + 1], head[2 * i + 2], foot[i + 1]});
    solid.add_cell({foot[i + 1], head[2 * i + 2], head[2 * i + 3], foot[i + 2]});
  }
  return solid.mesh();
}

/// The hub around `toothed`.
TriangleMesh toothed_hub(int teeth, double root, double tip, double outside, Lines levels) {
  PrismComplex solid(std::move(levels));
  const Outline foot = circle(4 * teeth, root), head = circle(8 * teeth, tip),
                rim = circle(8 * teeth, outside);
  Outline inner, outer;
  for (std::size_t i = 0; i < foot.size(); i += 4) {
    inner.insert(inner.end(),
                 {foot[i], head[2 * i + 1], head[2 * i + 2], head[2 * i + 3], foot[i + 2], foot[i + 3]});
    for (const std::size_t k : {0, 1, 2, 3, 4, 6}) outer.push_back(rim[2 * i + k]);
  }
  solid.add_ring(inner, outer);
  return solid.mesh();
}

/// Pointed teeth: tips stand at the share `lean` between two points of the root.
TriangleMesh pointed(int teeth, double bore, double root, double tip, double lean, Lines levels) {
  PrismComplex solid(std::move(levels));
  const Outline foot = circle(teeth, root), heads = circle(8 * teeth, tip);
  solid.add_ring(circle(teeth, bore), foot);
  const auto at = static_cast<std::size_t>(lean * 8.0);
  for (std::size_t i = 0; i < foot.size(); ++i)
    solid.add_cell({foot[i], heads[8 * i + at], foot[(i + 1) % foot.size()]});
  return solid.mesh();
}

/// Six-sided cells of width 2 `half`; each has walls of half the thickness.
TriangleMesh honeycomb(int columns_of_cells, int rows, double half, double hole) {
  PrismComplex solid({-0.125, 0.125});
  const std::array<Point, 6> corner = {{{1, 0.5}, {0, 1}, {-1, 0.5}, {-1, -0.5}, {0, -1}, {1, -0.5}}};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns_of_cells; ++i) {
      const Point centre(half * (2 * i + j % 2 - columns_of_cells), half * (1.5 * j - rows));
      Outline inner, outer;
      for (const Point& p : corner) {
        outer.emplace_back(centre + half * p);
        inner.emplace_back(centre + hole * p);
      }
      solid.add_ring(inner, outer);
    }
  }
  return solid.mesh();
}

/// A frame with leaning slats: its holes are sheared along x.
TriangleMesh louvres() {
  const Lines xs = bars(5, 0.125, 0.09375);
  return columns(xs, {-0.5, -0.375, 0.375, 0.5}, {-0.0625, 0.0625}, slits,
                 [](const Vec3& p) { return Vec3(p.x() + 0.5 * p.z(), p.y(), p.z()); });
}

/// The twelve edges of a cube.
TriangleMesh cube_frame(const Lines& at) {
  return columns(at, at, at, [](std::size_t i, std::size_t j) -> Layers {
    const int inside = (i == 1) + (j == 1);
    return inside == 0 ? 0b111 : inside == 1 ? 0b101 : 0b000;
  });
}

/// Scales circles by a factor that depends on the height.
std::function<Vec3(const Vec3&)> turned_on_a_lathe(double (*factor)(double height)) {
  return [factor](const Vec3& p) { return Vec3(p.x() * factor(p.z()), p.y() * factor(p.z()), p.z()); };
}

double cone(double height) {
  return 1.0 - 0.5 * height;
}

double round_top(double height) {
  return dyadic(std::sqrt(1.0 - 9.0 * height * height), 10);
}

double neck(double height) {
  return std::abs(height) < 0.2 ? 0.75 : 1.0;
}

TriangleMesh hex_bolt() {
  PrismComplex solid({-0.5, 0.25, 0.5});
  const Outline shank = circle(24, 0.25);
  solid.add_cell(shank);
  solid.add_ring(shank, polygon(6, 0.5, 4), [](std::size_t) -> Layers { return 0b10; });
  return solid.mesh();
}

TriangleMesh cup() {
  PrismComplex solid({-0.25, -0.125, 0.375});
  const Outline inner = circle(16, 0.25);
  solid.add_cell(inner, 0b01);
  solid.add_ring(inner, circle(16, 0.375));
  return solid.mesh();
}

TriangleMesh half_pipe() {
  // Profile: the lower half of a circle in a block, as a ring of quads.
  PrismComplex solid({-0.5, 0.5});
  const Outline round = circle(16, 0.375);
  for (std::size_t i = 8; i < 16; ++i) {
    const Point &a = round[i], &b = round[(i + 1) % 16];
    solid.add_cell({{a.x(), -0.5}, {b.x(), -0.5}, b, a});
  }
  return solid.mesh(laid_down);
}

/// Teeth along x: corners of one tooth's upper line, repeated.
TriangleMesh rack(int teeth, const Outline& tooth, double pitch) {
  Outline low, high;
  for (int i = 0; i < teeth; ++i)
    for (const Point& p : tooth) high.emplace_back(p.x() + pitch * (i - 0.5 * teeth), p.y());
  high.emplace_back(pitch * 0.5 * teeth, tooth.front().y());
  for (const Point& p : high) low.emplace_back(p.x(), -0.25);
  return between(low, high);
}

/// Narrower at the top; its flanks are parallel to those of the way.
TriangleMesh dovetail() {
  const double foot = 0.25 - 2.0 * CLEARANCE, head = 0.15625 - 1.5 * CLEARANCE;
  return between({{-foot, CLEARANCE}, {foot, CLEARANCE}}, {{-head, 0.1875}, {head, 0.1875}}, 0.75);
}

/// A block with two cheeks that lean over a groove.
TriangleMesh dovetail_way() {
  PrismComplex solid({-0.5, 0.5});
  const double floor = 0.0, top = 0.125, bottom = -0.25;
  solid.add_cell({{-0.5, bottom}, {-0.25, bottom}, {-0.25, floor}, {-0.5, floor}});
  solid.add_cell({{-0.25, bottom}, {0.25, bottom}, {0.25, floor}, {-0.25, floor}});
  solid.add_cell({{0.25, bottom}, {0.5, bottom}, {0.5, floor}, {0.25, floor}});
  solid.add_cell({{-0.5, floor}, {-0.25, floor}, {-0.1875, top}, {-0.5, top}});
  solid.add_cell({{0.25, floor}, {0.5, floor}, {0.5, top}, {0.1875, top}});
  return solid.mesh(laid_down);
}

TriangleMesh star(int points, double inner, double outer) {
  PrismComplex solid({-0.0625, 0.0625});
  const Outline valleys = circle(2 * points, inner), tips = circle(2 * points, outer);
  solid.add_cell([&] {
    Outline middle;
    for (std::size_t i = 1; i < valleys.size(); i += 2) middle.push_back(valleys[i]);
    return middle;
  }());
  for (std::size_t i = 0; i < tips.size(); i += 2)
    solid.add_cell({valleys[(i + tips.size() - 1) % tips.size()], tips[i], valleys[i + 1]});
  return solid.mesh();
}

TriangleMesh involute_gear() {
  const auto teeth = gear_outline(10, 0.1, 0.002);
  return make_sleeve(teeth, circle_outline(0.2, teeth), {.height = 0.2, .around = 80});
}

TriangleMesh peg(int sides) {
  return prism(polygon(sides, 0.25 - CLEARANCE), {-0.5, 0.5});
}

TriangleMesh bore(int sides) {
  return tube(polygon(sides, 0.25), polygon(sides, 0.5), {-0.25, 0.25});
}

TriangleMesh spoked_wheel() {
  PrismComplex solid({-0.0625, 0.0625});
  solid.add_ring(circle(16, 0.0625), circle(16, 0.125));
  solid.add_ring(circle(16, 0.125), circle(16, 0.375),
                 [](std::size_t i) { return i % 4 == 0 ? ALL_LAYERS : NO_LAYER; });
  solid.add_ring(circle(16, 0.375), circle(16, 0.5));
  return solid.mesh();
}

TriangleMesh v_block() {
  const double reach = 0.25 + CLEARANCE;
  return between({{-0.5, -0.5}, {-reach, -0.5}, {0.0, -0.5}, {reach, -0.5}, {0.5, -0.5}},
                 {{-0.5, 0.0}, {-reach, 0.0}, {0.0, -reach}, {reach, 0.0}, {0.5, 0.0}});
}

}  // namespace

TriangleMesh make_comb(int teeth, double tooth) {
  return columns(bars(teeth, tooth, tooth), {-0.375, -0.25, 0.375}, {-0.0625, 0.0625}, slits);
}

TriangleMesh make_perforated_sheet(int count, double side, double hole, double thickness) {
  PrismComplex solid({-thickness / 2, thickness / 2});
  const Lines lines = steps(count, -0.5 * side * count, 0.5 * side * count);
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      const double x = lines[static_cast<std::size_t>(i)], y = lines[static_cast<std::size_t>(j)];
      Outline inner = circle(8, hole), outer;
      for (const Point& p : inner) {
        const auto onto = [&](double c) {
          return c > 0.25 * hole ? side : c < -0.25 * hole ? 0.0 : 0.5 * side;
        };
        outer.emplace_back(x + onto(p.x()), y + onto(p.y()));
      }
      for (Point& p : inner) p += Point(x + 0.5 * side, y + 0.5 * side);
      solid.add_ring(inner, outer);
    }
  }
  return solid.mesh();
}

std::span<const Part> machine_parts() {
  static const std::vector<Part> PARTS = {
      {"plate", columns(steps(4, -0.5, 0.5), steps(4, -0.5, 0.5), {-0.0625, 0.0625})},
      {"block", box(0.5, 0.375, 0.25)},
      {"ring", tube(circle(24, 0.25), circle(24, 0.5), {-0.0625, 0.0625})},
      {"thin ring", tube(circle(32, 0.375), circle(32, 0.4375), {-0.0625, 0.0625})},
      {"retaining ring", tube(circle(24, 0.375), circle(24, 0.5), {-0.0625, 0.0625},
                              [](std::size_t i) { return i < 3 ? NO_LAYER : ALL_LAYERS; })},
      {"bush", tube(circle(16, 0.25), circle(16, 0.375), {-0.375, 0.375})},
      {"spoked wheel", spoked_wheel()},
      {"slit plate", columns(bars(6, 0.125, 0.0625), {-0.5, -0.375, 0.375, 0.5}, {-0.0625, 0.0625}, slits)},
      {"slotted plate",
       columns({-0.5, -0.25, -0.125, 0.125, 0.25, 0.5}, {-0.5, -0.125, 0.5}, {-0.0625, 0.0625}, slits)},
      {"comb", make_comb(8, 0.0625)},
      {"ribbed plate", columns(bars(5, 0.0625, 0.125), {-0.5, 0.5}, {-0.125, 0.0, 0.125},
                               [](std::size_t i, std::size_t) -> Layers { return even(i) ? 0b11 : 0b01; })},
      {"waffle",
       columns(bars(4, 0.0625, 0.1875), bars(4, 0.0625, 0.1875), {-0.125, 0.0, 0.125},
               [](std::size_t i, std::size_t j) -> Layers { return even(i) || even(j) ? 0b11 : 0b01; })},
      {"egg crate",
       columns(bars(5, 0.03125, 0.1875), bars(5, 0.03125, 0.1875), {-0.125, 0.125},
               [](std::size_t i, std::size_t j) { return even(i) || even(j) ? ALL_LAYERS : NO_LAYER; })},
      {"perforated sheet", make_perforated_sheet(4, 0.25, 0.09375, 0.0625)},
      {"honeycomb", honeycomb(3, 4, 0.15625, 0.125)},
      {"louvres", louvres()},
      {"gear", toothed(12, 0.1875, 0.375, 0.5, {-0.0625, 0.0625})},
      {"involute gear", involute_gear()},
      {"sprocket", pointed(16, 0.25, 0.375, 0.5, 0.5, {-0.0625, 0.0625})},
      {"ratchet", pointed(12, 0.25, 0.375, 0.5, 0.875, {-0.0625, 0.0625})},
      {"nut", tube(circle(24, 0.25), polygon(6, 0.5, 4), {-0.125, 0.125})},
      {"castellated nut", tube(circle(24, 0.25), polygon(6, 0.5, 4), {-0.25, 0.0625, 0.25},
                               [](std::size_t i) -> Layers { return i % 4 == 0 ? 0b01 : 0b11; })},
      {"hex bolt", hex_bolt()},
      {"threaded rod", make_sleeve(thread_outline(0.25 - CLEARANCE, 0.0625, 0.125), nullptr,
                                   {.height = 0.5, .around = 24, .layers = 16})},
      {"threaded nut", make_sleeve(polygon_outline(6, 0.4), thread_outline(0.25, 0.0625, 0.125),
                                   {.height = 0.25, .around = 24, .layers = 8})},
      {"stepped shaft", tower(16, {0.375, 0.25, 0.125}, {-0.5, -0.25, 0.125, 0.5})},
      {"grooved shaft",
       prism(circle(16, 0.25), {-0.5, -0.25, -0.125, 0.125, 0.25, 0.5}, turned_on_a_lathe(neck))},
      {"plain shaft", prism(circle(16, 0.25 - CLEARANCE), {-0.5, 0.5})},
      {"square peg", peg(4)},
      {"square bore", bore(4)},
      {"hexagonal peg", peg(6)},
      {"hexagonal bore", bore(6)},
      {"peg of 32 sides", peg(32)},
      {"bore of 32 sides", bore(32)},
      {"key", box(0.25 - 2.0 * CLEARANCE, 0.5, 0.25)},
      {"keyway", drawn({-0.5, -0.125, 0.125, 0.5}, {-0.375, -0.125 - CLEARANCE, 0.125}, "#.#/###")},
      {"T-slot",
       drawn({-0.5, -0.25, -0.125, 0.125, 0.25, 0.5}, {-0.25, -0.125, 0.0, 0.125}, "##.##/#...#/#####")},
      {"T-nut", drawn({-0.25 + CLEARANCE, -0.125 + CLEARANCE, 0.125 - CLEARANCE, 0.25 - CLEARANCE},
                      {-0.125 + CLEARANCE, 0.0 - CLEARANCE, 0.1875}, ".#./###", 0.5)},
      {"dovetail", dovetail()},
      {"dovetail way", dovetail_way()},
      {"L bracket", drawn({-0.5, -0.375, 0.0, 0.5}, {-0.5, -0.375, 0.0, 0.5}, "#../#../###", 0.5)},
      {"U channel", drawn({-0.375, -0.25, 0.25, 0.375}, {-0.25, -0.125, 0.25}, "#.#/###")},
      {"I beam", drawn({-0.25, -0.0625, 0.0625, 0.25}, {-0.375, -0.25, 0.25, 0.375}, "###/.#./###")},
      {"cross",
       columns({-0.5, -0.125, 0.125, 0.5}, {-0.5, -0.125, 0.125, 0.5}, {-0.125, 0.125},
               [](std::size_t i, std::size_t j) { return i == 1 || j == 1 ? ALL_LAYERS : NO_LAYER; })},
      {"star", star(5, 0.25, 0.5)},
      {"stairs", drawn(steps(4, -0.5, 0.5), steps(4, -0.25, 0.25), "#.../##../###./####", 0.5)},
      {"crenellated wall",
       drawn(bars(6, 0.125, 0.0625), {-0.25, 0.0, 0.1875}, "#.#.#.#.#.#/###########", 0.125)},
      {"wedge", between({{-0.25, 0.0}, {0.25, 0.0}}, {{-0.25, 0.375}, {0.25, 0.0}}, 0.5)},
      {"ridge", between({{-0.25, 0.0}, {0.0, -0.25}, {0.25, 0.0}},
                        {{-0.25, 0.125}, {0.0, 0.125}, {0.25, 0.125}}, 0.75)},
      {"V-block", v_block()},
      {"rack", rack(5, {{0.0, 0.0}, {0.0625, 0.0}, {0.09375, 0.125}, {0.15625, 0.125}}, 0.1875)},
      {"sawtooth", rack(6, {{0.0, 0.0}, {0.125, 0.125}}, 0.1875)},
      {"frustum", prism(circle(12, 0.375), {-0.25, 0.25}, turned_on_a_lathe(cone))},
      {"funnel", tube(circle(12, 0.375 + CLEARANCE), circle(12, 0.5), {-0.1875, 0.1875}, nullptr,
                      turned_on_a_lathe(cone))},
      {"dome", prism(circle(12, 0.5), steps(4, 0.0, 0.25), turned_on_a_lathe(round_top))},
      {"cup", cup()},
      {"slotted tube", tube(circle(16, 0.25), circle(16, 0.375), {-0.375, -0.25, 0.25, 0.375},
                            [](std::size_t i) -> Layers { return i % 4 == 0 ? 0b101 : 0b111; })},
      {"tray",
       columns({-0.5, -0.375, 0.375, 0.5}, {-0.375, -0.25, 0.25, 0.375}, {-0.25, -0.125, 0.125},
               [](std::size_t i, std::size_t j) -> Layers { return i == 1 && j == 1 ? 0b01 : 0b11; })},
      {"box for the tray", box(0.75 - 2.0 * CLEARANCE, 0.5 - 2.0 * CLEARANCE, 0.25 - 2.0 * CLEARANCE)},
      {"spline shaft", toothed(8, 0.0, 0.1875 - CLEARANCE, 0.25 - CLEARANCE, {-0.375, 0.375})},
      {"spline hub", toothed_hub(8, 0.1875, 0.25, 0.375, {-0.125, 0.125})},
      {"cage", cube_frame({-0.5, -0.375, 0.375, 0.5})},
      {"cross-drilled cube", cube_frame(steps(3, -0.375, 0.375))},
      {"pyramid of steps",
       columns(steps(6, -0.375, 0.375), steps(6, -0.375, 0.375), {-0.1875, -0.0625, 0.0625, 0.1875},
               [](std::size_t i, std::size_t j) -> Layers {
                 const std::size_t in = std::min({i, j, 5 - i, 5 - j});
                 return (Layers{2} << in) - 1;
               })},
      {"half pipe", half_pipe()},
  };
  return PARTS;
}

const TriangleMesh& machine_part(std::string_view name) {
  for (const Part& part : machine_parts())
    if (name == part.name) return part.mesh;
  throw UsageError("", "part", "there is no machine part '" + std::string(name) + "'",
                   "see machine_parts.cpp");
}

}  // namespace lmdbench::parts
