// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <utility>

namespace lmdbench {

/// Refuses a mesh whose products of coordinates overflow or vanish in double precision
/// (`LARGEST_COORDINATE`, `SMALLEST_DIAGONAL`), one without extent too.
/// @param name  of the mesh or file, for the message
/// @throws InputError
void refuse_extreme_size(const TriangleMesh& mesh, const std::string& name);

/// Place of a mesh of an experiment or path in its frame. Every reader of a path must place its
/// meshes with `placed`, or the path's poses do not fit.
struct Placement {
  std::optional<double> diagonal = std::nullopt;  ///< Of the bounding box after scaling [m].
  std::optional<double> scale =
      std::nullopt;  ///< Metres a unit of the file; 1 without it. Not beside a diagonal.
  std::optional<bool> centre =
      std::nullopt;  ///< Whether the box's centre becomes the origin; with a diagonal yes, else no.

  bool operator==(const Placement&) const = default;
  bool centres() const { return centre.value_or(diagonal.has_value()); }
  /// Metres a unit of the mesh's coordinates; not finite for a diagonal of a mesh without extent.
  double factor(const TriangleMesh& mesh) const {
    return diagonal ? *diagonal / bounding_box_diagonal(mesh) : scale.value_or(1.0);
  }
};

/// The keys "diagonal_m", "scale" and "centre" of a mesh in an experiment or a path specification.
/// @pre at most one of diagonal and scale, as both schemas say
Placement read_placement(const nlohmann::json& entry);

/// Adds the keys that `read_placement` reads.
void write_placement(const Placement& placement, nlohmann::ordered_json& entry);

/// The mesh at its place: moved, where the placement centres, until the centre of its axis-aligned
/// bounding box is the origin of its frame, then scaled about the origin.
/// @throws InputError when a mesh without extent should get a diagonal, or when coordinates become
///   too large or small (`refuse_extreme_size`)
TriangleMesh placed(TriangleMesh mesh, const Placement& placement);

/// `placed` with the diagonal alone: centred and scaled.
/// @throws InputError when the mesh has no extent (no vertices, or all in one place) or gets too
///   large or small coordinates (`refuse_extreme_size`)
inline TriangleMesh scaled_to_diagonal(TriangleMesh mesh, double diagonal) {
  return placed(std::move(mesh), {.diagonal = diagonal});
}

}  // namespace lmdbench
