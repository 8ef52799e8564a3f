// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lmdbench {

/// Rounding to single precision, out of line and in a unit of its own on purpose: GCC 12's vectoriser drops the rounding when it sees
/// double to float to double in one place (-ftree-slp-vectorize, from -O2 on), so a bound that is measured
/// from the rounded value would be measured from the unrounded one.
float to_single(double value);

/// Smallest single that is not below the value.
float round_up_to_single(double value);

}  // namespace lmdbench
