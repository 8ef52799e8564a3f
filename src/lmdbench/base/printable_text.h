// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench {

/// Text that is safe to show on a terminal, whatever file it came from: control characters (of ASCII, and the
/// second set U+0080 to U+009F, which some terminals obey), marks that turn the direction of writing, and bytes
/// that are no UTF-8 become \xNN; line ends and tabs too, because a message is one line. Everything else, the
/// backslash included, stays.
std::string printable(std::string_view text);

/// The same, cut in its middle to about `most` bytes, so that what stands behind it is still read.
std::string printable(std::string_view text, std::size_t most);

/// Whether the bytes are well-formed UTF-8 (RFC 3629: no surrogates, no overlong forms).
bool is_utf8(std::string_view text);

}  // namespace lmdbench
