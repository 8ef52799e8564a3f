// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/methods/certified/keep/certificate_queue.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace lmdbench {

namespace {

/// Plans end earlier by this part: rounding of single precision.
constexpr double FRAME_ROUNDING = 1e-4;
/// Most of what is kept begins in one frame and is valid for longer than any plan. The longest
/// plans differ by half, in so many steps, so that they do not all end in one frame.
constexpr double SPREAD_OF_ENDS = 0.5;
constexpr std::uint32_t ENDS = 16, TOGETHER = 64;

}  // namespace

std::uint32_t CertificateQueue::class_of(double deviation, const MotionForecast& forecast) {
  // The exponent and the first bit of the mantissa. Negative numbers are in the lowest class.
  constexpr int SHIFT = std::numeric_limits<float>::digits - 2;
  constexpr int HIGHEST = static_cast<int>(CLASSES) - 1, OF_HIGHEST = std::bit_cast<int>(1.0F) >> SHIFT;
  const int bits = std::bit_cast<int>(static_cast<float>(deviation / forecast.extent())) >> SHIFT;
  return static_cast<std::uint32_t>(std::clamp(bits - OF_HIGHEST + HIGHEST, 0, HIGHEST));
}

void CertificateQueue::clear() {
  frames_.clear();
  epochs_.clear();
  classes_.clear();
  free_.clear();
  least_class_.fill(CLASSES);
}

std::uint32_t CertificateQueue::add() {
  if (free_.empty()) {
    if (frames_.size() == frames_.capacity()) {
      // By an eighth: doubled they would be empty by half in a pile.
      const std::size_t room = frames_.size() + frames_.size() / 8 + 16;
      for (std::vector<std::uint8_t>* of_all : {&frames_, &epochs_, &classes_}) of_all->reserve(room);
    }
    frames_.push_back(NO_FRAME);
    epochs_.push_back(NO_EPOCH);
    classes_.push_back(0);
    return static_cast<std::uint32_t>(frames_.size() - 1);
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  return index;
}

void CertificateQueue::drop(std::uint32_t index) {
  LMDBENCH_EXPECTS(index < frames_.size() && count() > 0, "a thing dropped twice");
  frames_[index] = NO_FRAME;
  epochs_[index] = NO_EPOCH;
  free_.push_back(index);
}

void CertificateQueue::plan(std::uint32_t index, double frames, double deviation_budget,
                            const MotionForecast& forecast) {
  LMDBENCH_EXPECTS(!std::isnan(frames) && !std::isnan(deviation_budget),
                   "a certificate whose slack or gradient is not a number");
  const double longest =
      forecast.longest_plan() * (1.0 - SPREAD_OF_ENDS / ENDS * static_cast<double>(index / TOGETHER % ENDS));
  const double whole = std::clamp(frames * (1.0 - FRAME_ROUNDING), 0.0, longest);
  end_at(index, forecast.frame() + 1 + static_cast<std::uint32_t>(whole));
  const std::size_t epoch = forecast.epoch();
  const std::uint32_t budget_class =
      class_of((deviation_budget - forecast.used_at_start()) * (1.0 - FRAME_ROUNDING), forecast);
  epochs_[index] = static_cast<std::uint8_t>(epoch);
  classes_[index] = static_cast<std::uint8_t>(budget_class);
  least_class_[epoch] = std::min(least_class_[epoch], budget_class);
}

void CertificateQueue::collect(const MotionForecast& forecast, std::vector<std::uint32_t>& due,
                               Scratch& scratch) {
  using Eight = std::uint64_t;
  const std::size_t count = frames_.size();
  // The last eight may read beyond the end. Memory grows with the plans alone.
  scratch.is_due.reserve(frames_.capacity() + sizeof(Eight));
  scratch.is_due.assign(count + sizeof(Eight), 0);
  due.reserve(frames_.capacity());
  scratch.others.reserve(frames_.capacity());
  // Plain loops over local pointers, which the compiler vectorises.
  std::uint8_t* const frames = frames_.data();
  std::uint8_t* const epochs = epochs_.data();
  const std::uint8_t* const classes = classes_.data();
  std::uint8_t* const is_due = scratch.is_due.data();
  const auto now = static_cast<std::uint8_t>(forecast.frame() % FRAMES);
  for (std::size_t i = 0; i < count; ++i) is_due[i] = frames[i] == now;
  for (std::size_t epoch = 0; epoch < MotionForecast::EPOCHS; ++epoch) {
    if (least_class_[epoch] == CLASSES) continue;
    const std::uint32_t reached = class_of(forecast.deviation(epoch), forecast);
    if (least_class_[epoch] > reached) continue;
    least_class_[epoch] = reached + 1;
    const auto of_epoch = static_cast<std::uint8_t>(epoch), up_to = static_cast<std::uint8_t>(reached);
    for (std::size_t i = 0; i < count; ++i)
      is_due[i] |= static_cast<std::uint8_t>((epochs[i] == of_epoch) & (classes[i] <= up_to));
  }
  // First the pairs without a budget, as crossing pairs: together they are predicted well.
  due.clear();
  scratch.others.clear();
  for (std::size_t begin = 0; begin < count; begin += sizeof(Eight)) {
    Eight eight = 0;
    std::memcpy(&eight, is_due + begin, sizeof(eight));
    for (; eight != 0; eight &= eight - 1) {
      const std::size_t index = begin + static_cast<std::size_t>(std::countr_zero(eight)) / 8;
      (epochs[index] == NO_EPOCH ? due : scratch.others).push_back(static_cast<std::uint32_t>(index));
      frames[index] = NO_FRAME;
      epochs[index] = NO_EPOCH;
    }
  }
  due.insert(due.end(), scratch.others.begin(), scratch.others.end());
}

}  // namespace lmdbench
