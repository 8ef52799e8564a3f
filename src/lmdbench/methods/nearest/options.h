// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lmdbench {

/// Free choices of `nearest`. Members are called as in experiment files.
struct NearestOptions {
  /// Begin each search with the bound that the last frame's pair gives. FCL has no such mode of its own; its
  /// result may be seeded, which halves its time along a path and is what a user who cares for time does.
  bool warm_start = true;
};

}  // namespace lmdbench
