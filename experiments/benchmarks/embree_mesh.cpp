// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <benchmarks/embree_mesh.h>
#include <embree3/rtcore.h>

#include <algorithm>
#include <cstdint>

namespace lmdbench::experiments {
namespace {

/// Margin of a search for roundings to single precision, relative to the largest coordinate. Those
/// of vertex, point, reach and the sums between them need less than a tenth of it.
constexpr double SINGLE_PRECISION_MARGIN = 1e-5;

struct QueryState {
  const std::function<double(std::int32_t)>& visit;
  double margin;
};

bool visit_primitive(RTCPointQueryFunctionArguments* arguments) {
  const auto& state = *static_cast<const QueryState*>(arguments->userPtr);
  const double reach = state.visit(static_cast<std::int32_t>(arguments->primID));
  const auto radius = static_cast<float>(reach + state.margin);
  if (!(radius < arguments->query->radius)) return false;
  arguments->query->radius = radius;
  return true;
}

}  // namespace

void EmbreeMesh::Release::operator()(RTCDeviceTy* device) const {
  rtcReleaseDevice(device);
}
void EmbreeMesh::Release::operator()(RTCSceneTy* scene) const {
  rtcReleaseScene(scene);
}

EmbreeMesh::EmbreeMesh(const TriangleMesh& mesh) : device_(rtcNewDevice(nullptr)) {
  if (!device_)
    throw EnvironmentError("", "Embree", "no device", "check that the processor has at least SSE2");
  scene_.reset(rtcNewScene(device_.get()));
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  auto* corners = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                              mesh.triangles.size()));
  double largest = 0.0;
  for (const Vec3& vertex : mesh.vertices) {
    largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
    for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(vertex[axis]);
  }
  for (const auto& triangle : mesh.triangles)
    for (const std::int32_t corner : triangle) *corners++ = static_cast<std::uint32_t>(corner);
  margin_ = SINGLE_PRECISION_MARGIN * largest;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
}

void EmbreeMesh::query(const Vec3& point, double reach, const Visitor& visit) const {
  QueryState state{visit, margin_};
  RTCPointQuery query;
  query.x = static_cast<float>(point.x());
  query.y = static_cast<float>(point.y());
  query.z = static_cast<float>(point.z());
  query.time = 0.0F;
  query.radius = static_cast<float>(reach + margin_);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &query, &context, visit_primitive, &state);
}

}  // namespace lmdbench::experiments
