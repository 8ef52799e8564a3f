// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>
#include <lmdbench/decision/contact_tolerance.h>

namespace lmdbench {

/// The two meshes of a decision, at a pose; all that is named outlives it.
struct ShapePair {
  ShapeSide moving, fixed;
  ContactTolerance tolerance;

  ShapePair(const Surface& moving_surface, const ShapeComplex& moving_shape, const Surface& fixed_surface,
            const ShapeComplex& fixed_shape, const RigidTransform& X_WM, double cutoff);
};

/// The definition of an LMD (DEFINITION.md) for two features. Appends what they share: nothing, a
/// pair of points or, where parallel, one contact for each connected part. It depends on these
/// features and the pose alone, not on other pairs, an order or the cut into triangles.
///
/// Conditions are closed: each holds up to rounding, so one of neighbouring features says yes.
/// Several contacts of one place become one LMD afterwards (join_contacts.h).
///
/// Bounds may rest on (certified/PROOF.md, lemma 2): a contact of (f, g) has its points in the
/// convex hulls of f and g, a distance of at most `tolerance.reach`, and a direction u with
/// u . w <= grant |w| for every wing w of f, likewise of g. The grant is rounding / distance +
/// rounding / |w| between points, 2 rounding / |w| along a plane's normal, 2 rounding / |w| +
/// LARGEST_CROSSING_SLACK across crossing chains, and LARGEST_PARALLEL_TILT more where parallel.
/// @param on_moving, on_fixed  leads (ShapeComplex); what is no feature of the shape has no contact
void decide(const ShapePair& pair, const FeatureId& on_moving, const FeatureId& on_fixed, ContactSet& found);

}  // namespace lmdbench
