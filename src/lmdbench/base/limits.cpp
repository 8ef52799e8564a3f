// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace lmdbench {
namespace {

constexpr std::int64_t MIB = std::int64_t{1} << 20;
constexpr std::int64_t GIB = std::int64_t{1} << 30;
constexpr auto LIMIT_COUNT = static_cast<std::size_t>(Limit::COUNT);

/// Upper bounds: vertices, edges and corners are counted in 32 bits; checks of JSON documents
/// recurse in their depth and patterns along a text.
constexpr std::array<LimitInfo, LIMIT_COUNT> TABLE{{
    {Limit::FILE_BYTES, "file-bytes", 4 * GIB, 64 * GIB, "bytes of a mesh or path file"},
    {Limit::JSON_BYTES, "json-bytes", 16 * MIB, GIB, "bytes of a JSON file"},
    {Limit::JSON_DEPTH, "json-depth", 40, 100, "arrays and objects inside each other in a JSON file"},
    {Limit::JSON_TEXT, "json-text", 4000, 8000, "bytes of a text or key in a JSON file"},
    {Limit::TRIANGLES, "triangles", 20'000'000, 500'000'000, "triangles of a mesh"},
    {Limit::POLYGON_CORNERS, "polygon-corners", 5000, 1'000'000, "corners of a polygon of a mesh"},
    {Limit::EDGE_TRIANGLES, "edge-triangles", 100, 10'000, "triangles that share an edge"},
    {Limit::VERTEX_TRIANGLES, "vertex-triangles", 50'000, 10'000'000, "triangles that share a vertex"},
    {Limit::VERTEX_PAIRS, "vertex-pairs", 1'000'000, 100'000'000'000'000,
     "triangle pairs round a vertex of the moving and one of a fixed mesh"},
    {Limit::IMPORT_SECONDS, "import-seconds", 60, 86'400,
     "seconds of processor time to read a mesh or result"},
    {Limit::IMPORT_BYTES, "import-bytes", 16 * GIB, 1024 * GIB, "bytes of memory to read a mesh or result"},
    {Limit::PATH_SECONDS, "path-seconds", 600, 864'000, "seconds of processor time to make or check a path"},
    {Limit::FRAMES, "frames", 10'000'000, 1'000'000'000, "haptic frames of a run or path"},
    {Limit::PLUGIN_SECONDS, "plugin-seconds", 10, 86'400,
     "seconds to wait for an answer of a plugin's process"},
    {Limit::PLUGIN_BYTES, "plugin-bytes", 4 * GIB, 1024 * GIB, "bytes of memory for a plugin's process"},
}};

std::array<std::int64_t, LIMIT_COUNT>& values() {
  static std::array<std::int64_t, LIMIT_COUNT> instance = [] {
    std::array<std::int64_t, LIMIT_COUNT> usual{};
    std::transform(TABLE.begin(), TABLE.end(), usual.begin(),
                   [](const LimitInfo& info) { return info.usual; });
    return usual;
  }();
  return instance;
}

}  // namespace

std::span<const LimitInfo> limit_table() {
  return TABLE;
}

std::int64_t limit_of(Limit limit) {
  return values()[static_cast<std::size_t>(limit)];
}

void set_limit(const std::string& text) {
  const std::string place = "--limit " + text;
  const std::string name = text.substr(0, text.find('='));
  const auto found =
      std::find_if(TABLE.begin(), TABLE.end(), [&](const LimitInfo& info) { return info.name == name; });
  if (found == TABLE.end()) {
    std::string names;
    for (const LimitInfo& info : TABLE) names += (names.empty() ? "" : ", ") + std::string(info.name);
    throw UsageError("", place, fmt::format("there is no limit '{}'", name), "choose one of " + names);
  }
  const std::string_view digits = std::string_view(text).substr(std::min(name.size() + 1, text.size()));
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || value < 1 || value > found->most)
    throw UsageError("", place, fmt::format("'{}' is no whole number from 1 to {}", digits, found->most),
                     fmt::format("for example --limit {}={}", name, found->usual));
  values()[static_cast<std::size_t>(found->limit)] = value;
}

std::string raise_remedy(Limit limit) {
  return fmt::format("raise it with --limit {}=NUMBER", TABLE[static_cast<std::size_t>(limit)].name);
}

}  // namespace lmdbench
