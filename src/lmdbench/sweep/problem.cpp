// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/sweep/problem.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>

namespace lmdbench {
namespace {

/// {place: value} of all that decides what is true.
using Question = std::map<std::string, std::string>;

Question question_of(const SweepPoint& point) {
  nlohmann::json experiment = nlohmann::json::parse(point.truth.resolved_json);
  for (const char* key :
       {"$schema", "name", "title", "methods", "driver", "probes", "record", "rules", "limits", "acceptance"})
    experiment.erase(key);
  Question question;
  const nlohmann::json flat = experiment.flatten();  // outlives its items
  for (const auto& [place, value] : flat.items())
    question[place] = value.is_string() ? value.get<std::string>() : value.dump();
  return question;
}

/// Places in which the questions differ; one that only some have differs, too.
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
