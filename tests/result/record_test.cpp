// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/run/run.h>

#include <gtest/gtest.h>
#include <result/deterministic_datasets.h>
#include <result_file/result_reading.h>
#include <support/source_directory.h>

#include <string>
#include <vector>

namespace lmdbench {
namespace {

using testing::deterministic_datasets;
using testing::OpenResult;
using testing::ScratchDirectory;

/// The start of the shapes experiment, with all records on.
void run_shapes(const std::filesystem::path& file, std::vector<Override> overrides = {}) {
  overrides.insert(overrides.begin(),
                   {"/frames=120", "/driver/repetitions=2", "/record/lmds=true", "/record/torque=true"});
  run_experiment_to_file(load_experiment(LMDBENCH_SOURCE_DIR "/experiments/shapes.json", overrides), file,
                         {"lmdbench", "run"});
}

/// Each switch of /record removes its own datasets only; the others keep their bits.
TEST(Record, SaysWhatIsKept) {
  const ScratchDirectory scratch;
  run_shapes(scratch / "all.h5");
  const auto all = deterministic_datasets(scratch / "all.h5");
  const auto group_of = [](const std::string& path) {
    if (!path.starts_with("methods/")) return "scene";
    const std::string rest = path.substr(path.find('/', 8) + 1);
    if (rest.starts_with("counters/") || rest.starts_with("global_counters/")) return "counters";
    const std::size_t slash = rest.find('/');
    if (slash == std::string::npos) return rest == "torque" ? "torque" : "frames";
    return rest.starts_with("lmds/") ? "lmds" : "scene";
  };
  for (const std::string key : {"frames", "counters", "timings", "lmds", "torque"}) {
    const std::string file = key + ".h5";
    run_shapes(scratch / file, {"/record/" + key + "=false"});
    const auto kept = deterministic_datasets(scratch / file);
    std::size_t left_out = 0;
    for (const auto& [path, value] : all) {
      const std::string group = group_of(path);
      const bool goes = group == key || (key == "frames" && group == "torque");
      left_out += goes ? 1 : 0;
      ASSERT_EQ(kept.count(path), goes ? 0u : 1u) << key << ": " << path;
      if (!goes) {
        EXPECT_TRUE(kept.at(path) == value) << key << ": " << path;
      }
    }
    EXPECT_EQ(left_out > 0, key != "timings") << "times are not among the deterministic datasets";
    const OpenResult result(scratch / file);
    for (const std::string time : {"local_update_time", "global_search_time"})
      EXPECT_EQ(result.has("/methods/improved/" + time), key != "timings") << key;
  }
}

}  // namespace
}  // namespace lmdbench
