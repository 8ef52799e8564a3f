// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/wide_frontier.h>

#include <bit>
#include <cmath>

namespace lmdbench {

void WideFrontier::clear() {
  clock_ = 0.0;
  records_.clear();
  record_expiry_.clear();
  leaves_.clear();
  leaf_expiry_.clear();
  free_records_.clear();
  free_leaves_.clear();
  untested_.clear();
}

std::uint32_t WideFrontier::add_record(std::uint32_t slot_a, std::uint32_t slot_b) {
  std::uint32_t index = static_cast<std::uint32_t>(records_.size());
  if (free_records_.empty()) {
    records_.emplace_back();
    record_expiry_.push_back(0.0);
  } else {
    index = free_records_.back();
    free_records_.pop_back();
  }
  records_[index] = Record{};
  records_[index].slot_a = slot_a;
  records_[index].slot_b = slot_b;
  // Until it is tested, which is before the call ends.
  record_expiry_[index] = std::numeric_limits<double>::infinity();
  untested_.push_back(index);
  return index;
}

std::uint32_t WideFrontier::add_leaf(const WidePair& pair, bool touches) {
  std::uint32_t index = static_cast<std::uint32_t>(leaves_.size());
  if (free_leaves_.empty()) {
    leaves_.emplace_back();
    leaf_expiry_.push_back(0.0);
  } else {
    index = free_leaves_.back();
    free_leaves_.pop_back();
  }
  leaves_[index] = {pair, touches};
  leaf_expiry_[index] = -std::numeric_limits<double>::infinity();
  return index;
}

void WideFrontier::drop_leaf(std::uint32_t leaf) {
  leaf_expiry_[leaf] = std::numeric_limits<double>::infinity();
  free_leaves_.push_back(leaf);
}

void WideFrontier::drop_record(std::uint32_t record) {
  dropping_.push_back(record);
  while (!dropping_.empty()) {
    const std::uint32_t index = dropping_.back();
    dropping_.pop_back();
    const Record& dropped = records_[index];
    for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
      if ((dropped.opened_lanes >> lane & 1u) != 0) dropping_.push_back(dropped.below[lane]);
      if ((dropped.lmd_lanes >> lane & 1u) != 0) drop_leaf(dropped.below[lane]);
      if ((dropped.touch_lanes >> lane & 1u) != 0) drop_leaf(dropped.touching[lane]);
    }
    record_expiry_[index] = std::numeric_limits<double>::infinity();
    free_records_.push_back(index);
  }
}

void WideFrontier::test(const Work& work, std::uint32_t record) {
  const std::uint32_t slot_a = records_[record].slot_a, slot_b = records_[record].slot_b;
  const WideOpening opening = choose_opening(work.a, work.b, slot_a, slot_b);
  const WideNode& home =
      opening.open_a ? work.b.nodes[slot_b / WIDE_WIDTH] : work.a.nodes[slot_a / WIDE_WIDTH];
  const std::uint32_t home_lane = (opening.open_a ? slot_b : slot_a) % WIDE_WIDTH;
  const WideNode& node = (opening.open_a ? work.a : work.b).nodes[opening.node];
  const WideProbe probe = make_probe(home, home_lane, opening.open_a ? work.query.b_in_a : work.query.a_in_b);
  const WideRef probe_ref = WideRef::from_bits(home.child[home_lane]);

  std::uint32_t features = 0, faces = 0;
  for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
    const WideRef child = WideRef::from_bits(node.child[lane]);
    features |= static_cast<std::uint32_t>(child.is_feature()) << lane;
    faces |= static_cast<std::uint32_t>(child.is_face()) << lane;
  }
  const bool may_touch = !probe_ref.is_feature() || probe_ref.is_face();
  const std::uint32_t touch_lanes = may_touch ? faces | (0xFFu & ~features) : 0u;
  const WideSlackMasks masks =
      test_lanes_slack(node, probe, work.query.limits, work.lever, work.horizon, touch_lanes);
  ++work.counters.node_tests;
  work.counters.node_pairs += static_cast<std::uint64_t>(std::popcount(masks.used));
  record_expiry_[record] = clock_ + static_cast<double>(masks.slack);

  const std::uint32_t final_lanes = probe_ref.is_feature() ? features : 0u;
  const std::uint32_t opened = (masks.lmd | masks.touch) & ~final_lanes;
  const std::uint32_t lmd = masks.lmd & final_lanes, touch = masks.touch & final_lanes;
  const auto slot_of = [&](std::uint32_t lane) { return opening.node * WIDE_WIDTH + lane; };
  const auto pair_of = [&](std::uint32_t lane) {
    const WideRef child = WideRef::from_bits(node.child[lane]);
    return opening.open_a ? WidePair{child, probe_ref} : WidePair{probe_ref, child};
  };
  for (std::uint32_t change = opened ^ records_[record].opened_lanes; change != 0; change &= change - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(change));
    if ((opened >> lane & 1u) == 0) {
      drop_record(records_[record].below[lane]);
    } else {
      const std::uint32_t added =
          opening.open_a ? add_record(slot_of(lane), slot_b) : add_record(slot_a, slot_of(lane));
      records_[record].below[lane] = added;
    }
  }
  for (std::uint32_t change = lmd ^ records_[record].lmd_lanes; change != 0; change &= change - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(change));
    if ((lmd >> lane & 1u) == 0) {
      drop_leaf(records_[record].below[lane]);
    } else {
      records_[record].below[lane] = add_leaf(pair_of(lane), false);
    }
  }
  for (std::uint32_t change = touch ^ records_[record].touch_lanes; change != 0; change &= change - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(change));
    if ((touch >> lane & 1u) == 0) {
      drop_leaf(records_[record].touching[lane]);
    } else {
      records_[record].touching[lane] = add_leaf(pair_of(lane), true);
    }
  }
  records_[record].opened_lanes = opened;
  records_[record].lmd_lanes = lmd;
  records_[record].touch_lanes = touch;
}

void WideFrontier::test_new(const Work& work) {
  while (!untested_.empty()) {
    const std::uint32_t record = untested_.back();
    untested_.pop_back();
    test(work, record);
  }
}

void WideFrontier::start(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query, double lever,
                         double horizon, WideCounters& counters) {
  clear();
  const Work work{a, b, query, static_cast<float>(lever), static_cast<float>(horizon), counters};
  add_record(0, 0);
  test_new(work);
}

void WideFrontier::advance(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                           double lever, double horizon, double motion, WideCounters& counters) {
  const Work work{a, b, query, static_cast<float>(lever), static_cast<float>(horizon), counters};
  clock_ += motion;
  for (std::uint32_t record = 0; record < record_expiry_.size(); ++record) {
    if (!(record_expiry_[record] < clock_)) continue;
    test(work, record);
    test_new(work);
  }
}

}  // namespace lmdbench
