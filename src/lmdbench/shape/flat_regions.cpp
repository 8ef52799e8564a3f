// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/extent.h>
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/shape/flat_regions.h>
#include <lmdbench/shape/planar_faces.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace lmdbench {

namespace {

/// Joins the edges between regions into straight edges.
class StraightEdgeFinder {
 public:
  StraightEdgeFinder(const Surface& surface, FlatRegions& regions, double tolerance)
      : surface_(surface),
        regions_(regions),
        tolerance_(tolerance),
        borders_of_vertex_(surface.mesh.vertices.size(), {-1, -1}),
        border_count_(surface.mesh.vertices.size(), 0) {}

  void run() {
    const std::int32_t edge_count = surface_.adjacency.edge_count();
    regions_.straight_of_edge.assign(static_cast<std::size_t>(edge_count), UNKNOWN);
    for (std::int32_t e = 0; e < edge_count; ++e) {
      if (is_inside(e)) {
        regions_.straight_of_edge[static_cast<std::size_t>(e)] = -1;
        continue;
      }
      for (const std::int32_t end : ends(e)) {
        std::uint8_t& count = border_count_[static_cast<std::size_t>(end)];
        if (count < 2) borders_of_vertex_[static_cast<std::size_t>(end)][count] = e;
        if (count < 3) ++count;
      }
    }
    std::vector<std::pair<std::int32_t, std::int32_t>> rows;
    for (std::int32_t e = 0; e < edge_count; ++e)
      if (regions_.straight_of_edge[static_cast<std::size_t>(e)] == UNKNOWN) join_from(e, rows);
    regions_.edges_of_straight = CsrRows(static_cast<std::int32_t>(regions_.straight_edges.size()), rows);
    list_borders();
    mark_inner_vertices();
  }

 private:
  static constexpr std::int32_t UNKNOWN = -2;

  const std::array<std::int32_t, 2>& ends(std::int32_t edge) const {
    return surface_.adjacency.edges[static_cast<std::size_t>(edge)];
  }
  const Vec3& vertex(std::int32_t v) const { return surface_.mesh.vertices[static_cast<std::size_t>(v)]; }
  std::int32_t other_end(std::int32_t edge, std::int32_t v) const {
    return ends(edge)[0] == v ? ends(edge)[1] : ends(edge)[0];
  }

  /// Regions of an edge's triangles, ascending; only of edges with one or two triangles.
  std::array<std::int32_t, 2> regions_of(std::int32_t edge) const {
    const auto triangles = surface_.adjacency.edge_triangles[edge];
    const auto region = [&](std::size_t k) {
      return regions_.region_of_triangle[static_cast<std::size_t>(triangles[k])];
    };
    if (triangles.size() == 1) return {-1, region(0)};
    return {std::min(region(0), region(1)), std::max(region(0), region(1))};
  }

  /// Whether all of the triangles add nothing, and there are some.
  bool adds_nothing(std::span<const std::int32_t> triangles) const {
    return !regions_.adds_nothing.empty() && !triangles.empty() &&
           std::ranges::all_of(
               triangles, [&](std::int32_t t) { return regions_.adds_nothing[static_cast<std::size_t>(t)]; });
  }

  bool is_inside(std::int32_t edge) const {
    const auto e = static_cast<std::size_t>(edge);
    if (adds_nothing(surface_.adjacency.edge_triangles[edge])) return true;
    if (surface_.edge_is_boundary[e] || surface_.edge_is_non_manifold[e]) return false;
    const auto pair = regions_of(edge);
    return pair[0] >= 0 && pair[0] == pair[1];
  }

  /// The edge that continues `edge` in its line beyond `v`, or -1.
  std::int32_t continuation(std::int32_t edge, std::int32_t v) const {
    if (border_count_[static_cast<std::size_t>(v)] != 2) return -1;
    const auto& borders = borders_of_vertex_[static_cast<std::size_t>(v)];
    const std::int32_t next = borders[0] == edge ? borders[1] : borders[0];
    if (next == edge || surface_.edge_is_non_manifold[static_cast<std::size_t>(edge)] ||
        surface_.edge_is_non_manifold[static_cast<std::size_t>(next)])
      return -1;
    const auto pair = regions_of(edge);
    if (pair[1] < 0 || pair != regions_of(next)) return -1;
    // A triangle without area at the vertex is no part of either region.
    for (const std::int32_t t : surface_.adjacency.vertex_triangles[v]) {
      const std::int32_t region = regions_.region_of_triangle[static_cast<std::size_t>(t)];
      if (region < 0 || (region != pair[0] && region != pair[1])) return -1;
    }
    return is_between(v, other_end(edge, v), other_end(next, v)) ? next : -1;
  }

  /// Whether a vertex lies on the segment between two others.
  bool is_between(std::int32_t v, std::int32_t a, std::int32_t b) const {
    const PointSegmentDistance nearest = point_segment_distance(vertex(v), {vertex(a), vertex(b)});
    return nearest.feature == SegmentFeature::EDGE && (nearest.point - vertex(v)).norm() <= tolerance_;
  }

  void join_from(std::int32_t edge, std::vector<std::pair<std::int32_t, std::int32_t>>& rows) {
    std::vector<std::int32_t> chain{edge}, inner;
    std::int32_t first = ends(edge)[0], last = ends(edge)[1];
    for (std::int32_t e = edge; (e = continuation(e, last)) >= 0 && e != edge; last = other_end(e, last)) {
      inner.push_back(last);
      chain.push_back(e);
    }
    std::reverse(chain.begin(), chain.end());
    for (std::int32_t e = edge; (e = continuation(e, first)) >= 0 && e != chain.front();
         first = other_end(e, first)) {
      inner.push_back(first);
      chain.push_back(e);
    }
    // Each vertex is between its neighbours; many of them could still bend.
    const bool straight =
        std::all_of(inner.begin(), inner.end(), [&](std::int32_t v) { return is_between(v, first, last); });
    if (straight) {
      if (first > last) std::swap(first, last);
      if (ends(chain.front())[0] != first && ends(chain.front())[1] != first)
        std::reverse(chain.begin(), chain.end());
      add(chain, {first, last}, rows);
    } else {
      for (const std::int32_t e : chain) add({e}, ends(e), rows);
    }
  }

  void add(const std::vector<std::int32_t>& chain, const std::array<std::int32_t, 2>& chain_ends,
           std::vector<std::pair<std::int32_t, std::int32_t>>& rows) {
    const auto index = static_cast<std::int32_t>(regions_.straight_edges.size());
    regions_.straight_edges.push_back({chain_ends});
    for (const std::int32_t e : chain) {
      regions_.straight_of_edge[static_cast<std::size_t>(e)] = index;
      rows.emplace_back(index, e);
    }
  }

  void list_borders() {
    std::vector<std::pair<std::int32_t, std::int32_t>> rows;
    std::vector<std::int32_t> beside;
    for (std::size_t s = 0; s < regions_.straight_edges.size(); ++s) {
      beside.clear();
      // All faces of an edge: there may be more than two.
      const std::int32_t first = regions_.edges_of_straight[static_cast<std::int32_t>(s)].front();
      for (const std::int32_t t : surface_.adjacency.edge_triangles[first])
        if (const std::int32_t region = regions_.region_of_triangle[static_cast<std::size_t>(t)]; region >= 0)
          beside.push_back(region);
      std::ranges::sort(beside);
      beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
      for (const std::int32_t region : beside) rows.emplace_back(region, static_cast<std::int32_t>(s));
    }
    regions_.straight_edges_of_region = CsrRows(regions_.region_count(), rows);
  }

  void mark_inner_vertices() {
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(surface_.mesh.vertices.size()); ++v) {
      const auto i = static_cast<std::size_t>(v);
      const auto triangles = surface_.adjacency.vertex_triangles[v];
      const bool has_area = std::all_of(triangles.begin(), triangles.end(), [&](std::int32_t t) {
        return regions_.region_of_triangle[static_cast<std::size_t>(t)] >= 0;
      });
      if (adds_nothing(triangles)) regions_.vertex_is_inside[i] = true;
      if (triangles.empty() || !has_area) continue;
      if (border_count_[i] == 0) {
        // Two sheets may share a vertex.
        regions_.vertex_is_inside[i] = std::all_of(triangles.begin(), triangles.end(), [&](std::int32_t t) {
          return regions_.region_of_triangle[static_cast<std::size_t>(t)] ==
                 regions_.region_of_triangle[static_cast<std::size_t>(triangles.front())];
        });
      } else if (border_count_[i] == 2) {
        const auto& borders = borders_of_vertex_[i];
        regions_.vertex_is_inside[i] =
            borders[0] != borders[1] && regions_.straight_of_edge[static_cast<std::size_t>(borders[0])] ==
                                            regions_.straight_of_edge[static_cast<std::size_t>(borders[1])];
      }
    }
  }

  const Surface& surface_;
  FlatRegions& regions_;
  double tolerance_;
  std::vector<std::array<std::int32_t, 2>> borders_of_vertex_;  ///< The first two.
  std::vector<std::uint8_t> border_count_;                      ///< Up to 3.
};

/// FlatRegions::adds_nothing, once regions are known.
std::vector<bool> find_what_adds_nothing(const Surface& surface, const FlatRegions& regions) {
  std::vector<bool> found;
  const auto has_area = [&](std::int32_t t) {
    return regions.region_of_triangle[static_cast<std::size_t>(t)] >= 0;
  };
  const auto length_of = [&](std::int32_t e) {
    const auto [p, q] = surface.edge(e);
    return (q - p).norm();
  };
  for (std::size_t t = 0; t < regions.region_of_triangle.size(); ++t) {
    if (regions.region_of_triangle[t] >= 0) continue;
    std::array<std::int32_t, 3> edges = surface.adjacency.triangle_edges[t];
    std::ranges::sort(edges, {}, length_of);
    const std::int32_t longest = edges[2];
    const bool lies_on_one =
        length_of(longest) == 0.0 || std::ranges::any_of(surface.adjacency.edge_triangles[longest], has_area);
    const bool carries_one = std::ranges::any_of(edges, [&](std::int32_t e) {
      return e != longest && std::ranges::any_of(surface.adjacency.edge_triangles[e], has_area);
    });
    found.resize(regions.region_of_triangle.size());
    found[t] = lies_on_one && !carries_one;
  }
  return found;
}

}  // namespace

FlatRegions FlatRegions::of(const Surface& surface) {
  FlatRegions regions;
  regions.extent = largest_coordinate(surface.mesh.vertices);
  const double tolerance = FLATNESS * regions.extent;
  const std::vector<PlanarFace> faces = planar_faces(surface, tolerance, &regions.decides_region);
  regions.region_of_triangle.assign(surface.mesh.triangles.size(), -1);
  std::vector<std::pair<std::int32_t, std::int32_t>> rows;
  for (const PlanarFace& face : faces) {
    const std::int32_t region = regions.region_count();
    regions.planes.push_back(face.plane);
    for (const std::int32_t triangle : face.triangles) {
      regions.region_of_triangle[static_cast<std::size_t>(triangle)] = region;
      rows.emplace_back(region, triangle);
    }
  }
  regions.region_triangles = CsrRows(regions.region_count(), rows);
  regions.adds_nothing = find_what_adds_nothing(surface, regions);
  regions.vertex_is_inside.assign(surface.mesh.vertices.size(), false);
  StraightEdgeFinder(surface, regions, tolerance).run();
  return regions;
}

std::int32_t FlatRegions::edge_at(const Surface& surface, std::int32_t straight, const Vec3& p_S) const {
  const auto edges = edges_of_straight[straight];
  if (edges.size() == 1) return edges.front();
  const Segment whole = surface.mesh.segment(straight_edges[static_cast<std::size_t>(straight)].ends);
  const Vec3 p = point_segment_distance(p_S, whole).point, along = whole[1] - whole[0];
  // In order along the line, so of hundreds of edges two or three are compared.
  const double tolerance = NAMING_TOLERANCE * extent;
  const double place = along.dot(p), near = 2.0 * tolerance * along.norm();
  const auto extent_of = [&](std::int32_t e) { return extent_along(surface.edge(e), along); };
  std::int32_t first = -1;
  for (auto it = std::ranges::partition_point(
           edges, [&](std::int32_t e) { return extent_of(e).greatest < place - near; });
       it != edges.end() && extent_of(*it).least <= place + near; ++it) {
    const Vec3 nearest = point_segment_distance(p, surface.edge(*it)).point;
    if ((nearest - p).norm() <= tolerance && (first < 0 || *it < first)) first = *it;
  }
  return first >= 0 ? first : std::ranges::min(edges);
}

}  // namespace lmdbench
