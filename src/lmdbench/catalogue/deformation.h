// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace lmdbench {

/// Kinds of deformation. They move the *region*: the vertices farthest along `direction`, `share`
/// of all. Motion grows smoothly from none at its inner end (the *hinge*) to all at its tip.
enum class DeformationKind : std::uint8_t {
  BEND,     ///< Turns about an axis square to the direction at the hinge, up to `amplitude` rad.
  TWIST,    ///< Turns about the direction, by up to `amplitude` radians.
  DENT,     ///< Moves against the direction, by up to `amplitude` diagonals.
  BREATHE,  ///< Scales about the region's middle, up to `amplitude`; a whole mesh uniformly.
  CRUMPLE   ///< Moves along waves of random directions, lengths, up to `amplitude` diagonals.
};

/// "bend", "twist", "dent", "breathe", "crumple".
std::string_view to_string(DeformationKind kind);
/// All kinds.
std::span<const DeformationKind> deformation_kinds();

struct DeformationChoice {
  DeformationKind kind = DeformationKind::BEND;
  double amplitude = 0.5;          ///< See DeformationKind.
  double share = 1.0;              ///< Of the vertices, in (0, 1].
  Vec3 direction = Vec3::UnitZ();  ///< In the mesh's frame, any length but 0.
  std::uint64_t seed = 0;          ///< Of CRUMPLE's waves.
};

/// A deformation of one mesh: vertices as a function of a phase, at rest at every whole and half
/// period. The same arguments give the same bits on every processor.
class Deformation {
 public:
  /// @throws std::invalid_argument: share outside (0, 1], infinite or NaN amplitude, zero direction
  Deformation(const TriangleMesh& mesh, const DeformationChoice& choice);

  /// The vertices at a phase, deformed by `amplitude` times sin(2 pi phase). Vertices outside the
  /// region are those at rest, bit for bit.
  void at(double phase, std::vector<Vec3>& vertices) const { at_strength(wave(phase), vertices); }
  /// The same at a strength in [-1, 1], in parts of the amplitude.
  void at_strength(double strength, std::vector<Vec3>& vertices) const;

 private:
  struct MovingVertex {
    std::int32_t vertex;
    double weight;  ///< In (0, 1].
  };
  static double wave(double phase);

  DeformationChoice choice_;
  std::vector<Vec3> rest_;
  std::vector<MovingVertex> moving_;
  std::vector<Vec3> crumple_;  ///< Displacements of moving_ at full strength [m].
  double diagonal_ = 0.0;
  Vec3 along_ = Vec3::UnitZ(), across_ = Vec3::UnitX();  ///< Unit; direction, axis of a bend.
  Vec3 hinge_ = Vec3::Zero(), middle_ = Vec3::Zero();    ///< Of the region.
};

}  // namespace lmdbench
