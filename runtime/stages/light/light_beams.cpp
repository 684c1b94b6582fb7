// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/light_beams.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <tuple>
#include <vector>

#include "kernels/shared/beam.h"

namespace voxelume {
namespace {

/// The edge of a grid's square in voxels of the dilated occupancy. The rest of a beam's width
/// covers the rounding of the points where rays meet the grid.
constexpr double kEdge = 2 * (VXL_BEAM_RADIUS - 0.25);

/// The maximum sideways movement of rays for each voxel along their axis, as for other beams; see
/// lib/traverse/beam.h.
constexpr double kSteepest = 16;

/// The vector from a point to the light.
glm::dvec3 way(const LightRecord& light, const glm::dvec3& point) {
    const glm::dvec3 at(light.position.x, light.position.y, light.position.z);
    return light.kind == VXL_LIGHT_DIRECTIONAL ? at : at - point;
}

/// The axis along which all vectors from the world to the light have a positive component, and the
/// least of these is largest; -1 if there is none.
int common_axis(const LightRecord& light, const glm::dvec3& size) {
    const glm::dvec3 low = way(light, size), high = way(light, {0, 0, 0});
    const glm::dvec3 minimum = glm::max(low, -high);
    const int axis = minimum.x >= minimum.y && minimum.x >= minimum.z ? 0
                     : minimum.y >= minimum.z                         ? 1
                                                                      : 2;
    return minimum[axis] > 0 ? axis : -1;
}

/// The tiles of a grid whose beams pass any of the sectors of a world of `size`, in ascending
/// order.
std::vector<uint32_t> tiles_through(const BeamGrid& grid, const glm::dvec3& size,
                                    const std::vector<glm::ivec3>& sectors) {
    const int b = grid.axis == 0 ? 1 : 0, c = grid.axis == 2 ? 1 : 2;
    const glm::ivec2 tiles(grid.columns / 4, grid.rows / 4);
    const glm::dvec2 low(grid.low_b, grid.low_c), slope(grid.slope_b, grid.slope_c);
    std::vector<bool> passing(size_t(tiles.x) * size_t(tiles.y));
    for (const glm::ivec3& sector : sectors) {
        glm::dvec2 minimum(INFINITY), maximum(-INFINITY);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 far(corner & 1, corner >> 1 & 1, corner >> 2);
            const glm::dvec3 point = glm::min(glm::dvec3(kSectorSize * (sector + far)), size);
            const double up = point[grid.axis] - double(grid.far_side);
            const glm::dvec2 met =
                (glm::dvec2(point[b], point[c]) - slope * up) / (1 - double(grid.converging) * up);
            minimum = glm::min(minimum, met), maximum = glm::max(maximum, met);
        }
        const double edge = 4 * double(grid.edge);
        const glm::ivec2 from = glm::max(glm::ivec2(glm::floor((minimum - low) / edge)), 0);
        const glm::ivec2 to = glm::min(glm::ivec2(glm::floor((maximum - low) / edge)), tiles - 1);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x)
                passing[size_t(x) + size_t(tiles.x) * size_t(y)] = true;
    }
    std::vector<uint32_t> numbers;
    for (size_t i = 0; i < passing.size(); ++i)
        if (passing[i]) numbers.push_back(uint32_t(i));
    return numbers;
}

}  // namespace

BeamGrid beam_grid(const LightRecord& light, const glm::ivec3& size, float scale,
                   uint32_t maximum) {
    const glm::dvec3 extent(size);
    const int axis = common_axis(light, extent);
    if (axis < 0) return {};
    const bool above = way(light, 0.5 * extent)[axis] > 0;
    const double near_side = above ? extent[axis] : 0, far_side = above ? 0 : extent[axis];

    // The rectangle that the world's corners span on the plane of the far side, projected from the
    // light.
    glm::dvec3 low(0), high(extent), steepest(0);
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 point(corner & 1 ? extent.x : 0, corner & 2 ? extent.y : 0,
                         corner & 4 ? extent.z : 0);
        point[axis] = near_side;
        const glm::dvec3 to_light = way(light, point), slope = to_light / to_light[axis];
        const glm::dvec3 met = point + slope * (far_side - near_side);
        low = glm::min(low, met), high = glm::max(high, met);
        steepest = glm::max(steepest, glm::abs(slope));
    }
    const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
    const double edge = kEdge / double(scale);
    const double columns = 4 * std::ceil((high[b] - low[b]) / (4 * edge));
    const double rows = 4 * std::ceil((high[c] - low[c]) / (4 * edge));
    if (!(std::max(steepest[b], steepest[c]) <= kSteepest) || !(columns * rows <= maximum))
        return {};

    glm::dvec3 origin(0);
    origin[axis] = far_side;
    const glm::dvec3 from_origin = way(light, origin);
    BeamGrid grid{};
    grid.axis = axis;
    grid.sign = above ? -1.0f : 1.0f;
    grid.far_side = float(far_side);
    grid.columns = int(columns), grid.rows = int(rows);
    grid.low_b = float(low[b]), grid.low_c = float(low[c]);
    grid.edge = float(edge);
    grid.slope_b = float(from_origin[b] / from_origin[axis]);
    grid.slope_c = float(from_origin[c] / from_origin[axis]);
    grid.converging = light.kind == VXL_LIGHT_DIRECTIONAL ? 0.0f : float(1 / from_origin[axis]);
    grid.scale = scale;
    return grid;
}

std::vector<BeamGrid> beam_grids(std::span<const LightRecord> lights, const glm::ivec3& size,
                                 float scale, uint32_t maximum, uint32_t together) {
    std::vector<BeamGrid> grids;
    for (const LightRecord& light : lights) {
        grids.push_back(beam_grid(light, size, scale, std::min(maximum, together)));
        together -= uint32_t(grids.back().columns * grids.back().rows);
    }
    return grids;
}

Buffer<float> allocate_light_beams(const Device& device, const BeamGrid& grid) {
    return {device, "light beams", size_t(grid.columns) * size_t(grid.rows)};
}

bool same_beams(const BeamGrid& a, const BeamGrid& b) {
    const auto members = [](const BeamGrid& g) {
        return std::tie(g.axis, g.sign, g.far_side, g.columns, g.rows, g.low_b, g.low_c, g.edge,
                        g.slope_b, g.slope_c, g.converging, g.scale);
    };
    return members(a) == members(b);
}

uint32_t light_beams_that_pay(const GridFrame& world, uint64_t rays, int samples,
                              double voxels_a_pixel) {
    const glm::dvec3 size(world.size);
    const double longest = std::max({size.x, size.y, size.z});
    const double middle = size.x + size.y + size.z - longest - std::min({size.x, size.y, size.z});
    const double met = longest * middle * samples / (voxels_a_pixel * voxels_a_pixel);
    // Seen from a light nearby, the world's shadow is several times as large as its faces.
    const double useful = 8 * longest * middle / (kEdge * kEdge);
    return uint32_t(std::min({double(rays) / 16, met / 16, useful, 0x1p28}));
}

LightBeamStage::LightBeamStage(const Device& device, const Features& features,
                               const Pyramid& pyramid, DilatedOccupancy dilated_occupancy)
    : device_(device),
      size_(pyramid.frame.size),
      shape_(dilated_shape(pyramid, dilated_occupancy.of)),
      dilated_occupancy_(std::move(dilated_occupancy)),
      program_(device, "light_beams.cl", features.defines(device)),
      send_(program_.kernel("send_light_beams")) {}

Buffer<float> LightBeamStage::send(const BeamGrid& grid) {
    const std::vector<uint32_t> passing =
        tiles_through(grid, size_, dilated_occupancy_.sectors_with_voxels);
    const auto count = uint32_t(passing.size());
    Buffer<float> ends = allocate_light_beams(device_, grid);
    ends.fill(-INFINITY);
    const Buffer<uint32_t> tiles(device_, "light beams", std::span<const uint32_t>(passing));
    send_.launch_packets(size_t(count) * VXL_BEAM_TILE, shape_, dilated_occupancy_.sectors,
                         dilated_occupancy_.bricks, grid, tiles, count, ends);
    sent_ += uint64_t(count) * VXL_BEAM_TILE;
    return ends;
}

}  // namespace voxelume
