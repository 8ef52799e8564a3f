// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/whole_frame/implementation.h>

namespace lmdbench::experiments {

FrameImplementation method_frame(const std::string& method) {
  return method_description(method).tracks_locally ? rendered_tracking(method)
                                                   : rendered_search(method_search(method));
}

std::vector<FrameImplementation> frame_implementations() {
  std::vector<FrameImplementation> all;
  for (const MethodDescription& description : method_descriptions())
    all.push_back(method_frame(description.name));
  all.push_back(rendered_search(certified_search_from_scratch()));
  // The nearest pair only: every frame from scratch, and seeded with the last frame's.
  all.push_back(rendered_search(fcl_cold_search()));
  all.push_back(rendered_search(fcl_warm_search()));
  return all;
}

}  // namespace lmdbench::experiments
