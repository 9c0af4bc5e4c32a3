// SPDX-License-Identifier: MIT
#include "relucent/venue/ray_caster.h"

#include <tbb/task_arena.h>

#include <cstring>

#include "relucent/base/error.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace relucent::venue {

struct RayCaster::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

template <typename Element>
Element* newBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), count);
  if (!buffer)
    throw Error(
        ErrorKind::memory,
        RELUCENT_ENGLISH_MESSAGE("venue.not-enough-memory", "not enough memory for the simulated venue"),
        RELUCENT_ENGLISH_MESSAGE("venue.close-other-programs", "close other programs"));
  return static_cast<Element*>(buffer);
}

void attach(RTCDevice device, RTCScene scene, const Mesh& mesh, unsigned id) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = newBuffer<std::array<float, 3>>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                                   mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    vertices[i] = {mesh.positions[i].x(), mesh.positions[i].y(), mesh.positions[i].z()};
  auto* triangles = newBuffer<std::array<std::uint32_t, 3>>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                                            mesh.triangles.size());
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

void fill(RTCRay& to, const Ray& ray, float farthest) {
  to.org_x = ray.origin.x();
  to.org_y = ray.origin.y();
  to.org_z = ray.origin.z();
  to.dir_x = ray.direction.x();
  to.dir_y = ray.direction.y();
  to.dir_z = ray.direction.z();
  to.tnear = 0.0f;
  to.tfar = farthest;
  to.time = 0.0f;
  to.mask = ~0u;
  to.id = 0;
  to.flags = 0;
}

// Version 4 dropped the context argument.
#if RTC_VERSION_MAJOR >= 4
void intersect(RTCScene scene, RTCRayHit& query) {
  rtcIntersect1(scene, &query);
}
void occlude(RTCScene scene, RTCRay& query) {
  rtcOccluded1(scene, &query);
}
#else
void intersect(RTCScene scene, RTCRayHit& query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
}
void occlude(RTCScene scene, RTCRay& query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &query);
}
#endif

}  // namespace

RayCaster::RayCaster(const std::vector<const Mesh*>& meshes) : state_(std::make_unique<State>()) {
  state_->device = rtcNewDevice(nullptr);
  require(state_->device != nullptr, "Embree gives no device (error {})",
          static_cast<int>(rtcGetDeviceError(nullptr)));
  state_->scene = rtcNewScene(state_->device);
  rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
  for (std::size_t i = 0; i < meshes.size(); ++i)
    attach(state_->device, state_->scene, *meshes[i], static_cast<unsigned>(i));
  // On one thread, so that the tree never depends on how many there are.
  tbb::task_arena(1).execute([&] { rtcCommitScene(state_->scene); });
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

std::optional<RayHit> RayCaster::nearest(const Ray& ray) const {
  RTCRayHit query;
  fill(query.ray, ray, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  intersect(state_->scene, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  RayHit hit;
  hit.distance = query.ray.tfar;
  hit.mesh = query.hit.geomID;
  hit.triangle = query.hit.primID;
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  hit.normal = Eigen::Vector3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).normalized();
  return hit;
}

bool RayCaster::blocked(const Ray& ray, float distance) const {
  RTCRay query;
  fill(query, ray, distance);
  occlude(state_->scene, query);
  return query.tfar < 0.0f;
}

}  // namespace relucent::venue
