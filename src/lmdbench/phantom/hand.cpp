// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/phantom/hand.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

namespace lmdbench {
namespace {

Hand hand(const char* name, double mass, double damping, double stiffness, double grip_damping = 0.0,
          double grip_stiffness = 0.0) {
  return {name, mass, damping, stiffness, grip_damping, grip_stiffness};
}

}  // namespace

/// Arms differ a hundredfold between publications; none is the average person.
std::span<const KnownHand> known_hands() {
  static const std::array<KnownHand, 5> table{{
      {hand("postural-arm", 0.554, 6.45, 135.0), "Scientific Reports 5:18004 (2015), figure 3, one trial",
       Trust::STATED},
      {hand("hogan-1989", 0.8, 5.5, 568.0), "Hogan 1989, not re-read", Trust::FROM_MEMORY},
      {hand("yokokohji-1994", 2.0, 2.0, 10.0), "Yokokohji and Yoshikawa 1994, not re-read",
       Trust::FROM_MEMORY},
      {hand("kosuge-1992", 11.6, 17.0, 243.0), "Kosuge 1992, not re-read", Trust::FROM_MEMORY},
      {hand("speich-2005", 1.46, 4.5, 48.8, 7.9, 375.0), "Speich 2005, five parameters, not re-read",
       Trust::FROM_MEMORY},
  }};
  return table;
}

const Hand& hand_named(std::string_view name, std::string_view file, std::string_view pointer) {
  std::vector<std::string_view> names;
  for (const KnownHand& known : known_hands()) {
    if (known.hand.name == name) return known.hand;
    names.push_back(known.hand.name);
  }
  throw UsageError(std::string(file), std::string(pointer), fmt::format("there is no hand '{}'", name),
                   fmt::format("use one of {}, or give its figures", fmt::join(names, ", ")));
}

}  // namespace lmdbench
