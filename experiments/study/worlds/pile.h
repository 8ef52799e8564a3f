// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/scene/broad_phase.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench::worlds {

/// What the spheres of a pile do. All swing about their places, each in a direction, about an axis and with a phase of its own.
enum class PileMotion : std::uint8_t {
  JOSTLING,  ///< That alone: pairs in contact stay so.
  SETTLING,  ///< They come together from farther apart: contacts begin.
  STIRRED    ///< Layers turn against each other: neighbours change, and all leave their slack now and then.
};
const char* to_string(PileMotion motion);

/// Spheres on the closest packing, each in contact with those that it lies on and beside.
struct PileChoice {
  std::vector<std::size_t> counts = {10, 30, 100, 300, 1000};
  int subdivisions = 4;    ///< Of an icosahedron: 20 4^n triangles.
  double radius = 0.05;    ///< [m]
  double cutoff = 0.0005;  ///< [m]; neighbours are half of it apart.
  double swing_speed =
      0.002;  ///< At most [m/s]; a frame is a millisecond. A sphere turns at swing_speed / radius.
  double looseness = 0.02;  ///< SETTLING: how much farther from the origin they begin, over where they end.
  double stirring_speed = 0.2;  ///< STIRRED: of the outermost sphere [m/s].
  std::size_t frames = 300, passes = 3;
  std::uint64_t seed = 1;
};

struct PileRow {
  PileMotion motion = PileMotion::JOSTLING;
  std::size_t movers = 0, triangles = 0;
  double first_seconds = 0.0;   ///< Of the first frame, which finds all pairs and makes their methods.
  std::vector<double> seconds;  ///< One a frame after it: the least of the passes, wall clock.
  std::vector<std::size_t> contact_pairs;  ///< Pairs with an LMD, one a frame.
  // Means over frames.
  double lmds = 0.0;
  double touched = 0.0;   ///< Pairs looked at.
  double searched = 0.0;  ///< Pairs whose meshes were searched.
  double anchored = 0.0;  ///< Movers that left their slack.
  double node_pairs = 0.0;
  std::size_t candidates = 0, methods = 0;  ///< At the end.
  double bytes = 0.0;                       ///< Of the heap that the search has at the end, meshes apart.

  /// Of all frames together; NaN where there is no contact.
  double seconds_per_contact_pair() const;
  std::size_t frames_above(double limit) const;
};

/// Runs a pile of every size, sizes in turns pass by pass.
std::vector<PileRow> measure_piles(PileMotion motion, const PileChoice& choice,
                                   const BroadPhase::Tuning& tuning = {});

}  // namespace lmdbench::worlds
