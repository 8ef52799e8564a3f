// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/vector_target.h>

namespace lmdbench {

/// Free choices of `certified`. Members are called as in experiment files.
struct CertifiedOptions {
  bool frame_coherence = true;  ///< Reuse the last frames' tests; the set is the same either way.
  VectorTarget kernel = VectorTarget::BEST;  ///< Instruction set; the LMDs are the same with each.
};

}  // namespace lmdbench
