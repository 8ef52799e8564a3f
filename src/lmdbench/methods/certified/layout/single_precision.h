// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lmdbench {

/// Rounding to single precision, out of line and in a unit of its own. Else GCC 12's vectoriser
/// drops the rounding where it sees double to float to double in one place (-ftree-slp-vectorize,
/// from -O2 on), and a bound is measured from a value that is not the stored one.
float to_single(double value);

/// Smallest single that is not below the value.
float round_up_to_single(double value);

}  // namespace lmdbench
