// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What the program says beside its results: spdlog on standard error.
namespace lmdbench {

/// @param verbosity 0 is normal (information), negative is quiet (errors only from -1 on), positive tells
/// details. Colours are used on terminals only, and never where NO_COLOR is set (no-color.org).
void set_up_talk(int verbosity);

/// Whether a progress bar is welcome: not when quiet.
bool progress_welcome();

}  // namespace lmdbench
