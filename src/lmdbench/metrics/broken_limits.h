// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/acceptance.h>
#include <lmdbench/metrics/summary.h>

#include <string>
#include <vector>

namespace lmdbench {

/// A sentence for each broken limit, with its number; an unmeasured number breaks its limit. Any
/// limits are broken by a complete method whose nearest distance FCL and the exact search refute.
std::vector<std::string> broken_limits(const Acceptance& acceptance, const RunSummary& summary);

}  // namespace lmdbench
