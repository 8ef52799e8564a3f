// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench {

/// Text that is safe on a terminal, whatever file it came from. Control characters (of ASCII, and
/// U+0080 to U+009F, which some terminals obey), marks that turn the direction of writing, and
/// bytes that are not UTF-8 become \xNN; line ends and tabs too, because a message is one line.
/// Everything else stays, the backslash included.
std::string printable(std::string_view text);

/// The same, cut in its middle to about `most` bytes, so that people still read the text behind it.
std::string printable(std::string_view text, std::size_t most);

/// Whether the bytes are well-formed UTF-8 (RFC 3629: no surrogates, no overlong forms).
bool is_utf8(std::string_view text);

}  // namespace lmdbench
