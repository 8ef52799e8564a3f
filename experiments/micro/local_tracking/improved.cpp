// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/local_tracking/implementation.h>

namespace lmdbench::micro {

/// Exact triangle distances, result cache, reduction (paper, section 4.2).
FrameImplementation improved_tracking() {
  return {"improved", Exactness::APPROXIMATE, false,
          [](const RecordedPath& path) { return make_tracking("improved", path); }};
}

}  // namespace lmdbench::micro
