// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/result/run_to_file.h>

#include "result_file/result_reading.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <judge/ledger.h>
#include <nlohmann/json.hpp>
#include <support/source_directory.h>

#include <algorithm>
#include <string>

namespace lmdbench::exact {
namespace {

using ::testing::HasSubstr;

const std::string TINY = LMDBENCH_SOURCE_DIR "/experiments/extreme/tiny.json";

/// A scene of one micrometre: without scaling FCL must be wrong on it.
std::filesystem::path run_tiny(const testing::ScratchDirectory& folder, const std::string& stride) {
  const std::filesystem::path file = folder / "tiny.h5";
  run_experiment_to_file(load_experiment(TINY, {"/driver/repetitions=1", "/probes/truth/stride_frames=0",
                                                "/probes/fcl/stride_frames=" + stride}),
                         file, {"lmdbench", "run", TINY}, {});
  return file;
}

const Opinion& opinion_of(const LedgerRow& row, const std::string& who) {
  return *std::find_if(row.opinions.begin(), row.opinions.end(),
                       [&](const Opinion& opinion) { return opinion.who == who; });
}

TEST(Ledger, TellsWhoIsWrongOnAMicrometre) {
  const testing::ScratchDirectory folder;
  const std::filesystem::path file = run_tiny(folder, "10");
  EXPECT_EQ(experiment_file_of(file), TINY);
  const Ledger ledger = arbitrate(file, TINY);
  EXPECT_EQ(ledger.frames, 20);
  ASSERT_GT(ledger.rows.size(), 10u);
  int unscaled_wrong = 0;
  for (const LedgerRow& row : ledger.rows) {
    EXPECT_GT(row.truth, 0.0);
    for (const char* who : {"fcl", "lmdbench", "certified", "exhaustive"})
      EXPECT_FALSE(opinion_of(row, who).wrong) << who << ", frame " << row.frame;
    unscaled_wrong += opinion_of(row, "fcl-unscaled").wrong;
    ASSERT_FALSE(row.pairs.empty());
    EXPECT_EQ(row.pairs[0].exact, row.truth);
  }
  EXPECT_GT(unscaled_wrong, 10);
  const std::string text = ledger_markdown({ledger});
  EXPECT_THAT(text, HasSubstr("### fcl-unscaled: sees contact where there is none"));
  EXPECT_THAT(text, HasSubstr("TEST(LedgerRows, ExtremeTinyFrame"));
  const auto json = nlohmann::json::parse(ledger_json(ledger));
  ASSERT_EQ(json["rows"].size(), ledger.rows.size());
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(json["rows"][0]["pairs"][0]["moving_M"][1][axis].get<double>(),
              ledger.rows[0].pairs[0].moving_M[1][axis]);
}

TEST(Ledger, RefusesWhatItCannotJudge) {
  const testing::ScratchDirectory folder;
  const std::filesystem::path unchecked = run_tiny(folder, "0");
  EXPECT_THROW(arbitrate(unchecked, TINY), InputError);
}

}  // namespace
}  // namespace lmdbench::exact
