// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/build/polar_cap.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/shape/signed_features.h>

#include <optional>

namespace lmdbench {

/// A wide hierarchy over all features of LMDs or other critical pairs: reflex edges, saddles and
/// pits too (CRITICAL.md). Made when critical pairs are asked for, beside the one of LMDs.
struct SignedHierarchy {
  WideHierarchy hierarchy;

  static SignedHierarchy of(const Body& body);
  /// Builds it anew and notes so in `changes`: critical pairs are asked for seldom.
  void follow(const Body& body, const SurfaceChange& change);
};

/// Cap of all directions in which a feature's index is not 0: a region's normal, both normals of a
/// chain, the hull of all normals round a corner. Nothing for a feature without an index.
/// @param lead  of the shape
std::optional<PolarCap> signed_cap(const SignedFeatures& signs, const ShapeComplex& shape,
                                   const FeatureId& lead);

/// A cap around both, nearly the smallest.
PolarCap merged_caps(const PolarCap& a, const PolarCap& b);

}  // namespace lmdbench
