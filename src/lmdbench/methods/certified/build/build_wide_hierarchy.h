// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>

namespace lmdbench {

class ShapeComplex;
class SignedFeatures;

/// Builds the hierarchy of a mesh, the same with any number of threads. A leaf is one feature.
/// 1. Each feature gets the cap of its own directions (polar_cap.h; PROOF.md, lemmas 4 to 6).
/// 2. Sets are divided near the median, at powers of 8, which fills nodes (wide_partition.h).
/// 3. Bottom-up each child gets a body and a cone round all features below it (wide_bounds.h).
/// @param shape  where given, its regions and chains replace faces and edges
/// @param signs  where given, also features of other critical pairs (signed_hierarchy.h); needs a
///   shape
WideHierarchy build_wide_hierarchy(const Surface& surface, const ShapeComplex* shape = nullptr,
                                   const SignedFeatures* signs = nullptr);

/// Whether every lane holds the vertices of all features below it. Costs as much as building.
bool bounds_what_is_below(const WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex* shape);

}  // namespace lmdbench
