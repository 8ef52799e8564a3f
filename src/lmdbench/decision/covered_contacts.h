// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/decide.h>

#include <vector>

namespace lmdbench {

/// How far from a polygon's distance others are that may join with contacts that it covers [m].
double covered_spread(const ContactTolerance& tolerance, const Contact& polygon);

/// Takes out contacts that a polygon covers: of corners and chains of a face with another face,
/// inside the polygon that is all that both faces share. No other polygon may be as far away. (A
/// gear on a gear: one polygon, a thousand contacts.) The polygon remembers them (Contact::covers).
///
/// They are of its LMD. Joining the rest gives the same if all within `covered_spread` are of it
/// too.
std::vector<Contact> take_covered(const ShapePair& pair, std::vector<Contact>& contacts);

}  // namespace lmdbench
