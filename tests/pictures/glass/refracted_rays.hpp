// SPDX-License-Identifier: Apache-2.0
// The sight rays of a scene and their hits, followed through refractions by hand.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "runtime/render/illumination.hpp"
#include "runtime/stages/trace/sight.hpp"
#include "runtime/world/world.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

/// The rays of a flat image, one per pixel; width times height is a multiple of 16. Lengths are in
/// voxels, and positions are relative to the world's first corner.
class RefractedRays {
  public:
    RefractedRays(const Scene& scene, uint32_t count)
        : count_(count),
          world_(build_world(device_, scene, report_)),
          features_(features_of(scene, world_)),
          trace_(device_, features_),
          shade_(device_, features_, scene, world_.frame),
          scatter_(device_, features_, {shade_.materials(), shade_.ranks()}, 0, false) {
        rays_ = allocate_batch(device_, features_, count);
        SightStage(device_, features_, camera_of(scene, world_.frame))
            .cast(shape_of(world_), 0, count / 16, rays_);
        scatter_.begin(world_, rays_, count);
        find_points();
    }

    /// Continues with the refracted rays. Every ray must have a refracted ray and no reflected one.
    void refract() {
        Children children;
        children.nodes = Buffer<uint32_t>(device_, "children", 2 * rays_.stride);
        children.child_weights = Buffer<float>(device_, "child weights", 2 * rays_.stride);
        children.node_weights = Buffer<float>(device_, "node weights", 3 * rays_.stride);
        children.node_weights.fill(1);
        RayBatch queue = allocate_batch(device_, features_, 2 * count_);
        scatter_.rays(world_, rays_, first_, first_ + count_, children, queue);
        rays_ = std::move(queue);
        first_ = count_;
        find_points();
    }

    glm::dvec3 origin(uint32_t i) const { return row(rays_.rays, VXL_RAY_OX, i); }
    glm::dvec3 direction(uint32_t i) const {
        return glm::normalize(row(rays_.rays, VXL_RAY_DX, i));
    }
    glm::dvec3 position(uint32_t i) const { return row(rays_.positions, 0, i); }
    glm::dvec3 normal(uint32_t i) const { return row(rays_.normals, 0, i); }
    bool is_hit(uint32_t i) const {
        return rays_.hits.read_one(VXL_HIT_VOXEL * size_t(rays_.stride) + first_ + i) !=
               VXL_NO_VOXEL;
    }
    uint32_t side(uint32_t i) const { return rays_.sides.read_one(first_ + i); }

  private:
    void find_points() {
        trace_.closest(world_, rays_, rays_.stride);
        shade_.surface(world_, rays_, rays_.stride);
    }

    glm::dvec3 row(const Buffer<float>& values, uint32_t component, uint32_t i) const {
        const size_t stride = rays_.stride, at = first_ + i;
        return {values.read_one(component * stride + at),
                values.read_one((component + 1) * stride + at),
                values.read_one((component + 2) * stride + at)};
    }

    uint32_t count_;
    Device device_ = test_device();
    WorldReport report_;
    Pyramid world_;
    Features features_;
    TraceStage trace_;
    ShadeStage shade_;
    ScatterStage scatter_;
    RayBatch rays_;
    uint32_t first_ = 0;
};

}  // namespace voxelume
