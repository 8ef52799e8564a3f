// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_descriptor.h>
#include <lmdbench/base/run_program.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <functional>
#include <optional>
#include <string_view>
#include <system_error>

namespace lmdbench {
namespace {

class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

struct Pipe {
  FileDescriptor reads, writes;
};

/// A running program; its destructor ends it.
class Program {
 public:
  /// @param separate_output  whether standard output has a pipe of its own
  Program(const std::vector<std::string>& argv, const std::filesystem::path& working_folder,
          const std::string& remedy, bool separate_output) {
    const auto fail = [&](int error) {
      throw EnvironmentError(argv.front(), "", fmt::format("cannot be started: {}", std::strerror(error)),
                             remedy);
    };
    const auto make_pipe = [&] {
      std::array<int, 2> ends{};
      if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail(errno);
      return Pipe{FileDescriptor(ends[0]), FileDescriptor(ends[1])};
    };
    Pipe talk = make_pipe();
    std::optional<Pipe> output;
    if (separate_output) output = make_pipe();
    FileActions actions;
    posix_spawn_file_actions_addchdir_np(actions.get(), working_folder.c_str());
    posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(actions.get(), (output ? output->writes : talk.writes).get(),
                                     STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(actions.get(), talk.writes.get(), STDERR_FILENO);
    std::vector<std::string> words = argv;
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const int error =
        ::posix_spawnp(&child_, pointers.front(), actions.get(), nullptr, pointers.data(), environ);
    if (error != 0) {
      child_ = -1;
      fail(error);
    }
    talk_ = std::move(talk.reads);
    if (output) output_ = std::move(output->reads);
  }
  ~Program() {
    if (child_ < 0) return;
    ::kill(child_, SIGKILL);
    static_cast<void>(wait());
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Passes on the output, as it comes, until both pipes are closed.
  void read(const std::function<void(std::string_view)>& on_talk,
            const std::function<void(std::string_view)>& on_output) {
    while (talk_.valid() || output_.valid()) {
      // poll skips a negative descriptor.
      std::array<pollfd, 2> waiting{pollfd{talk_.get(), POLLIN, 0}, pollfd{output_.get(), POLLIN, 0}};
      if (::poll(waiting.data(), waiting.size(), -1) < 0) continue;  // interrupted
      if (waiting[0].revents != 0) read_some(talk_, on_talk);
      if (waiting[1].revents != 0) read_some(output_, on_output);
    }
  }

  /// Exit status; 128 + signal where a signal ended it.
  int wait() {
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  static void read_some(FileDescriptor& pipe, const std::function<void(std::string_view)>& sink) {
    std::array<char, 1 << 16> block;
    const ssize_t count = ::read(pipe.get(), block.data(), block.size());
    if (count < 0 && errno == EINTR) return;
    if (count <= 0)
      pipe.close();
    else
      sink({block.data(), static_cast<std::size_t>(count)});
  }

  pid_t child_ = -1;
  FileDescriptor talk_, output_;
};

/// Output beyond this is dropped: nobody reads so much.
constexpr std::size_t MOST_TALK = std::size_t{16} << 20;

std::function<void(std::string_view)> append_to(std::string& text) {
  return [&text](std::string_view part) {
    if (text.size() < MOST_TALK) text.append(part);
  };
}

}  // namespace

ProgramOutcome run_program(const std::vector<std::string>& argv, const std::filesystem::path& working_folder,
                           const std::string& remedy) {
  Program program(argv, working_folder, remedy, false);
  ProgramOutcome outcome;
  program.read(append_to(outcome.output), {});
  outcome.exit_status = program.wait();
  return outcome;
}

ProgramOutcome run_program_to_file(const std::vector<std::string>& argv,
                                   const std::filesystem::path& working_folder, const std::string& remedy,
                                   const std::filesystem::path& file, std::int64_t most_bytes) {
  const auto fail = [&] {
    throw EnvironmentError(file.string(), "", fmt::format("cannot be written: {}", std::strerror(errno)),
                           "check the disk space and the permissions");
  };
  FileDescriptor target(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!target.valid()) fail();
  Program program(argv, working_folder, remedy, true);
  ProgramOutcome outcome;
  std::int64_t written = 0;
  program.read(append_to(outcome.output), [&](std::string_view part) {
    written += static_cast<std::int64_t>(part.size());
    if (written > most_bytes) {
      ::unlink(file.c_str());
      throw InputError(argv.front(), "", fmt::format("gives more than {} bytes", most_bytes),
                       "check where the archive comes from");
    }
    while (!part.empty()) {
      const ssize_t count = ::write(target.get(), part.data(), part.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail();
      part.remove_prefix(static_cast<std::size_t>(count));
    }
  });
  if (!target.close()) fail();
  outcome.exit_status = program.wait();
  return outcome;
}

TemporaryFolder::TemporaryFolder(const std::filesystem::path& parent, const std::string& prefix) {
  std::string name = (parent / (prefix + "XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr)
    throw EnvironmentError(parent.string(), "",
                           fmt::format("no folder can be made: {}", std::strerror(errno)),
                           "check the disk space and the permissions");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace lmdbench
