// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/build/polar_cap.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>

#include <optional>
#include <vector>

namespace lmdbench {

class ShapeComplex;
class SignedFeatures;

/// A feature while a wide hierarchy is built.
struct WideItem {
  PolarCap cap;
  WideRef ref;
  bool carries_lmd = false;  ///< False for triangles without area: they have no cap.
};

/// A feature as a hierarchy owns it; nothing where it has no LMD and is no triangle without area.
/// @param feature  of a shape the lead
/// @param bounding  of a vertex, see polar_cap
std::optional<WideItem> make_wide_item(const Surface& surface, const ShapeComplex* shape,
                                       const SignedFeatures* signs, const FeatureId& feature,
                                       WingSet* bounding = nullptr);

/// The features that a hierarchy owns: vertices, edges, faces, by index; flat ones by leads.
std::vector<WideItem> collect_wide_items(const Surface& surface, const ShapeComplex* shape,
                                         const SignedFeatures* signs);

}  // namespace lmdbench
