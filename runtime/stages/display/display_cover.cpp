// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_cover.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "runtime/image/volume_geometry.hpp"

namespace voxelume {
namespace {

/// The direction of the sight line of E through the middle of a voxel, in E's coordinates.
glm::dvec3 sight_line(const VolumeFrame& frame, const glm::ivec3& cell) {
    if (shape_row(frame.display).projection == SightProjection::parallel) return {0, 0, 1};
    return frame.origin + frame.edge * (glm::dvec3(cell) + 0.5);
}

double crossings_along(const VolumeFrame& frame, const glm::dvec3& line, const MeanCrossings& m) {
    const glm::dvec3& e = frame.edge;
    const glm::dvec3 faces = glm::dvec3(e.y * e.z, e.z * e.x, e.x * e.y) * glm::abs(line);
    const double whole = faces.x + faces.y + faces.z;
    if (!(whole > 0)) return 0;
    double added = 0, signed_area = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double both = std::min(m.in[axis], m.out[axis]);
        added += faces[axis] * (m.cubes[axis] + 2 * both);
        signed_area += faces[axis] * (line[axis] < 0 ? -1 : 1) * (m.in[axis] - m.out[axis]);
    }
    return (added + std::abs(signed_area)) / whole;
}

}  // namespace

Buffer<uint32_t> allocate_covers(const Device& device, uint32_t voxels) {
    return {device, "display covers", size_t(voxels) * 3 * VXL_CROSSES_SENSES};
}

double mean_crossings(const VolumeFrame& frame, const glm::ivec3& cell,
                      const MeanCrossings& along_axes) {
    const glm::dvec3 all = along_axes.in + along_axes.out + along_axes.cubes;
    switch (frame.display.seen_along) {
        case SeenAlong::observer:
            return crossings_along(frame, sight_line(frame, cell), along_axes);
        case SeenAlong::facing:
            return std::max({all.x, all.y, all.z});
        case SeenAlong::x:
            return all.x;
        case SeenAlong::y:
            return all.y;
        case SeenAlong::z:
            break;
    }
    return all.z;
}

DisplayCoverStage::DisplayCoverStage(const Device& device, const Features& features,
                                     const VolumeFrame& frame, const GridFrame& world,
                                     const ShownVoxels& shown)
    : lattice_(display_lattice(frame, world)),
      shown_(shown),
      covers_(allocate_covers(device, uint32_t(shown.voxels.count))),
      program_(device, "display_cover.cl", features.defines(device)),
      count_(program_.kernel("count_covers")) {
    covers_.fill(0);
}

void DisplayCoverStage::count(int axis, const ProbePoints& points, const Buffer<uint32_t>& mask) {
    count_.launch(WorkItem::light, points.count, lattice_, points.count, points.total,
                  points.coordinates, uint32_t(axis), mask, shown_.starts, covers_);
}

void DisplayCoverStage::adjust(const glm::uvec3& lines, Volume& volume) const {
    const std::vector<uint32_t> covers = covers_.read();
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const auto opacity = double(volume.opacities[i]);
        if (opacity <= 0 || opacity >= 1) continue;
        MeanCrossings mean;
        for (int axis = 0; axis < 3; ++axis) {
            const uint32_t* counts = &covers[(i * 3 + size_t(axis)) * size_t(VXL_CROSSES_SENSES)];
            const double all = lines[axis];
            mean.out[axis] = counts[VXL_CROSSES_OUT] / all;
            mean.in[axis] = counts[VXL_CROSSES_IN] / all;
            mean.cubes[axis] = counts[VXL_CROSSES_CUBE] / all;
        }
        const double crossings =
            mean_crossings(volume.frame, cell_of(volume.frame, volume.indices[i]), mean);
        volume.opacities[i] = float(-std::expm1(crossings * std::log1p(-opacity)));
    }
}

}  // namespace voxelume
