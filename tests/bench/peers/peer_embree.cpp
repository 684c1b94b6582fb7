// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/peers/peer_embree.hpp"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace voxelume {
namespace {

glm::dvec3 surface_point(const Solid& solid, double u, double v) {
    const double around = 2 * glm::pi<double>() * u;
    if (solid.kind == SolidKind::sphere) {
        const double polar = glm::pi<double>() * v;
        return solid.radius * glm::dvec3(std::sin(polar) * std::cos(around), std::cos(polar),
                                         std::sin(polar) * std::sin(around));
    }
    const double along = 2 * glm::pi<double>() * v;
    const double radius = solid.radius + solid.tube * std::cos(along);
    return {radius * std::cos(around), solid.tube * std::sin(along), radius * std::sin(around)};
}

/// The only device, with its threads; it lives as long as the program.
RTCDevice embree_device() {
    static const RTCDevice device =
        rtcNewDevice(fmt::format("threads={}", std::thread::hardware_concurrency()).c_str());
    return device;
}

void trace_rows(RTCScene scene, const BenchTruth& truth, PeerPlanes planes, int first, int end) {
    alignas(64) RTCRayHit16 packet;
    alignas(64) int valid[16];
    std::fill_n(valid, 16, -1);
    for (int row = first; row < end; row += 4) {
        for (int column = 0; column + 4 <= truth.size.x; column += 4) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
            const auto pixel = [&](int i) {
                return size_t(row + i / 4) * size_t(truth.size.x) + size_t(column + i % 4);
            };
            for (int i = 0; i < 16; ++i) {
                const glm::vec3 direction(truth.directions[pixel(i)]);
                packet.ray.org_x[i] = float(truth.eye.x), packet.ray.dir_x[i] = direction.x;
                packet.ray.org_y[i] = float(truth.eye.y), packet.ray.dir_y[i] = direction.y;
                packet.ray.org_z[i] = float(truth.eye.z), packet.ray.dir_z[i] = direction.z;
                packet.ray.tnear[i] = 0, packet.ray.tfar[i] = INFINITY, packet.ray.time[i] = 0;
                packet.ray.mask[i] = ~0u, packet.ray.flags[i] = 0;
                packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            }
            rtcIntersect16(valid, scene, &context, &packet);
            for (int i = 0; i < 16; ++i) {
                if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
                    planes.put_miss(pixel(i));
                    continue;
                }
                const glm::dvec3 p =
                    truth.eye + double(packet.ray.tfar[i]) * truth.directions[pixel(i)];
                const glm::vec3 normal(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]);
                planes.put(pixel(i), p, glm::normalize(normal));
            }
        }
    }
}

}  // namespace

PeerMesh tessellated(const BenchSolid& solid, int rings) {
    const int columns = 2 * rings;
    PeerMesh mesh;
    for (int v = 0; v <= rings; ++v)
        for (int u = 0; u <= columns; ++u)
            mesh.positions.emplace_back(
                solid.world_from_solid *
                glm::dvec4(surface_point(solid.solid, double(u) / columns, double(v) / rings), 1));
    const auto number = [columns](int u, int v) { return uint32_t(v * (columns + 1) + u); };
    for (int v = 0; v < rings; ++v)
        for (int u = 0; u < columns; ++u) {
            const uint32_t corner = number(u, v), across = number(u + 1, v + 1);
            uint32_t neighbour = number(u + 1, v), above = number(u, v + 1);
            // v runs downwards on the sphere but upwards on the torus's outer side.
            if (solid.solid.kind != SolidKind::sphere) std::swap(neighbour, above);
            mesh.triangles.emplace_back(corner, neighbour, across);
            mesh.triangles.emplace_back(corner, across, above);
        }
    mesh.positions.reserve(mesh.positions.size() + 2);
    return mesh;
}

std::string embree_name() {
    return fmt::format("Embree {}.{}.{}", RTC_VERSION_MAJOR, RTC_VERSION_MINOR, RTC_VERSION_PATCH);
}

PeerTimes run_embree(const PeerMesh& mesh, const BenchTruth& truth, Image& image) {
    PeerTimes times;
    auto start = std::chrono::steady_clock::now();
    RTCDevice device = embree_device();
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // without it rays pass between triangles
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               mesh.positions.data(), 0, sizeof(glm::vec3), mesh.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.triangles.data(), 0, sizeof(glm::uvec3), mesh.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    times.build = seconds_since(start);
    start = std::chrono::steady_clock::now();
    const PeerPlanes planes(image);
    for_bands(truth.size.y,
              [&](int first, int end) { trace_rows(scene, truth, planes, first, end); });
    times.trace = seconds_since(start);
    rtcReleaseScene(scene);
    return times;
}

}  // namespace voxelume
