// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/missing_part.h>
#include <lmdbench/experiment/fcl_part.h>

namespace lmdbench {

bool has_fcl() {
  return LMDBENCH_HAS_FCL;
}

void require_fcl(const std::string& file, const std::string& place) {
  if (!has_fcl()) throw missing_part(PART_FCL, file, place, "the cross-check");
}

}  // namespace lmdbench
