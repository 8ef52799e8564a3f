// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/build/wide_bounds.h>

#include <limits>

// The rest of this file is compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lmdbench/methods/certified/build/wide_bounds.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <lmdbench/methods/certified/layout/wide_numbers-inl.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::Vec<FloatTag>;

/// A vector of every lane. Products and sums stay apart: fused, they would round differently.
struct Vectors {
  Floats x, y, z;
};

HWY_INLINE Vectors load(const LaneSets& sets, std::size_t at) {
  const FloatTag f;
  return {hn::LoadU(f, sets.x.data() + at), hn::LoadU(f, sets.y.data() + at),
          hn::LoadU(f, sets.z.data() + at)};
}

HWY_INLINE Vectors add(const Vectors& a, const Vectors& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

HWY_INLINE Vectors subtract(const Vectors& a, const Vectors& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vectors scale(Floats factor, const Vectors& a) {
  return {hn::Mul(factor, a.x), hn::Mul(factor, a.y), hn::Mul(factor, a.z)};
}

HWY_INLINE Floats dot(const Vectors& a, const Vectors& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

template <class Mask>
HWY_INLINE Vectors choose(Mask mask, const Vectors& yes, const Vectors& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

HWY_INLINE void store(const Vectors& v, LaneVectors& result, std::size_t first) {
  const FloatTag f;
  hn::Store(v.x, f, result.x + first);
  hn::Store(v.y, f, result.y + first);
  hn::Store(v.z, f, result.z + first);
}

HWY_INLINE Floats sine_of(Floats cosine) {
  const FloatTag f;
  return hn::Sqrt(hn::Max(hn::Zero(f), hn::Sub(hn::Set(f, 1.0F), hn::Mul(cosine, cosine))));
}

HWY_INLINE Vectors unit(const Vectors& v) {
  return scale(hn::Div(hn::Set(FloatTag(), 1.0F), hn::Sqrt(dot(v, v))), v);
}

void lane_axes(const LaneCaps& caps, int steps, LaneVectors& axes) {
  // An axis this close to the widest cap's does not move.
  constexpr float LEAST_SQUARED_ACROSS = 1e-12F;
  const FloatTag f;
  const auto one = hn::Set(f, 1.0F);
  for (std::size_t first = 0; first < WIDE_WIDTH; first += hn::Lanes(f)) {
    Vectors axis = load(caps.axes, first);
    for (std::size_t k = 1; k < caps.axes.count; ++k)
      axis = add(axis, load(caps.axes, k * WIDE_WIDTH + first));
    axis = unit(axis);
    Vectors best_axis = axis;
    auto best = hn::Set(f, -1.0F);
    for (int step = 0; step <= steps; ++step) {
      auto least = hn::Set(f, 2.0F);
      Vectors widest = axis;
      for (std::size_t k = 0; k < caps.axes.count; ++k) {
        const std::size_t at = k * WIDE_WIDTH + first;
        const Vectors direction = load(caps.axes, at);
        // A cap's farthest direction is at the angle to its axis plus its half angle.
        const auto cosine = hn::Min(one, dot(axis, direction));
        const auto reach = hn::Sub(hn::Mul(cosine, hn::LoadU(f, caps.cosines.data() + at)),
                                   hn::Mul(sine_of(cosine), hn::LoadU(f, caps.sines.data() + at)));
        const auto wider = hn::Lt(reach, least);
        least = hn::IfThenElse(wider, reach, least);
        widest = choose(wider, direction, widest);
      }
      const auto better = hn::Gt(least, best);
      best = hn::IfThenElse(better, least, best);
      best_axis = choose(better, axis, best_axis);
      const Vectors across = subtract(widest, scale(dot(axis, widest), axis));
      const auto squared_across = dot(across, across);
      const auto move = hn::Div(
          sine_of(least), hn::Mul(hn::Set(f, static_cast<float>(step) + 2.0F), hn::Sqrt(squared_across)));
      const auto moves = hn::Gt(squared_across, hn::Set(f, LEAST_SQUARED_ACROSS));
      axis = unit(add(axis, scale(hn::IfThenElseZero(moves, move), across)));
    }
    store(best_axis, axes, first);
  }
}

void lane_centres(const LaneSets& points, const LaneVectors& axes, int steps, LaneVectors& centres) {
  const FloatTag f;
  const auto half = hn::Set(f, 0.5F);
  for (std::size_t first = 0; first < WIDE_WIDTH; first += hn::Lanes(f)) {
    const Vectors axis{hn::Load(f, axes.x + first), hn::Load(f, axes.y + first), hn::Load(f, axes.z + first)};
    Vectors low = load(points, first), high = low;
    auto low_along = dot(low, axis), high_along = low_along;
    for (std::size_t k = 1; k < points.count; ++k) {
      const Vectors p = load(points, k * WIDE_WIDTH + first);
      low = {hn::Min(low.x, p.x), hn::Min(low.y, p.y), hn::Min(low.z, p.z)};
      high = {hn::Max(high.x, p.x), hn::Max(high.y, p.y), hn::Max(high.z, p.z)};
      const auto along = dot(p, axis);
      low_along = hn::Min(low_along, along);
      high_along = hn::Max(high_along, along);
    }
    Vectors centre = scale(half, add(low, high));
    const auto middle = hn::Mul(half, hn::Add(low_along, high_along));
    centre = add(centre, scale(hn::Sub(middle, dot(centre, axis)), axis));
    Vectors best = centre;
    auto least = hn::Set(f, std::numeric_limits<float>::infinity());
    for (int step = 0; step <= steps && steps > 0; ++step) {
      auto farthest = hn::Set(f, -1.0F);
      Vectors to_farthest = centre;
      for (std::size_t k = 0; k < points.count; ++k) {
        const Vectors to_point = subtract(load(points, k * WIDE_WIDTH + first), centre);
        const auto squared = dot(to_point, to_point);
        const auto farther = hn::Gt(squared, farthest);
        farthest = hn::IfThenElse(farther, squared, farthest);
        to_farthest = choose(farther, to_point, to_farthest);
      }
      const auto better = hn::Lt(farthest, least);
      least = hn::IfThenElse(better, farthest, least);
      best = choose(better, centre, best);
      const Vectors move = subtract(to_farthest, scale(dot(to_farthest, axis), axis));
      centre = add(centre, scale(hn::Set(f, 0.5F / (static_cast<float>(step) + 2.0F)), move));
    }
    store(best, centres, first);
  }
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace lmdbench {

HWY_EXPORT(lane_axes);
HWY_EXPORT(lane_centres);

void LaneSets::resize(std::size_t vectors) {
  count = vectors;
  for (auto* numbers : {&x, &y, &z})
    if (numbers->size() < vectors * WIDE_WIDTH) numbers->resize(2 * vectors * WIDE_WIDTH);
}

void LaneCaps::resize(std::size_t caps) {
  axes.resize(caps);
  cosines.resize(axes.x.size());
  sines.resize(axes.x.size());
}

void find_lane_axes(const LaneCaps& caps, int steps, LaneVectors& axes) {
  HWY_DYNAMIC_DISPATCH(lane_axes)(caps, steps, axes);
}

void find_lane_centres(const LaneSets& points, const LaneVectors& axes, int steps, LaneVectors& centres) {
  HWY_DYNAMIC_DISPATCH(lane_centres)(points, axes, steps, centres);
}

}  // namespace lmdbench

#endif  // HWY_ONCE
