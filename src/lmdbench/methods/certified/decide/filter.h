// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/decide.h>
#include <lmdbench/methods/certified/decide/certificate.h>

#include <cstdint>

namespace lmdbench {

enum class PairVerdict : std::uint8_t {
  NO_LMD,  ///< A condition fails by more than the margin, or TouchingPairs asks.
  ASK      ///< The definition must be asked.
};

/// The answer, and for which motions it stays valid.
struct PairAnswer {
  PairVerdict verdict = PairVerdict::ASK;
  Certificate certificate;  ///< Of NO_LMD.
};

/// Touch relative to the coordinates: up to this distance rounding dominates a direction between
/// two points; above it rounding / distance is below POLAR_SLACK.
inline constexpr double RELATIVE_TOUCH = 2e-8;

/// Rejects pairs of features in closed form (PROOF.md, lemmas 9, 19 and 20):
/// 1. The definition's conditions are asked in order (decision/pair_conditions.h), each with a
///    margin above what the definition grants it. The first that fails rejects the pair; where a
///    value is rounding (short sides, near parallels, touch) the definition is asked.
/// 2. Its certificate: by how much it fails beyond the margin, and how fast that can change.
/// Left to the definition: the outer side (the caps tell it nearly always), the place in a region,
/// features whose size is rounding, and parallel features that can be near.
struct PairFilter {
  const ShapePair& pair;
  double reach;   ///< metres; at least ContactTolerance::reach
  double touch;   ///< metres; of pairs nearer than half of it the definition is asked
  double margin;  ///< Relative to the lengths compared, or a sine: far above rounding.
  double tiny;    ///< metres; the size of shorter features is rounding: the definition is asked

  /// @param on_moving, on_fixed  leads (ShapeComplex)
  /// @param lever_arm  radius of the moving feature about its centre + 2 search distances [m]
  PairAnswer operator()(const FeatureId& on_moving, const FeatureId& on_fixed, double lever_arm) const;
};

}  // namespace lmdbench
