// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_writer.h>
#include <lmdbench/sweep/run_sweep.h>

#include <nlohmann/json.hpp>

#include <string>

namespace lmdbench {

/// /points/NAME, one entry a point: what it is (scene, series, method, axes, force_law) and its numbers; /counters/NAME;
/// /scenes; the samples that numbers are made from under /samples/INDEX where the sweep keeps them.
void write_sweep(ResultWriter& writer, const Sweep& sweep, const SweepResult& result);

/// For people: a line a point, scene by scene, by run time; failed ones last.
std::string sweep_text(const Sweep& sweep, const SweepResult& result);

/// JSON array of {"scene", "series", "method", "axes": {place: value}, "failure": text or null, NUMBER: value or null}.
std::string sweep_json(const Sweep& sweep, const SweepResult& result);

/// The values of a point's axes: JSON object {place in the experiment: value}.
nlohmann::ordered_json axes_json(const SweepPoint& point);

/// Whether a point is on the Pareto front of its scene: no other one has both less force error and less run time.
bool on_front(const Sweep& sweep, const SweepResult& result, std::size_t point);

}  // namespace lmdbench
