// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lmdbench {

/// The line, counted from 1, in which the value at a JSON pointer begins; that of the nearest enclosing value
/// that is there where it is not (a missing key).
/// @param text that `parse_json` accepts
int line_of(const std::string& text, const std::string& pointer);

}  // namespace lmdbench
