// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact_places.h>
#include <lmdbench/lmd/lmd.h>

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

namespace lmdbench {

using ContactPointers = std::pmr::vector<const Contact*>;

/// The contact that represents an LMD.
struct Representative {
  /// Centroid of polygons or segments, or a point whose direction another one knows; else none.
  std::optional<Contact> middle;
  const Contact* namesake = nullptr;  ///< Its features name the LMD.

  const Contact& contact() const { return middle ? *middle : *namesake; }
};

/// The centroid of the polygons; else of the segments if one line holds all and one of them it;
/// else the nearest points. Contacts higher than the tolerance over the lowest are out (rule K).
/// @param contacts  minima, nearest first, at least one of them a pair of points
Representative represent_contacts(const ShapePair& pair, ContactPlaces& places,
                                  const ContactPointers& contacts);

/// A contact as LMD. Its names are of the mesh features at the place of `namesake` nearest to it.
Lmd make_lmd(const ShapePair& pair, const ContactPlaces& places, const Contact& contact,
             const Contact& namesake, std::int32_t fixed_body);

}  // namespace lmdbench
