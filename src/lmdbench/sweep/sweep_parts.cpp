// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_descriptor.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/json_text.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/sweep/point_key.h>
#include <lmdbench/sweep/sweep_parts.h>
#include <lmdbench/sweep/write_sweep.h>

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <map>
#include <set>
#include <thread>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

constexpr std::size_t NAME_DIGITS = 16;  // of a hash: enough for thousands
constexpr std::chrono::milliseconds PAUSE{200};

std::string part_name(const Sweep& sweep, const std::vector<std::size_t>& points, InputHashes& hashes) {
  std::set<std::string> keys;  // independent of the points' order
  for (const std::size_t point : points) keys.insert(point_key(sweep, sweep.points[point], hashes));
  std::string text;
  for (const std::string& key : keys) text += key;
  return sha256_of_text(text).substr(0, NAME_DIGITS) + ".jsonl";
}

/// Locks the part's journal until it is closed.
FileDescriptor hold(const std::filesystem::path& part, const RunProgress& progress) {
  FileDescriptor held(::open(part.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (!held.valid())
    throw EnvironmentError(part.string(), "", std::string("cannot be written: ") + std::strerror(errno),
                           "check the disk and the permissions");
  while (!lock_whole_file(held.get())) {
    if (progress && !progress("another process measures these points; waiting for it", 0, -1))
      throw Interrupted();
    std::this_thread::sleep_for(PAUSE);
  }
  return held;
}

std::string point_name(const SweepPoint& point) {
  const std::string axes = point.axes_text();
  return fmt::format("{}, {}{}{}", point.scene, point.series, axes.empty() ? "" : ", ", axes);
}

std::string place_text(const Json& where) {
  if (!where.is_object() || !where.contains("node")) return "this machine";
  std::string text = where["node"].is_string() ? where["node"].get<std::string>() : where["node"].dump();
  if (where.contains("job"))
    text +=
        fmt::format(" (job {}, restart {})", where["job"].dump(), where.value("restarts", Json(0)).dump());
  return text;
}

}  // namespace

std::filesystem::path parts_folder(const std::filesystem::path& file) {
  return file.string() + ".points";
}

Journal journal_with_parts(const std::filesystem::path& own, const std::filesystem::path& file) {
  Journal journal(own);
  std::set<std::filesystem::path> others{journal_of(file)};
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(parts_folder(file), none))
    if (entry.path().extension() == ".jsonl") others.insert(entry.path());
  others.erase(own);
  for (const std::filesystem::path& other : others) journal.read_also(other);
  return journal;
}

SweepWork measure_part(const Sweep& sweep, const std::vector<std::size_t>& points,
                       const std::filesystem::path& file, const RunProgress& progress) {
  InputHashes hashes;
  hashes.of(sweep.file);
  const std::filesystem::path part = parts_folder(file) / part_name(sweep, points, hashes);
  std::error_code error;
  std::filesystem::create_directories(part.parent_path(), error);
  if (error)
    throw EnvironmentError(part.parent_path().string(), "", "cannot be made: " + error.message(),
                           "choose another place with --out");
  refuse_unsafe_output(part, {.what = "journal", .is_ours = &is_own_journal}, inputs_of(sweep), "--out");
  const FileDescriptor held = hold(part, progress);
  Journal journal = journal_with_parts(part, file);  // after its earlier owner
  return run_points(sweep, points, journal, hashes, true, progress);
}

std::string point_list_json(const Sweep& sweep, const std::filesystem::path& file) {
  const Journal journal = journal_with_parts(journal_of(file), file);
  InputHashes hashes;
  const std::vector<std::string> keys = point_keys(sweep, hashes);
  std::map<std::string, std::size_t> groups;
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const SweepPoint& point = sweep.points[i];
    const std::size_t group = groups.try_emplace(scene_key(point.experiment), groups.size()).first->second;
    rows.push_back({{"number", i},
                    {"key", keys[i]},
                    {"group", group},
                    {"scene", point.scene},
                    {"problem", point.problem},
                    {"series", point.series},
                    {"method", point.experiment.methods.front().name},
                    {"axes", axes_json(point)},
                    {"done", is_finished(journal, keys[i], sweep.repetitions)}});
  }
  return json_line(rows);
}

std::string point_list_text(const Sweep& sweep, const std::filesystem::path& file) {
  const Journal journal = journal_with_parts(journal_of(file), file);
  InputHashes hashes;
  const std::vector<std::string> keys = point_keys(sweep, hashes);
  std::string text;
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
    text += fmt::format("{:>6} {:<5} {}\n", i, is_finished(journal, keys[i], sweep.repetitions) ? "done" : "",
                        point_name(sweep.points[i]));
  return text;
}

std::vector<std::size_t> parse_point_numbers(const std::string& text, std::size_t count,
                                             const std::string& option) {
  const auto refuse = [&](const std::string& problem) {
    throw UsageError("", option, problem, "name points by the numbers that --list prints, for example 0-3,7");
  };
  std::vector<std::size_t> points;
  std::set<std::size_t> seen;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto number = [&] {
    std::size_t value = 0;
    const auto [rest, error] = std::from_chars(at, end, value);
    if (error != std::errc()) refuse(fmt::format("\"{}\" is no list of points", text));
    if (value >= count) refuse(fmt::format("there is no point {}: the sweep has {}", value, count));
    at = rest;
    return value;
  };
  while (true) {
    const std::size_t first = number();
    std::size_t last = first;
    if (at != end && *at == '-') {
      ++at;
      last = number();
    }
    if (last < first) refuse(fmt::format("\"{}-{}\" runs backwards", first, last));
    for (std::size_t point = first; point <= last; ++point) {
      if (!seen.insert(point).second) refuse(fmt::format("names point {} twice", point));
      points.push_back(point);
    }
    if (at == end) return points;
    if (*at++ != ',') refuse(fmt::format("\"{}\" is no list of points", text));
  }
}

std::string point_numbers_text(const std::vector<std::size_t>& points) {
  std::string text;
  for (std::size_t i = 0; i < points.size();) {
    std::size_t last = i;
    while (last + 1 < points.size() && points[last + 1] == points[last] + 1) ++last;
    text += fmt::format("{}{}", i == 0 ? "" : ",", points[i]);
    if (last > i) text += fmt::format("-{}", points[last]);
    i = last + 1;
  }
  return text;
}

std::vector<std::string> done_again(const Sweep& sweep, const std::filesystem::path& file) {
  const Journal journal = journal_with_parts(journal_of(file), file);
  InputHashes hashes;
  const std::vector<std::string> keys = point_keys(sweep, hashes);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    for (std::int64_t repetition = 0; repetition < sweep.repetitions; ++repetition) {
      const std::vector<Json>& begun = journal.begun(keys[i], repetition);
      if (begun.size() < 2) continue;
      std::string places;
      for (const Json& where : begun) places += (places.empty() ? "" : ", then ") + place_text(where);
      lines.push_back(fmt::format("point {} ({}), repetition {}, began {} times: {}", i,
                                  point_name(sweep.points[i]), repetition, begun.size(), places));
    }
  }
  return lines;
}

}  // namespace lmdbench
