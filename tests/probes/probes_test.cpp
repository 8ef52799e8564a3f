// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/experiment.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/files.h>
#include <support/source_directory.h>

#include <set>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;

TEST(Probes, EveryDatasetIsDescribedForReaders) {
  const std::string readme = testing::read_text(LMDBENCH_SOURCE_DIR "/results/README.md");
  std::set<std::string> paths;
  for (const Probe& probe : probes())
    for (const ProbeDataset& dataset : probe.datasets) {
      EXPECT_TRUE(paths.insert(dataset.path).second) << dataset.path << " stands twice";
      const std::string row = fmt::format("| `{}` | ({}) | {} |", dataset.path, dataset.shape, dataset.units);
      EXPECT_TRUE(readme.find(row) != std::string::npos) << "results/README.md needs the row\n"
                                                         << row << " " << dataset.long_name << " |";
    }
  EXPECT_GT(paths.size(), 40u);
}

TEST(Probes, TheirOptionsAreInTheSchemaWithDefaultAndDescription) {
  for (const Probe& probe : probes()) {
    const nlohmann::json& options =
        experiment_schema()["properties"][probe.parent.substr(1)]["properties"][probe.name]["properties"];
    EXPECT_EQ(options["stride_frames"]["default"], probe.stride_frames);
    EXPECT_EQ(options.size(), probe.options.size() + 1) << probe.name;
    for (const auto& [key, option] : options.items()) {
      EXPECT_TRUE(option.contains("default")) << probe.name << " " << key;
      EXPECT_FALSE(option["description"].get<std::string>().empty()) << probe.name << " " << key;
    }
    EXPECT_THAT(probe.left_out, HasSubstr("stride_frames is 0"));
  }
}

}  // namespace
}  // namespace lmdbench
