// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/decide.h>
#include <lmdbench/methods/certified/keep/certificate.h>

#include <cstdint>

namespace lmdbench {

/// What the closed-form test of a feature pair says.
enum class PairVerdict : std::uint8_t {
  NO_LMD,  ///< Some condition fails by more than the margin.
  ASK      ///< The definition has to be asked.
};

/// What a test answers, and what that stands.
struct PairAnswer {
  PairVerdict verdict = PairVerdict::ASK;
  Certificate certificate;  ///< Of NO_LMD.
};

/// Rejects pairs of features by the conditions of the definition (decision/pair_conditions.h), each with a margin above what the
/// definition grants it, and says how long that stands (PROOF.md, lemmas 9, 19 and 20): by how much the condition fails beyond
/// the margin, and how fast that can change. Leaves to the definition the outer side, which the caps of the hierarchy have settled
/// for nearly all, which part of a region a foot is in, features whose size is rounding, and what is parallel where it can be near.
struct PairFilter {
  const ShapePair& pair;
  double reach;   ///< metres; at least ContactTolerance::reach
  double touch;   ///< metres; pairs nearer than half of it are not this filter's: see TouchingPairs
  double margin;  ///< Relative to the lengths compared, or a sine. Far above rounding, far below geometry.
  double
      tiny;  ///< metres; a feature shorter than this is rounding in its size and always left to the definition

  /// @param on_moving, on_fixed  leads (ShapeComplex)
  /// @param lever_arm of the moving feature: its radius about its centre and two cutoffs [m]
  PairAnswer operator()(const FeatureId& on_moving, const FeatureId& on_fixed, double lever_arm) const;
};

}  // namespace lmdbench
