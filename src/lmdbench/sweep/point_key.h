// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/error.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/result_file/provenance.h>
#include <lmdbench/sweep/sweep.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Keys that identify the points of a sweep, in this run and earlier ones.
namespace lmdbench {

/// Key of all but method, driver and probes: points that share it share truth and take turns.
std::string scene_key(const Experiment& experiment);

/// Key of all that a point measures, as its files are named: unlike `point_key` it reads none.
std::string task_key(const SweepPoint& point);

/// An input changed since the sweep began: keys no longer identify its points.
class InputChanged : public InputError {
 public:
  explicit InputChanged(const std::filesystem::path& file);
};

/// Content of inputs when the sweep began, each read once.
class InputHashes {
 public:
  std::string of(const std::filesystem::path& file);
  /// Hash of the program: no input, so no limit of inputs holds for it.
  const std::string& program();
  /// @throws InputChanged where a run was prepared from other bytes
  void check(const PreparedRun& run);
  /// Those that exist.
  std::vector<InputFile> files() const;

 private:
  std::map<std::string, InputFile> files_;
  std::string program_;
};

/// A key made of all that a point's numbers depend on: the program, too, and what files hold, but
/// not where they are.
std::string point_key(const Sweep& sweep, const SweepPoint& point, InputHashes& hashes);

/// The keys of all points, in their order.
std::vector<std::string> point_keys(const Sweep& sweep, InputHashes& hashes);

/// Fills in SweepPoint::problem. A point's problem is its truth's experiment without the parts for
/// methods and schedules alone (methods, driver, probes, recording). Where those of one scene
/// differ, by an axis or a series' `set` or `truth`, the problems differ.
void name_problems(std::vector<SweepPoint>& points);

}  // namespace lmdbench
