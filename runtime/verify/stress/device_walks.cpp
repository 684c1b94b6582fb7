// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/device_walks.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "runtime/verify/exact/occupancy.hpp"

namespace voxelume {
namespace {

PyramidShape shape_of_grid(const FixedGrid& grid) {
    Pyramid pyramid;
    pyramid.frame.size = grid.size;
    return shape_of(pyramid);
}

Defines defines_of(const Device& device, Steps steps) {
    return {{"VXL_BLOCKS", steps == Steps::blocks}, {"VXL_NATIVE_DIVIDE", device.is_cpu()}};
}

Buffer<float> upload_rays(const Device& device, const FixedGrid& grid,
                          std::span<const FixedRay> rays) {
    const std::vector<float> values = ray_components(grid, rays, ray_stride(rays.size()));
    return {device, "stress rays", std::span<const float>(values)};
}

}  // namespace

std::vector<float> ray_components(const FixedGrid& grid, std::span<const FixedRay> rays,
                                  uint32_t stride) {
    std::vector<float> values(size_t(stride) * VXL_RAY_COMPONENTS, 0.0f);
    for (size_t i = 0; i < rays.size(); ++i) {
        for (size_t a = 0; a < 3; ++a) {
            values[(VXL_RAY_OX + a) * stride + i] = float(rays[i].origin[a]) / float(grid.unit());
            values[(VXL_RAY_DX + a) * stride + i] =
                float(rays[i].direction[a]) / float(1 << VXL_DIRECTION_BITS);
        }
        values[size_t(VXL_RAY_END) * stride + i] = std::numeric_limits<float>::infinity();
    }
    for (size_t i = rays.size(); i < stride; ++i) values[size_t(VXL_RAY_END) * stride + i] = -1;
    return values;
}

DeviceWalks::DeviceWalks(const Device& device)
    : device_(device),
      cells_(device, "stress.cl", defines_of(device, Steps::cells)),
      blocks_(device, "stress.cl", defines_of(device, Steps::blocks)) {}

void DeviceWalks::start(const FixedGrid& grid, std::span<const FixedRay> rays, Steps steps,
                        uint32_t maximum) {
    count_ = uint32_t(rays.size());
    const uint32_t stride = ray_stride(count_);
    digests_ = Buffer<uint32_t>(device_, "digests", size_t(stride) * 2);
    (steps == Steps::cells ? cells_ : blocks_)
        .kernel("digest_walks")
        .launch_packets(count_, shape_of_grid(grid), upload_rays(device_, grid, rays), count_,
                        stride, maximum, digests_);
}

std::vector<WalkDigest> DeviceWalks::digests() const {
    const std::vector<uint32_t> words = digests_.read();
    std::vector<WalkDigest> digests;
    digests.reserve(count_);
    for (size_t i = 0; i < count_; ++i) digests.push_back({words[i], words[words.size() / 2 + i]});
    return digests;
}

std::vector<EnteredCell> DeviceWalks::cells(const FixedGrid& grid, const FixedRay& ray, Steps steps,
                                            uint32_t maximum) {
    const uint32_t stride = 16;
    Buffer<int> lists(device_, "cell lists", size_t(maximum) * 5 * stride);
    lists.fill(-1);
    (steps == Steps::cells ? cells_ : blocks_)
        .kernel("list_walks")
        .launch_packets(1, shape_of_grid(grid), upload_rays(device_, grid, {&ray, 1}), 1u, stride,
                        maximum, lists);
    const std::vector<int> words = lists.read();
    std::vector<EnteredCell> cells;
    for (size_t at = 0; at < words.size() && words[at] >= 0; at += size_t(5) * stride)
        cells.push_back({{words[at], words[at + stride], words[at + 2 * stride]},
                         words[at + 3 * stride],
                         std::bit_cast<float>(words[at + 4 * stride])});
    return cells;
}

std::vector<std::optional<FixedRay>> DeviceWalks::snap(const FixedGrid& grid,
                                                       std::span<const FloatRay> rays) {
    const uint32_t count = uint32_t(rays.size()), stride = ray_stride(count);
    std::vector<float> values(size_t(stride) * VXL_RAY_COMPONENTS, 1.0f);
    for (size_t i = 0; i < count; ++i)
        for (int a = 0; a < 3; ++a) {
            values[size_t(VXL_RAY_OX + a) * stride + i] = rays[i].origin[a];
            values[size_t(VXL_RAY_DX + a) * stride + i] = rays[i].direction[a];
        }
    Buffer<float> snapped(device_, "snapped rays", values.size());
    cells_.kernel("snap_rays")
        .launch_packets(count, shape_of_grid(grid),
                        Buffer<float>(device_, "float rays", std::span<const float>(values)), count,
                        stride, snapped);
    const std::vector<float> words = snapped.read();
    std::vector<std::optional<FixedRay>> result(count);
    for (size_t i = 0; i < count; ++i) {
        if (!(words[size_t(VXL_RAY_END) * stride + i] >= 0)) continue;
        FixedRay ray;
        for (size_t a = 0; a < 3; ++a) {
            ray.origin[a] = int64_t(words[(VXL_RAY_OX + a) * stride + i] * float(grid.unit()));
            ray.direction[a] =
                int64_t(words[(VXL_RAY_DX + a) * stride + i] * float(1 << VXL_DIRECTION_BITS));
        }
        result[i] = ray;
    }
    return result;
}

BrickGrid cubes_of(const Device& device, const VoxelBits& voxels, const GridFrame& frame) {
    BrickGrid grid;
    grid.frame = frame;
    const glm::ivec3 bricks = grid.frame.bricks();
    std::vector<uint32_t> slots, coordinates;
    std::vector<uint64_t> occupancy;
    for (glm::ivec3 b{0}; b.z < bricks.z; ++b.z)
        for (b.y = 0; b.y < bricks.y; ++b.y)
            for (b.x = 0; b.x < bricks.x; ++b.x) {
                std::array<uint64_t, 64> masks{};
                const glm::ivec3 first = b * kBrickSize;
                const glm::ivec3 end = glm::min(first + kBrickSize, voxels.size());
                bool any = false;
                for (glm::ivec3 v = first; v.z < end.z; ++v.z)
                    for (v.y = first.y; v.y < end.y; ++v.y)
                        for (v.x = first.x; v.x < end.x; ++v.x) {
                            if (!voxels.is_set(v)) continue;
                            const VoxelSlot voxel_slot(v);
                            masks[voxel_slot.leaf] |= voxel_slot.bit;
                            any = true;
                        }
                slots.push_back(any ? uint32_t(coordinates.size()) : kBrickOutside);
                if (!any) continue;
                coordinates.push_back(uint32_t(slots.size() - 1));
                occupancy.insert(occupancy.end(), masks.begin(), masks.end());
            }
    grid.brick_count = uint32_t(coordinates.size());
    grid.slots = {device, "slots", std::span<const uint32_t>(slots)};
    grid.coordinates = {device, "coordinates", std::span<const uint32_t>(coordinates)};
    grid.occupancy = {device, "occupancy", std::span<const uint64_t>(occupancy)};
    return grid;
}

DeviceHits::DeviceHits(const Device& device, const Pyramid& pyramid)
    : device_(device), pyramid_(pyramid), stage_(device, features_of(pyramid)) {}

void DeviceHits::upload(const FixedGrid& grid, std::span<const FixedRay> rays) {
    count_ = uint32_t(rays.size());
    batch_ = {};
    batch_.stride = ray_stride(count_);
    batch_.rays = upload_rays(device_, grid, rays);
    batch_.hits = Buffer<uint32_t>(device_, "hits", size_t(batch_.stride) * VXL_HIT_COMPONENTS);
}

void DeviceHits::start(const FixedGrid& grid, std::span<const FixedRay> rays) {
    upload(grid, rays);
    stage_.closest(pyramid_, batch_, count_);
}

void DeviceHits::start_along_beams(const FixedGrid& grid, std::span<const FixedRay> rays) {
    upload(grid, rays);
    if (!beams_)
        beams_.emplace(device_, features_of(pyramid_), pyramid_,
                       build_dilated_occupancy(device_, pyramid_));
    beams_->start(batch_, count_);
    stage_.closest(pyramid_, batch_, count_);
}

std::vector<std::optional<EnteredCell>> DeviceHits::hits() const {
    const std::vector<uint32_t> words = batch_.hits.read();
    const size_t stride = batch_.stride;
    std::vector<std::optional<EnteredCell>> hits(count_);
    for (size_t i = 0; i < count_; ++i) {
        if (words[VXL_HIT_VOXEL * stride + i] == VXL_NO_VOXEL) continue;
        const uint32_t xy = words[VXL_HIT_CELL * stride + i];
        const uint32_t face = words[VXL_HIT_FACE * stride + i];
        hits[i] = {{int(xy & 0xFFFF), int(xy >> 16), int(face & 0xFFFF)},
                   int(face >> VXL_FACE_AXIS_SHIFT & VXL_FACE_AXIS_MASK),
                   std::bit_cast<float>(words[VXL_HIT_T * stride + i])};
    }
    return hits;
}

}  // namespace voxelume
