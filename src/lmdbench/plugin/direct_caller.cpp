// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/plugin/plugin_caller.h>
#include <lmdbench/plugin/wire.h>

#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

/// Contacts after the plugin's room; a change of them shows that it wrote beyond the end.
constexpr std::size_t CANARIES = 16;
constexpr int CANARY = 0xA5;

class DirectCaller : public PluginCaller {
 public:
  explicit DirectCaller(PluginTask task) : task_(std::move(task)) {
    try {
      plugin_ = std::make_unique<LoadedPlugin>(task_.file.string());
    } catch (const std::runtime_error& error) {
      throw InputError(task_.file.string(), "", error.what(), "lmdbench plugin check says more");
    }
    const auto mesh_of = [](const Body& body) {
      const TriangleMesh& mesh = body.surface().mesh;
      static_assert(sizeof(Vec3) == 3 * sizeof(double));
      return lmdbench_mesh{mesh.vertices.empty() ? nullptr : mesh.vertices.front().data(),
                           mesh.triangles.empty() ? nullptr : mesh.triangles.front().data(),
                           mesh.vertices.size(), mesh.triangles.size()};
    };
    try {
      const lmdbench_method* method = plugin_->method(task_.method);
      if (method == nullptr) throw std::runtime_error("has no such method any more");
      method_ = std::make_unique<LoadedMethod>(*method, mesh_of(*task_.a), mesh_of(*task_.b), task_.cutoff,
                                               task_.options.c_str());
      changed_float_mode_ = plugin_->changed_float_mode() || method_->changed_float_mode();
    } catch (const std::runtime_error& error) {
      why_not_ = error.what();
    }
    make_room(256);
  }

  double seconds_to_make() const override { return method_ == nullptr ? 0.0 : method_->seconds_to_make(); }

  PluginAnswer search(const double* X_BA) override {
    PluginAnswer answer;
    if (method_ == nullptr) {
      answer.lost = why_not_;
      return answer;
    }
    PluginReply reply = wire::search_with_room(
        capacity_, [&] { return call(X_BA); }, [&](std::uint64_t capacity) { make_room(capacity); });
    reply.changed_float_mode |= std::exchange(changed_float_mode_, false) ? 1U : 0U;
    judge_reply(reply, contacts_.data(), answer);
    return answer;
  }

 private:
  void make_room(std::uint64_t capacity) {
    capacity_ = capacity;
    contacts_.assign(capacity + CANARIES, {});
    std::memset(&contacts_[capacity], CANARY, CANARIES * sizeof(lmdbench_contact));
  }

  PluginReply call(const double* X_BA) {
    const PluginReply reply = method_->search(X_BA, contacts_.data(), capacity_);
    const auto* behind = reinterpret_cast<const unsigned char*>(&contacts_[capacity_]);
    for (std::size_t i = 0; i < CANARIES * sizeof(lmdbench_contact); ++i)
      if (behind[i] != CANARY)
        throw InputError(task_.file.string(), "",
                         "wrote past the end of its contacts into this program's memory",
                         "run it without --trusted-plugin; lmdbench plugin check finds the place");
    return reply;
  }

  PluginTask task_;
  std::unique_ptr<LoadedPlugin> plugin_;
  std::unique_ptr<LoadedMethod> method_;
  std::string why_not_;
  bool changed_float_mode_ = false;
  std::uint64_t capacity_ = 0;
  std::vector<lmdbench_contact> contacts_;
};

}  // namespace

std::unique_ptr<PluginCaller> make_direct_caller(PluginTask task) {
  return std::make_unique<DirectCaller>(std::move(task));
}

}  // namespace lmdbench
