// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/voxelize_steps.hpp"

#include <algorithm>

#include "runtime/stages/brick_arrays.hpp"

namespace voxelume {
namespace {

/// The number of a brick's slices that one work-item handles: all of them on devices with few
/// cores, else one layer of leaves.
int slices_per_item(const Device& device) {
    return device.is_cpu() ? kBrickSize : kLeafSize;
}

}  // namespace

size_t VoxelizeJob::items() const {
    return size_t(bins.stored) * (kBrickSize / slices_per_item(device));
}

Defines slice_defines(const Device& device) {
    return {{"VXL_SLICES", slices_per_item(device)}, {"VXL_NATIVE_DIVIDE", device.is_cpu()}};
}

glm::vec4 edge_scale(const GridFrame& frame) {
    const glm::dvec3& e = frame.voxel_edge;
    return glm::vec4(e / std::min({e.x, e.y, e.z}), 0);
}

glm::ivec3 band_reach(const GridFrame& frame, double band) {
    const glm::dvec3& e = frame.voxel_edge;
    return glm::ivec3(glm::ceil(band * std::min({e.x, e.y, e.z}) / e * double(kLatticePerVoxel))) +
           1;
}

Buffer<float> allocate_shapes(const Device& device, size_t triangles) {
    constexpr size_t kShapeFloats = 20;  // SHAPE_FLOATS of kernels/lib/voxelize/point_triangle.h
    return {device, "triangle shapes", kShapeFloats * triangles};
}

Buffer<float> shape_triangles(const VoxelizeJob& job, const Program& distance) {
    Buffer<float> shapes = allocate_shapes(job.device, job.triangles.count);
    distance.kernel("shape_triangles")
        .launch(WorkItem::light, job.triangles.count, edge_scale(job.grid.frame), job.triangles,
                shapes);
    return shapes;
}

void cover_bricks(VoxelizeJob& job, const Program& cover) {
    job.grid.occupancy = allocate_masks(job.device, "occupancy", job.bins.stored);
    cover.kernel("cover_bricks")
        .launch(WorkItem::heavy, job.items(), job.bins.stored, job.size, job.bricks, job.triangles,
                job.bins, job.grid.occupancy);
}

void mark_outside(VoxelizeJob& job, const Program& bin) {
    const auto rows = static_cast<uint32_t>(job.bricks.y * job.bricks.z);
    bin.kernel("mark_outside")
        .launch(WorkItem::light, rows, rows, job.bins.size, job.bins.number_of_bin, job.grid.slots);
}

void fill_solid(VoxelizeJob& job, const Program& winding, const Buffer<uint16_t>& inside) {
    job.grid.occupancy = allocate_masks(job.device, "occupancy", job.bins.stored);
    winding.kernel("fill_solid")
        .launch(WorkItem::heavy, job.bins.stored, job.bins.stored, job.size, job.bricks,
                job.bins.coordinates, inside, job.grid.occupancy);
}

void measure_distances(VoxelizeJob& job, const Program& distance, const Buffer<uint16_t>& inside,
                       double band) {
    const glm::ivec4 reach(band_reach(job.grid.frame, band), 0);
    const Buffer<float> shapes = shape_triangles(job, distance);
    job.grid.distance = allocate_distances(job.device, "distances", job.bins.stored);
    distance.kernel("measure_distances")
        .launch(WorkItem::heavy, job.items(), job.bins.stored, job.bricks, reach,
                edge_scale(job.grid.frame), static_cast<float>(band), job.triangles, job.bins,
                shapes, inside, job.grid.distance);
}

void list_primitives(VoxelizeJob& job, const Program& exact) {
    const uint32_t count = job.bins.stored;
    job.grid.primitive_first = allocate_list_starts(job.device, "primitive starts", count);
    Buffer<uint32_t> totals(job.device, "primitive totals", count);
    exact.kernel("count_brick_primitives")
        .launch(WorkItem::heavy, count, count, job.size, job.bricks, job.triangles, job.bins,
                job.grid.primitive_first, totals);
    std::vector<uint32_t> bases = totals.read();
    const uint64_t total = starts_of_counts(bases);
    totals.write(bases);
    job.grid.primitives = Buffer<uint32_t>(job.device, "primitives", total);
    exact.kernel("list_primitives")
        .launch(WorkItem::heavy, count, count, job.size, job.bricks, job.triangles, job.bins,
                totals, job.grid.primitive_first, job.grid.primitives);
    if (count == 0) job.grid.primitive_first.fill(0);
}

}  // namespace voxelume
