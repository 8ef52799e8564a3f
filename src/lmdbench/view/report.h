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
  std::filesystem::path out;  ///< Folder of index.html and of its figures; made where it is missing.
  std::vector<std::filesystem::path> studies;  ///< Markdown tables to show as well.
  bool paper =
      false;  ///< The results are held against the paper, its Figure 7 and its claims; else the page says nothing of it.
  std::filesystem::path
      paper_figures;  ///< Folder with the paper's Figures 1 to 6; empty: the page goes without.
};

/// Tells a person one line.
using Tell = std::function<void(const std::string&)>;

/// Writes `out`/index.html, one file that needs no network, and every figure as SVG and PNG beside it. The page itself is
/// made by scripts/report/report.py; this finds the meshes of each result again, from its provenance, and the exact LMD
/// sets of some of its frames for the 3D view. A result whose meshes are not to be had any more, or are no longer what was
/// run, gets a page that says so instead of a view.
/// @param progress what is being done, for a person who waits
/// @param warn     which result gets no view, why, and what to do about it
/// @return the page
/// @throws InputError for a file that is no result, EnvironmentError where Python, one of its modules or the script is missing
std::filesystem::path write_report(const ReportRequest& request, const Tell& progress, const Tell& warn);

/// Leaves in `folder` what the 3D view of a result draws: moving.off, fixed_0.off, ... as they stand in the scene (the
/// moving mesh in its own frame), and lmds.jsonl, the exact LMD sets of at most 600 evenly spread frames, a line each as
/// `lmdbench query --json` prints them with the frame's number ("frame") and the label of the method whose device it is in a
/// closed loop ("track", empty where all methods share the path) before.
/// @throws InputError where a mesh of the result is not to be had any more or is no longer what was run; UsageError where
/// the result's experiment is none
void write_report_scene(const ResultReader& result, const std::filesystem::path& folder);

}  // namespace lmdbench
