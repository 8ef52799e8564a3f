// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What users, terminals and schedulers send to end a program (SIGINT, SIGTERM and SIGHUP), for commands that put
/// their work into order first.
namespace lmdbench {

/// From now on the first of these signals is only remembered; a second one ends the program at once. What `nohup`
/// has set to be ignored stays ignored.
void heed_stop_signals();

/// Whether one has come.
bool stop_requested();

/// Ends the program by the signal that came, so that a calling shell or script sees the interruption, too.
void end_by_the_signal();

}  // namespace lmdbench
