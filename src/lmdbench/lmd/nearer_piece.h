// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

namespace lmdbench {

/// Whether a piece of a contact is nearer to the contact's centroid than another one, beyond rounding: that must not choose the
/// name of a symmetric contact.
/// @param distance, other  of the two pieces from the centroid [m]
inline bool is_nearer_piece(double distance, double other, const Vec3& centroid) {
  constexpr double EQUALLY_NEAR = 1e-9, ROUNDING = 1e-14;  // of the distance and of the coordinates
  return distance < other * (1.0 - EQUALLY_NEAR) - ROUNDING * centroid.cwiseAbs().maxCoeff();
}

}  // namespace lmdbench
