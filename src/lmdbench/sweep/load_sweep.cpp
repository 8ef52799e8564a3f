// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/json_document.h>
#include <lmdbench/sweep/point_key.h>
#include <lmdbench/sweep/sweep.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace lmdbench {

/// experiments/schema/sweep.schema.json as of the build.
const std::string& sweep_schema_text();

namespace {

using Json = nlohmann::json;
using Axes = std::vector<std::pair<std::string, std::string>>;

/// A place of the sweep in the experiment, whose only method is the series' one.
std::string in_experiment(const std::string& place) {
  constexpr std::string_view METHOD = "/method/";
  return place.starts_with(METHOD) ? "/methods/0/" + place.substr(METHOD.size()) : place;
}

void add_overrides(std::vector<Override>& overrides, const Json& values) {
  for (const auto& [place, value] : values.items())
    overrides.push_back(in_experiment(place) + "=" + value.dump());
}

/// All combinations of the axes' values.
/// @param place JSON pointer of the axes in the sweep file
std::vector<Axes> combinations(const Json& axes, const JsonDocument& document, const std::string& place,
                               std::size_t most_points) {
  std::vector<Axes> result{{}};
  std::set<std::string> places;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Json& together = axes[i];
    for (const auto& [name, values] : together.items())
      if (!places.insert(in_experiment(name)).second)
        document.fail(fmt::format("{}/{}", place, i),
                      fmt::format("{} is in two axes: the last one would win", name),
                      "leave one of them out");
    if (together.empty())
      document.fail(fmt::format("{}/{}", place, i), "an axis without a place",
                    "name a place of the experiment and its values");
    const std::size_t length = together.front().size();
    for (const auto& [name, values] : together.items())
      if (values.size() != length)
        document.fail(
            fmt::format("{}/{}", place, i),
            fmt::format("{} has {} values, another place {}", name, values.size(), length),
            "places of one object take their values together: give them equally many, or an object each");
    if (result.size() * length > most_points)
      document.fail(fmt::format("{}/{}", place, i), fmt::format("more than {} points", most_points),
                    "sweep fewer values");
    std::vector<Axes> longer;
    for (const Axes& begun : result)
      for (std::size_t value = 0; value < length; ++value) {
        longer.push_back(begun);
        for (const auto& [name, values] : together.items())
          longer.back().emplace_back(name, values[value].dump());
      }
    result = std::move(longer);
  }
  return result;
}

SweepPoint make_point(const std::filesystem::path& file, const Json& sweep, const Json& series,
                      const Axes& axes) {
  Json method = series["method"];
  method["label"] = series["label"];
  std::vector<Override> overrides{"/methods=" + Json::array({method}).dump(),
                                  "/probes={\"truth\":{\"stride_frames\":0}}", "/driver/repetitions=1",
                                  "/record={}"};
  add_overrides(overrides, sweep["set"]);
  add_overrides(overrides, series["set"]);
  for (const auto& [place, value] : axes) overrides.push_back(in_experiment(place) + "=" + value);
  SweepPoint point;
  point.series = series["label"].get<std::string>();
  point.axes = axes;
  point.experiment = load_experiment(file, overrides);
  point.scene = point.experiment.name;
  if (point.experiment.profiles.size() != 1)
    throw UsageError(file.string(), "/force",
                     fmt::format("{} force profiles", point.experiment.profiles.size()),
                     "sweep with a force profile a point: set /force to one of them, or make it an axis");
  if (point.experiment.methods.size() != 1 || point.experiment.methods.front().entry != point.series)
    throw UsageError(file.string(), "/methods", "another method than the series' own",
                     "give every method a series, and options as /method/OPTION");
  if (point.experiment.driver.repetitions != 1)
    throw UsageError(file.string(), "/driver/repetitions", "a sweep repeats its points itself",
                     "say how often by \"repetitions\" of the sweep");
  if (point.experiment.realtime)
    throw UsageError(file.string(), "/driver/kind", "a run on the clock",
                     "sweep with the driver \"lockstep\"");
  if (point.experiment.loop.closed)
    throw UsageError(file.string(), "/loop/kind", "a closed loop",
                     "sweep in an open loop: truth is at the poses of the path");
  add_overrides(overrides, series["truth"]);
  point.truth = series["truth"].empty() ? point.experiment : load_experiment(file, overrides);
  return point;
}

void fill_labels(Json& series, const JsonDocument& document) {
  std::set<std::string> labels;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (!series[i].contains("label")) series[i]["label"] = series[i]["method"]["name"];
    const auto label = series[i]["label"].get<std::string>();
    if (!labels.insert(label).second)
      document.fail(fmt::format("/series/{}", i), fmt::format("two series are called \"{}\"", label),
                    "give one of them another \"label\"");
  }
}

}  // namespace

std::string SweepPoint::axes_text() const {
  std::vector<std::string> parts;
  for (const auto& [place, value] : axes)
    parts.push_back(fmt::format("{}={}", place.substr(place.rfind('/') + 1), value));
  return fmt::format("{}", fmt::join(parts, ", "));
}

Sweep load_sweep(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  const InputKind kind{.what = "sweep file", .code = ExitCode::USAGE, .most_bytes = Limit::JSON_BYTES};
  return parse_sweep(read_input_file(file, kind).bytes, file, overrides);
}

Sweep parse_sweep(const std::string& text, const std::filesystem::path& file,
                  const std::vector<Override>& overrides, std::size_t most_points) {
  static const Json schema = Json::parse(sweep_schema_text());
  JsonDocument document(text, file.string(), schema, ExitCode::USAGE, overrides);
  Json& json = document.json();
  fill_labels(json["series"], document);
  Sweep sweep;
  sweep.file = file;
  sweep.name = json["name"].get<std::string>();
  sweep.title = json["title"].get<std::string>();
  sweep.repetitions = json["repetitions"].get<std::int64_t>();
  sweep.truth_check_frames = json["truth_check_frames"].get<std::int64_t>();
  sweep.keep_samples = json["keep_samples"].get<bool>();
  for (const Json& name : json["experiments"]) {
    const std::filesystem::path experiment = shortened(file.parent_path() / name.get<std::string>());
    for (std::size_t i = 0; i < json["series"].size(); ++i) {
      const Json& series = json["series"][i];
      for (const Axes& axes :
           combinations(series["axes"], document, fmt::format("/series/{}/axes", i), most_points)) {
        try {
          sweep.points.push_back(make_point(experiment, json, series, axes));
        } catch (const Error& error) {
          throw Error(error.code(), file.string(), fmt::format("/series/{}", i), error.what(), "");
        }
        if (sweep.points.size() > most_points)
          document.fail("/series", fmt::format("more than {} points", most_points), "sweep fewer values");
      }
    }
  }
  std::map<std::string, std::size_t> tasks;
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
    if (const auto [other, is_new] = tasks.try_emplace(task_key(sweep.points[i]), i); !is_new)
      document.fail(
          "/series",
          fmt::format("points {} and {} are the same: {}, {}", other->second, i, sweep.points[i].series,
                      sweep.points[i].axes_text()),
          "give a value once; name, title, /limits, /probes and /record of the experiment are no axes");
  if (json["from_frame"].is_null())
    for (const SweepPoint& point : sweep.points)
      sweep.from_frame = std::max(sweep.from_frame, point.experiment.driver.search_latency_frames);
  else
    sweep.from_frame = json["from_frame"].get<std::int64_t>();
  name_problems(sweep.points);
  sweep.resolved_json = json.dump(2);
  return sweep;
}

}  // namespace lmdbench
