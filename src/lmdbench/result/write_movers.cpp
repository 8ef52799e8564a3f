// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result/write_movers.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lmdbench {
namespace {

void write_vectors(ResultWriter& writer, const DatasetInfo& info, const std::vector<double>& values,
                   std::size_t movers) {
  writer.write(info, std::span<const double>(values), {values.size() / (3 * movers), movers, 3});
}

}  // namespace

void write_mover_poses(ResultWriter& writer, const MoverPlay& play) {
  const std::size_t movers = play.count(), frames = play.poses.size();
  std::vector<double> positions(3 * movers * frames), orientations(4 * movers * frames);
  for (std::size_t frame = 0; frame < frames; ++frame)
    for (std::size_t i = 0; i < movers; ++i) {
      const std::size_t row = frame * movers + play.number[i];
      const Pose& pose = play.poses[frame][i];
      std::copy_n(pose.translation.data(), 3, positions.begin() + static_cast<std::ptrdiff_t>(3 * row));
      std::copy_n(pose.rotation.coeffs().data(), 4,
                  orientations.begin() + static_cast<std::ptrdiff_t>(4 * row));
    }
  write_vectors(writer, {"/path/movers/position", "m", "origin of each mover's frame, world frame"},
                positions, movers);
  writer.write({"/path/movers/orientation", "1", "unit quaternion x, y, z, w of each mover"},
               std::span<const double>(orientations), {frames, movers, 4});
}

void write_mover_frames(ResultWriter& writer, const std::string& group, const MethodRecord& record,
                        std::size_t movers, bool torque) {
  const std::size_t frames = record.movers.size() / movers;
  const auto vectors = [&](const char* name, const char* units, const char* long_name,
                           Vec3 MoverFrame::*value) {
    std::vector<double> values;
    for (const MoverFrame& mover : record.movers)
      values.insert(values.end(), (mover.*value).begin(), (mover.*value).end());
    write_vectors(writer, {group + "/movers/" + name, units, long_name}, values, movers);
  };
  vectors("force", "N", "rendered force on each mover, world frame", &MoverFrame::force);
  if (torque)
    vectors("torque", "N m", "torque about each mover's centre, before the device clips it",
            &MoverFrame::torque);
  std::vector<std::uint8_t> clipped;
  std::vector<std::int64_t> counts;
  std::vector<double> distances;
  for (const MoverFrame& mover : record.movers) {
    clipped.push_back(mover.force_clipped ? 1 : 0);
    counts.push_back(mover.lmd_count);
    distances.push_back(mover.minimum_distance);
  }
  writer.write({group + "/movers/force_clipped", "1", "1 where the device clipped the mover's force"},
               std::span<const std::uint8_t>(clipped), {frames, movers});
  writer.write({group + "/movers/lmd_count", "1", "LMDs of the mover's pairs within the cutoff"},
               std::span<const std::int64_t>(counts), {frames, movers});
  writer.write({group + "/movers/minimum_distance", "m", "smallest LMD distance of the mover's pairs"},
               std::span<const double>(distances), {frames, movers});
}

}  // namespace lmdbench
