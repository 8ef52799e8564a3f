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

/// Tests and decisions that are to be repeated ("due"), by index. Dropped indices are reused.
/// 1. `plan` gives one a last frame, if the motion goes on as forecast, and a budget of deviation.
/// 2. `collect` finds all whose frame has come, or whose budget the deviation of their epoch has
///    reached (PROOF.md, lemma 17). It scans all, which is cheaper than lists all over the memory.
class CertificateQueue {
 public:
  CertificateQueue() { least_class_.fill(CLASSES); }

  void clear();
  std::size_t size() const { return frames_.size(); }  ///< Indices are below this.
  std::size_t count() const { return frames_.size() - free_.size(); }

  std::uint32_t add();
  void drop(std::uint32_t index);

  /// @param frames  of the forecast for which it is valid; it is due in the first frame after these
  /// @param deviation_budget  up to which it is valid [m]
  /// @param forecast  always the same one, not reset before `clear`
  void plan(std::uint32_t index, double frames, double deviation_budget, const MotionForecast& forecast);
  /// Due in the forecast's frame, which is not collected yet.
  void plan_now(std::uint32_t index, const MotionForecast& forecast) { end_at(index, forecast.frame()); }
  /// Due in the next frame, whatever the motion.
  void plan_next(std::uint32_t index, const MotionForecast& forecast) { end_at(index, forecast.frame() + 1); }

  /// Memory of `collect` alone: queues lend it to each other.
  struct Scratch {
    std::vector<std::uint8_t> is_due;
    std::vector<std::uint32_t> others;
  };
  /// Finds all that are due in the forecast's frame and ends their plans. To be called every frame.
  void collect(const MotionForecast& forecast, std::vector<std::uint32_t>& due, Scratch& scratch);

 private:
  /// More than the longest plan, and a power of two.
  static constexpr std::uint32_t FRAMES = 64;
  static_assert(MotionForecast::LONGEST_PLAN + 1 < FRAMES);
  /// Classes of budgets, two an octave, from the forecast's extent down to 6e-8 of it. A deviation
  /// that reaches a class ends its plans.
  static constexpr std::uint32_t CLASSES = 48;
  static std::uint32_t class_of(double deviation, const MotionForecast& forecast);

  void end_at(std::uint32_t index, std::uint32_t frame) {
    LMDBENCH_EXPECTS(index < frames_.size(), "a thing of another queue");
    frames_[index] = static_cast<std::uint8_t>(frame % FRAMES);
  }

  // By index: the frame in which its plan ends, modulo FRAMES; epoch and class of its budget.
  static constexpr std::uint8_t NO_FRAME = FRAMES, NO_EPOCH = MotionForecast::EPOCHS;
  std::vector<std::uint8_t> frames_, epochs_, classes_;
  /// By epoch: lower bound of its budgets' classes.
  std::array<std::uint32_t, MotionForecast::EPOCHS> least_class_;
  std::vector<std::uint32_t> free_;
};

}  // namespace lmdbench
