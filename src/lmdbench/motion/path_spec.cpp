// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/json_text.h>
#include <lmdbench/motion/path_spec.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <optional>
#include <set>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

constexpr double DEGREE = std::numbers::pi / 180.0;

/// Rates count as multiples of each other within this relative error.
constexpr double RATE_RATIO_TOLERANCE = 1e-9;

/// An object of the specification that knows where it is and which of its keys were asked for.
class ObjectReader {
 public:
  ObjectReader(const Json& object, std::string name, std::string pointer)
      : object_(object), name_(std::move(name)), pointer_(std::move(pointer)) {
    if (!object_.is_object()) fail("", "is not an object", "write { ... }");
  }

  [[noreturn]] void fail(const std::string& key, const std::string& problem,
                         const std::string& remedy) const {
    const std::string place = key.empty() ? pointer_ : pointer_ + "/" + key;
    throw UsageError(name_, place.empty() ? "/" : place, problem, remedy);
  }

  const Json* optional(const std::string& key) {
    known_.insert(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
  }

  const Json& required(const std::string& key) {
    const Json* value = optional(key);
    if (value == nullptr) fail(key, "is missing", "add it; the documentation of paths lists all keys");
    return *value;
  }

  ObjectReader object(const std::string& key) { return {required(key), name_, pointer_ + "/" + key}; }
  ObjectReader element(const Json& value, const std::string& key, std::size_t index) const {
    return {value, name_, fmt::format("{}/{}/{}", pointer_, key, index)};
  }

  double positive(const std::string& key, std::optional<double> fallback = std::nullopt) {
    const double value = number(key, fallback);
    if (!(value > 0.0)) fail(key, fmt::format("{} is not above 0", value), "give a number above 0");
    return value;
  }

  double number(const std::string& key, std::optional<double> fallback = std::nullopt) {
    if (fallback && optional(key) == nullptr) return *fallback;
    const Json& value = required(key);
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(key, "is not a number", "give a finite number");
    return value.get<double>();
  }

  double not_negative(const std::string& key) {
    const double value = number(key);
    if (value < 0.0) fail(key, fmt::format("{} is below 0", value), "give a number of at least 0");
    return value;
  }

  std::uint64_t count(const std::string& key) {
    const Json& value = required(key);
    if (!value.is_number_unsigned()) fail(key, "is not a whole number of at least 0", "give e.g. 1");
    return value.get<std::uint64_t>();
  }

  std::string text(const std::string& key) {
    const Json& value = required(key);
    if (!value.is_string() || value.get<std::string>().empty())
      fail(key, "is not a text", "write it in quotes");
    return value.get<std::string>();
  }

  /// Call when everything was asked for: what is left is a mistake.
  void refuse_unknown_keys() const {
    for (const auto& item : object_.items())
      if (!known_.contains(item.key()))
        fail(item.key(), "is not a known key", fmt::format("use one of {}", fmt::join(known_, ", ")));
  }

 private:
  const Json& object_;
  std::string name_;
  std::string pointer_;
  std::set<std::string> known_;
};

PlacedMesh read_placed_mesh(ObjectReader reader) {
  const PlacedMesh mesh = {.mesh = reader.text("mesh"), .diagonal = reader.positive("diagonal_m")};
  reader.refuse_unknown_keys();
  return mesh;
}

Vec3 read_direction(ObjectReader& reader, const std::string& key, const Vec3& fallback) {
  const Json* value = reader.optional(key);
  if (value == nullptr) return fallback;
  Vec3 direction = Vec3::Zero();
  bool sound = value->is_array() && value->size() == 3;
  for (std::size_t i = 0; sound && i < 3; ++i) {
    sound = (*value)[i].is_number();
    if (sound) direction[static_cast<Eigen::Index>(i)] = (*value)[i].get<double>();
  }
  const double length = direction.stableNorm();
  if (!sound || !std::isfinite(length) || length == 0.0)
    reader.fail(key, "is not a direction", "give three numbers that are not all 0");
  return direction / length;
}

std::vector<GapPoint> read_gaps(ObjectReader& reader, double gap_floor) {
  const Json& points = reader.required("gaps");
  if (!points.is_array() || points.size() < 2)
    reader.fail("gaps", "is not a list of at least two points", "give points with 'time_s' and 'gap'");
  std::vector<GapPoint> gaps;
  for (const Json& value : points) {
    ObjectReader point = reader.element(value, "gaps", gaps.size());
    const GapPoint gap = {.time = point.not_negative("time_s"), .gap = point.positive("gap")};
    point.refuse_unknown_keys();
    if (gaps.empty() && gap.time != 0.0) point.fail("time_s", "the first time is not 0", "begin at 0");
    if (!gaps.empty() && !(gap.time > gaps.back().time))
      point.fail("time_s", fmt::format("{} does not lie after {}", gap.time, gaps.back().time),
                 "sort the points");
    if (!(gap.gap > gap_floor))
      point.fail("gap", fmt::format("{} is not above gap_floor, {}", gap.gap, gap_floor), "widen it");
    gaps.push_back(gap);
  }
  return gaps;
}

}  // namespace

PathSpec parse_path_spec(const std::string& text, const std::string& name) {
  const Json json = parse_json(text, name);
  ObjectReader reader(json, name, "");
  PathSpec spec;
  spec.moving = read_placed_mesh(reader.object("moving"));
  spec.fixed = read_placed_mesh(reader.object("fixed"));
  spec.frame_rate = reader.positive("frame_rate_hz", spec.frame_rate);
  spec.stored_rate = reader.positive("stored_rate_hz", spec.frame_rate);
  const double ratio = spec.frame_rate / spec.stored_rate;
  if (ratio < 0.5 || std::abs(ratio - std::round(ratio)) > RATE_RATIO_TOLERANCE * ratio)
    reader.fail("stored_rate_hz",
                fmt::format("{} does not divide frame_rate_hz, {}", spec.stored_rate, spec.frame_rate),
                "store every n-th frame");
  spec.seed = reader.count("seed");
  spec.start_direction = read_direction(reader, "start_direction", spec.start_direction);
  spec.slide_rate = DEGREE * reader.not_negative("slide_rate_deg_per_s");
  spec.turn_rate = DEGREE * reader.not_negative("turn_rate_deg_per_s");
  spec.radial_limits.speed = reader.positive("radial_speed_m_per_s");
  spec.radial_limits.acceleration = reader.positive("radial_acceleration_m_per_s2");
  spec.gap_floor = reader.not_negative("gap_floor");
  spec.gaps = read_gaps(reader, spec.gap_floor);
  reader.refuse_unknown_keys();
  if (!(spec.duration() * spec.frame_rate < static_cast<double>(limit_of(Limit::FRAMES))))
    reader.fail("frame_rate_hz",
                fmt::format("{:g} s at {:g} Hz are {:g} frames, above the limit of {}", spec.duration(),
                            spec.frame_rate, spec.duration() * spec.frame_rate, limit_of(Limit::FRAMES)),
                "shorten the gaps' times, lower the rate, or " + raise_remedy(Limit::FRAMES));
  return spec;
}

PathSpec read_path_spec(const std::filesystem::path& file) {
  const InputKind kind{.what = "path specification", .most_bytes = Limit::JSON_BYTES};
  return parse_path_spec(read_input_file(file, kind).bytes, file.string());
}

}  // namespace lmdbench
