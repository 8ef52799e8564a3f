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

/// What may be done to two meshes and a pose without another answer: the distances of the LMDs stay, and how many there are.
namespace lmdbench::completeness {

/// Two meshes and a pose of one.
struct ScenePair {
  TriangleMesh moving, fixed;
  Pose X_WM;
  double cutoff = 0.0;  ///< [m]
  /// Distances at which an LMD may be or not, by design: ways lead down from there within rounding [m].
  std::vector<double> open;
  /// Whether planes are parallel to rounding or not at all: then the distances of extended contacts are known to that, too.
  bool is_level = false;
};

Scene scene_of(const ScenePair& pair);
ScenePair pair_of(const Scene& scene, const Pose& X_WM);
ScenePair pair_of(const parts::RestScene& scene);

struct Change {
  const char* name;
  bool
      keeps_bits;  ///< Every operation of the methods rounds as before, so that distances are the same bits but for the scale.
  /// @param scale receives what lengths were multiplied by
  ScenePair (*make)(const ScenePair& pair, experiments::Random& random, double& scale);
};
std::span<const Change> metamorphic_changes();

/// How the sets of a pair and of its change differ.
struct Difference {
  bool differs = false;
  bool bits_differ = false;
  /// Something that the definition leaves open: how many contacts intersecting triangles have, an LMD within rounding of the cutoff or at
  /// a distance that is open by design, or another answer because the lengths of the definition, which are shares of the coordinates, have
  /// grown. Everything else is compared all the same.
  bool tie = false;
};

/// What distances may be apart.
struct Widths {
  double rounding;  ///< Of all [m].
  double known;     ///< Of edges and faces, as well [m].
};

/// @param pair of which `a` is the set
/// @param b of the changed pair; its lengths are `scale` times those of `a`
Difference compare(const ScenePair& pair, const LmdSet& a, const LmdSet& b, double scale,
                   const Widths& widths);

/// Over many pairs.
struct MetamorphicCounts {
  std::size_t pairs = 0, different = 0, bits_different = 0, ties = 0;
  std::size_t incomplete = 0;  ///< Changed pairs of which `certified` has other distances than `exhaustive`.

  MetamorphicCounts& operator+=(const MetamorphicCounts& other);
  bool is_wrong(const Change& change) const {
    return different + incomplete > 0 || (change.keeps_bits && bits_different > 0);
  }
};

/// Changes a pair and compares; `objection` receives both sets where something is wrong.
/// @param truth the set of `exhaustive` for the pair
MetamorphicCounts judge_change(const ScenePair& pair, const LmdSet& truth, const Change& change,
                               experiments::Random& random, std::string& objection);

/// The set of a method.
LmdSet set_of(const char* method, const ScenePair& pair);

}  // namespace lmdbench::completeness
