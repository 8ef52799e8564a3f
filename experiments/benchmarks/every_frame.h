// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmarks/frame_loop.h>
#include <benchmarks/global_search/implementation.h>

namespace lmdbench::experiments {

/// A global search in every frame, for methods without local tracking and for peers.
std::unique_ptr<FrameLoop> make_search_every_frame(const SearchImplementation& search,
                                                   const RecordedPath& path);

}  // namespace lmdbench::experiments
