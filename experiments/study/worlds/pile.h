// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/scene/broad_phase.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench::worlds {

/// Motion of a pile. All spheres swing, each with its own direction, axis and phase.
enum class PileMotion : std::uint8_t {
  JOSTLING,  ///< Only that: pairs in contact stay so.
  SETTLING,  ///< They approach each other from farther apart: contacts begin.
  STIRRED    ///< Layers turn against each other: neighbours change, all leave their slack.
};
const char* to_string(PileMotion motion);

/// Spheres in the closest packing, in contact with those below and beside.
struct PileChoice {
  std::vector<std::size_t> counts = {10, 30, 100, 300, 1000};
  int subdivisions = 4;         ///< Of an icosahedron: 20 4^n triangles.
  double radius = 0.05;         ///< [m]
  double cutoff = 0.0005;       ///< [m]; neighbours have half of it as gap.
  double swing_speed = 0.002;   ///< Largest [m/s] at 1 kHz; they turn at swing_speed / radius.
  double looseness = 0.02;      ///< SETTLING: how much farther out they begin than end, relative.
  double stirring_speed = 0.2;  ///< STIRRED: of the outermost sphere [m/s].
  std::size_t frames = 300, passes = 3;
  std::uint64_t seed = 1;
};

struct PileRow {
  PileMotion motion = PileMotion::JOSTLING;
  std::size_t movers = 0, triangles = 0;
  double first_seconds = 0.0;              ///< Of the frame that makes all methods.
  std::vector<double> seconds;             ///< One per later frame: least pass, wall clock.
  std::vector<std::size_t> contact_pairs;  ///< Pairs with an LMD, one per frame.
  // Means over frames.
  double lmds = 0.0;
  double touched = 0.0;   ///< Pairs looked at.
  double searched = 0.0;  ///< Pairs whose meshes were searched.
  double anchored = 0.0;  ///< Movers that left their slack.
  double node_pairs = 0.0;
  std::size_t candidates = 0, methods = 0;  ///< At the end.
  double bytes = 0.0;                       ///< Heap of the search at the end, without meshes.

  /// Over all frames; NaN where there is no contact.
  double seconds_per_contact_pair() const;
  std::size_t frames_above(double limit) const;
};

/// Runs piles of all sizes, which take turns pass by pass.
std::vector<PileRow> measure_piles(PileMotion motion, const PileChoice& choice,
                                   const BroadPhase::Tuning& tuning = {});

}  // namespace lmdbench::worlds
