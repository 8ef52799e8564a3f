// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <triangles/triangle_families.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lmdbench::testing {

/// A pair as bytes: 18 doubles in the machine's order, a's corners first. Fewer bytes than that are no pair.
std::optional<TrianglePair> pair_from_bytes(std::span<const std::uint8_t> bytes);
std::vector<std::uint8_t> bytes_from_pair(const TrianglePair& pair);

/// What triangle_distance and its batch promise for any 18 doubles, checked; says what is broken, with the
/// pair as C++, or is empty.
std::string broken_promise(const TrianglePair& pair);

}  // namespace lmdbench::testing
