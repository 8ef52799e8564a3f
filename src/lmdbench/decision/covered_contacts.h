// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/decide.h>

#include <vector>

namespace lmdbench {

/// How far the distances of what is covered by a polygon and of what that may be joined with can be from the polygon's [m].
double covered_spread(const ContactTolerance& tolerance, const Contact& polygon);

/// Takes out what a polygon says already: what corners and chains of a face share with another face, inside the polygon that is all that the
/// two faces share, where no other polygon is as far away. A gear that lies on another one has one such polygon and a
/// thousand of them. The polygon remembers (Contact::covers, covers_point).
///
/// It is of the polygon's LMD. What is left is joined as if it were there when all contacts within `covered_spread` are of that LMD too:
/// nothing else is near enough in distance to be joined with what is covered.
std::vector<Contact> take_covered(const ShapePair& pair, std::vector<Contact>& contacts);

}  // namespace lmdbench
