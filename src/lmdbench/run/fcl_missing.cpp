// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
// In place of fcl_probe.cpp in a build without FCL (LMDBENCH_WITH_FCL).
#include <lmdbench/base/missing_part.h>
#include <lmdbench/run/fcl_probe.h>
#include <lmdbench/run/mover_probe.h>

namespace lmdbench {

FclCheck probe_fcl(const Scene& /*scene*/, const LockstepInput& /*input*/,
                   const std::vector<LockstepMethod>& /*methods*/,
                   const std::vector<std::int64_t>& /*frames*/, double /*tolerance_relative*/,
                   const Progress& /*progress*/, const ProbeShortcuts& /*shortcuts*/) {
  throw missing_part(PART_FCL, "", "", "the cross-check");
}

FclCheck probe_mover_fcl(const MoverPlay& /*play*/, double /*cutoff*/,
                         const std::vector<LockstepMethod>& /*methods*/,
                         const std::vector<std::int64_t>& /*frames*/, double /*tolerance_relative*/,
                         const Progress& /*progress*/) {
  throw missing_part(PART_FCL, "", "", "the cross-check");
}

}  // namespace lmdbench
