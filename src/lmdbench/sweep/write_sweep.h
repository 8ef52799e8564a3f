// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_writer.h>
#include <lmdbench/sweep/run_sweep.h>

#include <nlohmann/json.hpp>

#include <string>

namespace lmdbench {

/// /points/NAME, one entry a point: scene, series, method, axes, force_law, and its numbers;
/// /counters/NAME; /scenes; where kept, the numbers' samples under /samples/INDEX.
void write_sweep(ResultWriter& writer, const Sweep& sweep, const SweepResult& result);

/// For people: a line a point, scene by scene, by run time; failed ones last.
std::string sweep_text(const Sweep& sweep, const SweepResult& result);

/// JSON: {"scene", "series", "method", "axes": {place: value}, "failure", NUMBER: value} a point.
std::string sweep_json(const Sweep& sweep, const SweepResult& result);

/// Values of a point's axes: JSON object {place in the experiment: value}.
nlohmann::ordered_json axes_json(const SweepPoint& point);

/// Whether no point of its problem is better in force error or run time and as good in the other.
bool on_front(const Sweep& sweep, const SweepResult& result, std::size_t point);

}  // namespace lmdbench
