// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmarks/frame_loop.h>

#include <string>
#include <vector>

namespace lmdbench::experiments {

/// Task "local tracking": the LMD set of a frame from that of the frame before. Methods that track
/// begin with the same true set and track it until the next one, as often as the experiment's
/// search gives one. Frames of methods that search in every frame stand beside them.

/// A method of the registry, with its default options.
FrameImplementation tracking_implementation(const std::string& method);

/// All methods except those that test every pair of triangles.
std::vector<FrameImplementation> tracking_implementations();

}  // namespace lmdbench::experiments
