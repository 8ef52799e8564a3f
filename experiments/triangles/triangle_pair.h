// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <string>

namespace lmdbench::testing {

struct TrianglePair {
  Triangle a, b;
};

/// The pair with every corner scaled, rotated and moved.
TrianglePair transformed(const TrianglePair& pair, double scale, const Mat3& rotation, const Vec3& offset);

/// The pair with both triangles' corners reordered (0 <= order < 36) and, from 36 to 71, swapped.
TrianglePair reordered(const TrianglePair& pair, int order);

/// Largest absolute coordinate of the pair, the scale of errors.
double magnitude(const TrianglePair& pair);

/// The pair as C++ that pastes back into a test.
std::string paste(const TrianglePair& pair);

}  // namespace lmdbench::testing
