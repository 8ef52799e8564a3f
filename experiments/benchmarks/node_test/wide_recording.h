// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/keep/wide_lifetime.h>

#include <benchmarks/node_test/implementation.h>

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace lmdbench::experiments {

/// A test of one child of a wide node against the eight of another, in a search.
struct WideTest {
  const WideNode* node = nullptr;
  WideProbe probe{};
  WideLimits limits{};
  std::uint32_t touch_lanes = 0;  ///< Lanes for which touch matters.
  std::uint32_t used = 0;         ///< Lanes in use.
  std::uint32_t needed = 0;       ///< Lanes below which, with the probe, a true LMD is.
  std::size_t pose = 0;
};

/// The tests of all poses. The setting's bodies must outlive them.
std::vector<WideTest> record_wide_tests(const Setting& setting);

/// A form of the wide node test on a recording.
/// @tparam Test      WideTest -> masks with `lmd` and `touch`
/// @tparam Reference the same, slower and trusted
template <class Test, class Reference>
class WideNodeTest : public NodeTest {
 public:
  WideNodeTest(const Setting& setting, Test test, Reference reference)
      : scene_(setting.scene),
        tests_(record_wide_tests(setting)),
        survivors_(tests_.size()),
        test_(std::move(test)),
        reference_(std::move(reference)) {}

  void run() override {
    for (std::size_t i = 0; i < tests_.size(); ++i) {
      const auto masks = test_(tests_[i]);
      survivors_[i] = masks.lmd | (masks.touch & tests_[i].touch_lanes);
    }
  }
  std::size_t pair_count() const override {
    std::size_t count = 0;
    for (const WideTest& test : tests_) count += static_cast<std::size_t>(std::popcount(test.used));
    return count;
  }
  std::size_t survivor_count() const override {
    std::size_t count = 0;
    for (const std::uint32_t lanes : survivors_) count += static_cast<std::size_t>(std::popcount(lanes));
    return count;
  }
  std::size_t needed_count() const override {
    std::size_t count = 0;
    for (const WideTest& test : tests_) count += static_cast<std::size_t>(std::popcount(test.needed));
    return count;
  }
  std::string objection() override {
    run();
    for (std::size_t i = 0; i < tests_.size(); ++i) {
      const std::string where = "test " + std::to_string(i) + " at pose " + std::to_string(tests_[i].pose);
      if (!same(test_(tests_[i]), reference_(tests_[i]))) return where + ": not the bits of the scalar form";
      if ((tests_[i].needed & ~survivors_[i]) != 0) return where + ": rejects a child that holds an LMD";
    }
    return {};
  }

 private:
  static bool same(const WideMasks& a, const WideMasks& b) {
    return a.lmd == b.lmd && a.touch == b.touch && a.used == b.used && a.beyond == b.beyond &&
           a.not_collinear == b.not_collinear;
  }
  static bool same(const WideLifetimes& a, const WideLifetimes& b) {
    return a.used == b.used && a.lmd == b.lmd && a.touch == b.touch && a.frames == b.frames &&
           a.deviation_budget == b.deviation_budget;
  }

  Scene scene_;  ///< Keeps the nodes alive.
  std::vector<WideTest> tests_;
  std::vector<std::uint32_t> survivors_;
  Test test_;
  Reference reference_;
};

template <class Test, class Reference>
NodeTestImplementation wide_node_test(const std::string& name, Test test, Reference reference) {
  return {name, [test, reference](const Setting& setting) {
            return std::make_unique<WideNodeTest<Test, Reference>>(setting, test, reference);
          }};
}

}  // namespace lmdbench::experiments
