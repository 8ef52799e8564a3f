// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// `certified` behind the interface for methods from outside. Its results must not change on the
// way, and the cost of the interface can be measured.
#include <lmdbench/methods/registry.h>
#include <lmdbench/plugin/lmdbench_method.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>

namespace lmdbench {
namespace {

struct Instance {
  Scene scene;
  std::unique_ptr<Method> method;
  LmdSet lmds;
  WorkCounters counters;
};

std::shared_ptr<const Body> body_of(const lmdbench_mesh& from) {
  TriangleMesh mesh;
  for (std::uint64_t v = 0; v < from.vertex_count; ++v)
    mesh.vertices.emplace_back(from.vertices[3 * v], from.vertices[3 * v + 1], from.vertices[3 * v + 2]);
  for (std::uint64_t t = 0; t < from.triangle_count; ++t)
    mesh.triangles.push_back({from.triangles[3 * t], from.triangles[3 * t + 1], from.triangles[3 * t + 2]});
  return std::make_shared<const Body>("mesh", build_surface(std::move(mesh)));
}

std::int32_t create(const lmdbench_mesh* a, const lmdbench_mesh* b, double cutoff, const char* options,
                    void** instance, char* message, std::uint64_t message_size) {
  try {
    auto made = std::make_unique<Instance>();
    made->scene = {body_of(*a), {body_of(*b)}, cutoff};
    made->method = method_description("certified").make(made->scene, nlohmann::json::parse(options));
    *instance = made.release();
    return 0;
  } catch (const std::exception& error) {
    std::snprintf(message, message_size, "%s", error.what());
    return 1;
  }
}

std::int32_t part_of(const Surface& surface, std::int32_t triangle, const FeatureId& feature) {
  std::int32_t part = LMDBENCH_CORNER_0;
  while (part < LMDBENCH_FACE && surface.feature_of(triangle, static_cast<TriangleFeature>(part)) != feature)
    ++part;
  return part;
}

std::int32_t search(void* instance, const double* X, lmdbench_contact* contacts, std::uint64_t capacity,
                    std::uint64_t* needed) {
  auto& self = *static_cast<Instance*>(instance);
  Mat3 rotation;
  rotation << X[0], X[1], X[2], X[4], X[5], X[6], X[8], X[9], X[10];
  self.counters = {};
  self.method->search({Vec3(X[3], X[7], X[11]), Eigen::Quaterniond(rotation).normalized()}, self.lmds,
                      self.counters);
  *needed = self.lmds.size();
  for (std::uint64_t i = 0; i < std::min(capacity, *needed); ++i) {
    const Lmd& lmd = self.lmds[i];
    Eigen::Map<Vec3>(contacts[i].point_a) = lmd.point_moving;
    Eigen::Map<Vec3>(contacts[i].point_b) = lmd.point_fixed;
    contacts[i].triangle_a = lmd.triangle_moving;
    contacts[i].triangle_b = lmd.triangle_fixed;
    contacts[i].part_a = part_of(self.scene.moving->surface(), lmd.triangle_moving, lmd.feature_moving);
    contacts[i].part_b = part_of(self.scene.fixed[0]->surface(), lmd.triangle_fixed, lmd.feature_fixed);
  }
  return 0;
}

void destroy(void* instance) {
  delete static_cast<Instance*>(instance);
}

constexpr const char* NAMES[] = {"node_pairs"};
constexpr const char* SUMMARIES[] = {"the first counter of certified"};
void read_counters(void* instance, std::uint64_t* values) {
  values[0] = static_cast<Instance*>(instance)->counters.values[0];
}
constexpr lmdbench_counters COUNTERS = {1, NAMES, SUMMARIES, read_counters};

const void* extension(const char* id) {
  return std::string_view(id) == LMDBENCH_EXTENSION_COUNTERS ? &COUNTERS : nullptr;
}

constexpr const char* OPTIONS =
    R"({"frame_coherence": {"type": "boolean", "description": "reuse the last frame's tests", "default": true},
        "kernel": {"enum": ["best", "scalar"], "description": "vector instructions", "default": "best"}})";

constexpr lmdbench_method METHOD = {sizeof(lmdbench_method),
                                    "certified-plugin",
                                    "1",
                                    "certified itself, behind the interface for methods from outside",
                                    LMDBENCH_PROMISE_COMPLETE_SET,
                                    LMDBENCH_KEEPS_FRAMES,
                                    OPTIONS,
                                    create,
                                    search,
                                    destroy,
                                    extension};

const lmdbench_method* get(std::uint32_t index) {
  return index == 0 ? &METHOD : nullptr;
}

}  // namespace
}  // namespace lmdbench

const lmdbench_method_entry_type lmdbench_method_entry = {
    LMDBENCH_METHOD_ABI_MAJOR, LMDBENCH_METHOD_ABI_MINOR, sizeof(lmdbench_method_entry_type), lmdbench::get};
