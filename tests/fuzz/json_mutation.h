// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench::testing {

/// The text of a JSON document that differs from a given one in one to three values, keys or members: what
/// flipped bytes seldom reach, because most of them are no JSON. Empty where the text is no JSON.
std::string mutated_json(std::string_view text, unsigned int seed);

}  // namespace lmdbench::testing
