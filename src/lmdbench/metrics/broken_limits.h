// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/acceptance.h>
#include <lmdbench/metrics/summary.h>

#include <string>
#include <vector>

namespace lmdbench {

/// A sentence a broken limit, with the figure. A figure that could not be measured breaks its limit; and whatever they limit, a nearest
/// distance of a method that promises the complete set breaks them where FCL and the exact search bear another one out.
std::vector<std::string> broken_limits(const Acceptance& acceptance, const RunSummary& summary);

}  // namespace lmdbench
