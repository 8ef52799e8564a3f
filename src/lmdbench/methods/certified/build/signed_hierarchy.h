// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/build/polar_cap.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/shape/signed_features.h>

#include <optional>

namespace lmdbench {

/// A wide hierarchy over all features that carry an LMD or another critical pair: reflex edges, saddles and pits too. Made when
/// critical pairs are asked for, beside the one that LMDs are searched in.
struct SignedHierarchy {
  WideHierarchy hierarchy;

  static SignedHierarchy of(const Body& body);
  /// Built anew, and known to be: critical pairs are asked for seldom.
  void follow(const Body& body, const SurfaceChange& change);
};

/// Cap of all directions in which a feature has an index that is not 0: a region's normal, both normals of a chain, all normals round
/// a corner, whose index is 0 outside their convex hull; nothing for a feature without an index.
/// @param lead  of the shape
std::optional<PolarCap> signed_cap(const SignedFeatures& signs, const ShapeComplex& shape,
                                   const FeatureId& lead);

/// The smallest cap that the makers of cones find around both.
PolarCap merged_caps(const PolarCap& a, const PolarCap& b);

}  // namespace lmdbench
