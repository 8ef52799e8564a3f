// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/contact_work.h>
#include <lmdbench/motion/rotation_vector.h>

#include <cstddef>

namespace lmdbench {

ContactPorts contact_ports(const DriverInput& input) {
  ContactPorts ports;
  if (!input.loop.rotation) ports.turned_about_M = input.reference_M;
  ports.others_move = input.motion.is_any();
  return ports;
}

std::vector<double> contact_work(const MethodRecord& record, const ContactPorts& ports) {
  std::vector<double> work;
  if (ports.others_move) return work;
  double on_turn = 0.0;
  for (std::size_t i = 0; i < record.loop.size(); ++i) {
    work.push_back(record.loop[i].energy.rendered + on_turn);
    if (!ports.turned_about_M || i + 1 == record.loop.size()) continue;
    // The path turns the mesh about its origin.
    const FrameRecord& frame = record.frames[i];
    const Eigen::Quaterniond& now = record.loop[i].orientation;
    const Vec3 torque = frame.torque + (now * *ports.turned_about_M).cross(frame.force);
    on_turn += torque.dot(rotation_vector_of(record.loop[i + 1].orientation * now.conjugate()));
  }
  return work;
}

}  // namespace lmdbench
