// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result_file/node_watch.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace lmdbench {
namespace {

/// Sets an environment variable for a test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { ::setenv(name, value.c_str(), 1); }
  ~Variable() { ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

TEST(Neighbours, AreWhoWorkedBetweenTwoLooks) {
  const std::map<int, ProcessTime> before = {{1, {"init", 10, 5.0}},
                                             {2, {"make", 20, 1.0}},
                                             {3, {"us", 30, 0.0}},
                                             {4, {"old", 40, 90.0}},
                                             {5, {"gone", 50, 1.0}}};
  const std::map<int, ProcessTime> after = {{1, {"init", 10, 5.01}},
                                            {2, {"make", 20, 2.0}},
                                            {3, {"us", 30, 4.0}},
                                            {4, {"new", 99, 1.0}},
                                            {7, {"make", 70, 3.0}}};
  const std::vector<Neighbour> neighbours = neighbours_between(before, after, 4.0, 3);
  ASSERT_EQ(neighbours.size(), 2u)
      << "init did too little, we are no neighbour of ours, who has gone says nothing";
  EXPECT_EQ(neighbours[0].command, "make");
  EXPECT_DOUBLE_EQ(neighbours[0].processors, 1.0) << "of two processes, one of which is new";
  EXPECT_EQ(neighbours[1].command, "new");
  EXPECT_DOUBLE_EQ(neighbours[1].processors, 0.25)
      << "another process with an old number has worked all its time since";
}

TEST(Neighbours, AreTheFiveBusiest) {
  std::map<int, ProcessTime> after;
  for (int number = 1; number <= 8; ++number)
    after[number] = {"p" + std::to_string(number), 1, static_cast<double>(number)};
  const std::vector<Neighbour> neighbours = neighbours_between({}, after, 1.0, 0);
  ASSERT_EQ(neighbours.size(), 5u);
  EXPECT_EQ(neighbours.front().command, "p8");
  EXPECT_EQ(neighbours.back().command, "p4");
}

TEST(NodeWatch, SeesWhoWorksBeside) {
  const NodeWatch watch(true);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    while (::getppid() != 0) {  // for ever
    }
  }
  // Until the process has had its share, however busy the machine is.
  double share = 0.0;
  nlohmann::json seen;
  for (int tries = 0; tries < 3000 && share < 0.05; ++tries) {
    ::usleep(20'000);
    seen = watch.finish();
    for (const auto& neighbour : seen["neighbours"])
      if (neighbour["command"].get<std::string>().starts_with("lmdbench_result"))
        share = neighbour["processors"];
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_GE(share, 0.05) << seen;
  EXPECT_GE(seen["elsewhere"].get<double>(), 0.05);
  EXPECT_GE(seen["processors"].get<int>(), seen["allowed"].get<int>());
  EXPECT_FALSE(seen["node"].get<std::string>().empty());
}

TEST(NodeWatch, NamesNobodyUnlessAskedTo) {
  const Variable job("SLURM_JOB_ID", "12"), node("SLURMD_NODENAME", "n7");
  const nlohmann::json seen = NodeWatch(false).finish();
  for (const char* name : {"node", "job", "restarts", "exclusive", "neighbours"})
    EXPECT_FALSE(seen.contains(name)) << name;
  EXPECT_TRUE(seen.contains("elsewhere"));
}

TEST(NodeWatch, SaysWhatSlurmSays) {
  const long processors = ::sysconf(_SC_NPROCESSORS_CONF);
  const Variable job("SLURM_JOB_ID", "12"), node("SLURMD_NODENAME", "n7"),
      restarts("SLURM_RESTART_COUNT", "2");
  {
    const Variable all("SLURM_CPUS_ON_NODE", std::to_string(processors));
    const nlohmann::json where = describe_node(true);
    EXPECT_EQ(where["node"], "n7");
    EXPECT_EQ(where["job"], 12);
    EXPECT_EQ(where["restarts"], 2);
    EXPECT_EQ(where["exclusive"], true);
  }
  const Variable one("SLURM_CPUS_ON_NODE", std::to_string(processors - 1));
  EXPECT_EQ(describe_node(true)["exclusive"], false);
}

}  // namespace
}  // namespace lmdbench
