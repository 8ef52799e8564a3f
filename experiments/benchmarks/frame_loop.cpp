// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/prepare/prepare.h>

#include <benchmarks/frame_loop.h>
#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace lmdbench::experiments {
namespace {

class SearchEveryFrame : public FrameLoop {
 public:
  SearchEveryFrame(std::unique_ptr<GlobalSearch> search, const RecordedPath& path)
      : path_(path), search_(std::move(search)) {}

  void step(std::size_t frame) override { search_->run(path_.poses()[frame]); }
  double minimum_distance() const override { return search_->minimum_distance(); }
  const LmdSet* lmds() const override { return search_->lmds(); }

 private:
  const RecordedPath& path_;
  std::unique_ptr<GlobalSearch> search_;
};

}  // namespace

DrivenMethod RecordedPath::method(const std::string& method) const {
  for (const DrivenMethod& known : methods)
    if (known.label == method) return known;
  return {method, [method, scene = scene] { return make_method(method, scene); }, profile};
}

RecordedPath load_path(const PathChoice& choice) {
  Experiment experiment = load_experiment(choice.experiment);
  experiment.mesh_folder = choice.meshes;
  PreparedRun prepared = prepare(experiment);
  std::vector<Pose>& poses = prepared.input.poses;
  if (poses.size() < choice.first_frame + choice.frame_count)
    throw InputError(experiment.held().motion.path_file.string(), "",
                     fmt::format("has {} frames, which is not enough", poses.size()),
                     "generate the path again");
  const auto first = poses.begin() + static_cast<std::ptrdiff_t>(choice.first_frame);
  poses = std::vector<Pose>(first, first + static_cast<std::ptrdiff_t>(choice.frame_count));
  std::vector<DrivenMethod> methods = driven_methods(experiment, prepared);
  RecordedPath path{.name = experiment.name,
                    .scene = prepared.scene(),
                    .input = std::move(prepared.input),
                    .driver = experiment.driver,
                    .methods = std::move(methods),
                    .profile = prepared.profiles.front().force};
  find_truth(path, choice.check_stride);
  return path;
}

void find_truth(RecordedPath& path, std::size_t check_stride) {
  const std::unique_ptr<Method> certified = make_method("certified", path.scene);
  WorkCounters counters;
  path.lmds.resize(path.poses().size());
  for (std::size_t i = 0; i < path.poses().size(); ++i)
    certified->search(path.poses()[i], path.lmds[i], counters);
  std::vector<Pose> checked_poses;
  for (std::size_t i = 0; i < path.poses().size(); i += check_stride) {
    path.checked.push_back(i);
    checked_poses.push_back(path.poses()[i]);
  }
  path.truth = exhaustive_truth(path.scene, checked_poses);
}

std::vector<std::size_t> frames_of(const FrameImplementation& implementation, const RecordedPath& path) {
  if (implementation.slow) return path.checked;
  std::vector<std::size_t> frames(path.poses().size());
  std::iota(frames.begin(), frames.end(), 0);
  return frames;
}

LmdError check_frames(const FrameImplementation& implementation, FrameLoop& loop, const RecordedPath& path) {
  LmdError error;
  for (const std::size_t frame : frames_of(implementation, path)) {
    loop.step(frame);
    const auto checked = std::lower_bound(path.checked.begin(), path.checked.end(), frame);
    if (checked == path.checked.end() || *checked != frame) continue;
    const auto index = static_cast<std::size_t>(checked - path.checked.begin());
    error.add(implementation.promise, fmt::format("frame {} of {}", frame, path.name), path.scene,
              path.truth[index], loop.lmds(), loop.minimum_distance());
  }
  return error;
}

std::unique_ptr<FrameLoop> make_search_every_frame(const SearchImplementation& search,
                                                   const RecordedPath& path) {
  return std::make_unique<SearchEveryFrame>(search.make(path.scene), path);
}

}  // namespace lmdbench::experiments
