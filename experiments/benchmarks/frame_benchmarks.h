// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmarks/frame_loop.h>

#include <string>
#include <vector>

namespace lmdbench::experiments {

/// Recorded paths of the hard and the soft experiment, while in contact; loaded once.
const std::vector<RecordedPath>& contact_paths();

/// Registers <task>/<implementation>/<path> with Google Benchmark. An iteration is the whole path,
/// so that every frame has the same weight; the counter "per_frame" is the time of one frame.
/// `paths` must outlive the run.
void add_frame_benchmarks(const std::string& task, const std::vector<FrameImplementation>& implementations,
                          const std::vector<RecordedPath>& paths);

}  // namespace lmdbench::experiments
