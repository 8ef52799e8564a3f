// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Plugins that break rules, each this file with another KIND. All have some good frames, which
// shows the fate of the others. GOOD, PUSHES, SAYS_GOODBYE and SLOW do nothing wrong; STOPS throws,
// and interrupts the program once.
#include <lmdbench/plugin/lmdbench_method.h>

#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <vector>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#define GOOD 0
#define CRASH 1
#define HANG 2
#define LEAK 3
#define WRITE_PAST_END 4
#define NOT_A_NUMBER 5
#define UNSORTED 6
#define WRONG_ABI 7
#define FAST_MATH 8
#define WRONG_PROMISE 9
#define TOO_MANY 10
#define THROWS 11
#define EXITS 12
#define NAN_FORCE 13
#define NO_FORCE 14
#define NO_PROMISE 15
#define PUSHES 16
#define BAD_SCHEMA 17
#define SAYS_GOODBYE 18
#define TWICE 19
#define GROWS 20
#define SLOW 21
#define ENDLESS_SCHEMA 22
#define ENDLESS_TABLE 23
#define STOPS 24

namespace {

struct Instance {
  std::vector<double> a, b;  // corner 0 of each triangle
  double origin[3];          // of A at the last pose
  std::uint64_t calls = 0;
};

constexpr std::uint64_t TRIANGLES = 4;

std::vector<double> corners_of(const lmdbench_mesh& mesh) {
  std::vector<double> corners;
  for (std::uint64_t t = 0; t < TRIANGLES; ++t)
    for (int k = 0; k < 3; ++k) corners.push_back(mesh.vertices[3 * mesh.triangles[3 * t] + k]);
  return corners;
}

std::int32_t create(const lmdbench_mesh* a, const lmdbench_mesh* b, double /*cutoff*/,
                    const char* /*options*/, void** instance, char* /*message*/,
                    std::uint64_t /*message_size*/) {
  if (KIND == SLOW) ::usleep(100000);
  *instance = new Instance{corners_of(*a), corners_of(*b), {}};
  return 0;
}

[[maybe_unused]] void misbehave(lmdbench_contact* contacts, std::uint64_t capacity, std::uint64_t* needed) {
  static_cast<void>(contacts), static_cast<void>(capacity), static_cast<void>(needed);
#if KIND == CRASH
  std::signal(SIGSEGV, SIG_DFL);  // Sanitizers would leave with an exit code of their own.
  std::raise(SIGSEGV);
#elif KIND == HANG
  for (;;) ::pause();
#elif KIND == LEAK
  for (std::size_t gib = 0; gib < 10; ++gib) {
    constexpr std::size_t GIB = std::size_t{1} << 30;
    auto* memory = static_cast<char*>(std::malloc(GIB));
    if (memory == nullptr) std::abort();
    memory[gib] = 1;  // writing all could take the machine's memory
  }
#elif KIND == WRITE_PAST_END
  std::memset(contacts + capacity, 0, sizeof(lmdbench_contact));
#elif KIND == NOT_A_NUMBER
  contacts[0].point_a[0] = NAN;
#elif KIND == UNSORTED
  std::swap(contacts[0], contacts[*needed - 1]);
#elif KIND == FAST_MATH && defined(__SSE__)
  _mm_setcsr(_mm_getcsr() | 0x8040);
#elif KIND == TOO_MANY
  *needed = std::uint64_t{1} << 31;
#elif KIND == GROWS && defined(__SSE__)
  _mm_setcsr(_mm_getcsr() | 0x8040);
  *needed = capacity + 1;
#elif KIND == THROWS || KIND == STOPS
  throw std::runtime_error("out of a C interface");
#elif KIND == EXITS
  std::exit(0);
#endif
}

/// The nearest pair of the corners, or all pairs, nearest first.
std::int32_t search(void* instance, const double* X, lmdbench_contact* contacts, std::uint64_t capacity,
                    std::uint64_t* needed) {
  auto& self = *static_cast<Instance*>(instance);
  std::vector<std::pair<double, lmdbench_contact>> all;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(TRIANGLES); ++i)
    for (std::int32_t j = 0; j < static_cast<std::int32_t>(TRIANGLES); ++j) {
      lmdbench_contact contact{{0, 0, 0}, {0, 0, 0}, i, j, LMDBENCH_CORNER_0, LMDBENCH_CORNER_0};
      double squared = 0.0;
      for (int r = 0; r < 3; ++r) {
        const double* p = &self.a[static_cast<std::size_t>(3 * i)];
        contact.point_a[r] = X[4 * r] * p[0] + X[4 * r + 1] * p[1] + X[4 * r + 2] * p[2] + X[4 * r + 3];
        contact.point_b[r] = self.b[static_cast<std::size_t>(3 * j + r)];
        squared += (contact.point_b[r] - contact.point_a[r]) * (contact.point_b[r] - contact.point_a[r]);
      }
      std::size_t at = all.size();
      while (at > 0 && all[at - 1].first > squared) --at;
      all.insert(all.begin() + static_cast<std::ptrdiff_t>(at), {squared, contact});
    }
  for (int r = 0; r < 3; ++r) self.origin[r] = X[4 * r + 3];
  *needed = all.size();
  for (std::uint64_t i = 0; i < *needed && i < capacity; ++i) contacts[i] = all[i].second;
  const char* const stopped = std::getenv("LMDBENCH_STOPPED");
  if (KIND == STOPS && self.calls == 20 && stopped != nullptr && ::access(stopped, F_OK) != 0) {
    if (std::FILE* const written = std::fopen(stopped, "w")) std::fclose(written);
    ::kill(::getppid(), SIGINT);
  }
  if (++self.calls % 5 == 3) misbehave(contacts, capacity, needed);
  if (KIND == SLOW) ::usleep(300000);
  return KIND == GROWS && self.calls == 9 ? 7 : 0;
}

void destroy(void* instance) {
  delete static_cast<Instance*>(instance);
  const char* const file = std::getenv("LMDBENCH_GOODBYE");
  if (KIND != SAYS_GOODBYE || file == nullptr) return;
  if (std::FILE* const written = std::fopen(file, "w")) std::fclose(written);
}

/// 2 N along z, at the origin of B's frame.
[[maybe_unused]] std::int32_t read_force(void* instance, double* wrench) {
  const auto& self = *static_cast<Instance*>(instance);
  const bool at_fault = self.calls % 5 == 3;
  if (KIND == NO_FORCE && at_fault) return 1;
  const double result[6] = {
      0, 0, KIND == NAN_FORCE && at_fault ? NAN : 2.0, -2.0 * self.origin[1], 2.0 * self.origin[0], 0};
  std::memcpy(wrench, result, sizeof(result));
  return 0;
}

const void* extension(const char* id) {
  static constexpr lmdbench_force FORCE = {sizeof(lmdbench_force), read_force};
  const bool has_force = KIND == NAN_FORCE || KIND == NO_FORCE || KIND == PUSHES;
  return has_force && std::strcmp(id, LMDBENCH_EXTENSION_FORCE) == 0 ? &FORCE : nullptr;
}

#if KIND == FAST_MATH && defined(__SSE__)
// What GCC before 13 links into a shared object with -ffast-math.
__attribute__((constructor)) void set_fast_math() {
  _mm_setcsr(_mm_getcsr() | 0x8040);
}
#endif

[[maybe_unused]] constexpr const char* OF_ITSELF =
    R"({"x": {"$ref": "#/properties/x", "type": "integer", "description": "itself", "default": 1}})";
[[maybe_unused]] constexpr const char* NO_SCHEMA =
    R"({"x": {"type": "nonsense", "description": "none", "default": 1}})";

constexpr lmdbench_method METHOD = {sizeof(lmdbench_method),
                                    NAME,
                                    "1",
                                    "a plugin that does what it must not",
                                    KIND == WRONG_PROMISE                  ? LMDBENCH_PROMISE_COMPLETE_SET
                                    : KIND == NO_PROMISE || KIND == PUSHES ? LMDBENCH_PROMISE_FORCE_ONLY
                                                                           : LMDBENCH_PROMISE_APPROXIMATION,
                                    0,
                                    KIND == BAD_SCHEMA       ? NO_SCHEMA
                                    : KIND == ENDLESS_SCHEMA ? OF_ITSELF
                                                             : nullptr,
                                    create,
                                    search,
                                    destroy,
                                    extension};

const lmdbench_method* get(std::uint32_t index) {
  if (KIND == TWICE && index > 2) std::abort();  // beyond the NULL that ends a table
  return index == 0 || (KIND == TWICE && index == 1) || KIND == ENDLESS_TABLE ? &METHOD : nullptr;
}

}  // namespace

const lmdbench_method_entry_type lmdbench_method_entry = {KIND == WRONG_ABI ? 99 : LMDBENCH_METHOD_ABI_MAJOR,
                                                          LMDBENCH_METHOD_ABI_MINOR,
                                                          sizeof(lmdbench_method_entry_type), get};
