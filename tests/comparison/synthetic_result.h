// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Small result files in the real format; a test can choose every value.
namespace lmdbench::testing {

/// Two methods, "original" (searches every 5 frames) and "certified" (whole search in every frame),
/// ten frames, three repetitions of which the first one warms up.
struct SyntheticResult {
  std::vector<std::string> methods{"original", "certified"};  ///< In the order of the experiment
  double cutoff = 0.01;                                       ///< As in the experiment
  double scene_cutoff = 0.0;    ///< As the program took it; 0: as in the experiment
  bool sweep = false;           ///< Whether there is a group /sweep, as `work-precision` writes
  std::string mesh = "moving";  ///< As the experiment names its file
  std::string moving_hash = "aa";
  std::string moving = "{}";               ///< JSON of /moving in the experiment
  std::string vertices_hash;               ///< Of the files that deform it; "" for none
  std::map<std::string, double> slowdown;  ///< "original/search": factor on its times
  double process_factor = 1.0;             ///< On all times
  double jitter = 0.0;                     ///< Added to times of frame 0, so that files differ [s]
  int spike_frame = -1;                    ///< 1 ms longer, in one measured repetition
  int frame_with_other_force = -1;         ///< Last bit of original's force z
  int frame_with_lost_lmd = -1;            ///< certified
  int search_with_more_work = -1;          ///< original: node_pairs of that search
  bool lists = false;                      ///< LMD lists
  bool polylines = false;                  ///< Two of two points in frames 3 and 6 each.
  int other_polyline = -1;                 ///< Has another length and last point.
  std::string processor = "processor A";
  std::string extra_counter;         ///< Another counter of certified, "" for none
  std::string idle_counter;          ///< Another counter of certified that stays 0, "" for none
  double summary = 0.5;              ///< A number of the summary that is no time
  double true_jumps = 3.0;           ///< In the summary
  std::string truth_of_every_frame;  ///< Label of a method, "" for none
  int repetitions = 3;
  int warm_up = 1;                                        ///< As the attribute says
  std::string lost_times;                                 ///< "original/search": NaN throughout
  bool times = true;                                      ///< As /record/timings
  bool counters = true;                                   ///< As /record/counters
  std::string record = "{}";                              ///< JSON of /record in the experiment
  std::string patch = "{}";                               ///< JSON merge patch of the experiment
  std::map<std::string, std::vector<std::int64_t>> more;  ///< Other datasets

  std::filesystem::path write(const std::filesystem::path& file) const;
};

}  // namespace lmdbench::testing
