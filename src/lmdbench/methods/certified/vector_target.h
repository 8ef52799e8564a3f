// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace lmdbench {

/// Instruction set of the vectorised kernels (Highway's targets). Sets and counters are the same.
enum class VectorTarget : std::uint8_t {
  BEST,    ///< The widest that the processor has.
  AVX512,  ///< Eight doubles or sixteen floats at once.
  AVX2,    ///< Four or eight.
  SSE4,    ///< Two or four.
  SCALAR   ///< One: plain C++.
};

/// Whether the processor has it and this build has kernels for it.
bool is_available(VectorTarget target);

/// Makes all kernels of the process use a target during its life; BEST changes nothing. While other
/// threads search it must not be used: their sets stay right, their times are of either target.
class UseVectorTarget {
 public:
  /// @throws EnvironmentError when the target is not available
  explicit UseVectorTarget(VectorTarget target);
  ~UseVectorTarget();
  UseVectorTarget(const UseVectorTarget&) = delete;
  UseVectorTarget& operator=(const UseVectorTarget&) = delete;

 private:
  bool is_best_;
};

}  // namespace lmdbench
