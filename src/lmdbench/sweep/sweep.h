// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// A sweep file after checking (schema: experiments/schema/sweep.schema.json): points that compare
/// error with run time. Every point is an experiment with one method.
namespace lmdbench {

struct SweepPoint {
  std::string scene;  ///< Name of the experiment file's experiment.
  /// The point's task in words: the scene, and where the sweep changes its truth (cutoff, meshes,
  /// path, ...) the values that vary. Fronts, lines and panels have points of one problem.
  std::string problem;
  std::string series;  ///< Label of the series.
  /// In the order of the axes: place in the experiment as the sweep names it, value as JSON text.
  std::vector<std::pair<std::string, std::string>> axes;
  Experiment experiment;  ///< One method, no probes, one repetition.
  Experiment truth;       ///< Has the true sets' meshes; may differ by the series.

  /// For people: "search_every_frames=20, visibility=off", without the places' parents.
  std::string axes_text() const;
};

struct Sweep {
  std::filesystem::path file;
  std::string name;
  std::string title;
  std::int64_t repetitions = 0;
  std::int64_t truth_check_frames = 0;
  std::int64_t from_frame = 0;  ///< First frame that counts.
  bool keep_samples = true;
  std::vector<SweepPoint> points;  ///< By experiment, series, axes (last axis fastest).
  std::string resolved_json;       ///< The file with overrides and defaults, for the record.
};

/// Most points of a sweep; a product of axes exceeds it by mistake only.
inline constexpr std::size_t MOST_SWEEP_POINTS = 100'000;

/// Reads a sweep and all its experiments, so that a mistake in the last point shows before the
/// first runs.
/// @throws UsageError naming file and place: as `load_experiment`, two series of one label, axes of
///         unequal lengths, a closed loop (its poses depend on the method: no common truth)
Sweep load_sweep(const std::filesystem::path& file, const std::vector<Override>& overrides = {});

/// The same from text; `file` serves messages and relative names.
/// @param most_points at most; each is an experiment to read
Sweep parse_sweep(const std::string& text, const std::filesystem::path& file,
                  const std::vector<Override>& overrides = {}, std::size_t most_points = MOST_SWEEP_POINTS);

}  // namespace lmdbench
