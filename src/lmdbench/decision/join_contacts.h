// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>
#include <lmdbench/decision/critical_index.h>
#include <lmdbench/decision/decide.h>
#include <lmdbench/decision/drop_intersecting.h>
#include <lmdbench/decision/intersections.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/lmd.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Makes LMDs of the contacts of all pairs of features (DEFINITION.md, "One place, one LMD"). The
/// result depends on the set alone, never on its order.
///
/// - Contacts are one LMD where a way leads from one to the other along which the distance stays
///   the same up to `ContactPlaces::granted`: they lie on one closed pair of features and the
///   segments between their points stay on it (J1), or both are extended, have one direction, share
///   a lower pair of features and meet there (J2). Contacts of unknown direction bring no others
///   together that are at an angle.
/// - Extended contacts without a pair of points are no minimum (rule S): they lead down somewhere.
/// - Contacts higher than the tolerance over the lowest of their LMD are dropped (rule K).
/// - Its representative: see represent_contacts.h.
/// - Contacts nearer than rounding whose triangles intersect by more are left to intersections.h.
/// @param contacts  of one fixed body, in any order, repeated or not; left in some order
/// @param intersections  of all bodies; those that contacts at rest replace are taken out
/// @param lmds  those within the cutoff are appended, unsorted
/// @param at_rest  regions whose triangles `intersections` leaves out
void join_contacts(const ShapePair& pair, std::int32_t fixed_body, ContactSet& contacts,
                   std::vector<Intersection>& intersections, LmdSet& lmds, const AtRest& at_rest = {});

/// The same with critical pairs among the contacts: an LMD's index is the sum over its contacts;
/// pairs of no LMD are listed by themselves. The minima are those of `join_contacts`.
void join_critical(const ShapePair& pair, const SignedFeatures& moving, const SignedFeatures& fixed,
                   std::int32_t fixed_body, ContactSet& contacts, std::vector<Intersection>& intersections,
                   CriticalSet& critical, const AtRest& at_rest = {});

}  // namespace lmdbench
