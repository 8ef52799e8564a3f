// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_reader.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lmdbench {

/// The page of one or more results.
struct ReportRequest {
  std::vector<std::filesystem::path> results;  ///< Result files, in the order of the page.
  std::filesystem::path out;                   ///< Folder of index.html and figures; made if none.
  std::vector<std::filesystem::path> studies;  ///< Markdown tables to show as well.
  /// Compares the results with the paper, its Figure 7 and its claims; else the page omits these.
  bool paper = false;
  std::filesystem::path paper_figures;  ///< Folder with the paper's Figures 1 to 6; or empty.
};

/// Prints one line for the user.
using Tell = std::function<void(const std::string&)>;

/// Writes `out`/index.html, one file that needs no network, and each figure as SVG and PNG. The
/// page is made by scripts/report/report.py. This finds each result's meshes by its provenance, and
/// exact LMD sets of some frames for the 3D view. If meshes are missing or differ from the run's,
/// the page has the reason instead of a view.
/// @param progress what is being done, for a waiting user
/// @param warn     names a result without a view, the reason and the remedy
/// @return file of the page
/// @throws InputError for a file that is no result, EnvironmentError without Python, module or
/// script
std::filesystem::path write_report(const ReportRequest& request, const Tell& progress, const Tell& warn);

/// Writes the 3D view's input to `folder`: moving.off, fixed_0.off, ... as placed in the scene (the
/// moving mesh in its own frame), and lmds.jsonl, exact LMD sets of at most 600 evenly spread
/// frames. Its lines are those of `lmdbench query --json` after the number ("frame") and, in a
/// closed loop, the label of the device's method ("track", empty where all share the path).
/// @throws InputError where a mesh of the result is missing or differs from that of the run;
/// UsageError where the result's experiment is invalid
void write_report_scene(const ResultReader& result, const std::filesystem::path& folder);

}  // namespace lmdbench
