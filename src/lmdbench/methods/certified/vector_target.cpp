// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/methods/certified/vector_target.h>

#include <hwy/targets.h>

namespace lmdbench {
namespace {

/// Of the processor. Highway asks it anew at every call, which in a virtual machine takes 30 us.
std::int64_t supported_targets() {
  static const std::int64_t targets = hwy::SupportedTargets();
  return targets;
}

std::int64_t mask_of(VectorTarget target) {
  switch (target) {
    case VectorTarget::AVX512:
      return HWY_AVX3;
    case VectorTarget::AVX2:
      return HWY_AVX2;
    case VectorTarget::SSE4:
      return HWY_SSE4;
    case VectorTarget::SCALAR:
      return HWY_SCALAR | HWY_EMU128;
    case VectorTarget::BEST:
      break;
  }
  return supported_targets();
}

}  // namespace

bool is_available(VectorTarget target) {
  // Highway never lists the plain form as supported.
  return (mask_of(target) & HWY_TARGETS & (supported_targets() | HWY_SCALAR | HWY_EMU128)) != 0;
}

UseVectorTarget::UseVectorTarget(VectorTarget target) : is_best_(target == VectorTarget::BEST) {
  if (is_best_) return;
  if (!is_available(target))
    throw EnvironmentError(
        "", "kernel", "this processor or this build has no such vectors",
        "leave the method's option kernel out, or choose a narrower one; a build has more than the "
        "narrowest with LMDBENCH_WITH_WIDE_TARGETS=ON");
  hwy::GetChosenTarget().Update(mask_of(target));
}

UseVectorTarget::~UseVectorTarget() {
  if (!is_best_) hwy::GetChosenTarget().Update(mask_of(VectorTarget::BEST));
}

}  // namespace lmdbench
