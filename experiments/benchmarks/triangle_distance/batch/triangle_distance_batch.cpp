// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>

#include <benchmarks/triangle_distance/batch/triangle_distance_batch.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

// Steps, each on up to eight pairs at a time:
// - first step: the corners of each triangle that are farthest towards the other; if a neighbouring corner is
//   ahead, the nearest points of the edges to those. Proves nearly every pair a few sizes apart.
// - all candidates: 9 edge pairs and 6 corner-face pairs, for what the first step left.
// - crossing: pairs that clearly cross.
// - triangle_distance, for what is still open.
// The proof is that of feature_proof.cpp: every corner that does not carry the pair is behind the plane
// across d by a margin far above rounding, and the pair is nearer than its neighbours by as much. Vectors
// decide only what is well conditioned (MIN_SQUARED_SINE), so that points agree with the scalar kernel's.
//
// Only plain multiplications and additions, no fused ones, so that every processor gives the same bits.

// Vectors of unknown length cannot be members of structures.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// The rest of this file is compiled once for every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "benchmarks/triangle_distance/batch/triangle_distance_batch.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <lmdbench/geometry/lane_crossing-inl.h>

#include <benchmarks/triangle_distance/batch/lane_all_candidates-inl.h>
#include <benchmarks/triangle_distance/batch/lane_first_step-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lmdbench::HWY_NAMESPACE {

const char* batch_target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace lmdbench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace lmdbench {

HWY_EXPORT(first_step);
HWY_EXPORT(all_candidates);
HWY_EXPORT(crossing);
HWY_EXPORT(batch_target_name);

namespace {

using kernel::LaneBlock;
using kernel::LaneResult;
using kernel::MAX_LANES;

TriangleFeature feature_of(double carriers) {
  // By the bits of corners 2, 1 and 0; the empty set cannot be.
  constexpr std::array<TriangleFeature, 8> FEATURES{
      TriangleFeature::FACE, TriangleFeature::V0, TriangleFeature::V1, TriangleFeature::E0,
      TriangleFeature::V2,   TriangleFeature::E2, TriangleFeature::E1, TriangleFeature::FACE};
  return FEATURES[static_cast<std::size_t>(static_cast<int>(carriers))];
}

void store(const LaneResult& lanes, std::size_t lane, TrianglePairDistance& result) {
  result.point_a = {lanes.point_a[0][lane], lanes.point_a[1][lane], lanes.point_a[2][lane]};
  result.point_b = {lanes.point_b[0][lane], lanes.point_b[1][lane], lanes.point_b[2][lane]};
  result.squared_distance = lanes.squared_distance[lane];
  result.feature_a = feature_of(lanes.carriers_a[lane]);
  result.feature_b = feature_of(lanes.carriers_b[lane]);
  result.intersecting = false;
  result.minimiser_dimension = 0;
  result.minimiser_measure = 0.0;
}

/// Pairs that wait for a stage. The last pair fills lanes that have none.
struct Queue {
  LaneBlock block;
  std::array<std::size_t, MAX_LANES> index{};
  std::size_t size = 0;

  void push(const Triangle& a, const Triangle& b, std::size_t pair) {
    load(block, size, a, b);
    index[size++] = pair;
  }
  void fill(std::span<const Triangle> a, std::span<const Triangle> b) {
    for (std::size_t lane = size; lane < MAX_LANES; ++lane) load(block, lane, a[index[0]], b[index[0]]);
  }
};

/// The stages and what waits between them.
class Batch {
 public:
  Batch(std::span<const Triangle> a, std::span<const Triangle> b, std::span<TrianglePairDistance> results)
      : a_(a), b_(b), results_(results) {}

  TriangleBatchStages run() {
    for (std::size_t begin = 0; begin < results_.size(); begin += MAX_LANES) {
      const std::size_t end = std::min(begin + MAX_LANES, results_.size());
      for (std::size_t pair = begin; pair < end; ++pair) fresh_.push(a_[pair], b_[pair], pair);
      take_first_step();
    }
    if (not_proved_.size > 0) examine_all_candidates();
    if (perhaps_crossing_.size > 0) find_crossing();
    return stages_;
  }

 private:
  void take_first_step() {
    fresh_.fill(a_, b_);
    LaneResult lanes;
    const std::uint32_t proved = HWY_DYNAMIC_DISPATCH(first_step)(fresh_.block, lanes);
    for (std::size_t lane = 0; lane < fresh_.size; ++lane) {
      if (((proved >> lane) & 1U) != 0) {
        store(lanes, lane, results_[fresh_.index[lane]]);
        ++stages_.first_step;
      } else {
        pass_on(fresh_.index[lane], not_proved_, &Batch::examine_all_candidates);
      }
    }
    fresh_.size = 0;
  }

  void examine_all_candidates() {
    not_proved_.fill(a_, b_);
    LaneResult lanes;
    const std::uint32_t proved = HWY_DYNAMIC_DISPATCH(all_candidates)(not_proved_.block, lanes);
    for (std::size_t lane = 0; lane < not_proved_.size; ++lane) {
      if (((proved >> lane) & 1U) != 0) {
        store(lanes, lane, results_[not_proved_.index[lane]]);
        ++stages_.all_candidates;
      } else {
        pass_on(not_proved_.index[lane], perhaps_crossing_, &Batch::find_crossing);
      }
    }
    not_proved_.size = 0;
  }

  void find_crossing() {
    perhaps_crossing_.fill(a_, b_);
    LaneResult lanes;
    const std::uint32_t crosses = HWY_DYNAMIC_DISPATCH(crossing)(perhaps_crossing_.block, lanes);
    for (std::size_t lane = 0; lane < perhaps_crossing_.size; ++lane) {
      const std::size_t pair = perhaps_crossing_.index[lane];
      if (((crosses >> lane) & 1U) != 0) {
        store(lanes, lane, results_[pair]);
        results_[pair].intersecting = true;
        results_[pair].minimiser_dimension = 1;
        results_[pair].minimiser_measure = lanes.shared_length[lane];
        ++stages_.crossing;
      } else {
        results_[pair] = triangle_distance(a_[pair], b_[pair]);
        ++stages_.scalar;
      }
    }
    perhaps_crossing_.size = 0;
  }

  void pass_on(std::size_t pair, Queue& queue, void (Batch::*stage)()) {
    queue.push(a_[pair], b_[pair], pair);
    if (queue.size == MAX_LANES) (this->*stage)();
  }

  std::span<const Triangle> a_, b_;
  std::span<TrianglePairDistance> results_;
  Queue fresh_, not_proved_, perhaps_crossing_;
  TriangleBatchStages stages_;
};

}  // namespace

TriangleBatchStages triangle_distance_batch_stages(std::span<const Triangle> a, std::span<const Triangle> b,
                                                   std::span<TrianglePairDistance> results) {
  return Batch(a, b, results).run();
}

void triangle_distance_batch(std::span<const Triangle> a, std::span<const Triangle> b,
                             std::span<TrianglePairDistance> results) {
  triangle_distance_batch_stages(a, b, results);
}

std::string triangle_distance_batch_target() {
  return HWY_DYNAMIC_DISPATCH(batch_target_name)();
}

}  // namespace lmdbench

#endif  // HWY_ONCE
