// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_reader.h>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace lmdbench {

/// Frames of a result for ParaView and other readers of VTK's XML formats. In `folder`:
///   fixed_0.vtu, ...       the fixed meshes;
///   moving.pvd             the moving mesh at its poses;
///   lmds-exact.pvd         the exact LMD sets, a line for each pair, with distance and features;
///   lmds-METHOD.pvd        those of a method, where the run recorded them (/record/lmds);
///   forces.pvd             each method's rendered force [N], at the middle of the moving mesh;
///   polylines.pvd          the curves in which the meshes intersect, where recorded.
/// In a closed loop every method moves its own mesh: moving-METHOD.pvd, lmds-exact-METHOD.pvd,
/// forces-METHOD.pvd. Where several objects move: movers.pvd, lmds-movers.pvd, forces-movers.pvd
/// (on the clock of the held one alone). World coordinates [m], times [s]; a .pvd lists a file a
/// frame, in its folder. Replaces an earlier export in the folder as a whole.
/// @param most_frames evenly spread, over all tracks together
/// @return the collections and meshes
/// @throws InputError where a mesh of the result is missing or differs from that of the run,
/// UsageError where the folder has a file that is not an export
std::vector<std::filesystem::path> export_frames(const ResultReader& result,
                                                 const std::filesystem::path& folder,
                                                 std::size_t most_frames);

}  // namespace lmdbench
