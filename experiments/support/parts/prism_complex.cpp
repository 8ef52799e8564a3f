// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <support/parts/prism_complex.h>

#include <array>
#include <map>
#include <utility>

namespace lmdbench::parts {
namespace {

bool filled(Layers layers, std::size_t layer) {
  return ((layers >> layer) & 1U) != 0;
}

}  // namespace

void PrismComplex::add_cell(Outline corners, Layers layers) {
  const Layers there_are = (Layers{1} << layer_count()) - 1;
  if ((layers & there_are) != NO_LAYER) cells_.push_back({std::move(corners), layers & there_are});
}

void PrismComplex::add_ring(const Outline& inner, const Outline& outer,
                            const std::function<Layers(std::size_t)>& layers) {
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const std::size_t next = (i + 1) % inner.size();
    add_cell({inner[i], outer[i], outer[next], inner[next]}, layers ? layers(i) : ALL_LAYERS);
  }
}

void PrismComplex::add_grid(std::span<const double> xs, std::span<const double> ys,
                            const std::function<Layers(std::size_t, std::size_t)>& layers) {
  for (std::size_t j = 0; j + 1 < ys.size(); ++j)
    for (std::size_t i = 0; i + 1 < xs.size(); ++i)
      add_cell({{xs[i], ys[j]}, {xs[i + 1], ys[j]}, {xs[i + 1], ys[j + 1]}, {xs[i], ys[j + 1]}},
               layers ? layers(i, j) : ALL_LAYERS);
}

TriangleMesh PrismComplex::mesh(const std::function<Vec3(const Vec3&)>& place) const {
  std::map<std::array<double, 2>, std::size_t> number_of;  // points of the plane
  std::vector<std::vector<std::size_t>> corners(cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c)
    for (const Point& p : cells_[c].corners)
      corners[c].push_back(number_of.try_emplace({p.x() + 0.0, p.y() + 0.0}, number_of.size()).first->second);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> cell_left_of;  // directed side
  for (std::size_t c = 0; c < cells_.size(); ++c)
    for (std::size_t i = 0; i < corners[c].size(); ++i)
      cell_left_of[{corners[c][i], corners[c][(i + 1) % corners[c].size()]}] = c;

  TriangleMesh mesh;
  std::map<std::pair<std::size_t, std::size_t>, std::int32_t> vertices;  // point and level
  const auto vertex = [&](std::size_t c, std::size_t i, std::size_t level) {
    const std::size_t corner = i % corners[c].size();
    const auto [found, is_new] =
        vertices.try_emplace({corners[c][corner], level}, static_cast<std::int32_t>(mesh.vertices.size()));
    if (is_new) {
      const Point& p = cells_[c].corners[corner];
      const Vec3 x(p.x(), p.y(), levels_[level]);
      mesh.vertices.push_back(place ? place(x) : x);
    }
    return found->second;
  };
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Layers layers = cells_[c].layers;
    const std::size_t sides = corners[c].size();
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      const bool below = level > 0 && filled(layers, level - 1);
      const bool above = level < layer_count() && filled(layers, level);
      if (below == above) continue;
      for (std::size_t i = 1; i + 1 < sides; ++i) {
        const std::int32_t a = vertex(c, 0, level), b = vertex(c, i, level), d = vertex(c, i + 1, level);
        mesh.triangles.push_back(below ? std::array{a, b, d} : std::array{a, d, b});
      }
    }
    for (std::size_t i = 0; i < sides; ++i) {
      const auto other = cell_left_of.find({corners[c][(i + 1) % sides], corners[c][i]});
      const Layers beyond = other == cell_left_of.end() ? NO_LAYER : cells_[other->second].layers;
      for (std::size_t layer = 0; layer < layer_count(); ++layer) {
        if (!filled(layers, layer) || filled(beyond, layer)) continue;
        const std::int32_t low_a = vertex(c, i, layer), low_b = vertex(c, i + 1, layer);
        const std::int32_t high_a = vertex(c, i, layer + 1), high_b = vertex(c, i + 1, layer + 1);
        mesh.triangles.push_back({low_a, low_b, high_b});
        mesh.triangles.push_back({low_a, high_b, high_a});
      }
    }
  }
  return mesh;
}

TriangleMesh between(const Outline& low, const Outline& high, double length) {
  PrismComplex solid({-length / 2, length / 2});
  for (std::size_t i = 0; i + 1 < low.size(); ++i) {
    Outline cell = {low[i], low[i + 1]};
    if (high[i + 1] != low[i + 1]) cell.push_back(high[i + 1]);
    if (high[i] != low[i]) cell.push_back(high[i]);
    solid.add_cell(cell);
  }
  return solid.mesh(laid_down);
}

}  // namespace lmdbench::parts
