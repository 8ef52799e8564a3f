// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/sweep/sweep.h>

#include <vector>

namespace lmdbench {

/// Fills in SweepPoint::problem. What a point is asked is its truth's experiment without what only a method or a schedule does
/// (methods, driver, probes, recording): of the points of one scene the places in which that differs make problems apart,
/// whether an axis, a series' `set` or its `truth` changed them.
void name_problems(std::vector<SweepPoint>& points);

}  // namespace lmdbench
