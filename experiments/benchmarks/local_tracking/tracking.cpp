// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>

#include <benchmarks/local_tracking/implementation.h>

namespace lmdbench::experiments {
namespace {

class Tracking : public FrameLoop {
 public:
  Tracking(const std::string& method, const RecordedPath& path)
      : path_(path),
        method_(make_method(method, path.scene)),
        renewal_(static_cast<std::size_t>(path.driver.search_every_frames)) {}

  void step(std::size_t frame) override {
    // The set of the frame before, so that every tracking has a motion to follow. Its copy is timed
    // too, once a renewal.
    if (frame % renewal_ == 0) working_ = path_.lmds[frame == 0 ? 0 : frame - 1];
    method_->track(path_.poses()[frame], working_, counters_);
  }
  double minimum_distance() const override { return lmdbench::minimum_distance(working_); }
  const LmdSet* lmds() const override {
    // Tracking may carry a pair beyond the cutoff, where it is no LMD.
    reported_ = within_cutoff(working_, path_.scene.cutoff);
    return &reported_;
  }

 private:
  const RecordedPath& path_;
  std::unique_ptr<Method> method_;
  std::size_t renewal_;
  LmdSet working_;
  mutable LmdSet reported_;
  WorkCounters counters_;
};

}  // namespace

FrameImplementation tracking_implementation(const std::string& method) {
  const MethodDescription& description = method_description(method);
  if (description.tracks_locally)
    return {method, description.promise, false,
            [method](const RecordedPath& path) { return std::make_unique<Tracking>(method, path); }};
  const SearchImplementation search = method_search(method);
  return {method, description.promise, description.brute_force,
          [search](const RecordedPath& path) { return make_search_every_frame(search, path); }};
}

std::vector<FrameImplementation> tracking_implementations() {
  std::vector<FrameImplementation> all;
  for (const MethodDescription& description : method_descriptions())
    if (!description.brute_force) all.push_back(tracking_implementation(description.name));
  return all;
}

}  // namespace lmdbench::experiments
