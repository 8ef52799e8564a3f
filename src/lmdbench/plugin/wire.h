// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/plugin/loaded_plugin.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

/// Messages between program and child process. Both are of one build, so structures are sent as
/// they are: small ones over a socket that keeps messages whole and tells either side when the
/// other has ended; meshes and contacts by shared memory. The program checks all that it reads.
namespace lmdbench::wire {

/// File descriptors of the child after its standard ones.
inline constexpr int SOCKET = 3, MESHES = 4, CONTACTS = 5, FIRST_UNUSED = 6;

/// Most contacts of one pose: shared memory is reserved for them, and pages only when used.
inline constexpr std::uint64_t MOST_CONTACTS = std::uint64_t{1} << 20;
inline constexpr std::size_t CONTACT_BYTES = MOST_CONTACTS * sizeof(lmdbench_contact);
static_assert(sizeof(lmdbench_contact) == 64, "pages hold a whole number of them");

/// A plugin's search; again where it has more contacts than there is room, with room for twice as
/// many.
/// @param capacity  room that there is
/// @param search    gives a PluginReply
/// @param make_room takes a number of contacts
template <typename Search, typename MakeRoom>
PluginReply search_with_room(std::uint64_t capacity, const Search& search, const MakeRoom& make_room) {
  const PluginReply first = search();
  if (first.status != 0 || first.needed <= capacity || first.needed > MOST_CONTACTS) return first;
  capacity = std::min(2 * first.needed, MOST_CONTACTS);
  make_room(capacity);
  PluginReply second = search();
  second.seconds += first.seconds;
  second.changed_float_mode |= first.changed_float_mode;
  if (second.status == 0 && second.needed > capacity) second.status = PluginReply::UNSTEADY;
  return second;
}

/// Begins the meshes' memory. Then: vertices of A, of B, triangles of A, of B, options ended by 0.
struct Task {
  std::uint32_t method = 0;
  double cutoff = 0.0;
  std::array<std::uint64_t, 2> vertices{}, triangles{};

  std::size_t triangles_begin() const {
    return sizeof(Task) + (vertices[0] + vertices[1]) * 3 * sizeof(double);
  }
  std::size_t options_begin() const {
    return triangles_begin() + (triangles[0] + triangles[1]) * 3 * sizeof(std::int32_t);
  }
};

struct Request {
  std::uint64_t number = 0;
  std::array<double, 12> X_BA{};
};

/// The first one tells whether the method was made, or why not. Contacts are in shared memory:
/// `reply.needed` of them, where that is at most MOST_CONTACTS.
struct Answer {
  std::uint64_t number = 0;
  PluginReply reply;
  std::array<char, 512> message{};
};

}  // namespace lmdbench::wire
