// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// The process of a plugin. `lmdbench-plugin-child PARENT BYTES FILE describe` writes the plugin's
// description as JSON to the contacts' memory; without `describe` it makes the task's method and
// answers poses (wire.h) until the socket closes. It ends with its parent and has BYTES of memory.
#include <lmdbench/plugin/loaded_plugin.h>
#include <lmdbench/plugin/wire.h>

#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace lmdbench {
namespace {

constexpr int NOBODY_ASKS = 0, BAD_CALL = 64, NO_MEMORY = 65;

/// Room for contacts that ends at a protected page: a write beyond the end crashes at once.
class GuardedContacts {
 public:
  explicit GuardedContacts(std::uint64_t capacity) : capacity_(capacity) {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    used_ = (capacity * sizeof(lmdbench_contact) + page - 1) / page * page;
    void* memory = ::mmap(nullptr, used_ + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) ::_exit(NO_MEMORY);
    end_ = static_cast<char*>(memory) + used_;
    ::mprotect(end_, page, PROT_NONE);
  }
  GuardedContacts(const GuardedContacts&) = delete;
  GuardedContacts& operator=(const GuardedContacts&) = delete;
  ~GuardedContacts() { ::munmap(end_ - used_, used_ + static_cast<std::size_t>(::sysconf(_SC_PAGESIZE))); }
  lmdbench_contact* data() const {
    return reinterpret_cast<lmdbench_contact*>(end_ - capacity_ * sizeof(lmdbench_contact));
  }
  std::uint64_t capacity() const { return capacity_; }

 private:
  std::uint64_t capacity_;
  std::size_t used_ = 0;
  char* end_ = nullptr;
};

void limit_memory(const char* text) {
  std::uint64_t bytes = 0;
  std::from_chars(text, text + std::strlen(text), bytes);
  if (bytes == 0) return;
  const rlimit limit{bytes, bytes};
  static_cast<void>(::setrlimit(RLIMIT_AS, &limit));
}

void send(const wire::Answer& answer) {
  if (::send(wire::SOCKET, &answer, sizeof(answer), MSG_NOSIGNAL) != sizeof(answer)) ::_exit(NOBODY_ASKS);
}

nlohmann::json described(const LoadedPlugin& plugin) {
  nlohmann::json all = nlohmann::json::array();
  for (std::uint32_t i = 0; const lmdbench_method* method = plugin.method(i); ++i) {
    nlohmann::json entry{{"name", method->name},
                         {"version", method->version},
                         {"summary", method->summary},
                         {"promise", method->promise},
                         {"flags", method->flags},
                         {"own_force", LoadedPlugin::force(*method) != nullptr},
                         {"options", method->options_schema == nullptr ? "{}" : method->options_schema},
                         {"counters", nlohmann::json::array()}};
    if (const lmdbench_counters* counters = LoadedPlugin::counters(*method))
      for (std::uint32_t c = 0; c < counters->count; ++c)
        entry["counters"].push_back({{"name", counters->names[c]}, {"summary", counters->summaries[c]}});
    all.push_back(std::move(entry));
  }
  return {{"methods", all}, {"changed_float_mode", plugin.changed_float_mode()}};
}

void describe(const std::string& file) {
  nlohmann::json json;
  try {
    json = described(LoadedPlugin(file));
  } catch (const std::exception& error) {
    json = {{"error", error.what()}};
  }
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (::write(wire::CONTACTS, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    ::_exit(NO_MEMORY);
}

const char* map_task() {
  struct stat about {};
  if (::fstat(wire::MESHES, &about) != 0) ::_exit(BAD_CALL);
  void* memory =
      ::mmap(nullptr, static_cast<std::size_t>(about.st_size), PROT_READ, MAP_PRIVATE, wire::MESHES, 0);
  if (memory == MAP_FAILED) ::_exit(NO_MEMORY);
  return static_cast<const char*>(memory);
}

void serve(const std::string& file) {
  const char* memory = map_task();
  wire::Task task;
  std::memcpy(&task, memory, sizeof(task));
  const auto* vertices = reinterpret_cast<const double*>(memory + sizeof(task));
  const auto* triangles = reinterpret_cast<const std::int32_t*>(memory + task.triangles_begin());
  const lmdbench_mesh a{vertices, triangles, task.vertices[0], task.triangles[0]};
  const lmdbench_mesh b{vertices + 3 * task.vertices[0], triangles + 3 * task.triangles[0], task.vertices[1],
                        task.triangles[1]};
  void* shared = ::mmap(nullptr, wire::CONTACT_BYTES, PROT_READ | PROT_WRITE, MAP_SHARED, wire::CONTACTS, 0);
  if (shared == MAP_FAILED) ::_exit(NO_MEMORY);

  wire::Answer answer;
  const auto refuse = [&](const char* why) {
    answer.reply.status = 1;
    std::strncpy(answer.message.data(), why, answer.message.size() - 1);
    send(answer);
  };
  try {
    const LoadedPlugin plugin(file);
    const lmdbench_method* method = plugin.method(task.method);
    if (method == nullptr) throw std::runtime_error("has no such method any more");
    LoadedMethod made(*method, a, b, task.cutoff, memory + task.options_begin());
    answer.reply.seconds = made.seconds_to_make();
    answer.reply.changed_float_mode = plugin.changed_float_mode() || made.changed_float_mode() ? 1 : 0;
    send(answer);
    auto contacts = std::make_unique<GuardedContacts>(256);
    wire::Request request;
    for (;;) {
      const ssize_t got = ::recv(wire::SOCKET, &request, sizeof(request), 0);
      if (got < 0 && errno == EINTR) continue;
      if (got == 0) return;  // the end of the search: destroys the method
      if (got != sizeof(request)) ::_exit(NOBODY_ASKS);
      answer = {};
      answer.number = request.number;
      answer.reply = wire::search_with_room(
          contacts->capacity(),
          [&] { return made.search(request.X_BA.data(), contacts->data(), contacts->capacity()); },
          [&](std::uint64_t capacity) { contacts = std::make_unique<GuardedContacts>(capacity); });
      if (answer.reply.status == 0 && answer.reply.needed <= contacts->capacity())
        std::memcpy(shared, contacts->data(), answer.reply.needed * sizeof(lmdbench_contact));
      send(answer);
    }
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

}  // namespace
}  // namespace lmdbench

int main(int argc, char** argv) {
  using namespace lmdbench;
  if (argc < 4) {
    std::fputs("lmdbench starts this program to run a plugin in; see lmdbench plugin --help\n", stderr);
    return BAD_CALL;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (std::to_string(::getppid()) != argv[1]) return NOBODY_ASKS;
  // The parent decides when to end, also where a terminal sends its signals to both.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  ::close_range(wire::FIRST_UNUSED, ~0U, 0);
  const rlimit none{0, 0};
  static_cast<void>(::setrlimit(RLIMIT_CORE, &none));
  limit_memory(argv[2]);
  if (argc > 4 && std::string_view(argv[4]) == "describe")
    describe(argv[3]);
  else
    serve(argv[3]);
  // Skips the plugin's own destructors and exit handlers.
  ::_exit(NOBODY_ASKS);
}
