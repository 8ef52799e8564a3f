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
  CertificateQueue() { least_class_.fill(CLASSES); }

  void clear();
  std::size_t count() const { return size_ - free_.size(); }

  /// A new thing, without a plan.
  std::uint32_t add();
  void drop(std::uint32_t index);

  /// @param frames    of the forecast after which the thing is due; at least the next frame is
  /// @param deviation_budget deviation that it stands [m]
  /// @param forecast  the same one, not reset, until everything is forgotten
  void plan(std::uint32_t index, double frames, double deviation_budget, const MotionForecast& forecast);
  /// In the forecast's frame, which is not collected yet.
  void plan_now(std::uint32_t index, const MotionForecast& forecast) {
    LMDBENCH_EXPECTS(index < size_, "a thing of another queue");
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

  /// Classes of budgets, two an octave, from the forecast's reach down to 6e-8 of it: when a deviation reaches a class, its plans
  /// end, without a look at each.
  static constexpr std::uint32_t CLASSES = 48;
  static std::uint32_t class_of(double deviation, const MotionForecast& forecast);

  std::uint32_t size_ = 0;  ///< Indices that were ever given.
  std::vector<std::uint32_t> free_;
  IndexLists by_frame_{FRAMES};
  /// Due in the next frame whatever the motion: in deep contact thousands are, frame after frame, and lists that
  /// lose any of their links at any time would cost more than the decisions.
  std::vector<std::uint32_t> next_, place_in_next_;
  IndexLists by_class_{static_cast<std::uint32_t>(MotionForecast::EPOCHS) *
                       CLASSES};                                     ///< epoch * CLASSES + class
  std::array<std::uint32_t, MotionForecast::EPOCHS> least_class_{};  ///< Over the plans of an epoch, or less.
};

}  // namespace lmdbench
