// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/plugin/loaded_plugin.h>

#include <array>
#include <cstddef>
#include <cstdint>

/// What program and child process tell each other. Both are of one build, so structures go as they are: small ones over a
/// socket that keeps messages whole, which also tells both sides at once when the other one is gone; meshes and contacts by shared
/// memory. The child may write whatever it likes into what the program reads: sizes are checked and everything is judged.
namespace lmdbench::wire {

/// Open files of the child beside its standard ones.
inline constexpr int SOCKET = 3, MESHES = 4, CONTACTS = 5, FIRST_UNUSED = 6;

/// Contacts of one pose, at most; shared memory is reserved for them and taken as it is used.
inline constexpr std::uint64_t MOST_CONTACTS = std::uint64_t{1} << 20;
inline constexpr std::size_t CONTACT_BYTES = MOST_CONTACTS * sizeof(lmdbench_contact);
static_assert(sizeof(lmdbench_contact) == 64, "pages hold a whole number of them");

/// At the begin of the meshes' memory. Behind it: vertices of A, of B, triangles of A, of B, options ended by 0.
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

/// The first one tells that the method is made, or why not. Contacts stand in shared memory: `reply.needed` of them, where that is at
/// most MOST_CONTACTS.
struct Answer {
  std::uint64_t number = 0;
  PluginReply reply;
  std::array<char, 512> message{};
};

}  // namespace lmdbench::wire
