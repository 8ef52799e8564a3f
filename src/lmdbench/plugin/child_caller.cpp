// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_descriptor.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/base/sanitizers.h>
#include <lmdbench/plugin/plugin_caller.h>
#include <lmdbench/plugin/wire.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

extern char** environ;

namespace lmdbench {
namespace {

/// How often a plugin is started anew after a lost call.
constexpr int RESTARTS = 3;
/// Preparing two meshes may take so many times the limit of a search.
constexpr int PREPARING_FACTOR = 30;

/// A limit would refuse what sanitizers reserve.
constexpr bool LIMITS_MEMORY = !IS_SANITIZED;

[[noreturn]] void refuse(int error) {
  throw EnvironmentError("", "",
                         "no process for a plugin can be started: " + std::generic_category().message(error),
                         "check the limits on processes, files and memory (ulimit -a)");
}

/// In the program's folder, or in libexec/lmdbench next to that folder.
std::string child_program() {
  std::error_code none;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
  for (const char* place : {"lmdbench-plugin-child", "../libexec/lmdbench/lmdbench-plugin-child"})
    if (::access((folder / place).c_str(), X_OK) == 0) return (folder / place).string();
  throw EnvironmentError((folder / "lmdbench-plugin-child").string(), "",
                         "the program that plugins run in is not there",
                         "install lmdbench as a whole, or build the target lmdbench_plugin_child");
}

FileDescriptor shared_memory(const char* name) {
  FileDescriptor memory(::memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!memory.valid()) refuse(errno);
  return memory;
}

void append(const FileDescriptor& memory, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(memory.get(), bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse(errno);
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

/// A running child.
class Child {
 public:
  Child(const std::string& plugin, bool describe, int meshes, int contacts) {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) refuse(errno);
    socket_ = FileDescriptor(ends[0]);
    // High numbers: the child's dup2 to the low ones must not overwrite what it copies next.
    const FileDescriptor child_end(::fcntl(ends[1], F_DUPFD_CLOEXEC, 16));
    ::close(ends[1]);
    const FileDescriptor meshes_end(::fcntl(meshes, F_DUPFD_CLOEXEC, 16)),
        contacts_end(::fcntl(contacts, F_DUPFD_CLOEXEC, 16));
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, child_end.get(), wire::SOCKET);
    ::posix_spawn_file_actions_adddup2(&actions, meshes_end.get(), wire::MESHES);
    ::posix_spawn_file_actions_adddup2(&actions, contacts_end.get(), wire::CONTACTS);
    std::vector<std::string> words{child_program(), std::to_string(::getpid()),
                                   std::to_string(LIMITS_MEMORY ? limit_of(Limit::PLUGIN_BYTES) : 0), plugin};
    if (describe) words.emplace_back("describe");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const int error = ::posix_spawn(&pid_, argv.front(), &actions, nullptr, argv.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0) refuse(error);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    socket_ = FileDescriptor();  // tells it to destroy the method and end
    end();
  }

  bool send(const wire::Request& request) {
    return ::send(socket_.get(), &request, sizeof(request), MSG_NOSIGNAL) == sizeof(request);
  }

  /// @return empty, or why there is no answer; then the child has ended
  std::string receive(wire::Answer& answer, double seconds) {
    // In slices: a job that is suspended goes on with its plugin, and at most one slice has passed.
    constexpr double SLICE = 0.25;
    for (double left = seconds;;) {
      const double slice = std::clamp(left, 0.0, SLICE);
      pollfd waiting{socket_.get(), POLLIN, 0};
      const int ready = ::poll(&waiting, 1, static_cast<int>(std::ceil(slice * 1000.0)));
      if (ready < 0 && errno == EINTR) continue;
      if (ready == 0) {
        left -= slice;
        if (left > 0.0) continue;
        end();
        return fmt::format("gave no answer within {:g} s (--limit plugin-seconds=NUMBER)", seconds);
      }
      const ssize_t got = ::recv(socket_.get(), &answer, sizeof(answer), 0);
      if (got < 0 && errno == EINTR) continue;
      if (got == sizeof(answer)) return {};
      return end();
    }
  }

  /// Waits for a child that ends by itself.
  std::string wait(double seconds) {
    wire::Answer none;
    return receive(none, seconds);
  }

 private:
  /// Ends the child if it still runs.
  /// @return how it ended, in words
  std::string end() {
    if (pid_ < 0) return {};
    // A child that closed the socket is about to end: its exit status is worth waiting for.
    int status = 0;
    pid_t gone = 0;
    for (int i = 0; i < 50 && (gone = ::waitpid(pid_, &status, WNOHANG)) == 0; ++i) ::usleep(1000);
    if (gone == 0) {
      ::kill(pid_, SIGKILL);
      while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
      }
    }
    pid_ = -1;
    if (gone == 0) return "was ended";
    if (WIFSIGNALED(status)) return fmt::format("crashed ({})", ::strsignal(WTERMSIG(status)));
    return fmt::format("ended its process with status {}", WEXITSTATUS(status));
  }

  pid_t pid_ = -1;
  FileDescriptor socket_;
};

class ChildCaller : public PluginCaller {
 public:
  explicit ChildCaller(const PluginTask& task)
      : file_(task.file.string()),
        meshes_(shared_memory("lmdbench-meshes")),
        contacts_(shared_memory("lmdbench-contacts")) {
    write_task(task);
    if (::ftruncate(contacts_.get(), wire::CONTACT_BYTES) != 0) refuse(errno);
    void* memory = ::mmap(nullptr, wire::CONTACT_BYTES, PROT_READ, MAP_SHARED, contacts_.get(), 0);
    if (memory == MAP_FAILED) refuse(errno);
    // A child that made the memory smaller would crash this program at its next read.
    ::fcntl(contacts_.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL);
    shared_ = static_cast<const lmdbench_contact*>(memory);
    static_cast<void>(start());
  }
  ~ChildCaller() override { ::munmap(const_cast<lmdbench_contact*>(shared_), wire::CONTACT_BYTES); }

  double seconds_to_make() const override { return seconds_to_make_; }

  PluginAnswer search(const double* X_BA) override {
    PluginAnswer answer;
    if (!child_ && !start()) {
      answer.lost = why_not_;
      return answer;
    }
    wire::Request request{++number_, {}};
    std::copy_n(X_BA, request.X_BA.size(), request.X_BA.begin());
    wire::Answer received;
    static_cast<void>(child_->send(request));  // Shows below if it fails.
    std::string lost = child_->receive(received, static_cast<double>(limit_of(Limit::PLUGIN_SECONDS)));
    if (lost.empty() && received.number != number_) lost = "answered what it was not asked";
    if (!lost.empty()) {
      child_.reset();
      why_not_ = answer.lost = std::move(lost);
      return answer;
    }
    received.reply.changed_float_mode |= std::exchange(changed_float_mode_, 0U);
    judge_reply(received.reply, shared_, answer);
    return answer;
  }

 private:
  /// @return whether a child is ready; else `why_not_` tells
  bool start() {
    if (starts_++ > RESTARTS) return false;
    child_ = std::make_unique<Child>(file_, false, meshes_.get(), contacts_.get());
    wire::Answer answer;
    std::string lost =
        child_->receive(answer, PREPARING_FACTOR * static_cast<double>(limit_of(Limit::PLUGIN_SECONDS)));
    if (lost.empty() && answer.reply.status == 0) {
      changed_float_mode_ = answer.reply.changed_float_mode;
      seconds_to_make_ = answer.reply.seconds;
      return true;
    }
    answer.message.back() = '\0';
    why_not_ = "preparing: " + (lost.empty() ? std::string(answer.message.data()) : lost);
    if (lost.empty()) starts_ = RESTARTS + 1;  // It refused, and would again.
    child_.reset();
    return false;
  }

  void write_task(const PluginTask& task) {
    const TriangleMesh &a = task.a->surface().mesh, &b = task.b->surface().mesh;
    const wire::Task head{task.method,
                          task.cutoff,
                          {a.vertices.size(), b.vertices.size()},
                          {a.triangles.size(), b.triangles.size()}};
    append(meshes_, &head, sizeof(head));
    for (const TriangleMesh* mesh : {&a, &b})
      append(meshes_, mesh->vertices.data(), mesh->vertices.size() * sizeof(Vec3));
    for (const TriangleMesh* mesh : {&a, &b})
      append(meshes_, mesh->triangles.data(), mesh->triangles.size() * sizeof(mesh->triangles.front()));
    append(meshes_, task.options.c_str(), task.options.size() + 1);
    // The next child must find the meshes unchanged.
    ::fcntl(meshes_.get(), F_ADD_SEALS, F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL);
  }

  std::string file_;
  FileDescriptor meshes_, contacts_;
  const lmdbench_contact* shared_ = nullptr;
  std::unique_ptr<Child> child_;
  int starts_ = 0;
  std::uint64_t number_ = 0;
  std::uint32_t changed_float_mode_ = 0;
  double seconds_to_make_ = 0.0;
  std::string why_not_;
};

}  // namespace

void judge_reply(const PluginReply& reply, const lmdbench_contact* contacts, PluginAnswer& answer) {
  if (reply.status == PluginReply::THREW)
    answer.lost = "threw an exception";
  else if (reply.status == PluginReply::UNSTEADY)
    answer.lost = "had more contacts again when it was given room for those that it had";
  else if (reply.status != 0)
    answer.lost = fmt::format("failed with status {}", reply.status);
  if (!answer.lost.empty()) return;
  answer.reply = reply;
  answer.too_many = reply.needed > wire::MOST_CONTACTS;
  if (!answer.too_many) answer.contacts = {contacts, reply.needed};
}

std::unique_ptr<PluginCaller> make_child_caller(const PluginTask& task) {
  return std::make_unique<ChildCaller>(task);
}

std::string describe_plugin(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& why) {
    throw InputError(file.string(), "", why,
                     "see lmdbench_method.h, or begin with lmdbench plugin new FOLDER");
  };
  const FileDescriptor none = shared_memory("lmdbench-none"),
                       text_memory = shared_memory("lmdbench-description");
  Child child(file.string(), true, none.get(), text_memory.get());
  const std::string end = child.wait(static_cast<double>(limit_of(Limit::PLUGIN_SECONDS)));
  if (end != "ended its process with status 0") fail(end + " when it was loaded");
  struct stat about {};
  constexpr off_t MOST_BYTES = 1 << 20;
  if (::fstat(text_memory.get(), &about) != 0 || about.st_size > MOST_BYTES)
    fail("says more of itself than 1 MiB");
  std::string text(static_cast<std::size_t>(about.st_size), '\0');
  if (::pread(text_memory.get(), text.data(), text.size(), 0) != about.st_size) fail("cannot be asked");
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) fail("ended its process when it was loaded");
  if (json.contains("error")) fail(json["error"].get<std::string>());
  return text;
}

}  // namespace lmdbench
