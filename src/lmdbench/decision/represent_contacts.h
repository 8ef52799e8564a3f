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

/// What stands for the contacts of an LMD.
struct Representative {
  std::optional<Contact> middle;      ///< The centroid of several; nothing where one of them represents all.
  const Contact* namesake = nullptr;  ///< Its features name the LMD.

  const Contact& contact() const { return middle ? *middle : *namesake; }
};

/// The centroid of the polygons among the contacts; else of the segments, where that lies on one of them; else the nearest contact.
/// Contacts higher than the lowest by more than what one distance may vary do not count (rule K).
/// @param contacts  minima, nearest first, one of them at least a pair of points
Representative represent_contacts(const ShapePair& pair, ContactPlaces& places,
                                  const ContactPointers& contacts);

/// A contact as LMD, named after the mesh features of another one's place that is nearest to it.
Lmd make_lmd(const ShapePair& pair, const ContactPlaces& places, const Contact& contact,
             const Contact& namesake, std::int32_t fixed_body);

}  // namespace lmdbench
