// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// A sweep file after checking (schema: experiments/schema/sweep.schema.json): the points at which error stands
/// against run time. Every point is an experiment with one method.
namespace lmdbench {

struct SweepPoint {
  std::string scene;  ///< Name of the experiment file's experiment.
  /// What the point is asked, in words: the scene, and where the sweep changes its truth (cutoff, meshes, path, ...) the values
  /// of the places that vary. Only points of one problem stand on a front, on a line and in a panel together.
  std::string problem;
  std::string series;  ///< Label of the series.
  /// Place in the experiment, as the sweep names it, and the value there as JSON text; in the order of the axes.
  std::vector<std::pair<std::string, std::string>> axes;
  Experiment experiment;  ///< One method, no probes, one repetition.
  Experiment truth;  ///< Whose meshes the true sets come from; the same but where the series says otherwise.

  /// "search_every_frames=20, visibility=off": the axes without what leads to a value, for people.
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
  std::vector<SweepPoint> points;  ///< Experiment by experiment, series by series, the last axis fastest.
  std::string resolved_json;       ///< The file with overrides and defaults, for the record.
};

/// No sweep has more points than this; a product of axes gets there by a slip.
inline constexpr std::size_t MOST_SWEEP_POINTS = 100'000;

/// Reads a sweep and every experiment that it makes, so that a slip in the last point is told before the first
/// one runs.
/// @throws UsageError naming file and place: what `load_experiment` refuses, two series of one label, axes of unequal
///         lengths, a closed loop (its poses differ from method to method, so there is no common truth)
Sweep load_sweep(const std::filesystem::path& file, const std::vector<Override>& overrides = {});

/// The same from text; `file` serves messages and relative names.
/// @param most_points that it may have: each is an experiment to be read
Sweep parse_sweep(const std::string& text, const std::filesystem::path& file,
                  const std::vector<Override>& overrides = {}, std::size_t most_points = MOST_SWEEP_POINTS);

}  // namespace lmdbench
