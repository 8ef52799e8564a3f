// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>

#include <cstdio>
#include <cstdlib>

namespace lmdbench {

void contract_broken(const char* condition, const char* file, int line, const char* likely_cause) noexcept {
  std::fprintf(stderr, "contract broken: %s (%s:%d): %s\n", condition, file, line, likely_cause);
  std::abort();
}

}  // namespace lmdbench
