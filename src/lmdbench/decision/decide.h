// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>
#include <lmdbench/decision/contact_tolerance.h>

namespace lmdbench {

/// The two meshes of a decision.
struct ShapePair {
  ShapeSide moving, fixed;
  ContactTolerance tolerance;
};

/// The definition of an LMD (DEFINITION.md) for two features of the shapes: appends what they share, nothing, a pair of points
/// or where they are parallel one contact for each connected part. Depends on the two features and the pose alone, never on how
/// planes are cut into triangles, on other pairs or on an order. Both `exhaustive` and `certified` ask it; they differ in the
/// pairs that they ask.
///
/// Every condition is closed: it holds up to the rounding of what it compares, so that of neighbouring features at least one
/// says yes. What two of them say of one place becomes one LMD afterwards (join_contacts.h).
///
/// What bounds may rest on (certified/PROOF.md, lemma 2): a contact of (f, g) has its points in the convex hulls of f and g, a distance of at most
/// `tolerance.reach`, and a direction within largest_tilt + rounding / distance + rounding / (the shortest wing) of f's polar
/// cone, and likewise of g's. Corners have no tilt. Of a corner or a chain against a region, and of chains that cross,
/// rounding / distance does not enter.
/// @param on_moving, on_fixed  leads (ShapeComplex); what is no feature of the shape has no contact
void decide(const ShapePair& pair, const FeatureId& on_moving, const FeatureId& on_fixed, ContactSet& found);

}  // namespace lmdbench
