// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <micro/frame_loop.h>

#include <vector>

namespace lmdbench::micro {

/// Task "local tracking": the LMD set of a frame from that of the frame before. Original and improved begin
/// with the same set, the true one, and track it until the next one comes, as often as the experiment's
/// search brings one. `certified` tracks nothing; its frame stands beside them.

FrameImplementation original_tracking();
FrameImplementation improved_tracking();
FrameImplementation certified_frame();

/// All that this build knows.
std::vector<FrameImplementation> tracking_implementations();

/// Tracking by a method of the registry, with its default options.
std::unique_ptr<FrameLoop> make_tracking(const std::string& method, const RecordedPath& path);

}  // namespace lmdbench::micro
