// SPDX-License-Identifier: Apache-2.0
// mesh groups and colours -> the packed attributes and colours of voxels.
#include <algorithm>
#include <cmath>

#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/voxelize/voxelize_steps.hpp"

namespace voxelume {
namespace {

/// For each sRGB code above 0, the smallest linear value that rounds to it.
std::vector<float> srgb_thresholds() {
    std::vector<float> thresholds;
    for (int code = 1; code <= 255; ++code) {
        const double value = (code - 0.5) / 255;
        thresholds.push_back(static_cast<float>(
            value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4)));
    }
    return thresholds;
}

/// The distance, in shortest edges, within which a surface concerns a voxel's centre. A surface
/// concerns a voxel that it meets, and one with a corner within 0.35 voxel of it: the zero of a
/// smooth field can still lie in that voxel.
double label_band(const GridFrame& frame) {
    return 0.35 + 0.5 * double(glm::length(glm::vec3(edge_scale(frame))));
}

}  // namespace

glm::ivec3 label_reach(const GridFrame& frame) {
    return band_reach(frame, label_band(frame));
}

void label_voxels(VoxelizeJob& job, const Program& label, const Program& distance,
                  const TriangleBins& lists, const MeshLabels& labels) {
    const size_t voxels = size_t(4096) * job.bins.stored;
    const glm::vec4 scale = edge_scale(job.grid.frame);
    Buffer<uint32_t> nearest = allocate_words(job.device, "nearest triangles", job.bins.stored);
    label.kernel("find_nearest")
        .launch(WorkItem::heavy, job.items(), job.bins.stored, job.bricks,
                glm::ivec4(label_reach(job.grid.frame), 0), scale,
                static_cast<float>(label_band(job.grid.frame)), job.triangles, lists,
                job.bins.coordinates, shape_triangles(job, distance), nearest);
    const auto count = static_cast<uint32_t>(voxels);
    if (!labels.triangle_attributes.empty()) {
        const Buffer<uint32_t> words(job.device, "triangle attributes",
                                     std::span<const uint32_t>(labels.triangle_attributes));
        job.grid.attributes = allocate_words(job.device, "voxel attributes", job.bins.stored);
        label.kernel("label_voxels")
            .launch(WorkItem::light, voxels, count, labels.attributes, nearest, words,
                    job.grid.attributes);
    }
    if (!labels.vertex_colors.empty()) {
        const Buffer<float> colors(
            job.device, "vertex colors",
            std::span(&labels.vertex_colors.front().x, 3 * labels.vertex_colors.size()));
        const std::vector<float> thresholds = srgb_thresholds();
        const Buffer<float> codes(job.device, "sRGB thresholds", std::span(thresholds));
        job.grid.colors = allocate_words(job.device, "voxel colors", job.bins.stored);
        label.kernel("color_voxels")
            .launch(WorkItem::light, voxels, count, job.bricks, scale, job.triangles,
                    job.bins.coordinates, nearest, colors, codes, job.grid.colors);
    }
}

}  // namespace voxelume
