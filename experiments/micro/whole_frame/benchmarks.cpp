// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/frame_benchmarks.h>
#include <micro/tasks.h>
#include <micro/whole_frame/implementation.h>

namespace lmdbench::micro {

void add_whole_frames() {
  add_frame_benchmarks("whole_frame", frame_implementations(), contact_paths());
}

}  // namespace lmdbench::micro
