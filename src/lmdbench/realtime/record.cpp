// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/record.h>

#include <fmt/format.h>

#include <algorithm>

namespace lmdbench {

std::int64_t RealtimeRecord::frames_from(FrameSource source) const {
  return std::count(frame_source.begin(), frame_source.end(), source);
}

std::vector<std::string> realtime_warnings(const RealtimeRecord& clock) {
  std::vector<std::string> warnings;
  for (const Grant& grant : clock.grants)
    if (!grant.granted)
      warnings.push_back(
          fmt::format("{}: {}: {} was refused: {}", clock.label, grant.thread, grant.asked, grant.reason));
  const auto note = [&](std::int64_t count, const std::string& what) {
    if (count > 0) warnings.push_back(fmt::format("{}: {} {}", clock.label, count, what));
  };
  note(clock.frames_from(FrameSource::SKIPPED),
       "frames without a tick of the servo loop, shown as the device held them");
  note(clock.frames_from(FrameSource::LOST), "frames lost because the recorder had no room, shown as held");
  note(clock.lmd_lists_lost, "LMD lists lost because the recorder had no room");
  note(clock.servo().use.minor_faults + clock.servo().use.major_faults, "page faults in the servo loop");
  return warnings;
}

}  // namespace lmdbench
