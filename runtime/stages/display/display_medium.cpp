// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_medium.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/grid/grid_arguments.hpp"
#include "runtime/image/volume_geometry.hpp"

namespace voxelume {
namespace {

constexpr size_t kMeansAtOnce = 1 << 20;  ///< voxels that are measured together

/// The maximum number of lines in a voxel along an edge perpendicular to them.
constexpr double kMaxLines = 8;

uint32_t stride_of(const glm::ivec3& size) {
    return uint32_t(size.x + 15) / 16 * 16;
}

/// The number of lines along an edge: two for each of the world's voxels.
uint32_t lines_along(const float4& edge) {
    const double voxels = glm::length(glm::dvec3(edge.x, edge.y, edge.z));
    return uint32_t(std::clamp(std::ceil(2 * voxels - 1e-3), 1.0, kMaxLines));
}

/// The medium in one voxel: the light that it adds if nothing covers it, and its opacity.
struct MediumSample {
    glm::dvec3 light{0};
    double opacity = 0;
};

/// The opacity and light of a way of `length` metres through the medium.
MediumSample shown_by(const Medium& medium, double absorption, double density,
                      const glm::dvec3& color, double length) {
    MediumSample sample;
    sample.opacity = -std::expm1(-absorption * density * length);
    for (int c = 0; c < 3; ++c)
        sample.light[c] = color[c] * -std::expm1(-double(medium.absorption[c]) * density * length);
    return sample;
}

/// The composite of two samples in a voxel: each lies in front of the other in one half.
MediumSample mixed(const MediumSample& a, const MediumSample& b) {
    return {a.light * (1 - b.opacity / 2) + b.light * (1 - a.opacity / 2),
            a.opacity + b.opacity - a.opacity * b.opacity};
}

void show(const MediumSample& sample, Volume& volume, size_t i) {
    volume.colors[i] = sample.light / sample.opacity;
    volume.opacities[i] = float(sample.opacity);
}

}  // namespace

void append(const MediumVoxels& from, size_t i, MediumVoxels& to) {
    to.indices.push_back(from.indices[i]);
    to.densities.push_back(from.densities[i]);
    if (!from.colors.empty()) to.colors.push_back(from.colors[i]);
}

uint32_t medium_rows(const glm::ivec3& size) {
    const uint64_t all = uint64_t(size.y) * uint64_t(size.z);
    return uint32_t(std::clamp<uint64_t>(kMeansAtOnce / stride_of(size), 1, all));
}

Buffer<float> allocate_medium_means(const Device& device, const Features& features,
                                    const glm::ivec3& size) {
    const size_t planes = features.medium_colors ? 4 : 1;
    return {device, "display medium", planes * medium_rows(size) * stride_of(size)};
}

DisplayMediumStage::DisplayMediumStage(const Device& device, const Features& features,
                                       const VolumeFrame& frame, const Pyramid& world)
    : lattice_(display_lattice(frame, world.frame)),
      world_(shape_of(world)),
      has_colors_(features.medium_colors),
      lines_(lines_along(lattice_.axis_x), lines_along(lattice_.axis_y)),
      means_(allocate_medium_means(device, features, frame.size)),
      program_(device, "display/display_medium.cl", features.defines(device)),
      measure_(program_.kernel("measure_medium")) {}

void DisplayMediumStage::measure(const DensityGrid& density,
                                 const std::function<void(MediumVoxels)>& sink) {
    const glm::ivec3 size(lattice_.size_x, lattice_.size_y, lattice_.size_z);
    const auto all = uint32_t(size.y) * uint32_t(size.z);
    const uint32_t maximum = medium_rows(size), stride = stride_of(size);
    for (uint32_t first = 0; first < all; first += maximum) {
        const uint32_t rows = std::min(maximum, all - first);
        measure_.launch_packets(size_t(rows) * stride, lattice_, world_, density, density.colors,
                                lines_.x, lines_.y, first, rows, stride, means_);
        MediumVoxels voxels = listed(first, rows);
        if (!voxels.indices.empty()) sink(std::move(voxels));
    }
}

MediumVoxels DisplayMediumStage::listed(uint32_t first_row, uint32_t rows) const {
    const auto width = uint32_t(lattice_.size_x);
    const uint32_t stride = stride_of({lattice_.size_x, 0, 0});
    const size_t plane = size_t(rows) * stride;
    const std::vector<float> means = means_.read(0, (has_colors_ ? 4 : 1) * plane);
    MediumVoxels voxels;
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t x = 0; x < width; ++x) {
            const size_t at = size_t(row) * stride + x;
            if (!(means[at] > 0)) continue;
            voxels.indices.push_back(uint64_t(first_row + row) * width + x);
            voxels.densities.push_back(means[at]);
            if (has_colors_)
                voxels.colors.emplace_back(means[plane + at], means[2 * plane + at],
                                           means[3 * plane + at]);
        }
    return voxels;
}

double way_through(const VolumeFrame& frame, const glm::ivec3& cell) {
    const glm::dvec3& e = frame.edge;
    const CoverAxes axes = cover_axes(frame.display);
    if (axes == CoverAxes::all) return (e.x + e.y + e.z) / 3;  // the medium has no facing axis
    if (axes != CoverAxes::oblique) return e[int(axes)];
    const glm::dvec3 line = glm::abs(frame.origin + e * (glm::dvec3(cell) + 0.5));
    // The mean over parallel lines: the volume divided by the area that the lines meet.
    const double met = glm::dot(glm::dvec3(e.y * e.z, e.z * e.x, e.x * e.y), line);
    return met > 0 ? e.x * e.y * e.z * glm::length(line) / met : (e.x + e.y + e.z) / 3;
}

void add_medium_voxels(const MediumVoxels& voxels, const Medium& medium, Volume& volume) {
    const VolumeFrame& frame = volume.frame;
    const auto absorption = double(display_steps(frame, medium).absorption);
    const bool along_z = shape_row(frame.display).depth_is_along_z;
    Volume sum;
    size_t next = 0;
    for (size_t i = 0; i < voxels.indices.size(); ++i) {
        const uint64_t index = voxels.indices[i];
        while (next < volume.indices.size() && volume.indices[next] < index)
            sum.append(volume, next++);
        const glm::ivec3 cell = cell_of(frame, index);
        const auto density = double(voxels.densities[i]);
        const glm::dvec3 color = voxels.colors.empty() ? glm::dvec3(medium.color)
                                                       : glm::dvec3(voxels.colors[i]) / density;
        const MediumSample own =
            shown_by(medium, absorption, density, color, way_through(frame, cell));
        if (!(float(own.opacity) > 0)) continue;
        if (next < volume.indices.size() && volume.indices[next] == index) {
            const auto opacity = double(volume.opacities[next]);
            sum.append(volume, next++);
            if (opacity < 1)
                show(mixed({glm::dvec3(sum.colors.back()) * opacity, opacity}, own), sum,
                     sum.indices.size() - 1);
            continue;
        }
        const glm::dvec3 middle = frame.origin + frame.edge * (glm::dvec3(cell) + 0.5);
        sum.indices.push_back(index);
        sum.colors.emplace_back();
        sum.opacities.push_back(0);
        sum.depths.push_back(float(along_z ? middle.z : glm::length(middle)));
        sum.objects.push_back(0);
        sum.kinds.push_back(VoxelKind::space);
        show(own, sum, sum.indices.size() - 1);
    }
    while (next < volume.indices.size()) sum.append(volume, next++);
    sum.frame = frame;
    volume = std::move(sum);
}

}  // namespace voxelume
