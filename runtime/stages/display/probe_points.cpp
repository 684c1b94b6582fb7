// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/probe_points.hpp"

namespace voxelume {

uint32_t points_seen(const ProbePoints& points, uint32_t first, uint32_t count) {
    const std::vector<uint32_t> views = points.views.read(first, count);
    return count - uint32_t(std::ranges::count(views, kNoView));
}

ProbePoints allocate_points(const Device& device, uint32_t count) {
    ProbePoints points;
    points.count = count;
    points.total = (count + 15) / 16 * 16;
    points.coordinates = Buffer<float>(device, "probe points", size_t(points.total) * 3);
    points.views = Buffer<uint32_t>(device, "probe views", points.total);
    return points;
}

Buffer<float> allocate_crossings(const Device& device, uint32_t lines, uint32_t slots) {
    return {device, "probe crossings", size_t(lines) * slots};
}

Buffer<uint32_t> allocate_surfaces(const Device& device, uint32_t lines, uint32_t slots) {
    return {device, "probe surfaces", size_t(lines) * slots};
}

void bind(KernelArguments& to, const ProbePoints& points) {
    to.add(points.count, points.total, points.coordinates, points.views);
}

void bind(KernelArguments& to, const ProbeViews& views) {
    to.add(views.camera, views.world, views.lattice, views.views);
}

void bind(KernelArguments& to, const CrossingArrays& arrays) {
    to.add(arrays.counts, arrays.crossings, arrays.surfaces);
}

void bind(KernelArguments& to, const LinePoints& lines) {
    to.add(lines.starts, lines.points.total, lines.points.coordinates, lines.surfaces);
}

}  // namespace voxelume
