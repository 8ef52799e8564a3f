// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmarks/global_search/implementation.h>

namespace lmdbench::experiments {

/// Runs the implementation at every pose and compares with truth.
LmdError check_search(const SearchImplementation& implementation, GlobalSearch& search, const Scene& scene,
                      const std::vector<Pose>& poses, const Truth& truth);

}  // namespace lmdbench::experiments
