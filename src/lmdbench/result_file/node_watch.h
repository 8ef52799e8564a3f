// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// Where a time was measured and what worked beside it. Points of a sweep that are spread over a cluster are not measured in
/// turns on one quiet machine: whoever compares their times has to see on which node each was, and how busy it was.
namespace lmdbench {

/// A process of the machine, as /proc tells.
struct ProcessTime {
  std::string command;
  std::uint64_t started = 0;  ///< Clock ticks since boot: tells two processes of one number apart.
  double seconds = 0.0;       ///< Processor time so far, children that have ended left out.
};

/// Who kept how many processors busy.
struct Neighbour {
  std::string command;
  double processors = 0.0;
};

/// What ran between two looks at the machine, the busiest first, a command once, at most five. Less than a fiftieth of a
/// processor is left out.
/// @param seconds between the looks
/// @param own     number of the process that asks
std::vector<Neighbour> neighbours_between(const std::map<int, ProcessTime>& before,
                                          const std::map<int, ProcessTime>& after, double seconds, int own);

/// What is known of the machine beforehand: "processors", and "allowed" to this process; by name "node", and under Slurm "job",
/// "restarts" of it, and "exclusive", whether the job has all processors of the node.
/// @param by_name whether the node and what works there are named; what is measured on one's own machine names nobody
nlohmann::json describe_node(bool by_name);

/// Looks at the machine when a traversal begins and when it has ended.
class NodeWatch {
 public:
  explicit NodeWatch(bool by_name);

  /// `describe_node`, and what worked beside since the construction: "elsewhere", processors that others kept busy, also those
  /// that have come and gone (left out where the system does not say); by name "neighbours" with "command" and "processors".
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
