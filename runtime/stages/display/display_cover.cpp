// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <unordered_map>

#include "runtime/image/volume_geometry.hpp"

namespace voxelume {
namespace {

/// The direction of the sight line of E through the middle of a voxel, in E's coordinates.
glm::dvec3 sight_line(const VolumeFrame& frame, const glm::ivec3& cell) {
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

/// The part of a column's lines that its voxels so far haven't covered.
class ColumnClearance {
  public:
    explicit ColumnClearance(const VolumeFrame& frame) : frame_(frame) {}

    /// Subtracts the part of its column's lines that a voxel's surfaces cover. Voxels come in
    /// ascending order. Returns the covered part of what reaches the voxel, or -1 if too little
    /// reaches it to tell.
    double take(glm::ivec3 cell, int axis, double taken) {
        cell[axis] = 0;
        const glm::u64vec3 at(cell), size(frame_.size);
        double& clear =
            clear_[axis].try_emplace(at.x + size.x * (at.y + size.y * at.z), 1.0).first->second;
        const double before = clear;
        clear = std::max(clear - taken, 0.0);
        return before < kMinClear ? -1 : std::min(taken / before, 1.0);
    }

  private:
    static constexpr double kMinClear = 1.0 / 256;

    const VolumeFrame& frame_;
    std::array<std::unordered_map<uint64_t, double>, 3> clear_;
};

/// The sums of lines in a voxel, see cover_lines.
struct VoxelCover {
    MeanCrossings mean;
    glm::dvec3 taken{0};
};

VoxelCover cover_of(const uint32_t* sums, const glm::uvec3& lines) {
    VoxelCover cover;
    for (int axis = 0; axis < 3; ++axis, sums += VXL_COVER_SUMS) {
        if (lines[axis] == 0) continue;
        const double all = lines[axis], logs = all * double(VXL_LOG_UNITS);
        cover.taken[axis] = sums[0] / (all * double(VXL_COVER_UNITS));
        cover.mean.out[axis] = sums[1 + VXL_CROSSES_OUT] / logs;
        cover.mean.in[axis] = sums[1 + VXL_CROSSES_IN] / logs;
        cover.mean.cubes[axis] = sums[1 + VXL_CROSSES_CUBE] / logs;
    }
    return cover;
}

/// VXL_COVERED_PARAMETERS of display_cover.cl.
struct CoveredVoxels {
    const Buffer<uint32_t>& mask;
    const ShownVoxels& shown;
    const Buffer<uint32_t>& logs;
};

void bind(KernelArguments& to, const CoveredVoxels& covered) {
    const VoxelArrays& voxels = covered.shown.voxels;
    to.add(covered.mask, covered.shown.starts, voxels.objects, voxels.opacities, covered.logs);
}

}  // namespace

Buffer<uint32_t> allocate_covers(const Device& device, uint32_t voxels) {
    return {device, "display covers", size_t(voxels) * 3 * size_t(VXL_COVER_SUMS)};
}

int axis_seen_along(const VolumeFrame& frame, const MeanCrossings& along_axes) {
    const CoverAxes axes = cover_axes(frame.display);
    if (axes == CoverAxes::oblique) return -1;
    if (axes != CoverAxes::all) return int(axes);
    const glm::dvec3 all = along_axes.in + along_axes.out + along_axes.cubes;
    return all.x >= all.y && all.x >= all.z ? 0 : all.y >= all.z ? 1 : 2;
}

double mean_crossings(const VolumeFrame& frame, const glm::ivec3& cell,
                      const MeanCrossings& along_axes) {
    const int axis = axis_seen_along(frame, along_axes);
    if (axis < 0) return crossings_along(frame, sight_line(frame, cell), along_axes);
    return along_axes.in[axis] + along_axes.out[axis] + along_axes.cubes[axis];
}

DisplayCoverStage::DisplayCoverStage(const Device& device, const Features& features,
                                     const VolumeFrame& frame, const GridFrame& world,
                                     const ShownVoxels& shown)
    : lattice_(display_lattice(frame, world)),
      shown_(shown),
      covers_(allocate_covers(device, uint32_t(shown.voxels.count))),
      program_(device, "display/display_cover.cl", features.defines(device)),
      cover_(program_.kernel("cover_lines")) {
    covers_.fill(0);
    std::vector<uint32_t> logs;
    for (const float opacity : shown.voxels.opacities.read(0, shown.voxels.count))
        logs.push_back(log_clear(double(opacity)));
    logs_ = Buffer<uint32_t>(device, "voxel logs", std::span<const uint32_t>(logs));
}

void DisplayCoverStage::add(int axis, const LinePoints& lines, const LineSurfaces& surfaces,
                            const Buffer<uint32_t>& mask) {
    cover_.launch(WorkItem::light, lines.lines, lattice_, lines.lines, lines, uint32_t(axis),
                  surfaces.opacities, surfaces.logs, CoveredVoxels{mask, shown_, logs_}, covers_);
}

void DisplayCoverStage::adjust(const glm::uvec3& lines, Volume& volume) const {
    const std::vector<uint32_t> covers = covers_.read();
    ColumnClearance columns(volume.frame);
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const VoxelCover cover = cover_of(&covers[i * 3 * size_t(VXL_COVER_SUMS)], lines);
        const glm::ivec3 cell = cell_of(volume.frame, volume.indices[i]);
        const int along = axis_seen_along(volume.frame, cover.mean);
        std::array<double, 3> covered{};
        for (int axis = 0; axis < 3; ++axis)
            if (lines[axis] > 0 && along >= 0)
                covered[size_t(axis)] = columns.take(cell, axis, cover.taken[axis]);
        const auto opacity = double(volume.opacities[i]);
        if (opacity <= 0 || opacity >= 1) continue;
        const double exact = along < 0 ? -1 : covered[size_t(along)];
        volume.opacities[i] = float(
            exact >= 0 ? exact : -std::expm1(-mean_crossings(volume.frame, cell, cover.mean)));
    }
}

}  // namespace voxelume
