// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>
#include <lmdbench/methods/certified/coherence/index_lists.h>
#include <lmdbench/methods/certified/coherence/motion_forecast.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// Things that must be done again after a number of frames, if the motion goes as forecast, or as soon as it
/// deviates too far. Named by indices, which are used again once dropped.
class CertificateQueue {
 public:
  CertificateQueue() { clear(); }

  void clear();
  std::size_t count() const { return budgets_.size() - free_.size(); }

  /// A new thing, without a plan.
  std::uint32_t add();
  void drop(std::uint32_t index);

  /// @param frames    of the forecast after which the thing is due; at least the next frame is
  /// @param deviation_budget deviation that it stands [m]
  void plan(std::uint32_t index, double frames, double deviation_budget, const MotionForecast& forecast);
  /// In the forecast's frame, which is not collected yet.
  void plan_now(std::uint32_t index, const MotionForecast& forecast) {
    LMDBENCH_EXPECTS(index < budgets_.size(), "a thing of another queue");
    if (place_in_next_[index] == NONE) by_frame_.move_to(index, forecast.frame() % FRAMES);
  }

  /// In the next frame, whatever the motion.
  /// @pre not planned yet, or collected or dropped since
  void plan_next(std::uint32_t index) {
    LMDBENCH_EXPECTS(place_in_next_[index] == NONE, "planned twice: it would be decided twice");
    place_in_next_[index] = static_cast<std::uint32_t>(next_.size());
    next_.push_back(index);
  }

  /// What is due at the forecast's frame. Every frame must be collected.
  void collect(const MotionForecast& forecast, std::vector<std::uint32_t>& due);

 private:
  /// More than the longest plan, and a power of two.
  static constexpr std::uint32_t FRAMES = 64;
  static_assert(MotionForecast::LONGEST_PLAN + 1 < FRAMES);
  static constexpr std::uint32_t NONE = 0xFFFFFFFFU;

  std::vector<float> budgets_;  ///< Deviations from their epoch's forecast that plans stand [m].
  std::vector<std::uint32_t> free_;
  IndexLists by_frame_{FRAMES};
  /// Due in the next frame whatever the motion: in deep contact thousands are, frame after frame, and lists that
  /// lose any of their links at any time would cost more than the decisions.
  std::vector<std::uint32_t> next_, place_in_next_;
  IndexLists by_epoch_{static_cast<std::uint32_t>(MotionForecast::EPOCHS)};
  std::array<float, MotionForecast::EPOCHS> least_budgets_{};  ///< Over the plans of an epoch, or less.
};

}  // namespace lmdbench
