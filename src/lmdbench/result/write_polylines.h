// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/record/result_writer.h>
#include <lmdbench/run/polyline_probe.h>

#include <string>
#include <vector>

namespace lmdbench {

/// Writes the polylines of all probed frames: flat rows of points, with offsets of lines and frames.
void write_polylines(ResultWriter& writer, const std::string& group,
                     const std::vector<PolylineFrame>& frames);

}  // namespace lmdbench
