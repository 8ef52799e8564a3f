// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lmdbench {

/// The remedy for a mesh file whose length does not fit its header.
inline constexpr const char* CUT_SHORT =
    "the file may be cut short: get it again, or correct the counts in its header";

}  // namespace lmdbench
