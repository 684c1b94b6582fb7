// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/peers/peer_openvdb.hpp"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/RayIntersector.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace voxelume {
namespace {

constexpr double kBand = 3;  // voxels

using Leaf = openvdb::FloatTree::LeafNodeType;

/// The torus's distance in the leaves that its band touches, which are found by their centres.
openvdb::FloatGrid::Ptr torus_level_set(const BenchSolid& solid, double voxel) {
    const glm::dmat4 solid_from_world = glm::inverse(solid.world_from_solid);
    const auto distance = [&](const openvdb::Vec3d& index) {
        const glm::dvec3 p(solid_from_world *
                           glm::dvec4(glm::dvec3(index.x(), index.y(), index.z()) * voxel, 1));
        return std::hypot(std::hypot(p.x, p.z) - solid.solid.radius, p.y) - solid.solid.tube;
    };
    constexpr int kEdge = int(Leaf::DIM);
    const double reach = (kBand + std::sqrt(3.0) * kEdge / 2) * voxel;
    const int half = int(std::ceil((solid.solid.radius + solid.solid.tube + 0.05) / voxel / kEdge));
    std::vector<openvdb::Coord> corners;
    for (int z = -half; z < half; ++z)
        for (int y = -half; y < half; ++y)
            for (int x = -half; x < half; ++x) {
                const openvdb::Coord corner(x * kEdge, y * kEdge, z * kEdge);
                const openvdb::Vec3d middle = corner.asVec3d() + openvdb::Vec3d(kEdge / 2.0 - 0.5);
                if (std::abs(distance(middle)) < reach) corners.push_back(corner);
            }
    std::vector<Leaf*> leaves(corners.size());
    const double background = kBand * voxel;
    tbb::parallel_for(size_t(0), corners.size(), [&](size_t i) {
        Leaf* leaf = new Leaf(corners[i], float(background));
        for (openvdb::Index n = 0; n < Leaf::SIZE; ++n) {
            const double d = distance(leaf->offsetToGlobalCoord(n).asVec3d());
            if (std::abs(d) < background)
                leaf->setValueOn(n, float(d));
            else
                leaf->setValueOff(n, float(std::copysign(background, d)));
        }
        leaves[i] = leaf;
    });
    auto grid = openvdb::FloatGrid::create(float(background));
    for (Leaf* leaf : leaves) {
        if (leaf->isEmpty())
            delete leaf;
        else
            grid->tree().addLeaf(leaf);
    }
    openvdb::tools::signedFloodFill(grid->tree());
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    return grid;
}

openvdb::FloatGrid::Ptr level_set(const BenchSolid& solid, double voxel) {
    if (solid.solid.kind == SolidKind::torus) return torus_level_set(solid, voxel);
    const glm::dvec4& center = solid.world_from_solid[3];
    return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        float(solid.solid.radius),
        openvdb::Vec3f(float(center.x), float(center.y), float(center.z)), float(voxel),
        float(kBand));
}

}  // namespace

std::string openvdb_name() {
    return fmt::format("OpenVDB {}", openvdb::getLibraryVersionString());
}

PeerTimes run_openvdb(const BenchSolid& solid, int resolution, const BenchTruth& truth,
                      Image& image) {
    using Intersector = openvdb::tools::LevelSetRayIntersector<openvdb::FloatGrid>;
    PeerTimes times;
    auto start = std::chrono::steady_clock::now();
    const openvdb::FloatGrid::Ptr grid = level_set(solid, 1.0 / resolution);
    const Intersector shared(*grid);
    times.build = seconds_since(start);
    start = std::chrono::steady_clock::now();
    const PeerPlanes whole(image);
    for_bands(truth.size.y, [&](int first, int end) {
        Intersector intersector(shared);  // has a cache of its own
        PeerPlanes planes = whole;
        const openvdb::Vec3d eye(truth.eye.x, truth.eye.y, truth.eye.z);
        for (size_t pixel = size_t(first) * size_t(truth.size.x);
             pixel < size_t(end) * size_t(truth.size.x); ++pixel) {
            const glm::dvec3& d = truth.directions[pixel];
            const Intersector::RayType ray(eye, openvdb::Vec3d(d.x, d.y, d.z));
            openvdb::Vec3d at, normal;
            if (intersector.intersectsWS(ray, at, normal))
                planes.put(pixel, {at.x(), at.y(), at.z()}, {normal.x(), normal.y(), normal.z()});
            else
                planes.put_miss(pixel);
        }
    });
    times.trace = seconds_since(start);
    return times;
}

}  // namespace voxelume
