// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <triangles/random_triangles.h>
#include <triangles/triangle_pair.h>

#include <span>
#include <string_view>

namespace lmdbench::testing {

/// A family of triangle pairs that some published distance routine gets wrong, or could. The
/// generator depends on the engine's state alone, on every platform.
struct TriangleFamily {
  std::string_view name;
  TrianglePair (*generate)(Random& random);
};

/// The families of the accuracy table, in its order.
std::span<const TriangleFamily> triangle_families();

}  // namespace lmdbench::testing
