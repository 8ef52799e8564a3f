// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/write_loop.h>

#include <cstdint>
#include <span>

namespace lmdbench {
namespace {

void write_vectors(ResultWriter& writer, const DatasetInfo& info, const std::vector<LoopFrame>& frames,
                   Vec3 LoopFrame::*member) {
  std::vector<double> values;
  values.reserve(frames.size() * 3);
  for (const LoopFrame& frame : frames) {
    const Vec3& value = frame.*member;
    values.insert(values.end(), value.data(), value.data() + 3);
  }
  writer.write(info, std::span<const double>(values), {frames.size(), 3});
}

}  // namespace

void write_loop(ResultWriter& writer, const std::string& group, const std::vector<LoopFrame>& frames) {
  write_vectors(writer, {group + "/position", "m", "true position of the device, world frame"}, frames,
                &LoopFrame::position);
  write_vectors(writer, {group + "/velocity", "m/s", "velocity of the device, world frame"}, frames,
                &LoopFrame::velocity);
  write_vectors(writer, {group + "/held_force", "N", "force held until the next frame, delay included"},
                frames, &LoopFrame::held_force);
  const auto energy = [&](const std::string& name, const std::string& long_name,
                          double EnergyAccount::*member) {
    std::vector<double> values;
    values.reserve(frames.size());
    for (const LoopFrame& frame : frames) values.push_back(frame.energy.*member);
    writer.write({group + "/energy_" + name, "J", long_name}, std::span<const double>(values),
                 {values.size()});
  };
  energy("kinetic", "energy of the device's motion", &EnergyAccount::kinetic);
  energy("spring", "energy in the springs of hand and grip", &EnergyAccount::spring);
  energy("rendered", "work of the held force on the device since the start", &EnergyAccount::rendered);
  energy("push", "work of the push since the start", &EnergyAccount::push);
  energy("hand", "work of the person who moves the hand since the start", &EnergyAccount::hand);
  energy("damped", "energy lost in dampers since the start", &EnergyAccount::damped);
  energy("friction", "energy lost to Coulomb friction since the start", &EnergyAccount::friction);
  energy("moved", "sum of the lengths of all energies that flowed since the start", &EnergyAccount::moved);
}

}  // namespace lmdbench
