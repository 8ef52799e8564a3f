// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/pose_source.h>
#include <lmdbench/record/result_writer.h>

#include <string>
#include <vector>

namespace lmdbench {

/// Writes what a closed loop adds to one method's group: the device's motion, the force that it held, its energies.
void write_loop(ResultWriter& writer, const std::string& group, const std::vector<LoopFrame>& frames);

}  // namespace lmdbench
