// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/frame_benchmarks.h>
#include <benchmarks/local_tracking/implementation.h>
#include <benchmarks/tasks.h>

namespace lmdbench::experiments {

void add_local_trackings() {
  add_frame_benchmarks("local_tracking", tracking_implementations(), contact_paths());
}

}  // namespace lmdbench::experiments
