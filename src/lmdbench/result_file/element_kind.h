// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lmdbench {

/// What a dataset of a result file holds.
enum class ElementKind {
  REAL,     ///< Floating point
  INTEGER,  ///< Counts, indices, flags
  TEXT      ///< Strings
};

}  // namespace lmdbench
