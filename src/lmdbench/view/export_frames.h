// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_reader.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// Frames of a result for ParaView and whatever else reads VTK's XML formats. In `folder`:
///   fixed_0.vtu, ...       the fixed meshes;
///   moving.pvd             the moving mesh at its poses;
///   lmds-exact.pvd         the exact LMD sets, a line a pair, with distance and features;
///   lmds-METHOD.pvd        those of a method, where the run recorded them (/record/lmds);
///   forces.pvd             each method's rendered force [N], vectors at the middle of the moving mesh;
///   polylines.pvd          the curves in which the meshes intersect, where recorded.
/// In a closed loop every method moves a mesh of its own: moving-METHOD.pvd, lmds-exact-METHOD.pvd, forces-METHOD.pvd.
/// World coordinates in metres, times in seconds; a .pvd lists one file a frame in a folder of its name.
/// @param most_frames evenly spread, of all tracks together
/// @return the collections and meshes
/// @throws InputError where a mesh of the result is not to be had any more or is no longer what was run, UsageError where a
/// file of the folder is not one of ours
std::vector<std::filesystem::path> export_frames(const ResultReader& result,
                                                 const std::filesystem::path& folder,
                                                 std::size_t most_frames);

}  // namespace lmdbench
