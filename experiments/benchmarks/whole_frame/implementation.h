// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmarks/frame_loop.h>
#include <benchmarks/global_search/implementation.h>

#include <string>
#include <vector>

namespace lmdbench::experiments {

/// Task "whole frame": the whole cost of a haptic frame, from the pose to the force of the device.
/// Methods with local tracking search and track as the experiment configures them; their searches
/// are spread over the frames between two of them, as if one core did everything. Peers outside the
/// registry find a nearest pair and make no force.

/// A method of the registry, as the experiment configures it or with its default options.
FrameImplementation method_frame(const std::string& method);

/// All implementations of this build.
std::vector<FrameImplementation> frame_implementations();

/// A search in every frame, and the force of its set.
FrameImplementation rendered_search(const SearchImplementation& search);

/// A method by its name: local tracking, periodic searches, and the force.
FrameImplementation rendered_tracking(const std::string& method);

}  // namespace lmdbench::experiments
