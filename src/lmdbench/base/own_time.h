// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lmdbench {

/// Seconds of this thread, since somebody set it to 0, that passed within a method and are not the method's: the way to and from a
/// method from outside and the judgement of its answers (plugin/). Who times a method takes them off.
inline double& seconds_of_others() {
  thread_local double seconds = 0.0;
  return seconds;
}

}  // namespace lmdbench
