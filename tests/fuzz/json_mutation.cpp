// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "json_mutation.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench::testing {
namespace {

using Json = nlohmann::json;
using Random = std::mt19937_64;

/// The functions here are recursive; deeper documents get mutations of bytes only.
constexpr std::size_t DEEPEST = 60;

void collect(Json& value, std::vector<Json*>& all) {
  all.push_back(&value);
  if (value.is_structured())
    for (auto& child : value.items()) collect(child.value(), all);
}

const Json& interesting(Random& random) {
  static const Json values =
      Json::parse(R"([null, true, false, 0, -0.0, 1, -1, 2, 3, 0.5, 1e-310, 5e-324, 1e-9,
    1e9, 1e308, -1e308, 2147483647, 2147483648, 4294967296, 9007199254740993, 9223372036854775807,
    -9223372036854775808, 18446744073709551614, "", "0", "sphere", "box", "../x", "/etc/passwd", "a/../b", "-",
    "certified", "improved", "linear", "auto", "\u0000", "\u001b[2J", "\u00fc", "~0~1", "1e999", [], {}, [[]],
    [0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1], [1e308, 1e308, 1e308], [{}], {"kind": 3}, {"mesh": "sphere"},
    {"kind": "duplicates", "every": 1, "of": {"kind": "sphere", "radius": 1, "subdivisions": 2}}])");
  return values[random() % values.size()];
}

void mutate_number(Json& value, Random& random) {
  if (random() % 2 == 0) {
    value = interesting(random);
  } else if (value.is_number_integer()) {
    value = value.get<std::int64_t>() / 2 + static_cast<std::int64_t>(random() % 1000);
  } else {
    constexpr std::array<double, 6> FACTORS{-1.0, 0.0, 0.5, 2.0, 1e6, 1e-6};
    value = value.get<double>() * FACTORS[random() % FACTORS.size()];
  }
}

void mutate_members(Json& value, const Json& other, Random& random) {
  const std::size_t choice = random() % 4;
  if (value.is_array()) {
    if (choice == 0 && !value.empty()) value.erase(random() % value.size());
    if (choice == 1) value.push_back(value.empty() ? other : Json(value[random() % value.size()]));
    if (choice == 2) value.push_back(interesting(random));
    if (choice == 3 && !value.empty()) value[random() % value.size()] = other;
    return;
  }
  if (value.empty()) {
    value["kind"] = other;
    return;
  }
  auto member = value.begin();
  std::advance(member, static_cast<std::ptrdiff_t>(random() % value.size()));
  if (choice == 0) value.erase(member);
  if (choice == 1) member.value() = other;
  if (choice == 2) value[member.key() + "x"] = other;
  if (choice == 3) member.value() = interesting(random);
}

}  // namespace

std::string mutated_json(std::string_view text, unsigned int seed) {
  bool too_deep = false;
  const auto watch = [&](int depth, Json::parse_event_t, Json&) {
    too_deep |= static_cast<std::size_t>(depth) > DEEPEST;
    return true;
  };
  Json document;
  try {
    document = Json::parse(text, watch, false);
  } catch (const Json::exception&) {
    return {};
  }
  if (document.is_discarded() || too_deep) return {};
  Random random(seed);
  for (std::size_t count = 1 + random() % 3; count > 0; --count) {
    std::vector<Json*> all;
    collect(document, all);
    Json& value = *all[random() % all.size()];
    const Json other = *all[random() % all.size()];
    if (value.is_structured())
      mutate_members(value, other, random);
    else if (value.is_number())
      mutate_number(value, random);
    else
      value = random() % 2 == 0 ? other : interesting(random);
  }
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lmdbench::testing
