// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>

namespace lmdbench {

class ShapeComplex;
class SignedFeatures;

/// Deterministic, whatever the number of threads. Sets are divided at the median along the longest side of the box of centres, at
/// multiples of powers of the width, which fills nodes, and each feature has a lane and the cone of its own directions. Other ways
/// were no better on scans (commit 2c9786a, node tests of a query at a cutoff of 2 % of the diagonal, two bunnies of 16,298
/// triangles; this one 856): halved at the middle 1,134, by cone axes too 877 to 6,308, in Morton order 3,296, cones of the normals
/// round a feature 2,204, width 4 1,240; two features a lane 768, but 6 to 11 times the pairs left to the final tests.
/// @param shape where given, its regions and chains are features in place of faces and edges
/// @param signs where given, features that carry other critical pairs than LMDs are owned too (signed_hierarchy.h); needs a shape
WideHierarchy build_wide_hierarchy(const Surface& surface, const ShapeComplex* shape = nullptr,
                                   const SignedFeatures* signs = nullptr);

/// Whether every lane holds the vertices of all features below it: what no search may lose. As dear as building.
bool bounds_what_is_below(const WideHierarchy& hierarchy, const Surface& surface, const ShapeComplex* shape);

}  // namespace lmdbench
