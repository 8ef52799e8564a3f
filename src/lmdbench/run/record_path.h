// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/motion/path.h>
#include <lmdbench/run/run.h>

#include <cstddef>

namespace lmdbench {

/// Path of the simulated device when the experiment's first method renders the force: one pose a
/// frame, true (not the encoders'); orientations of the intended path where the device turns
/// nothing. No probes.
/// @param every keeps every so many-th frame, from the first one on; at least 1
/// @throws UsageError for an open loop; Interrupted when `progress` returned false
Path record_path(const Experiment& experiment, std::size_t every = 1, const RunProgress& progress = {});

}  // namespace lmdbench
