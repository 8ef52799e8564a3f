// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/frame_benchmarks.h>
#include <benchmarks/tasks.h>
#include <benchmarks/whole_frame/implementation.h>

namespace lmdbench::experiments {

void add_whole_frames() {
  add_frame_benchmarks("whole_frame", frame_implementations(), contact_paths());
}

}  // namespace lmdbench::experiments
