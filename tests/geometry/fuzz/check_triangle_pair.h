// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <triangles/triangle_families.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lmdbench::testing {

/// A pair from 18 doubles in the machine's order, a's corners first. Nothing for fewer bytes.
std::optional<TrianglePair> pair_from_bytes(std::span<const std::uint8_t> bytes);
std::vector<std::uint8_t> bytes_from_pair(const TrianglePair& pair);

/// Checks the promises of triangle_distance and its batch for any 18 doubles. Empty, or what is
/// broken, with the pair as C++ text.
std::string broken_promise(const TrianglePair& pair);

}  // namespace lmdbench::testing
