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

/// What tells the points of a sweep apart, now and in what was measured before.
namespace lmdbench {

/// What points must share to have one truth and to take turns: all but the method, the driver and the probes.
std::string scene_key(const Experiment& experiment);

/// An input is not what it was when the sweep began: its points cannot be told apart any more.
class InputChanged : public InputError {
 public:
  explicit InputChanged(const std::filesystem::path& file);
};

/// Content of inputs when the sweep began, each read once.
class InputHashes {
 public:
  std::string of(const std::filesystem::path& file);
  /// @throws InputChanged where a run was prepared from other bytes
  void check(const PreparedRun& run);
  /// Those that exist, but for the program.
  std::vector<InputFile> files() const;

 private:
  std::map<std::string, InputFile> files_;
};

/// Names a point by all that its numbers depend on, the program included.
std::string point_key(const Sweep& sweep, const SweepPoint& point, InputHashes& hashes);

/// The keys of all points, in their order.
std::vector<std::string> point_keys(const Sweep& sweep, InputHashes& hashes);

/// Fills in SweepPoint::problem. What a point is asked is its truth's experiment without what only a method or a schedule does
/// (methods, driver, probes, recording): of the points of one scene the places in which that differs make problems apart,
/// whether an axis, a series' `set` or its `truth` changed them.
void name_problems(std::vector<SweepPoint>& points);

}  // namespace lmdbench
