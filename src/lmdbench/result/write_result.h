// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_writer.h>
#include <lmdbench/run/run.h>

namespace lmdbench {

/// Writes /path, /scene, /methods, /reference and /crosscheck of the result contract;
/// provenance is not part of it. Does not commit.
void write_result(ResultWriter& writer, const Experiment& experiment, const RunResult& result);

/// The group /path: time and pose of every frame; in a closed loop of the path that the hand means to take.
void write_path(ResultWriter& writer, const RunResult& result);

/// Attributes of a group: the profile's constants in use, and what its sum is clipped to on the device.
void write_profile(ResultWriter& writer, const std::string& group, const PreparedProfile& profile,
                   const VirtualPhantom& device);

/// The group /scene: first force profile, device, meshes and warnings.
void write_scene(ResultWriter& writer, const RunResult& result);

}  // namespace lmdbench
