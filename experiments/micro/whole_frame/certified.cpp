// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/whole_frame/implementation.h>

namespace lmdbench::micro {

/// With frame coherence.
FrameImplementation certified_whole_frame() {
  return rendered_search(certified_search());
}

FrameImplementation certified_from_scratch_frame() {
  return rendered_search(certified_search_from_scratch());
}

}  // namespace lmdbench::micro
