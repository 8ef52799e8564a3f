// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/methods/certified/coherence/certificate_queue.h>

#include <algorithm>
#include <limits>

namespace lmdbench {

namespace {

constexpr float UNLIMITED = std::numeric_limits<float>::infinity();
/// Plans end earlier by this part: rounding of single precision.
constexpr double FRAME_ROUNDING = 1e-4;
/// When a deviation ends plans, it ends those as well that would stand little more: looking at the others of
/// the epoch again a frame later costs more.
constexpr float HEADROOM = 1.5F;

}  // namespace

void CertificateQueue::clear() {
  budgets_.clear();
  free_.clear();
  by_frame_.clear();
  next_.clear();
  place_in_next_.clear();
  by_epoch_.clear();
  least_budgets_.fill(UNLIMITED);
}

std::uint32_t CertificateQueue::add() {
  if (free_.empty()) {
    budgets_.push_back(UNLIMITED);
    by_frame_.add();
    by_epoch_.add();
    place_in_next_.push_back(NONE);
    return static_cast<std::uint32_t>(budgets_.size() - 1);
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  return index;
}

void CertificateQueue::drop(std::uint32_t index) {
  LMDBENCH_EXPECTS(index < budgets_.size() && count() > 0, "a thing dropped twice");
  by_frame_.remove(index);
  by_epoch_.remove(index);
  if (place_in_next_[index] != NONE) next_[place_in_next_[index]] = NONE;
  place_in_next_[index] = NONE;
  free_.push_back(index);
}

void CertificateQueue::plan(std::uint32_t index, double frames, double deviation_budget,
                            const MotionForecast& forecast) {
  LMDBENCH_EXPECTS(index < budgets_.size(), "a thing of another queue");
  LMDBENCH_EXPECTS(!std::isnan(frames) && !std::isnan(deviation_budget),
                   "a certificate whose slack or gradient is not a number");
  const double whole = std::clamp(frames * (1.0 - FRAME_ROUNDING), 0.0, forecast.longest_plan());
  if (whole < 1.0) {
    plan_next(index);
    return;
  }
  by_frame_.move_to(index, (forecast.frame() + 1 + static_cast<std::uint32_t>(whole)) % FRAMES);
  const std::size_t epoch = forecast.epoch();
  by_epoch_.move_to(index, static_cast<std::uint32_t>(epoch));
  budgets_[index] =
      static_cast<float>((deviation_budget - forecast.used_at_start()) * (1.0 - FRAME_ROUNDING));
  least_budgets_[epoch] = std::min(least_budgets_[epoch], budgets_[index]);
}

void CertificateQueue::collect(const MotionForecast& forecast, std::vector<std::uint32_t>& due) {
  for (std::size_t epoch = 0; epoch < MotionForecast::EPOCHS; ++epoch) {
    const auto deviation = static_cast<float>(forecast.deviation(epoch));
    if (!(deviation > least_budgets_[epoch])) continue;
    const float limit = deviation * HEADROOM;
    float least = UNLIMITED;
    by_epoch_.for_each(static_cast<std::uint32_t>(epoch), [&](std::uint32_t index) {
      if (budgets_[index] < limit) {
        plan_now(index, forecast);
      } else {
        least = std::min(least, budgets_[index]);
      }
    });
    least_budgets_[epoch] = least;
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
    by_epoch_.remove(index);
    due.push_back(index);
  });
}

}  // namespace lmdbench
