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

/// What a method's set is meant to be; it is judged by that.
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

/// All that the program knows of a method. Schema, checks, help, plan, result groups, reports and
/// benchmarks follow, so a new method is its folder and a line in `methods/CMakeLists.txt`.
struct MethodDescription {
  std::string name;     ///< In experiment files, snake_case or kebab-case.
  std::string summary;  ///< One sentence without a full stop.
  Promise promise = Promise::APPROXIMATION;

  /// Whether it needs local tracking between searches; if not, drivers search in every haptic
  /// frame.
  bool tracks_locally = false;

  /// How often `track` runs after a search in the global thread (paper, section 4.3; decision E11):
  /// 0 original, 2 improved algorithm (first reduction, second tracking).
  int trackings_after_search = 0;

  /// Whether a search looks at every pair of triangles; benchmarks time it only on demand.
  bool brute_force = false;

  /// Whether `search` keeps results of a pair of meshes for the next frame. Then each near pair of
  /// objects gets its own method; else one serves all pairs of two meshes.
  bool frame_coherent = false;

  /// Whether `Method::find_critical` answers.
  bool finds_critical_pairs = false;

  /// Whether an instance follows Body::deform; others are made anew (scene/mesh_pair.h).
  bool follows_deformation = false;

  /// The options, as "properties" of a draft-07 JSON Schema; each has a description and a default.
  nlohmann::json options = nlohmann::json::object();

  /// Every value of the method's enumeration, in the order of reports.
  std::vector<CounterDescription> counters;

  /// File of a method from outside (plugin/plugin.h), empty for own ones. It is no truth for
  /// others, and its repetitions may differ.
  std::filesystem::path plugin = {};
  std::shared_ptr<MethodFaults> faults = {};  ///< Of a method from outside.
  /// Its first counters count faults of its answers; the very first one lost answers.
  static constexpr std::size_t MARKS = 9;

  /// Makes an instance for two bodies (`Scene::is_pair`).
  /// @param options checked against `options`, with all defaults filled in
  std::function<std::unique_ptr<Method>(const Scene& scene, const nlohmann::json& options)> make;

  /// Whether it may have a force of its own (own_wrench.h), which the option "own_force" renders.
  bool has_own_force() const { return options.contains("own_force"); }

  /// Counters of a frame's local part: of tracking, or of a search in every frame.
  std::vector<CounterDescription> local_counters() const;

  /// Counters of the global part: of the search and the trackings after it; none without one.
  std::vector<CounterDescription> global_counters() const;
};

/// The properties with their defaults, from the method's options as a JSON object: each default is
/// written once.
/// @throws std::logic_error when a property has no default, or a default no property
nlohmann::json with_defaults(nlohmann::json properties, const nlohmann::json& defaults);

}  // namespace lmdbench
