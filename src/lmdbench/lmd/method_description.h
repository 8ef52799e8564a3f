// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// What a method's set is meant to be, and so how it is judged.
enum class Promise : std::uint8_t {
  COMPLETE_SET,   ///< The true LMD set, in every frame.
  APPROXIMATION,  ///< May miss LMDs and report pairs that are none; its error is reported.
  NEAREST_PAIR,   ///< The one nearest pair, with its true distance.
  FORCE_ONLY      ///< No set: a force of its own (own_wrench.h).
};

/// "complete-set", "approximation", "nearest-pair", "force-only".
std::string_view to_string(Promise promise);

/// In which part of a method a kind of work is done.
enum class CountedBy : std::uint8_t { SEARCH, TRACKING, BOTH };

/// One counter of a method.
struct CounterDescription {
  /// @param value of the method's enumeration
  template <class Counter>
  CounterDescription(Counter value, std::string called, std::string meaning, CountedBy part)
      : index(static_cast<std::size_t>(value)),
        name(std::move(called)),
        summary(std::move(meaning)),
        counted_by(part) {}

  std::size_t index;  ///< Into WorkCounters::values.
  std::string name;   ///< In files and reports, snake_case.
  std::string summary;
  CountedBy counted_by;
};

/// Why answers of a method from outside were lost; from any thread.
class MethodFaults {
 public:
  void tell(const std::string& why) {
    const std::lock_guard lock(mutex_);
    last_ = why;
  }
  std::string last() const {
    const std::lock_guard lock(mutex_);
    return last_;
  }

 private:
  mutable std::mutex mutex_;
  std::string last_;
};

/// All that the rest of the program knows of a method. Schema, checks, help, plan, result groups, reports and
/// benchmarks are made from it, so that a new method is its folder and a line in `methods/CMakeLists.txt`.
struct MethodDescription {
  std::string name;     ///< In experiment files, snake_case or kebab-case.
  std::string summary;  ///< One sentence without a full stop.
  Promise promise = Promise::APPROXIMATION;

  /// Whether the method needs local tracking between searches. If not, drivers call `search` in every haptic
  /// frame.
  bool tracks_locally = false;

  /// How many times `track` runs in the global thread right after a search (paper, section 4.3; decision
  /// E11): 0 for the original, 2 for the improved algorithm (first reduction, second tracking).
  int trackings_after_search = 0;

  /// Whether a search looks at every pair of triangles, so that benchmarks time it only where asked to.
  bool brute_force = false;

  /// Whether `search` keeps what it found of a pair of meshes for the next frame. Then each pair of a scene's objects that is near gets a
  /// method of its own; else one serves all pairs of two meshes.
  bool frame_coherent = false;

  /// Whether `Method::find_critical` answers.
  bool finds_critical_pairs = false;

  /// Whether an instance goes on where a body of its scene has deformed (Body::deform); others are made anew (scene/mesh_pair.h).
  bool follows_deformation = false;

  /// The options, as "properties" of a draft-07 JSON Schema; each has a description and a default.
  nlohmann::json options = nlohmann::json::object();

  /// Every value of the method's enumeration, in the order of reports.
  std::vector<CounterDescription> counters;

  /// File of a method from outside (plugin/plugin.h), of which nothing is believed: it is no truth for others, and what it does from
  /// one repetition to the next is its own matter. Empty for the program's own.
  std::filesystem::path plugin = {};
  std::shared_ptr<MethodFaults> faults = {};  ///< Of a method from outside.
  /// Its first counters are what is wrong with its answers; the very first one, answers that were lost.
  static constexpr std::size_t MARKS = 9;

  /// Makes an instance for two bodies (`Scene::is_pair`).
  /// @param options checked against `options`, with all defaults filled in
  std::function<std::unique_ptr<Method>(const Scene& scene, const nlohmann::json& options)> make;

  /// Whether it has a force of its own (own_wrench.h): then the option "own_force" says whether that is rendered.
  bool has_own_force() const { return options.contains("own_force"); }

  /// What is counted in the local part of a frame: by tracking, or by a search where every frame has one.
  std::vector<CounterDescription> local_counters() const;

  /// What is counted in the global part: by the search and by the trackings after it; nothing where there is
  /// none.
  std::vector<CounterDescription> global_counters() const;
};

/// The properties with the defaults that the method's options have as a JSON object, so that each default
/// stands in one place.
/// @throws std::logic_error when a property has no default, or a default no property
nlohmann::json with_defaults(nlohmann::json properties, const nlohmann::json& defaults);

}  // namespace lmdbench
