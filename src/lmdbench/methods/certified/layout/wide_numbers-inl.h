// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers that the node tests are written for: the widest vectors of an instruction set, and single
// floats, the reference. Compiled once for every instruction set: included after foreach_target.h,
// with an include guard that Highway toggles.
#if defined(LMDBENCH_WIDE_NUMBERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LMDBENCH_WIDE_NUMBERS_INL_H
#undef LMDBENCH_WIDE_NUMBERS_INL_H
#else
#define LMDBENCH_WIDE_NUMBERS_INL_H
#endif

#include <lmdbench/methods/certified/layout/wide_hierarchy.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Lanes per vector: eight, or four twice where vectors are 128 bits wide.
using FloatTag = hn::CappedTag<float, WIDE_WIDTH>;

template <class Mask>
HWY_INLINE std::uint32_t mask_bits(FloatTag f, Mask mask, std::uint32_t first) {
#ifdef __SANITIZE_THREAD__
  std::uint64_t bits = 0;  // GCC 12 reads more than one byte (-O1 -fsanitize=thread).
  hn::StoreMaskBits(f, mask, reinterpret_cast<std::uint8_t*>(&bits));
#else
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(f, mask, bytes);
  const std::uint32_t bits = bytes[0];
#endif
  const std::uint32_t all = hn::Lanes(f) >= 8 ? 0xFFu : (1u << hn::Lanes(f)) - 1u;
  return (static_cast<std::uint32_t>(bits) & all) << first;
}

/// Which lanes of a vector.
struct VectorChoice {
  hn::Mask<FloatTag> raw;
};

/// One number a lane.
struct VectorNumber {
  hn::Vec<FloatTag> raw;
  friend HWY_INLINE VectorNumber operator+(VectorNumber a, VectorNumber b) { return {hn::Add(a.raw, b.raw)}; }
  friend HWY_INLINE VectorNumber operator-(VectorNumber a, VectorNumber b) { return {hn::Sub(a.raw, b.raw)}; }
  friend HWY_INLINE VectorNumber operator*(VectorNumber a, VectorNumber b) { return {hn::Mul(a.raw, b.raw)}; }
  friend HWY_INLINE VectorNumber operator/(VectorNumber a, VectorNumber b) { return {hn::Div(a.raw, b.raw)}; }
  friend HWY_INLINE VectorNumber operator-(VectorNumber a) { return {hn::Neg(a.raw)}; }
  friend HWY_INLINE VectorChoice operator<=(VectorNumber a, VectorNumber b) { return {hn::Le(a.raw, b.raw)}; }
  friend HWY_INLINE VectorChoice operator>=(VectorNumber a, VectorNumber b) { return {hn::Ge(a.raw, b.raw)}; }
  friend HWY_INLINE VectorChoice operator<(VectorNumber a, VectorNumber b) { return {hn::Lt(a.raw, b.raw)}; }
  friend HWY_INLINE VectorChoice operator>(VectorNumber a, VectorNumber b) { return {hn::Gt(a.raw, b.raw)}; }
};

HWY_INLINE VectorNumber least_of(VectorNumber a, VectorNumber b) {
  return {hn::Min(a.raw, b.raw)};
}
HWY_INLINE VectorNumber largest_of(VectorNumber a, VectorNumber b) {
  return {hn::Max(a.raw, b.raw)};
}
HWY_INLINE VectorNumber root(VectorNumber a) {
  return {hn::Sqrt(a.raw)};
}
HWY_INLINE VectorNumber magnitude(VectorNumber a) {
  return {hn::Abs(a.raw)};
}
HWY_INLINE VectorNumber select(VectorChoice choice, VectorNumber yes, VectorNumber no) {
  return {hn::IfThenElse(choice.raw, yes.raw, no.raw)};
}
HWY_INLINE VectorChoice both_of(VectorChoice a, VectorChoice b) {
  return {hn::And(a.raw, b.raw)};
}
HWY_INLINE VectorChoice but_not(VectorChoice a, VectorChoice b) {
  return {hn::AndNot(b.raw, a.raw)};
}

/// The lanes of a node, as many at a time as a vector holds.
struct VectorLanes {
  using Number = VectorNumber;
  using Choice = VectorChoice;
  static HWY_INLINE std::uint32_t count() { return static_cast<std::uint32_t>(hn::Lanes(FloatTag())); }
  static HWY_INLINE Number set(float x) { return {hn::Set(FloatTag(), x)}; }
  static HWY_INLINE Number load(const float* x) { return {hn::Load(FloatTag(), x)}; }
  /// Lanes from `first` on whose entry is not zero.
  static HWY_INLINE Choice not_zero(const std::uint32_t* row, std::uint32_t first) {
    const hn::RebindToUnsigned<FloatTag> u;
    return {hn::RebindMask(FloatTag(), hn::Ne(hn::Load(u, row + first), hn::Zero(u)))};
  }
  /// Lanes from `first` on whose bit is set.
  static HWY_INLINE Choice of_bits(std::uint32_t bits, std::uint32_t first) {
    alignas(32) static constexpr std::uint32_t LANE_BITS[WIDE_WIDTH] = {1, 2, 4, 8, 16, 32, 64, 128};
    const hn::RebindToUnsigned<FloatTag> u;
    return {hn::RebindMask(FloatTag(),
                           hn::Ne(hn::And(hn::Load(u, LANE_BITS + first), hn::Set(u, bits)), hn::Zero(u)))};
  }
  static HWY_INLINE std::uint32_t bits(Choice choice, std::uint32_t first) {
    return mask_bits(FloatTag(), choice.raw, first);
  }
  static HWY_INLINE float least(Number x) { return hn::GetLane(hn::MinOfLanes(FloatTag(), x.raw)); }
};

HWY_INLINE float least_of(float a, float b) {
  return std::min(a, b);
}
HWY_INLINE float largest_of(float a, float b) {
  return std::max(a, b);
}
HWY_INLINE float root(float a) {
  return std::sqrt(a);
}
HWY_INLINE float magnitude(float a) {
  return std::abs(a);
}
HWY_INLINE float select(bool choice, float yes, float no) {
  return choice ? yes : no;
}
HWY_INLINE bool both_of(bool a, bool b) {
  return a && b;
}
HWY_INLINE bool but_not(bool a, bool b) {
  return a && !b;
}

/// The lanes of a node, one at a time.
struct ScalarLanes {
  using Number = float;
  using Choice = bool;
  static HWY_INLINE std::uint32_t count() { return 1; }
  static HWY_INLINE Number set(float x) { return x; }
  static HWY_INLINE Number load(const float* x) { return *x; }
  static HWY_INLINE Choice not_zero(const std::uint32_t* row, std::uint32_t first) { return row[first] != 0; }
  static HWY_INLINE Choice of_bits(std::uint32_t bits, std::uint32_t first) {
    return (bits >> first & 1u) != 0;
  }
  static HWY_INLINE std::uint32_t bits(Choice choice, std::uint32_t first) {
    return choice ? 1u << first : 0u;
  }
  static HWY_INLINE float least(Number x) { return x; }
};

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
