// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <micro/every_frame.h>
#include <micro/local_tracking/implementation.h>

namespace lmdbench::micro {

/// The whole set anew in every frame, with what the last frame left (frame coherence).
FrameImplementation certified_frame() {
  const SearchImplementation search = certified_search();
  return {search.name, search.exactness, false,
          [search](const RecordedPath& path) { return make_search_every_frame(search, path); }};
}

}  // namespace lmdbench::micro
