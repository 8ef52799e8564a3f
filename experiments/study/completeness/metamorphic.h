// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

#include <support/parts/rest_fits.h>
#include <support/random.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

/// Changes of two meshes and a pose that keep the LMDs.
namespace lmdbench::completeness {

/// Two meshes and a pose of the moving one.
struct ScenePair {
  TriangleMesh moving, fixed;
  Pose X_WM;
  double cutoff = 0.0;  ///< [m]
  /// Distances [m] of contacts that are LMDs or not by rounding: the design leaves them open.
  std::vector<double> open;
  /// Planes are parallel up to rounding or not at all; extended contacts' distances are as exact.
  bool is_level = false;
};

Scene scene_of(const ScenePair& pair);
ScenePair pair_of(const Scene& scene, const Pose& X_WM);
ScenePair pair_of(const parts::RestScene& scene);
/// With all lengths times a factor; `open` stays.
ScenePair scaled_by(double factor, ScenePair pair);
/// The set of a method.
LmdSet set_of(const char* method, const ScenePair& pair);

/// What brings LMDs of a changed pair back.
struct Undo {
  double scale = 1.0;    ///< Factor of all lengths by the change.
  RigidTransform X;      ///< From the changed world, divided by the scale, to that before.
  bool swapped = false;  ///< The meshes are exchanged.
  /// Another of several equally near points may be the first in the moving mesh's frame.
  bool orders_anew = false;
};
LmdSet undone(const LmdSet& changed, const Undo& undo);

struct Change {
  const char* name;
  bool keeps_bits;  ///< Operations round alike: distances keep their bits.
  /// @param undo receives what the change was
  ScenePair (*make)(const ScenePair& pair, experiments::Random& random, Undo& undo);
};
std::span<const Change> metamorphic_changes();

/// How the set of a pair differs from that of the changed pair.
struct Difference {
  bool differs = false;
  bool bits_differ = false;
  /// The definition leaves it open: the number of contacts of intersecting triangles, an LMD within
  /// rounding of the cutoff or at an open distance, or one that hangs on the definition's
  /// tolerances, which grew with the coordinates. All else is still compared.
  bool tie = false;
};

/// Allowed differences of distances, on which those of places and directions depend.
struct Widths {
  double rounding;     ///< Of every distance [m].
  double known;        ///< In addition where two edges or faces are in contact [m].
  double coordinates;  ///< Of both meshes [m].
};

/// Compares kinds of features, distances, places and directions.
/// @param pair its set is `a`
/// @param b set of the changed pair, undone
/// @param orders_anew whether LMDs of points that moved square to their direction are a tie
Difference compare(const ScenePair& pair, const LmdSet& a, const LmdSet& b, const Widths& widths,
                   bool orders_anew = false);

/// Sums over many pairs.
struct MetamorphicCounts {
  std::size_t pairs = 0, different = 0, bits_different = 0, ties = 0;
  std::size_t incomplete = 0;  ///< Changed pairs for which `certified` and `exhaustive` differ.

  MetamorphicCounts& operator+=(const MetamorphicCounts& other);
  bool is_wrong(const Change& change) const {
    return different + incomplete > 0 || (change.keeps_bits && bits_different > 0);
  }
};

/// Changes a pair and compares; `objection` receives both sets when they differ.
/// @param truth the set of `exhaustive` for the pair
MetamorphicCounts judge_change(const ScenePair& pair, const LmdSet& truth, const Change& change,
                               experiments::Random& random, std::string& objection);

/// The set that a method finds for the pair.
LmdSet set_of(const char* method, const ScenePair& pair);

}  // namespace lmdbench::completeness
