// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_reader.h>

#include <filesystem>

namespace lmdbench {

/// Leaves in `folder` what the 3D view of a result draws: moving.off, fixed_0.off, ... as they stand in the scene (the
/// moving mesh in its own frame), and lmds.jsonl, the exact LMD sets of at most 600 evenly spread frames, a line each as
/// `lmdbench query --json` prints them with the frame's number ("frame") and the label of the method whose device it is in a
/// closed loop ("track", empty where all methods share the path) before.
/// @throws InputError where a mesh of the result is not to be had any more or is no longer what was run; UsageError where
/// the result's experiment is none
void write_report_scene(const ResultReader& result, const std::filesystem::path& folder);

}  // namespace lmdbench
