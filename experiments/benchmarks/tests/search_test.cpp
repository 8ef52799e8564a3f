// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/global_search/implementation.h>
#include <gtest/gtest.h>
#include <support/tests/shapes_setting.h>

#include <set>

namespace lmdbench::experiments {
namespace {

TEST(GlobalSearches, KeepTheirPromises) {
  const Setting setting = shapes_setting(0.3, 6);
  std::set<std::string> names;
  for (const SearchImplementation& implementation : search_implementations()) {
    EXPECT_TRUE(names.insert(implementation.name).second) << implementation.name;
    const auto search = implementation.make(setting.scene);
    const LmdError error = check_search(implementation, *search, setting.scene, setting.poses, setting.truth);
    EXPECT_EQ(error.objection, "") << implementation.name;
    if (implementation.promise != Promise::APPROXIMATION) {
      EXPECT_EQ(error.minimum_missed, 0U) << implementation.name;
    }
  }
}

TEST(GlobalSearches, AreCheckedAtEveryPose) {
  const Setting setting = shapes_setting(0.3, 6);
  SearchImplementation lying = method_search("improved");
  lying.promise = Promise::COMPLETE_SET;
  const auto search = lying.make(setting.scene);
  EXPECT_NE(check_search(lying, *search, setting.scene, setting.poses, setting.truth).objection, "")
      << "candidates are no LMD set";
}

}  // namespace
}  // namespace lmdbench::experiments
