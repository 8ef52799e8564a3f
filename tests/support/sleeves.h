// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/sleeve.h>

namespace lmdbench::testing {

/// A flat ring, 0.2 high.
inline TriangleMesh make_ring(double outer, double inner, int around, int rings) {
  return make_sleeve(circle_outline(outer), circle_outline(inner), {0.2, around, 1, rings});
}

/// A flat gear of diameter 1, 0.2 high; its ends fold onto themselves beside the teeth.
inline TriangleMesh make_gear(int teeth) {
  return make_sleeve(gear_outline(teeth, 1.0 / teeth, 0.01), circle_outline(0.2), {0.2, 8 * teeth, 1, 1});
}

}  // namespace lmdbench::testing
