// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/whole_frame/implementation.h>

namespace lmdbench::micro {

FrameImplementation improved_frame() {
  return rendered_tracking("improved");
}

}  // namespace lmdbench::micro
