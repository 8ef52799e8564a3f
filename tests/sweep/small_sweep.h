// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <support/source_directory.h>

#include <string>

namespace lmdbench::testing {

/// The text of a sweep over the shapes: two points of improved, then those of certified.
/// @param of_certified further keys of that series, and
/// @param keys         of the sweep, each behind a comma
inline std::string small_sweep(int frames, int truth_check_frames, const std::string& of_certified = "",
                               const std::string& keys = "") {
  return R"({"name": "small", "title": "a test", "experiments": [")" LMDBENCH_SOURCE_DIR
         R"(/experiments/shapes.json"], "repetitions": 2, "truth_check_frames": )" +
         std::to_string(truth_check_frames) + R"(, "set": {"/frames": )" + std::to_string(frames) + "}" +
         keys +
         R"(, "series": [
    {"method": {"name": "improved", "force_law": "exponential"},
     "axes": [{"/driver/search_every_frames": [5, 40], "/driver/search_latency_frames": [5, 40]}]},
    {"method": {"name": "certified", "force_law": "exponential"})" +
         of_certified + "}]}";
}

}  // namespace lmdbench::testing
