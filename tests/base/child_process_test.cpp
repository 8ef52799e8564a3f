// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/child_process.h>
#include <lmdbench/base/sanitizers.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;
constexpr ChildLimits LIMITS{1, std::int64_t{64} << 20};

/// How a child ends that runs this work and sends nothing.
std::string end_of(const std::function<void()>& work) {
  ChildProcess child([&](const ChildProcess::Send&) { work(); }, LIMITS);
  std::array<std::byte, 1> byte;
  EXPECT_FALSE(child.receive(byte));
  return child.end_in_words();
}

TEST(ChildProcess, SendsMoreThanAPipeHolds) {
  std::vector<std::byte> sent(1 << 20);
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::byte>(i * 7);
  ChildProcess child([&](const ChildProcess::Send& send) { send(sent); }, LIMITS);
  std::vector<std::byte> received(sent.size());
  EXPECT_TRUE(child.receive(received));
  EXPECT_EQ(received, sent);
  EXPECT_FALSE(child.receive(std::span(received).first(1))) << "nothing more";
}

TEST(ChildProcess, TellsHowItEnded) {
  EXPECT_THAT(end_of([] {
                ::signal(SIGSEGV, SIG_DFL);  // Sanitizers have handlers of their own.
                ::raise(SIGSEGV);
              }),
              HasSubstr("crashed (signal 11)"));
  EXPECT_THAT(end_of([] { throw std::runtime_error("x"); }), HasSubstr("status"));
  EXPECT_THAT(end_of([] {
                volatile bool forever = true;
                while (forever) {
                }
              }),
              HasSubstr("used up its 1 s"));
}

TEST(ChildProcess, InterruptsAreForTheParent) {
  ChildProcess child(
      [](const ChildProcess::Send& send) {
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::raise(signal);
        send(std::array{std::byte{7}});
      },
      LIMITS);
  std::array<std::byte, 1> byte;
  EXPECT_TRUE(child.receive(byte)) << child.end_in_words();
}

TEST(ChildProcess, MemoryIsLimited) {
  if (IS_SANITIZED) GTEST_SKIP() << "sanitizers reserve more than any limit";
  EXPECT_THAT(end_of([] {
                std::vector<char> eaten(std::size_t{256} << 20, 'x');
                if (eaten[7] == 'y') std::abort();
              }),
              HasSubstr("memory"));
}

TEST(ChildProcess, EndsWithItsOwner) {
  // Whoever has the writing end open is alive.
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  {
    const ChildProcess child([](const ChildProcess::Send&) { ::pause(); }, LIMITS);
  }
  const pid_t parent = ::fork();
  if (parent == 0) {
    std::array<std::byte, 1> begun{};
    ChildProcess child(
        [&](const ChildProcess::Send& send) {
          send(begun);
          ::pause();
        },
        LIMITS);
    child.receive(begun);
    ::_exit(0);  // no destructor
  }
  ASSERT_GT(parent, 0);
  ASSERT_EQ(::waitpid(parent, nullptr, 0), parent);
  ::close(ends[1]);
  pollfd reading{ends[0], POLLIN, 0};
  EXPECT_EQ(::poll(&reading, 1, 20'000), 1);
  EXPECT_TRUE((reading.revents & POLLHUP) != 0) << "a child is still there";
  ::close(ends[0]);
}

}  // namespace
}  // namespace lmdbench
