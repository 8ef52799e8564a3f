// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench::testing {

/// A JSON document that differs from the given one in one to three values, keys or members. Mutated
/// bytes seldom do that, because most of them are no JSON. Empty where the text is no JSON.
std::string mutated_json(std::string_view text, unsigned int seed);

}  // namespace lmdbench::testing
