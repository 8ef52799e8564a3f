// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench {

/// A file's stem as a name of ASCII letters, digits and `also`: other ASCII characters become `-`,
/// and those at its start are left out. Where the stem holds others, which are left out, a hash of
/// it follows: two such names stay two. May be empty.
std::string plain_name(std::string_view stem, std::string_view also);

/// A word of a shell command: quoted where a shell would not take it as it is.
std::string shell_word(const std::string& text);

}  // namespace lmdbench
