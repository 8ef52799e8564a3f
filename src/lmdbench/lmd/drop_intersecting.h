// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/contact_places.h>
#include <lmdbench/lmd/intersections.h>

#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// Drops contacts nearer than rounding whose triangles intersect: they are reported as what intersects (intersections.h).
/// @param intersections  of all fixed bodies
void drop_intersecting(const ShapePair& pair, std::int32_t fixed_body, const ContactPlaces& places,
                       std::span<const Intersection> intersections, std::vector<Contact>& contacts);

}  // namespace lmdbench
