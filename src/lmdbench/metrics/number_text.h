// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Numbers of tables for readers; files have all digits.
namespace lmdbench {

/// Three digits, of numbers above 1000 all whole ones; "-" for what was not measured (NaN).
std::string number_text(double value);

/// A share times `whole`, such as 100 for percent: as many digits more as it takes for what is
/// below 1 not to read as 1.
std::string share_text(double share, double whole);

}  // namespace lmdbench
