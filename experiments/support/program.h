// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/agreement.h>

#include <nlohmann/json_fwd.hpp>
#include <support/bodies.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// Shared by the study programs of experiments/: options, error reports, result files.
namespace lmdbench::experiments {

/// Poses and cutoffs of a study.
struct StudyChoice {
  SceneChoice scene;
  std::vector<double> cutoffs = {0.005, 0.02, 0.05};  ///< Shares of the diagonal.
  std::size_t poses = 1000;
  std::uint64_t seed = 1;
  std::string json;  ///< File for the tables as JSON; empty for none.
};

/// Adds --moving and --fixed.
void add_mesh_options(CLI::App& app, SceneChoice& scene);

/// Adds --meshes, --diagonal and --gap.
void add_scene_options(CLI::App& app, SceneChoice& scene);

/// Adds those of a scene, --cutoff, --poses, --seed and --json. `choice` holds the defaults.
void add_study_options(CLI::App& app, StudyChoice& choice);

/// Reports errors on standard error.
/// @return the result of `run`, or the exit code of its error (error.h)
int report_errors(const std::function<int()>& run);

/// Commands take no 0 as their --poses, --frames and --repetitions: of nothing they would find
/// nothing wrong.
void refuse_nothing(CLI::App& app);

/// Parses the command line and runs the study.
/// @return the exit code, as `report_errors`; 2 for what the command line does not take
int run_program(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& run);

/// Whether reports get a "where": their node and other load on it (`NodeWatch`, from this call on).
bool& reports_name_node();

/// Writes the report: the file is the old or the new one at any time. Nothing without a file name.
/// @throws Error when it cannot be written
void write_report(const std::string& file, const nlohmann::json& report);

/// Recall and precision with the names of results/README.md, and the counts of these ratios.
nlohmann::json error_json(const Agreement& same, const Agreement& neighbours);

}  // namespace lmdbench::experiments
