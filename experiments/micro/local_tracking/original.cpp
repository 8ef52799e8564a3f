// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/local_tracking/implementation.h>

namespace lmdbench::micro {

/// Distances are those of 7x7 feature points (paper, section 3.2.2).
FrameImplementation original_tracking() {
  return {"original", Exactness::APPROXIMATE, false,
          [](const RecordedPath& path) { return make_tracking("original", path); }};
}

}  // namespace lmdbench::micro
