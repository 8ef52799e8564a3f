// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/lockstep.h>

#include <benchmarks/global_search/implementation.h>
#include <support/lmd_error.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Tasks along a recorded path: cost of a haptic frame ("whole frame") and of its local part
/// ("local tracking").
namespace lmdbench::experiments {

/// Consecutive frames of an experiment, with the truth in some of them.
struct RecordedPath {
  std::string name;
  Scene scene;
  DriverInput input;  ///< Poses of the frames.
  DriverChoice driver;
  std::vector<DrivenMethod> methods;      ///< The experiment's.
  ForceProfile profile;                   ///< For loops outside the experiment's methods.
  std::vector<LmdSet> lmds = {};          ///< LMDs of every frame, by `certified`.
  std::vector<std::size_t> checked = {};  ///< Frames whose truth is known, ascending.
  Truth truth = {};                       ///< One per checked frame, by `exhaustive`.

  const std::vector<Pose>& poses() const { return input.poses; }
  /// The experiment's method of that label, else the method of that name with default options.
  DrivenMethod method(const std::string& method) const;
};

struct PathChoice {
  std::filesystem::path experiment;
  std::filesystem::path meshes;
  std::size_t first_frame = 0;
  std::size_t frame_count = 0;
  std::size_t check_stride = 1;  ///< Truth is computed in every so many frames.
};

/// @throws Error for an unusable experiment, mesh or path, or a path that is too short
RecordedPath load_path(const PathChoice& choice);

/// Fills in LMDs, checked frames and truth.
void find_truth(RecordedPath& path, std::size_t check_stride);

/// Work of every haptic frame.
class FrameLoop {
 public:
  virtual ~FrameLoop() = default;
  /// The timed work. Frames follow each other; frame 0 restarts.
  virtual void step(std::size_t frame) = 0;
  /// Smallest distance of the last step [m]; NaN without one.
  virtual double minimum_distance() const = 0;
  /// LMD set after the last step; null for peers that find a nearest pair only.
  virtual const LmdSet* lmds() const = 0;
};

struct FrameImplementation {
  std::string name;
  Promise promise = Promise::APPROXIMATION;
  bool slow = false;  ///< Only steps at checked frames; for loops that keep nothing.
  std::function<std::unique_ptr<FrameLoop>(const RecordedPath&)> make;
};

/// The frames that an implementation steps through.
std::vector<std::size_t> frames_of(const FrameImplementation& implementation, const RecordedPath& path);

/// Steps through the path and compares with truth.
LmdError check_frames(const FrameImplementation& implementation, FrameLoop& loop, const RecordedPath& path);

/// A global search in every frame, for methods without local tracking and for peers.
std::unique_ptr<FrameLoop> make_search_every_frame(const SearchImplementation& search,
                                                   const RecordedPath& path);

}  // namespace lmdbench::experiments
