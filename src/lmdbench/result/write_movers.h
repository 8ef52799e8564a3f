// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_writer.h>
#include <lmdbench/run/mover_play.h>

#include <string>
#include <vector>

/// What results have of several movers, one a column in the order of the file: the moving mesh, then the entries of `/movers`.
namespace lmdbench {

/// /path/movers: every pose of every mover.
void write_mover_poses(ResultWriter& writer, const MoverPlay& play);

/// movers/ of a method: what each felt in each frame.
void write_mover_frames(ResultWriter& writer, const std::string& group, const MethodRecord& record,
                        std::size_t movers, bool torque);

}  // namespace lmdbench
