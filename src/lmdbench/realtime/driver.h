// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/experiment/realtime_choice.h>
#include <lmdbench/realtime/record.h>

#include <vector>

/// The real-time driver: the paper's four threads (section 5) on the machine's clock, one method after the other.
///  - servo (the PHANTOM loop): at each instant of a grid it senses the pose, sums the latest set's forces and gives the
///    device the result. A method without local tracking searches here: one loop in the place of three;
///  - search: searches at the latest pose, reduces, tracks once more (section 4.3), hands over, and begins again;
///  - tracking: brings the latest set to the latest pose, over and over;
///  - scene: records instead of drawing.
/// Threads hand the latest value over without locks (latest_value.h); what the servo loop records goes through a queue of fixed
/// length. In the servo loop nothing is allocated, locked, written or faulted in. Late periods are skipped and counted
/// (servo_clock.h). With fewer cores than roles the servo loop shares one with tracking, as the paper found that it can (section
/// 6.1), and search one with the scene.
/// Frames of the result are those of the path: a period without a tick shows what the device held.
namespace lmdbench {

struct RealtimeRun {
  std::vector<MethodRecord> records;   ///< In the order of the methods, as is
  std::vector<RealtimeRecord> clocks;  ///< this.
};

/// What a run on the clock needs of the experiment.
struct RealtimeSettings {
  RealtimeChoice choice;
  bool predict = false;  ///< Search and track where the mesh will be when the result is used.
};

/// @param keeper keeps every frame as it is recorded; may be nullptr
/// @throws EnvironmentError where `choice.required` and the system refuses something
/// @throws Interrupted when `progress` returned false
RealtimeRun run_realtime(const std::vector<DrivenMethod>& methods, const DriverInput& input,
                         const RealtimeSettings& settings, const Progress& progress,
                         RunKeeper* keeper = nullptr);

}  // namespace lmdbench
