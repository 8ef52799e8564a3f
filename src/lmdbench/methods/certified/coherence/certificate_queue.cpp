// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/methods/certified/coherence/certificate_queue.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lmdbench {

namespace {

/// Plans end earlier by this part: rounding of single precision.
constexpr double FRAME_ROUNDING = 1e-4;

}  // namespace

std::uint32_t CertificateQueue::class_of(double deviation, const MotionForecast& forecast) {
  // The exponent and the first bit of the mantissa; what is negative has the sign's bit.
  constexpr int SHIFT = std::numeric_limits<float>::digits - 2;
  constexpr int HIGHEST = static_cast<int>(CLASSES) - 1, OF_HIGHEST = std::bit_cast<int>(1.0F) >> SHIFT;
  const int bits = std::bit_cast<int>(static_cast<float>(deviation / forecast.reach())) >> SHIFT;
  return static_cast<std::uint32_t>(std::clamp(bits - OF_HIGHEST + HIGHEST, 0, HIGHEST));
}

void CertificateQueue::clear() {
  if (size_ == 0) return;
  size_ = 0;
  free_.clear();
  by_frame_.clear();
  next_.clear();
  place_in_next_.clear();
  by_class_.clear();
  least_class_.fill(CLASSES);
}

std::uint32_t CertificateQueue::add() {
  if (free_.empty()) {
    by_frame_.add();
    by_class_.add();
    place_in_next_.push_back(NONE);
    return size_++;
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  return index;
}

void CertificateQueue::drop(std::uint32_t index) {
  LMDBENCH_EXPECTS(index < size_ && count() > 0, "a thing dropped twice");
  by_frame_.remove(index);
  by_class_.remove(index);
  if (place_in_next_[index] != NONE) next_[place_in_next_[index]] = NONE;
  place_in_next_[index] = NONE;
  free_.push_back(index);
}

void CertificateQueue::plan(std::uint32_t index, double frames, double deviation_budget,
                            const MotionForecast& forecast) {
  LMDBENCH_EXPECTS(index < size_, "a thing of another queue");
  LMDBENCH_EXPECTS(!std::isnan(frames) && !std::isnan(deviation_budget),
                   "a certificate whose slack or gradient is not a number");
  const double whole = std::clamp(frames * (1.0 - FRAME_ROUNDING), 0.0, forecast.longest_plan());
  if (whole < 1.0) {
    plan_next(index);
    return;
  }
  by_frame_.move_to(index, (forecast.frame() + 1 + static_cast<std::uint32_t>(whole)) % FRAMES);
  const std::size_t epoch = forecast.epoch();
  const std::uint32_t budget_class =
      class_of((deviation_budget - forecast.used_at_start()) * (1.0 - FRAME_ROUNDING), forecast);
  by_class_.move_to(index, static_cast<std::uint32_t>(epoch) * CLASSES + budget_class);
  least_class_[epoch] = std::min(least_class_[epoch], budget_class);
}

void CertificateQueue::collect(const MotionForecast& forecast, std::vector<std::uint32_t>& due) {
  for (std::size_t epoch = 0; epoch < MotionForecast::EPOCHS; ++epoch) {
    if (least_class_[epoch] == CLASSES) continue;
    const std::uint32_t reached = class_of(forecast.deviation(epoch), forecast);
    for (; least_class_[epoch] <= reached; ++least_class_[epoch])
      by_class_.for_each(static_cast<std::uint32_t>(epoch) * CLASSES + least_class_[epoch],
                         [&](std::uint32_t index) { plan_now(index, forecast); });
  }
  due.clear();
  for (const std::uint32_t index : next_) {
    if (index == NONE) continue;
    place_in_next_[index] = NONE;
    due.push_back(index);
  }
  next_.clear();
  by_frame_.for_each(forecast.frame() % FRAMES, [&](std::uint32_t index) {
    by_frame_.remove(index);
    by_class_.remove(index);
    due.push_back(index);
  });
}

}  // namespace lmdbench
