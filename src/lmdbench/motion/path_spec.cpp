// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/json_document.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/motion/path_spec.h>

#include <fmt/format.h>

#include <cmath>

namespace lmdbench {

const std::string& path_schema_text();  // path.schema.json, compiled in

namespace {

using Json = nlohmann::json;

/// Rates count as multiples of each other within this relative error.
constexpr double RATE_RATIO_TOLERANCE = 1e-9;

std::optional<double> optional_number(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? std::nullopt : std::optional(found->get<double>());
}

PlacedMesh placed_mesh(const Json& entry) {
  return {.mesh = entry["mesh"].get<std::string>(), .placement = read_placement(entry)};
}

double stored_rate(const JsonDocument& document, double frame_rate) {
  const double rate = optional_number(document.json(), "stored_rate_hz").value_or(frame_rate);
  const double ratio = frame_rate / rate;
  if (ratio < 0.5 || std::abs(ratio - std::round(ratio)) > RATE_RATIO_TOLERANCE * ratio)
    document.fail("/stored_rate_hz", fmt::format("{} does not divide frame_rate_hz, {}", rate, frame_rate),
                  "store every n-th frame");
  return rate;
}

Vec3 direction(const JsonDocument& document, const char* key) {
  const Json& value = document.json()[key];
  const Vec3 direction(value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
  const double length = direction.stableNorm();
  if (!std::isfinite(length) || length == 0.0)
    document.fail(fmt::format("/{}", key), "is not a direction", "give three numbers that are not all 0");
  return direction / length;
}

std::vector<GapPoint> gap_points(const JsonDocument& document, double gap_floor) {
  std::vector<GapPoint> gaps;
  for (const Json& value : document.json()["gaps"]) {
    const GapPoint gap = {.time = value["time_s"].get<double>(), .gap = value["gap"].get<double>()};
    const std::string place = fmt::format("/gaps/{}", gaps.size());
    if (gaps.empty() && gap.time != 0.0)
      document.fail(place + "/time_s", "the first time is not 0", "begin at 0");
    if (!gaps.empty() && !(gap.time > gaps.back().time))
      document.fail(place + "/time_s", fmt::format("{} does not lie after {}", gap.time, gaps.back().time),
                    "sort the points");
    if (!(gap.gap > gap_floor))
      document.fail(place + "/gap", fmt::format("{} is not above gap_floor, {}", gap.gap, gap_floor),
                    "widen it");
    gaps.push_back(gap);
  }
  return gaps;
}

}  // namespace

MotionLimits PathSpec::radial_limits(double moving_diagonal) const {
  return {.speed = radial_speed.value_or(DEFAULT_RADIAL_SPEED * moving_diagonal),
          .acceleration = radial_acceleration.value_or(DEFAULT_RADIAL_ACCELERATION * moving_diagonal)};
}

PathSpec parse_path_spec(const std::string& text, const std::string& name) {
  static const Json schema = Json::parse(path_schema_text());
  const JsonDocument document(text, name, schema, ExitCode::USAGE);
  const Json& json = document.json();
  PathSpec spec;
  spec.moving = placed_mesh(json["moving"]);
  spec.fixed = placed_mesh(json["fixed"]);
  spec.frame_rate = json["frame_rate_hz"].get<double>();
  spec.stored_rate = stored_rate(document, spec.frame_rate);
  spec.seed = json["seed"].get<std::uint64_t>();
  spec.start_direction = direction(document, "start_direction");
  spec.slide_rate = DEGREE * json["slide_rate_deg_per_s"].get<double>();
  spec.turn_rate = DEGREE * json["turn_rate_deg_per_s"].get<double>();
  spec.radial_speed = optional_number(json, "radial_speed_m_per_s");
  spec.radial_acceleration = optional_number(json, "radial_acceleration_m_per_s2");
  spec.gap_floor = json["gap_floor"].get<double>();
  spec.gaps = gap_points(document, spec.gap_floor);
  if (!(spec.duration() * spec.frame_rate < static_cast<double>(limit_of(Limit::FRAMES))))
    document.fail("/frame_rate_hz",
                  fmt::format("{:g} s at {:g} Hz are {:g} frames, above the limit of {}", spec.duration(),
                              spec.frame_rate, std::floor(spec.duration() * spec.frame_rate) + 1.0,
                              limit_of(Limit::FRAMES)),
                  "shorten the gaps' times, lower the rate, or " + raise_remedy(Limit::FRAMES));
  return spec;
}

std::string path_spec_text(const PathSpec& spec) {
  using OrderedJson = nlohmann::ordered_json;
  const auto mesh = [](const PlacedMesh& choice) {
    OrderedJson entry{{"mesh", choice.mesh}};
    write_placement(choice.placement, entry);
    return entry;
  };
  const auto degrees = [](double angle) { return to_significant_digits(angle / DEGREE, 12); };
  OrderedJson json{
      {"moving", mesh(spec.moving)},
      {"fixed", mesh(spec.fixed)},
      {"frame_rate_hz", spec.frame_rate},
      {"stored_rate_hz", spec.stored_rate},
      {"seed", spec.seed},
      {"start_direction", {spec.start_direction.x(), spec.start_direction.y(), spec.start_direction.z()}},
      {"slide_rate_deg_per_s", degrees(spec.slide_rate)},
      {"turn_rate_deg_per_s", degrees(spec.turn_rate)}};
  if (spec.radial_speed) json["radial_speed_m_per_s"] = *spec.radial_speed;
  if (spec.radial_acceleration) json["radial_acceleration_m_per_s2"] = *spec.radial_acceleration;
  json["gap_floor"] = spec.gap_floor;
  json["gaps"] = OrderedJson::array();
  for (const GapPoint& point : spec.gaps)
    json["gaps"].push_back({{"time_s", point.time}, {"gap", point.gap}});
  return json.dump(2) + "\n";
}

PathSpec read_path_spec(const std::filesystem::path& file) {
  const InputKind kind{
      .what = "path specification", .code = ExitCode::USAGE, .most_bytes = Limit::JSON_BYTES};
  return parse_path_spec(read_input_file(file, kind).bytes, file.string());
}

}  // namespace lmdbench
