// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/frame_benchmarks.h>
#include <micro/local_tracking/implementation.h>
#include <micro/tasks.h>

namespace lmdbench::micro {

void add_local_trackings() {
  add_frame_benchmarks("local_tracking", tracking_implementations(), contact_paths());
}

}  // namespace lmdbench::micro
