// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// Properties of a mesh. None stops an algorithm, but results on open, non-manifold or inside-out
/// meshes need a warning. Lengths in the mesh's unit.
struct ValidityReport {
  std::int64_t vertices = 0;
  std::int64_t edges = 0;
  std::int64_t triangles = 0;
  std::int64_t unused_vertices = 0;  ///< Vertices without triangles.
  std::int64_t components = 0;       ///< Groups of triangles that are connected over vertices.

  std::int64_t boundary_edges = 0;
  std::int64_t boundary_loops = 0;         ///< Groups of boundary edges, connected over vertices.
  std::int64_t non_manifold_edges = 0;     ///< Edges with more than two triangles.
  std::int64_t non_manifold_vertices = 0;  ///< Vertices whose triangles are not one fan.
  std::int64_t misoriented_edges = 0;      ///< Edges whose triangles disagree on the outer side.
  std::int64_t degenerate_triangles = 0;   ///< Triangles without area (ZERO_AREA_TOLERANCE).
  std::int64_t duplicate_triangles = 0;    ///< With an earlier one's vertices, in any order.

  /// What `orient_outward` would turn; 0 where edges are misoriented, which tell as much.
  std::int64_t inward_triangles = 0;

  bool closed = false;                 ///< No boundary edge.
  bool manifold = false;               ///< No non-manifold edge or vertex.
  bool consistently_oriented = false;  ///< No misoriented edge.
  /// Whether no triangle is inward; unset where edges are misoriented, and for an open mesh or one
  /// without volume of which none is.
  std::optional<bool> outward;
  std::optional<double> volume;  ///< Enclosed, signed; only if closed, consistently oriented.
  std::optional<std::int64_t>
      genus;  ///< Sum over the components; only where closed, manifold, consistently oriented.

  double area = 0.0;
  double diagonal = 0.0;          ///< Of the bounding box.
  double mean_edge_length = 0.0;  ///< Mean of all triangle sides.
  double shortest_edge = 0.0;
  double longest_edge = 0.0;
  double worst_aspect = 0.0;  ///< Largest (longest side / altitude on it) of triangles with area.
};

ValidityReport check_mesh(const Surface& surface);

/// Sentences about faults, worst first; empty for a closed, manifold, consistently and outward
/// oriented mesh without degenerate or duplicate triangles.
std::vector<std::string> findings(const ValidityReport& report);

/// Keys as the members above; unknown values are null.
nlohmann::ordered_json to_json(const ValidityReport& report);

/// Lines for people, with a final newline.
std::string to_text(const ValidityReport& report);

}  // namespace lmdbench
