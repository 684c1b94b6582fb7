// SPDX-License-Identifier: Apache-2.0
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/cpu_time.hpp"
#include "tests/bench/peers/trace_peers.hpp"

namespace voxelume {
namespace {

/// Embree's calls for packets of kWidth rays.
template <int kWidth>
struct Packets;

template <>
struct Packets<8> {
    using RayHit = RTCRayHit8;
    using Ray = RTCRay8;
    static constexpr auto kClosest = rtcIntersect8;
    static constexpr auto kOccluded = rtcOccluded8;
};

template <>
struct Packets<16> {
    using RayHit = RTCRayHit16;
    using Ray = RTCRay16;
    static constexpr auto kClosest = rtcIntersect16;
    static constexpr auto kOccluded = rtcOccluded16;
};

RTCIntersectContext context_of(PeerQuery query) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (query != PeerQuery::closest_incoherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

template <int kWidth>
PeerPass packet_pass(RTCScene scene, const std::vector<PeerRay>& rays, PeerQuery query) {
    using Kind = Packets<kWidth>;
    struct alignas(64) Packet {
        typename Kind::RayHit rays;
        int valid[kWidth];
    };
    auto packets = std::make_shared<std::vector<Packet>>((rays.size() + kWidth - 1) / kWidth);
    for (size_t i = 0; i < packets->size() * kWidth; ++i) {
        Packet& packet = (*packets)[i / kWidth];
        const size_t lane = i % kWidth;
        const PeerRay& ray = rays[std::min(i, rays.size() - 1)];
        packet.valid[lane] = i < rays.size() ? -1 : 0;
        auto& r = packet.rays.ray;
        r.org_x[lane] = ray.origin.x, r.org_y[lane] = ray.origin.y, r.org_z[lane] = ray.origin.z;
        r.dir_x[lane] = ray.direction.x, r.dir_y[lane] = ray.direction.y;
        r.dir_z[lane] = ray.direction.z;
        r.tnear[lane] = 0, r.time[lane] = 0, r.mask[lane] = ~0u, r.flags[lane] = 0;
    }
    return [scene, packets, query] {
        size_t hits = 0;
        for (Packet& packet : *packets) {
            RTCIntersectContext context = context_of(query);
            std::fill_n(packet.rays.ray.tfar, kWidth, INFINITY);
            if (query == PeerQuery::occluded_coherent) {
                Kind::kOccluded(packet.valid, scene, &context, &packet.rays.ray);
                for (int i = 0; i < kWidth; ++i)
                    hits += packet.valid[i] && packet.rays.ray.tfar[i] < 0;
                continue;
            }
            std::fill_n(packet.rays.hit.geomID, kWidth, RTC_INVALID_GEOMETRY_ID);
            Kind::kClosest(packet.valid, scene, &context, &packet.rays);
            for (int i = 0; i < kWidth; ++i)
                hits += packet.valid[i] && packet.rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        }
        return hits;
    };
}

PeerPass single_pass(RTCScene scene, const std::vector<PeerRay>& rays, PeerQuery query) {
    auto list = std::make_shared<std::vector<RTCRayHit>>(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) {
        RTCRay& ray = (*list)[i].ray;
        ray.org_x = rays[i].origin.x, ray.org_y = rays[i].origin.y, ray.org_z = rays[i].origin.z;
        ray.dir_x = rays[i].direction.x, ray.dir_y = rays[i].direction.y;
        ray.dir_z = rays[i].direction.z;
        ray.tnear = 0, ray.time = 0, ray.mask = ~0u, ray.flags = 0;
    }
    return [scene, list, query] {
        size_t hits = 0;
        for (RTCRayHit& ray : *list) {
            RTCIntersectContext context = context_of(query);
            ray.ray.tfar = INFINITY;
            ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            if (query == PeerQuery::occluded_coherent)
                rtcOccluded1(scene, &context, &ray.ray);
            else
                rtcIntersect1(scene, &context, &ray);
            hits += ray.ray.tfar < 0 || ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
        return hits;
    };
}

/// A scene with its own copy of the mesh; it lives as long as the program.
RTCScene build_scene(const Mesh& mesh) {
    static const RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), mesh.positions.size()));
    std::ranges::copy(mesh.positions, positions);
    auto* triangles = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), mesh.triangles.size()));
    std::ranges::transform(mesh.triangles, triangles,
                           [](const auto& t) { return glm::uvec3(t[0], t[1], t[2]); });
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

}  // namespace

std::vector<TracePeer> embree_tracers(const Mesh& mesh) {
    const double start = cpu_seconds();
    RTCScene scene = build_scene(mesh);
    const double seconds = cpu_seconds() - start;
    const auto peer = [&](const char* name, auto&& pass) {
        return TracePeer{name, seconds, [scene, pass](const auto& rays, PeerQuery query) {
                             return pass(scene, rays, query);
                         }};
    };
    return {peer("Embree 3, 1", single_pass), peer("Embree 3, 8", packet_pass<8>),
            peer("Embree 3, 16", packet_pass<16>)};
}

}  // namespace voxelume
