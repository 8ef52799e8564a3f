// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/keep/traversal_front.h>
#include <lmdbench/methods/certified/layout/wide_lane.h>
#include <lmdbench/methods/certified/traverse/wide_lanes.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace lmdbench {

namespace {

/// Losses are at least this, so that nothing is divided by zero [m].
constexpr double LEAST_LOSS = 1e-30;

/// What links to the entry of a list that has an entry before it for each of these bits, or ends
/// the list there.
template <class Entry>
std::uint32_t& link_after(std::uint32_t before, SteadyArray<Entry>& entries, std::uint32_t& first) {
  std::uint32_t* link = &first;
  for (; before != 0; before &= before - 1) link = &entries[*link].next;
  return *link;
}

}  // namespace

void TraversalFront::clear() {
  test_queue_.clear();
  leaf_queue_.clear();
  requested_.clear();
}

std::uint32_t TraversalFront::add_record(const WideHierarchy& a, const WideHierarchy& b, std::uint32_t slot_a,
                                         std::uint32_t slot_b) {
  const std::uint32_t index = test_queue_.add();
  const WideKeptPair pair(a, b, slot_a, slot_b);
  if (index == records_.size()) {
    pairs_.push_back(pair);
    records_.push_back({});
  } else {
    pairs_[index] = pair;
    records_[index] = Record{};
  }
  requested_.push_back(index);
  return index;
}

std::uint32_t TraversalFront::add_leaf(const Work& work, std::uint32_t slot_a, const WidePair& pair,
                                       bool touches) {
  const std::uint32_t index = leaf_queue_.add();
  if (index == leaves_.size()) leaves_.push_back({});
  leaves_[index] = {pair, slot_a, NONE, touches};
  leaf_queue_.plan_now(index, work.motion);
  return index;
}

void TraversalFront::plan_leaf(const WideHierarchy& a, const MotionForecast& motion, std::uint32_t index,
                               const Certificate& certificate) {
  if (!(certificate.slack > 0.0 && certificate.turn > 0.0)) {
    leaf_queue_.plan_next(index, motion);
    return;
  }
  const Leaf& leaf = leaves_[index];
  const Vec3 c = centre_of_lane(a.nodes[leaf.slot_a / WIDE_WIDTH], leaf.slot_a % WIDE_WIDTH);
  const Vec3 velocity = motion.turn() * c + motion.origin_velocity();
  const double loss = certificate.gradient.dot(velocity) + certificate.spread * velocity.norm() +
                      certificate.lever_arm * motion.spin() + (1.0 + certificate.spread) * motion.creep();
  // As in the node test: a deviation moves the centre and turns the mesh (PROOF.md, lemma 18).
  const double weight =
      std::max(1.0 + certificate.spread,
               ((1.0 + certificate.spread) * c.norm() + certificate.lever_arm) / motion.extent());
  const auto frames_of = [&](double slack, double loss_a_frame) {
    const double wanted = (slack * (1.0 - static_cast<double>(DEVIATION_SHARE)) - motion.base()) /
                          (loss_a_frame + motion.drift());
    return std::min(std::max(wanted, static_cast<double>(LEAST_SHARE) * slack / loss_a_frame),
                    static_cast<double>(MotionForecast::LONGEST_PLAN));
  };
  const double turn = certificate.turn * motion.extent();
  const double loss_of_length = std::max(loss, LEAST_LOSS);
  const double loss_of_turn = std::max(motion.spin() * motion.extent(), LEAST_LOSS);
  const double frames = std::min(frames_of(certificate.slack, loss_of_length), frames_of(turn, loss_of_turn));
  const double deviation_budget =
      std::min((certificate.slack - loss_of_length * frames) / weight, turn - loss_of_turn * frames);
  leaf_queue_.plan(index, frames, deviation_budget, motion);
}

void TraversalFront::drop_leaves(const Record& record) {
  for (std::uint32_t leaf = record.first_leaf; leaf != NONE; leaf = leaves_[leaf].next)
    leaf_queue_.drop(leaf);
}

void TraversalFront::drop_records(std::uint32_t first) {
  while (first != NONE) {
    Record& record = records_[first];
    drop_leaves(record);
    record.state = State::UNUSED;
    test_queue_.drop(first);
    // Those below it come before those after it.
    link_after(record.opened_lanes, records_, record.first_below) = record.next;
    first = record.first_below;
  }
}

void TraversalFront::follow(const WideHierarchy& a, std::uint32_t seen_a, const WideHierarchy& b,
                            std::uint32_t seen_b, const MotionForecast& motion) {
  if (a.changes.now == seen_a && b.changes.now == seen_b) return;
  for (std::uint32_t i = 0; i < test_queue_.size(); ++i) {
    Record& record = records_[i];
    if (record.state == State::UNUSED) continue;
    const WideKeptPair& pair = pairs_[i];
    const WideHierarchy &opened = pair.open_a ? a : b, &other = pair.open_a ? b : a;
    const std::uint32_t seen_opened = pair.open_a ? seen_a : seen_b,
                        seen_other = pair.open_a ? seen_b : seen_a;
    if (!opened.changes.bounds_after(pair.node, seen_opened) &&
        !other.changes.bounds_after(pair.other_slot() / WIDE_WIDTH, seen_other))
      continue;
    // Where the other child is a new one, the record that opened its node drops this pair.
    if (opened.changes.lanes_after(pair.node, seen_opened)) {
      drop_leaves(record);
      drop_records(record.first_below);
      record.first_below = record.first_leaf = NONE;
      record.opened_lanes = record.leaf_lanes = 0;
    }
    test_queue_.plan_now(i, motion);
    for (std::uint32_t leaf = record.first_leaf; leaf != NONE; leaf = leaves_[leaf].next)
      leaf_queue_.plan_now(leaf, motion);
  }
}

void TraversalFront::apply(const Work& work, const WideKeptTest& test) {
  const std::uint32_t index = test.pair;
  test_queue_.plan(index, static_cast<double>(test.frames), static_cast<double>(test.deviation_budget),
                   work.motion);
  ++work.counters.node_tests;
  work.counters.node_pairs += LANE_LISTS[test.used].count;

  const std::uint32_t leaf_lanes = test.lmd | test.touch << WIDE_WIDTH;
  Record& record = records_[index];
  std::uint32_t change_opened = test.opened ^ record.opened_lanes,
                change_leaves = leaf_lanes ^ record.leaf_lanes;
  if ((change_opened | change_leaves) == 0) return;
  const WideKeptPair& pair = pairs_[index];
  const std::uint32_t first_slot = pair.node * WIDE_WIDTH;
  const auto slot_a_of = [&](std::uint32_t lane) { return pair.open_a ? first_slot + lane : pair.slot_a; };
  const auto slot_b_of = [&](std::uint32_t lane) { return pair.open_a ? pair.slot_b : first_slot + lane; };
  const auto ref = [](const WideHierarchy& hierarchy, std::uint32_t slot) {
    return WideRef::from_bits(hierarchy.nodes[slot / WIDE_WIDTH].child[slot % WIDE_WIDTH]);
  };
  const auto pair_of = [&](std::uint32_t lane) {
    return WidePair{ref(work.a, slot_a_of(lane)), ref(work.b, slot_b_of(lane))};
  };
  for (; change_opened != 0; change_opened &= change_opened - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(change_opened));
    const std::uint32_t before = std::uint32_t{record.opened_lanes} >> (lane + 1);
    if ((test.opened >> lane & 1u) == 0) {
      std::uint32_t& link = link_after(before, records_, record.first_below);
      drop_records(std::exchange(link, std::exchange(records_[link].next, NONE)));
    } else {
      const std::uint32_t added = add_record(work.a, work.b, slot_a_of(lane), slot_b_of(lane));
      records_[added].next = std::exchange(link_after(before, records_, record.first_below), added);
    }
    record.opened_lanes ^= static_cast<std::uint8_t>(1u << lane);
  }
  for (; change_leaves != 0; change_leaves &= change_leaves - 1) {
    const auto bit = static_cast<std::uint32_t>(std::countr_zero(change_leaves)), lane = bit % WIDE_WIDTH;
    const std::uint32_t before = record.leaf_lanes & ((1u << bit) - 1);
    if ((leaf_lanes >> bit & 1u) == 0) {
      std::uint32_t& link = link_after(before, leaves_, record.first_leaf);
      leaf_queue_.drop(std::exchange(link, leaves_[link].next));
    } else {
      const std::uint32_t added = add_leaf(work, slot_a_of(lane), pair_of(lane), bit >= WIDE_WIDTH);
      leaves_[added].next = std::exchange(link_after(before, leaves_, record.first_leaf), added);
    }
    record.leaf_lanes ^= static_cast<std::uint16_t>(1u << bit);
  }
}

void TraversalFront::start(const WideHierarchy& a, const WideHierarchy& b) {
  clear();
  add_record(a, b, 0, 0);
}

std::size_t TraversalFront::collect_due_tests(const MotionForecast& motion, Scratch& scratch) {
  std::vector<std::uint32_t>& due = scratch.batch;
  test_queue_.collect(motion, due, scratch.queue);
  requested_.reserve(records_.capacity());  // As of the records: none is allocated later.
  for (const std::uint32_t index : due) records_[index].state = State::REQUESTED;
  requested_.insert(requested_.begin(), due.begin(), due.end());
  return due.size();
}

void TraversalFront::advance(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                             const MotionForecast& motion, const RigidTransform& X_BA, double search_distance,
                             std::size_t most, WideCounters& counters, Scratch& scratch) {
  std::vector<std::uint32_t>& batch = scratch.batch;
  const Work work{a, b, query, motion, WideForecast(motion, X_BA, search_distance), counters};
  while (!requested_.empty() && most > 0) {
    // An index that was dropped and reused while it waited is in the list twice.
    batch.clear();
    std::size_t taken = 0;
    while (taken < requested_.size() && batch.size() < most) {
      const std::uint32_t index = requested_[taken++];
      if (records_[index].state != State::REQUESTED) continue;
      records_[index].state = State::TESTED;
      batch.push_back(index);
    }
    requested_.erase(requested_.begin(), requested_.begin() + static_cast<std::ptrdiff_t>(taken));
    most -= batch.size();
    scratch.tests.reserve(batch.capacity());  // As of the batch: none is allocated later.
    test_batch(work.a, work.b, work.query, work.forecast, pairs_, batch, scratch.tests);
    for (const WideKeptTest& test : scratch.tests) {
      // Not where an earlier test of the batch dropped the pair, or gave its index to a new one.
      if (records_[test.pair].state == State::TESTED) apply(work, test);
    }
  }
}

}  // namespace lmdbench
