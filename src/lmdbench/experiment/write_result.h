// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/run.h>
#include <lmdbench/record/result_writer.h>

namespace lmdbench {

/// Writes /path, /scene, /methods, /reference and /crosscheck of the result contract;
/// provenance is not part of it. Does not commit.
void write_result(ResultWriter& writer, const Experiment& experiment, const RunResult& result);

/// The group /scene: force profile, device, meshes and warnings.
void write_scene(ResultWriter& writer, const RunResult& result);

}  // namespace lmdbench
