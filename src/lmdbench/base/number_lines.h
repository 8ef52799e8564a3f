// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>

namespace lmdbench {

/// Goes through text whose lines hold numbers, separated by blanks or commas; `#` begins a comment. Lines without a number are left
/// out.
/// @param name for messages
/// @param remedy what a line should hold, for messages
/// @param use gets the place of a line, for messages ("line 7"), and its numbers
/// @throws InputError naming the line of a word that is no finite number
void for_each_number_line(
    const std::string& text, const std::string& name, const std::string& remedy,
    const std::function<void(const std::string& place, std::span<const double> numbers)>& use);

}  // namespace lmdbench
