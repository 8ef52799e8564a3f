// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <micro/frame_loop.h>
#include <micro/global_search/implementation.h>

#include <vector>

namespace lmdbench::micro {

/// Task "whole frame": all that a haptic frame costs, from the pose to the force of the device. Original and
/// improved search and track as the experiment configures it; their searches are spread over the frames
/// between two of them, as if one core did everything. Peers that find a nearest pair only make no force.

FrameImplementation original_frame();
FrameImplementation improved_frame();
FrameImplementation certified_whole_frame();
FrameImplementation certified_from_scratch_frame();
FrameImplementation exhaustive_frame();
FrameImplementation fcl_cold_frame();
FrameImplementation fcl_warm_frame();

/// All that this build knows.
std::vector<FrameImplementation> frame_implementations();

/// A search in every frame, and the force of what it finds.
FrameImplementation rendered_search(const SearchImplementation& search);

/// A method of the experiment by its label, with local tracking and a search now and then, and the force.
FrameImplementation rendered_tracking(const std::string& label);

}  // namespace lmdbench::micro
