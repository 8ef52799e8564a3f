// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lmdbench {

/// Seconds of this thread, counted since they were set to 0, within a method but not its own:
/// hand-over to a plugin and checks of its contacts (plugin/). Timers subtract them.
inline double& seconds_of_others() {
  thread_local double seconds = 0.0;
  return seconds;
}

}  // namespace lmdbench
