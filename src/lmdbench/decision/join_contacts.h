// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>
#include <lmdbench/decision/critical_index.h>
#include <lmdbench/decision/decide.h>
#include <lmdbench/decision/intersections.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/lmd.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Makes LMDs out of what pairs of features share (DEFINITION.md, "One place, one LMD"). The result depends on the set alone,
/// never on its order.
///
/// - Contacts are one LMD where a way leads from one to the other along which the distance stays the same up to
///   `ContactPlaces::granted`: they lie on one closed pair of features and the segments between their points stay on
///   it (J1), or both are extended, have one direction, share a lower pair of features and meet there (J2).
/// - Extended contacts without a point contact are no minimum (rule S): what the tolerance calls level leads down somewhere.
/// - Contacts higher than the tolerance over the lowest of their LMD go (rule K).
/// - The LMD is represented by the centroid of its polygons; else of its segments where that lies on one of them; else by the
///   nearest contact.
/// - Contacts nearer than rounding whose triangles intersect by more than rounding are reported as such, not here.
/// @param contacts  of one fixed body, in any order; the same pair of features may come twice; is left in some order
/// @param intersections  of all bodies; those that contacts at rest say better are taken out
/// @param lmds  those within the cutoff are appended, unsorted
void join_contacts(const ShapePair& pair, std::int32_t fixed_body, ContactSet& contacts,
                   std::vector<Intersection>& intersections, LmdSet& lmds);

/// The same with the critical pairs among the contacts: an LMD's index is the sum over its contacts, and pairs that are of
/// no LMD are listed by themselves. The minima are the set that `join_contacts` makes.
void join_critical(const ShapePair& pair, const SignedFeatures& moving, const SignedFeatures& fixed,
                   std::int32_t fixed_body, ContactSet& contacts, std::vector<Intersection>& intersections,
                   CriticalSet& critical);

}  // namespace lmdbench
