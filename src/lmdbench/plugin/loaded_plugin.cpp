// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/plugin/loaded_plugin.h>

#include <dlfcn.h>

#include <cfenv>
#include <chrono>
#include <cstring>
#include <limits>
#include <stdexcept>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace lmdbench {
namespace {

#if defined(__SSE__)
/// The exception flags of MXCSR, which no mode depends on.
constexpr unsigned FLAGS = 0x3F;
unsigned control_bits() {
  return _mm_getcsr() & ~FLAGS;
}
void set_control_bits(unsigned bits) {
  _mm_setcsr((_mm_getcsr() & FLAGS) | bits);
}
#elif defined(__aarch64__)
unsigned control_bits() {
  unsigned long bits = 0;
  asm volatile("mrs %0, fpcr" : "=r"(bits));
  return static_cast<unsigned>(bits);
}
void set_control_bits(unsigned bits) {
  asm volatile("msr fpcr, %0" : : "r"(static_cast<unsigned long>(bits)));
}
#else
unsigned control_bits() {
  return 0;
}
void set_control_bits(unsigned) {}
#endif

std::string word(const char* text) {
  return text == nullptr ? std::string() : text;
}

}  // namespace

FloatMode::FloatMode() : control_(control_bits()), rounding_(std::fegetround()) {}

bool FloatMode::restore() const {
  if (control_bits() == control_ && std::fegetround() == rounding_) return false;
  std::fesetround(rounding_);
  set_control_bits(control_);
  return true;
}

LoadedPlugin::LoadedPlugin(const std::string& file) {
  const FloatMode mode;
  handle_ = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  changed_float_mode_ = mode.restore();
  if (handle_ == nullptr) throw std::runtime_error("cannot be loaded: " + word(::dlerror()));
  const auto fail = [this](const std::string& why) {
    ::dlclose(handle_);
    throw std::runtime_error(why);
  };
  entry_ = static_cast<const lmdbench_method_entry_type*>(::dlsym(handle_, "lmdbench_method_entry"));
  if (entry_ == nullptr) fail("exports no lmdbench_method_entry (lmdbench_method.h)");
  if (entry_->abi_major != LMDBENCH_METHOD_ABI_MAJOR ||
      entry_->struct_size < sizeof(lmdbench_method_entry_type))
    fail("is built for version " + std::to_string(entry_->abi_major) + "." +
         std::to_string(entry_->abi_minor) + " of lmdbench_method.h, and this program takes " +
         std::to_string(LMDBENCH_METHOD_ABI_MAJOR) + ".x: build it with this program's header");
  if (entry_->get == nullptr || entry_->get(0) == nullptr) fail("has no method");
  // A table that ends in NULL is asked no further.
  for (std::uint32_t i = 0; const lmdbench_method* described = entry_->get(i); ++i) {
    if (i == MOST_METHODS) fail("has more than " + std::to_string(MOST_METHODS) + " methods");
    const std::string which = "method " + std::to_string(i) + " ";
    if (described->struct_size < sizeof(lmdbench_method))
      fail(which + "is a structure of " + std::to_string(described->struct_size) + " bytes, not of " +
           std::to_string(sizeof(lmdbench_method)) + ": set struct_size to sizeof(lmdbench_method)");
    if (described->name == nullptr || described->version == nullptr || described->summary == nullptr)
      fail(which + "lacks its name, version or summary");
    if (described->create == nullptr || described->search == nullptr || described->destroy == nullptr)
      fail(which + "lacks create, search or destroy");
    if (const lmdbench_counters* counted = counters(*described))
      if (counted->count > LMDBENCH_MOST_COUNTERS || counted->names == nullptr ||
          counted->summaries == nullptr || counted->read == nullptr)
        fail(which + "counts more than it may, or lacks names, summaries or read");
    const lmdbench_force* own = force(*described);
    if (own != nullptr && (own->struct_size < sizeof(lmdbench_force) || own->read == nullptr))
      fail(which + "has a structure of force that is too small, or lacks read");
    if (own == nullptr && described->promise == LMDBENCH_PROMISE_FORCE_ONLY)
      fail(which + "promises a force and has none: answer " LMDBENCH_EXTENSION_FORCE " in extension");
  }
}

LoadedPlugin::~LoadedPlugin() {
  // Without dlclose: threads and destructors of the plugin may outlive its last instance.
}

const lmdbench_method* LoadedPlugin::method(std::uint32_t index) const {
  return index < MOST_METHODS ? entry_->get(index) : nullptr;
}

const lmdbench_counters* LoadedPlugin::counters(const lmdbench_method& method) {
  if (method.extension == nullptr) return nullptr;
  return static_cast<const lmdbench_counters*>(method.extension(LMDBENCH_EXTENSION_COUNTERS));
}

const lmdbench_force* LoadedPlugin::force(const lmdbench_method& method) {
  if (method.extension == nullptr) return nullptr;
  return static_cast<const lmdbench_force*>(method.extension(LMDBENCH_EXTENSION_FORCE));
}

LoadedMethod::LoadedMethod(const lmdbench_method& method, const lmdbench_mesh& a, const lmdbench_mesh& b,
                           double cutoff, const char* options)
    : method_(method), counters_(LoadedPlugin::counters(method)), force_(LoadedPlugin::force(method)) {
  std::array<char, 512> message{};
  const FloatMode mode;
  const auto begin = std::chrono::steady_clock::now();
  std::int32_t status = PluginReply::THREW;
  try {
    status = method.create(&a, &b, cutoff, options, &instance_, message.data(), message.size());
  } catch (...) {
  }
  seconds_to_make_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  changed_float_mode_ = mode.restore();
  message.back() = '\0';
  if (status != 0)
    throw std::runtime_error(std::strlen(message.data()) > 0 ? "says: " + std::string(message.data())
                             : status == PluginReply::THREW  ? "throws when it is made"
                                                             : "cannot be made and does not say why");
}

LoadedMethod::~LoadedMethod() {
  const FloatMode mode;
  try {
    method_.destroy(instance_);
  } catch (...) {
  }
  mode.restore();
}

PluginReply LoadedMethod::search(const double* X_BA, lmdbench_contact* contacts, std::uint64_t capacity) {
  PluginReply reply;
  constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
  reply.wrench.fill(NONE);
  const FloatMode mode;
  const auto begin = std::chrono::steady_clock::now();
  try {
    reply.status = method_.search(instance_, X_BA, contacts, capacity, &reply.needed);
    if (force_ != nullptr && reply.status == 0 && force_->read(instance_, reply.wrench.data()) != 0)
      reply.wrench.fill(NONE);
  } catch (...) {
    reply.status = PluginReply::THREW;
  }
  reply.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (counters_ != nullptr && reply.status == 0) counters_->read(instance_, reply.counters.data());
  reply.changed_float_mode = mode.restore() ? 1 : 0;
  return reply;
}

}  // namespace lmdbench
