// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/wide_frontier.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace lmdbench {

namespace {

constexpr double NEVER = std::numeric_limits<double>::infinity();
/// Tests that would be rejected for no longer than this many frames at the present pace are opened: more
/// means fewer repeated tests, but more that are kept for nothing. The best of 0.5, 1, 2 and 4 on recorded
/// paths.
constexpr float HORIZON_FRAMES = 2.0F;
/// Share of the last frames' pace that is still expected in the next one.
constexpr double PACE_DECAY = 0.9;
/// A pace of zero must not become infinite frames, whose product with zero is no number.
constexpr double LEAST_PACE = 1e-30;
/// Relative rounding that is added to every motion.
constexpr double MOTION_ROUNDING = 1e-12;

Expiry free_expiry() {
  return {0, 0.0, NEVER, NEVER};
}

/// Clock and lever of a child of the moving hierarchy.
Expiry timed_by(const MotionClocks& clocks, const WideNode& node, std::uint32_t lane, double cutoff) {
  const Vec3 centre(node.centre[0][lane], node.centre[1][lane], node.centre[2][lane]);
  Expiry expiry;
  expiry.clock = static_cast<std::uint32_t>(clocks.nearest(centre));
  expiry.lever =
      ((centre - clocks.point(expiry.clock)).norm() + static_cast<double>(node.radius[lane]) + 2.0 * cutoff) *
      (1.0 + MOTION_ROUNDING);
  return expiry;
}

float frames_per_radian(const MotionClocks& clocks) {
  return 1.0F / static_cast<float>(std::max(clocks.angle_pace(), LEAST_PACE));
}

}  // namespace

void MotionClocks::place(const RigidTransform& X_WM, const Vec3& origin,
                         std::array<Vec3, COUNT>& places) const {
  const Vec3 first = X_WM.point(origin + points_[0]);
  const Vec3 x = step_ * X_WM.rotation.col(0), y = step_ * X_WM.rotation.col(1),
             z = step_ * X_WM.rotation.col(2);
  std::size_t index = 0;
  for (int i = 0; i < GRID; ++i)
    for (int j = 0; j < GRID; ++j)
      for (int k = 0; k < GRID; ++k) places[index++] = first + double(i) * x + double(j) * y + double(k) * z;
}

void MotionClocks::reset(const WideHierarchy& moving, const RigidTransform& X_WM, const Pose& pose) {
  step_ = 2.0 * moving.radius / (GRID - 1);
  std::size_t index = 0;
  for (int i = 0; i < GRID; ++i)
    for (int j = 0; j < GRID; ++j)
      for (int k = 0; k < GRID; ++k) points_[index++] = step_ * Vec3(i, j, k) - Vec3::Constant(moving.radius);
  place(X_WM, moving.origin, places_);
  shifts_.fill(0.0);
  shift_paces_.fill(0.0);
  angle_ = angle_pace_ = largest_shift_pace_ = 0.0;
  pose_ = pose;
}

bool MotionClocks::advance(const WideHierarchy& moving, const RigidTransform& X_WM, const Pose& pose,
                           double rounding) {
  // The angle is 2 asin(s) <= 2 (s + s^3) for the length s <= 0.8 of the relative quaternion's vector part.
  const double sine = (pose.rotation * pose_.rotation.conjugate()).vec().norm();
  if (!(sine <= 0.8)) {
    reset(moving, X_WM, pose);
    return false;
  }
  const double angle = 2.0 * (sine + sine * sine * sine) * (1.0 + MOTION_ROUNDING);
  angle_ += angle;
  angle_pace_ = std::max(angle, PACE_DECAY * angle_pace_);
  std::array<Vec3, COUNT> places;
  place(X_WM, moving.origin, places);
  largest_shift_pace_ = 0.0;
  for (std::size_t i = 0; i < COUNT; ++i) {
    const double shift = (places[i] - places_[i]).norm() * (1.0 + MOTION_ROUNDING) + rounding;
    shifts_[i] += shift;
    shift_paces_[i] = std::max(shift, PACE_DECAY * shift_paces_[i]);
    largest_shift_pace_ = std::max(largest_shift_pace_, shift_paces_[i]);
  }
  places_ = places;
  pose_ = pose;
  return true;
}

std::size_t MotionClocks::nearest(const Vec3& p_H) const {
  std::size_t index = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = (p_H[axis] - points_[0][axis]) / step_ + 0.5;
    index = index * GRID + static_cast<std::size_t>(std::clamp(cell, 0.0, GRID - 0.5));
  }
  return index;
}

void WideFrontier::clear() {
  slots_.clear();
  records_.clear();
  record_expiries_.clear();
  leaves_.clear();
  leaf_expiries_.clear();
  free_records_.clear();
  free_leaves_.clear();
  requested_.clear();
}

void WideFrontier::add_record(const Work& work, std::uint32_t slot_a, std::uint32_t slot_b,
                              std::uint32_t& index) {
  if (free_records_.empty()) {
    index = static_cast<std::uint32_t>(records_.size());
    slots_.emplace_back();
    records_.emplace_back();
    record_expiries_.emplace_back();
  } else {
    index = free_records_.back();
    free_records_.pop_back();
  }
  const std::uint32_t added = index;  // `index` may be in a record
  records_[added] = Record{};
  records_[added].in_use = true;
  slots_[added] = {slot_a, slot_b};
  record_expiries_[added] =
      timed_by(work.clocks, work.a.nodes[slot_a / WIDE_WIDTH], slot_a % WIDE_WIDTH, work.cutoff);
  request(work, added);
}

std::uint32_t WideFrontier::add_leaf(const Work& work, std::uint32_t slot_a, const WidePair& pair,
                                     bool touches) {
  auto index = static_cast<std::uint32_t>(leaves_.size());
  if (free_leaves_.empty()) {
    leaves_.emplace_back();
    leaf_expiries_.emplace_back();
  } else {
    index = free_leaves_.back();
    free_leaves_.pop_back();
  }
  leaves_[index] = {pair, touches};
  leaf_expiries_[index] =
      timed_by(work.clocks, work.a.nodes[slot_a / WIDE_WIDTH], slot_a % WIDE_WIDTH, work.cutoff);
  return index;
}

void WideFrontier::drop_leaf(std::uint32_t leaf) {
  leaf_expiries_[leaf] = free_expiry();
  free_leaves_.push_back(leaf);
}

void WideFrontier::drop_record(std::uint32_t record) {
  dropping_.push_back(record);
  while (!dropping_.empty()) {
    const std::uint32_t index = dropping_.back();
    dropping_.pop_back();
    const Record& dropped = records_[index];
    for (std::uint32_t left = dropped.opened_lanes; left != 0; left &= left - 1)
      dropping_.push_back(dropped.below[static_cast<std::size_t>(std::countr_zero(left))]);
    for (std::uint32_t left = dropped.lmd_lanes; left != 0; left &= left - 1)
      drop_leaf(dropped.below[static_cast<std::size_t>(std::countr_zero(left))]);
    for (std::uint32_t left = dropped.touch_lanes; left != 0; left &= left - 1)
      drop_leaf(dropped.touching[static_cast<std::size_t>(std::countr_zero(left))]);
    records_[index].in_use = false;
    record_expiries_[index] = free_expiry();
    free_records_.push_back(index);
  }
}

void WideFrontier::request(const Work& work, std::uint32_t record) {
  const Expiry& expiry = record_expiries_[record];
  WideKeptTest test{};
  test.record = record;
  test.slot_a = slots_[record].a;
  test.slot_b = slots_[record].b;
  const double size_pace = work.clocks.shift_pace(expiry.clock) + expiry.lever * work.clocks.angle_pace();
  test.paces = {1.0F / static_cast<float>(std::max(size_pace, LEAST_PACE)), work.frames_per_radian,
                HORIZON_FRAMES};
  requested_.push_back(test);
}

void WideFrontier::apply(const Work& work, const WideKeptTest& test) {
  // Records move in memory when one is added: by index, and nothing kept across.
  const std::uint32_t index = test.record;
  Expiry& expiry = record_expiries_[index];
  expiry.size = work.clocks.shift(expiry.clock) + expiry.lever * work.clocks.angle() +
                static_cast<double>(test.length_slack);
  expiry.angle = work.clocks.angle() + static_cast<double>(test.angle_slack);
  ++work.counters.node_tests;
  work.counters.node_pairs += static_cast<std::uint64_t>(std::popcount(test.used));

  if (test.opened == records_[index].opened_lanes && test.lmd == records_[index].lmd_lanes &&
      test.touch == records_[index].touch_lanes)
    return;
  const Record before = records_[index];
  const bool open_a = test.opening.open_a;
  const std::uint32_t first_slot = test.opening.node * WIDE_WIDTH;
  const auto slot_a_of = [&](std::uint32_t lane) { return open_a ? first_slot + lane : test.slot_a; };
  const auto slot_b_of = [&](std::uint32_t lane) { return open_a ? test.slot_b : first_slot + lane; };
  const auto ref = [](const WideHierarchy& hierarchy, std::uint32_t slot) {
    return WideRef::from_bits(hierarchy.nodes[slot / WIDE_WIDTH].child[slot % WIDE_WIDTH]);
  };
  const auto pair_of = [&](std::uint32_t lane) {
    return WidePair{ref(work.a, slot_a_of(lane)), ref(work.b, slot_b_of(lane))};
  };
  for (std::uint32_t change = test.opened ^ before.opened_lanes; change != 0; change &= change - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(change));
    if ((test.opened >> lane & 1u) == 0) {
      drop_record(before.below[lane]);
    } else {
      std::uint32_t added = 0;
      add_record(work, slot_a_of(lane), slot_b_of(lane), added);
      records_[index].below[lane] = added;
    }
  }
  for (std::uint32_t change = test.lmd ^ before.lmd_lanes; change != 0; change &= change - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(change));
    if ((test.lmd >> lane & 1u) == 0) {
      drop_leaf(before.below[lane]);
    } else {
      records_[index].below[lane] = add_leaf(work, slot_a_of(lane), pair_of(lane), false);
    }
  }
  for (std::uint32_t change = test.touch ^ before.touch_lanes; change != 0; change &= change - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(change));
    if ((test.touch >> lane & 1u) == 0) {
      drop_leaf(before.touching[lane]);
    } else {
      records_[index].touching[lane] = add_leaf(work, slot_a_of(lane), pair_of(lane), true);
    }
  }
  records_[index].opened_lanes = test.opened;
  records_[index].lmd_lanes = test.lmd;
  records_[index].touch_lanes = test.touch;
}

void WideFrontier::make_requested_tests(const Work& work) {
  while (!requested_.empty()) {
    std::swap(requested_, batch_);
    requested_.clear();
    test_batch(work.a, work.b, work.query, batch_);
    for (const WideKeptTest& test : batch_) {
      // An earlier test of this batch may have dropped the record, and given it to another pair.
      if (records_[test.record].in_use && slots_[test.record] == Slots{test.slot_a, test.slot_b})
        apply(work, test);
    }
  }
}

/// Without a branch: which are due follows no pattern.
void WideFrontier::list_due(const std::vector<Expiry>& expiries, const MotionClocks& clocks) {
  due_.reserve(expiries.capacity());  // grows as seldom as that does, not by one
  due_.resize(expiries.size());
  std::size_t count = 0;
  const double angle = clocks.angle();
  for (std::uint32_t i = 0; i < expiries.size(); ++i) {
    due_[count] = i;
    count += static_cast<std::size_t>(expiries[i].is_due(clocks.shifts(), angle));
  }
  due_.resize(count);
}

void WideFrontier::start(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                         const MotionClocks& clocks, double cutoff, WideCounters& counters) {
  clear();
  const Work work{a, b, query, clocks, cutoff, frames_per_radian(clocks), counters};
  std::uint32_t root = 0;
  add_record(work, 0, 0, root);
  make_requested_tests(work);
}

void WideFrontier::advance(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                           const MotionClocks& clocks, double cutoff, WideCounters& counters) {
  const Work work{a, b, query, clocks, cutoff, frames_per_radian(clocks), counters};
  list_due(record_expiries_, clocks);
  for (const std::uint32_t record : due_) request(work, record);
  make_requested_tests(work);
}

}  // namespace lmdbench
