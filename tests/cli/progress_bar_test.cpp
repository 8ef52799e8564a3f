// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/progress_bar.h>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ProgressLine, ShowsShareRateAndTimeLeft) {
  const std::string line = progress_line("run", 250, 1000, 50.0);
  EXPECT_THAT(line, HasSubstr("run"));
  EXPECT_THAT(line, HasSubstr(" 25 %"));
  EXPECT_THAT(line, HasSubstr(" 5/s"));
  EXPECT_THAT(line, HasSubstr("ETA 2:30"));
}

TEST(ProgressLine, HasNoRateBeforeAnythingIsDone) {
  EXPECT_THAT(progress_line("run", 0, 1000, 0.0), Not(HasSubstr("ETA")));
  EXPECT_THAT(progress_line("run", 0, 1000, 3.0), Not(HasSubstr("ETA")));
}

TEST(ProgressLine, KeepsItsLength) {
  const auto bar = [](std::int64_t done) {
    const std::string line = progress_line("run", done, 10, 1.0);
    return line.find(']') - line.find('[');
  };
  EXPECT_EQ(bar(0), bar(10));
  EXPECT_EQ(bar(3), bar(10));
  EXPECT_EQ(bar(11), bar(10)) << "more than announced";
  EXPECT_THAT(progress_line("truth", 0, 0, 1.0), HasSubstr("100 %")) << "nothing to do is done";
  EXPECT_THAT(progress_line("run", 20, 10, 10.0), HasSubstr("ETA 0:00"));
  EXPECT_EQ(progress_note("run", 20, 10, 10.0), "run: 100 %, 0 s left");
}

/// The output of two updates to standard error, which is no terminal here.
std::string lines_of(bool enabled, std::chrono::milliseconds silence) {
  ::testing::internal::CaptureStderr();
  {
    ProgressBar bar(enabled, silence);
    bar.update("run", 1, 4);
    bar.update("run", 2, 4);
  }
  return ::testing::internal::GetCapturedStderr();
}

TEST(ProgressBar, ALogGetsLinesNowAndThen) {
  EXPECT_THAT(lines_of(true, std::chrono::milliseconds(0)),
              AllOf(HasSubstr("run: 25 %"), HasSubstr("run: 50 %"), Not(HasSubstr("\r"))));
  EXPECT_EQ(lines_of(true, std::chrono::hours(1)), "") << "short commands are silent";
  EXPECT_EQ(lines_of(false, std::chrono::milliseconds(0)), "");
}

/// Standard error goes to `descriptor`, which it closes, until the end of the scope.
class StandardErrorTo {
 public:
  explicit StandardErrorTo(int descriptor) {
    EXPECT_GE(descriptor, 0);
    dup2(descriptor, STDERR_FILENO);
    close(descriptor);
  }
  ~StandardErrorTo() {
    dup2(before_, STDERR_FILENO);
    close(before_);
  }

 private:
  int before_ = dup(STDERR_FILENO);
};

TEST(ProgressBar, WorkGoesOnWhereNothingCanBeTold) {
  const StandardErrorTo full(open("/dev/full", O_WRONLY));
  ProgressBar bar(true, std::chrono::milliseconds(0));
  EXPECT_NO_THROW(bar.update("run", 1, 4));
}

TEST(ProgressBar, WorkGoesOnWhenNobodyReadsTheLog) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const StandardErrorTo log(ends[1]);
  ProgressBar bar(true, std::chrono::milliseconds(0));
  EXPECT_NO_THROW(bar.update("run", 1, 4));
}

TEST(ProgressBar, WorkGoesOnWhenTheTerminalIsGone) {
  const int emulator = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(emulator, 0);
  ASSERT_EQ(grantpt(emulator), 0);
  ASSERT_EQ(unlockpt(emulator), 0);
  const StandardErrorTo terminal(open(ptsname(emulator), O_RDWR | O_NOCTTY));
  ProgressBar bar(true);  // its destructor wipes what was drawn
  bar.update("run", 1, 4);
  char drawn = '\0';
  EXPECT_EQ(read(emulator, &drawn, 1), 1) << "a bar is drawn on a terminal";
  close(emulator);
  EXPECT_NO_THROW(bar.update("run", 4, 4));
}

TEST(ProgressLine, WithoutATotalIsThePhase) {
  EXPECT_EQ(progress_line("trial 7", 0, -1, 3.0), "trial 7");
  EXPECT_EQ(progress_note("trial 7", 0, -1, 3.0), "trial 7");
}

TEST(ProgressNote, TellsShareAndTimeLeftInWords) {
  EXPECT_EQ(progress_note("run", 250, 1000, 50.0), "run: 25 %, 150 s left");
  EXPECT_EQ(progress_note("run", 0, 1000, 0.0), "run: 0 %");
}

}  // namespace
}  // namespace lmdbench
