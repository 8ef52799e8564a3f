// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// Where a time was measured and what else ran there. A cluster does not measure a sweep's points
/// in turns on one quiet machine: readers of their times need each point's node and its load.
namespace lmdbench {

/// A process of the machine, according to /proc.
struct ProcessTime {
  std::string command;
  std::uint64_t started = 0;  ///< Clock ticks since boot: tells apart two processes of one id.
  double seconds = 0.0;       ///< Processor time so far, without ended children.
};

/// A command and how many processors it kept busy.
struct Neighbour {
  std::string command;
  double processors = 0.0;
};

/// What ran between two looks at the machine: the busiest first, each command once, at most five,
/// without those below a fiftieth of a processor.
/// @param seconds between the looks
/// @param own     id of the calling process
std::vector<Neighbour> neighbours_between(const std::map<int, ProcessTime>& before,
                                          const std::map<int, ProcessTime>& after, double seconds, int own);

/// Facts about the machine: "processors", and those "allowed" to this process; by name "node", and
/// under Slurm "job", its "restarts", and "exclusive" (the job has all processors of the node).
/// @param by_name whether to name the node and its processes: not on somebody's own machine
nlohmann::json describe_node(bool by_name);

/// Looks at the machine when a traversal begins and when it has ended.
class NodeWatch {
 public:
  explicit NodeWatch(bool by_name);

  /// `describe_node`, and the load since construction: "elsewhere", processors kept busy by others,
  /// ended ones too (absent if unknown); by name "neighbours" with "command", "processors".
  nlohmann::json finish() const;

 private:
  struct Look {
    std::chrono::steady_clock::time_point time;
    std::map<int, ProcessTime> processes;
    double machine_seconds = 0.0, own_seconds = 0.0;
  };
  static Look look(bool by_name);

  bool by_name_;
  Look before_;
};

}  // namespace lmdbench
