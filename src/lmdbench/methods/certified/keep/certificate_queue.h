// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>
#include <lmdbench/methods/certified/keep/motion_forecast.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// Things that must be done again after a number of frames, if the motion goes as forecast, or as soon as it
/// deviates too far. Named by indices, which are used again once dropped.
///
/// Who is due is found by a look at everyone, many at a time: cheaper than lists, whose links lead all over the memory, and what
/// is due comes in the order in which it lies there.
class CertificateQueue {
 public:
  CertificateQueue() { least_class_.fill(CLASSES); }

  void clear();
  std::size_t size() const { return frames_.size(); }  ///< Indices are below this.
  std::size_t count() const { return frames_.size() - free_.size(); }

  /// A new thing, without a plan.
  std::uint32_t add();
  void drop(std::uint32_t index);

  /// @param frames    of the forecast after which the thing is due; at least the next frame is
  /// @param deviation_budget deviation that it stands [m]
  /// @param forecast  the same one, not reset, until everything is forgotten
  void plan(std::uint32_t index, double frames, double deviation_budget, const MotionForecast& forecast);
  /// In the forecast's frame, which is not collected yet.
  void plan_now(std::uint32_t index, const MotionForecast& forecast) { end_at(index, forecast.frame()); }
  /// In the next frame, whatever the motion.
  void plan_next(std::uint32_t index, const MotionForecast& forecast) { end_at(index, forecast.frame() + 1); }

  /// What is due at the forecast's frame, which is then without a plan. Every frame must be collected.
  void collect(const MotionForecast& forecast, std::vector<std::uint32_t>& due);

 private:
  /// More than the longest plan, and a power of two.
  static constexpr std::uint32_t FRAMES = 64;
  static_assert(MotionForecast::LONGEST_PLAN + 1 < FRAMES);
  /// Classes of budgets, two an octave, from the forecast's extent down to 6e-8 of it: when a deviation reaches a class, its plans
  /// end.
  static constexpr std::uint32_t CLASSES = 48;
  static std::uint32_t class_of(double deviation, const MotionForecast& forecast);

  void end_at(std::uint32_t index, std::uint32_t frame) {
    LMDBENCH_EXPECTS(index < frames_.size(), "a thing of another queue");
    frames_[index] = static_cast<std::uint8_t>(frame % FRAMES);
  }

  // Of every index that was ever given: the frame in which its plan ends, modulo FRAMES, and epoch * CLASSES + class of its budget.
  static constexpr std::uint8_t NO_FRAME = FRAMES;
  static constexpr std::uint16_t NO_BUDGET = MotionForecast::EPOCHS * CLASSES;
  std::vector<std::uint8_t> frames_;
  std::vector<std::uint16_t> budgets_;
  std::array<std::uint32_t, MotionForecast::EPOCHS> least_class_;  ///< Of an epoch's budgets, or less.
  std::vector<std::uint32_t> free_;
  std::vector<std::uint8_t> is_due_;   ///< Scratch.
  std::vector<std::uint32_t> others_;  ///< Scratch.
};

}  // namespace lmdbench
