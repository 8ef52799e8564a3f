// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/sweep/point_key.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>

namespace lmdbench {
namespace {

/// All of an experiment but method, driver and probes; names of files are relative to its folder.
nlohmann::json scene_of(const Experiment& experiment) {
  nlohmann::json json = nlohmann::json::parse(experiment.resolved_json);
  for (const char* other : {"$schema", "name", "title", "methods", "driver", "probes", "record", "limits"})
    json.erase(other);
  return json;
}

/// All that a point measures. What its files hold and where they are is not in it.
nlohmann::json task_of(const SweepPoint& point) {
  return {{"experiment", scene_of(point.experiment)},
          {"method", nlohmann::json::parse(point.experiment.methods.front().options_json)},
          {"driver", nlohmann::json::parse(point.experiment.resolved_json)["driver"]},
          {"truth", scene_of(point.truth)}};
}

std::string folder_of(const Experiment& experiment) {
  return std::filesystem::weakly_canonical(experiment.file).parent_path().string();
}

}  // namespace

std::string scene_key(const Experiment& experiment) {
  nlohmann::json json = scene_of(experiment);
  json["folder"] = folder_of(experiment);
  return json.dump();
}

std::string task_key(const SweepPoint& point) {
  nlohmann::json json = task_of(point);
  json["folder"] = folder_of(point.experiment);
  return json.dump();
}

InputChanged::InputChanged(const std::filesystem::path& file)
    : InputError(file.string(), "", "has changed since the sweep began",
                 "run the sweep again: points of what it held before are kept and not mixed in") {}

std::string InputHashes::of(const std::filesystem::path& file) {
  const auto [entry, is_new] = files_.try_emplace(file.lexically_normal().string());
  std::error_code ignored;
  if (is_new && std::filesystem::exists(file, ignored)) {
    const FileContent content = read_input_file(file, {.what = "file"});
    entry->second = {"sweep", file, content.sha256, static_cast<std::int64_t>(content.bytes.size())};
  }
  return entry->second.sha256;
}

const std::string& InputHashes::program() {
  if (program_.empty()) program_ = program_sha256();
  return program_;
}

void InputHashes::check(const PreparedRun& run) {
  for (const MeshNote& mesh : run.meshes)
    if (mesh.file && of(*mesh.file) != mesh.sha256) throw InputChanged(*mesh.file);
  for (const InputFile& file : run.files)
    if (!file.file.empty() && of(file.file) != file.sha256) throw InputChanged(file.file);
}

std::vector<InputFile> InputHashes::files() const {
  std::vector<InputFile> result;
  for (const auto& [name, file] : files_)
    if (!file.sha256.empty()) result.push_back(file);
  return result;
}

std::string point_key(const Sweep& sweep, const SweepPoint& point, InputHashes& hashes) {
  nlohmann::json json{{"program", hashes.program()},
                      {"task", task_of(point)},
                      {"truth_check_frames", sweep.truth_check_frames},
                      {"from_frame", sweep.from_frame},
                      {"inputs", nlohmann::json::array()}};
  for (const Experiment* experiment : {&point.experiment, &point.truth}) {
    for (const std::filesystem::path& file : input_files(*experiment)) {
      const std::string hash = hashes.of(file);
      if (file != experiment->file) json["inputs"].push_back(hash);
    }
  }
  return sha256_of_text(json.dump());
}

std::vector<std::string> point_keys(const Sweep& sweep, InputHashes& hashes) {
  std::vector<std::string> keys;
  for (const SweepPoint& point : sweep.points) keys.push_back(point_key(sweep, point, hashes));
  return keys;
}

namespace {

/// {place: value} of all that determines the true sets.
using Question = std::map<std::string, std::string>;

Question question_of(const SweepPoint& point) {
  nlohmann::json experiment = scene_of(point.truth);
  experiment.erase("plan");  // whose rules change no bit
  Question question;
  const nlohmann::json flat = experiment.flatten();  // outlives its items
  for (const auto& [place, value] : flat.items())
    question[place] = value.is_string() ? value.get<std::string>() : value.dump();
  return question;
}

/// Places in which the questions differ, those missing in some included.
std::set<std::string> varying(const std::vector<const Question*>& questions) {
  std::map<std::string, std::set<std::string>> values;
  std::map<std::string, std::size_t> count;
  for (const Question* question : questions)
    for (const auto& [place, value] : *question) {
      values[place].insert(value);
      ++count[place];
    }
  std::set<std::string> places;
  for (const auto& [place, found] : values)
    if (found.size() > 1 || count[place] < questions.size()) places.insert(place);
  return places;
}

}  // namespace

void name_problems(std::vector<SweepPoint>& points) {
  std::vector<Question> questions;
  std::map<std::string, std::vector<const Question*>> of_scene;
  for (const SweepPoint& point : points) questions.push_back(question_of(point));
  for (std::size_t i = 0; i < points.size(); ++i) of_scene[points[i].scene].push_back(&questions[i]);
  std::map<std::string, std::set<std::string>> places;
  for (const auto& [scene, own] : of_scene) places[scene] = varying(own);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].problem = points[i].scene;
    for (const std::string& place : places[points[i].scene])
      if (const auto found = questions[i].find(place); found != questions[i].end())
        points[i].problem += fmt::format(", {} {}", place.substr(1), found->second);
  }
}

}  // namespace lmdbench
