// SPDX-License-Identifier: Apache-2.0
#include <openvdb/tools/RayIntersector.h>

#if VXL_BENCH_NANOVDB
#include <nanovdb/util/HDDA.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <nanovdb/util/Ray.h>
#endif

#include <glm/geometric.hpp>

#include "tests/bench/cpu_time.hpp"
#include "tests/bench/peers/peer_level_set.hpp"
#include "tests/bench/peers/trace_peers.hpp"

namespace voxelume {
namespace {

TracePeer openvdb_peer(const openvdb::FloatGrid::Ptr& grid, double build_seconds) {
    using Intersector = openvdb::tools::LevelSetRayIntersector<openvdb::FloatGrid>;
    const auto intersector = std::make_shared<Intersector>(*grid);
    return {"OpenVDB level set", build_seconds, [grid, intersector](const auto& rays, PeerQuery) {
                std::vector<Intersector::RayType> list;
                for (const PeerRay& r : rays)
                    list.emplace_back(openvdb::Vec3d(r.origin.x, r.origin.y, r.origin.z),
                                      openvdb::Vec3d(r.direction.x, r.direction.y, r.direction.z));
                return PeerPass([intersector, list] {
                    size_t hits = 0;
                    openvdb::Vec3d at;
                    for (const auto& ray : list) hits += intersector->intersectsWS(ray, at);
                    return hits;
                });
            }};
}

#if VXL_BENCH_NANOVDB
TracePeer nanovdb_peer(const openvdb::FloatGrid& source, double build_seconds) {
    const double start = cpu_seconds();
    const auto handle = std::make_shared<nanovdb::GridHandle<>>(nanovdb::openToNanoVDB(source));
    build_seconds += cpu_seconds() - start;
    return {"NanoVDB level set", build_seconds, [handle](const auto& rays, PeerQuery) {
                using Ray = nanovdb::Ray<float>;
                const auto* grid = handle->template grid<float>();
                std::vector<Ray> list;
                for (const PeerRay& r : rays)
                    list.push_back(Ray({r.origin.x, r.origin.y, r.origin.z},
                                       {r.direction.x, r.direction.y, r.direction.z})
                                       .worldToIndexF(*grid));
                return PeerPass([grid, handle, list] {
                    auto accessor = grid->tree().getAccessor();
                    size_t hits = 0;
                    nanovdb::Coord cell;
                    float value = 0, t = 0;
                    for (Ray ray : list)
                        hits += nanovdb::ZeroCrossing(ray, accessor, cell, value, t);
                    return hits;
                });
            }};
}
#endif

}  // namespace

std::vector<TracePeer> level_set_tracers(const Mesh& mesh, double voxel) {
    const double start = cpu_seconds();
    const openvdb::FloatGrid::Ptr grid = level_set(mesh, voxel);
    const double seconds = cpu_seconds() - start;
    std::vector<TracePeer> peers = {openvdb_peer(grid, seconds)};
#if VXL_BENCH_NANOVDB
    peers.push_back(nanovdb_peer(*grid, seconds));
#endif
    return peers;
}

}  // namespace voxelume
