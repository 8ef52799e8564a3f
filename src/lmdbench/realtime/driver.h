// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/experiment/realtime_choice.h>
#include <lmdbench/realtime/record.h>

#include <vector>

/// The real-time driver: the paper's four threads (section 5) on the machine's clock, by method.
///  - servo (the PHANTOM loop): at each instant of a grid it senses the pose, sums the latest set's
///    forces and gives the device the result. A method without local tracking searches here alone;
///  - search: searches at the latest pose, reduces, tracks once more (section 4.3), hands over;
///  - tracking: brings the latest set to the latest pose, again and again;
///  - scene: records instead of drawing.
/// Threads hand over the latest value without locks (latest_value.h); the servo loop's records go
/// through a queue of fixed length. The servo loop allocates, locks, writes and faults in nothing.
/// Late periods are skipped and counted (servo_clock.h). With fewer cores than roles it shares one
/// with tracking, as the paper found possible (section 6.1), and search one with the scene.
/// Frames of the result are the path's: a period without a tick has what the device held.
namespace lmdbench {

struct RealtimeRun {
  std::vector<MethodRecord> records;   ///< In the order of the methods, as is
  std::vector<RealtimeRecord> clocks;  ///< this.
};

/// Settings of the experiment for a realtime run.
struct RealtimeSettings {
  RealtimeChoice choice;
  bool predict = false;  ///< Search and track at the pose expected when the result is used.
};

/// @param keeper keeps every frame as it is recorded; may be nullptr
/// @throws EnvironmentError where `choice.required` and the system refuses a request
/// @throws Interrupted when `progress` returned false
RealtimeRun run_realtime(const std::vector<DrivenMethod>& methods, const DriverInput& input,
                         const RealtimeSettings& settings, const Progress& progress,
                         RunKeeper* keeper = nullptr);

}  // namespace lmdbench
