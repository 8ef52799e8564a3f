// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/comparison/compare.h>

#include <string>

namespace lmdbench {

/// For people, as plain text; the first line is the verdict.
std::string comparison_text(const Comparison& comparison);

/// The same as Markdown, for a comment on a change.
std::string comparison_markdown(const Comparison& comparison);

/// One line each: "improved: force differs in frame 12 (and 3 more rows): [0,0,1.5] became [0,0,1.25]".
std::string difference_text(const Difference& difference);
/// "improved, search: 1.104 times the base's time (1.087 to 1.121), slower; the same work: ..."
std::string timing_text(const Timing& timing);

}  // namespace lmdbench
