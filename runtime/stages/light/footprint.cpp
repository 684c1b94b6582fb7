// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/footprint.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/opencl/float4.hpp"
#include "runtime/scene/parts/display_shape.hpp"

namespace voxelume {
namespace {

/// The number of samples of a cell in each direction, so that all cells have about equally many.
constexpr double kCellSamples = 8;

}  // namespace

Footprint footprint_of(const Scene& scene, const GridFrame& world) {
    const Observer& observer = scene.observer;
    const glm::dmat3& axes = observer.world_from_observer;
    const DisplayShapeRow& shape = shape_row(observer.display);
    const glm::dvec2 pixel =
        2.0 * shape.half_extent(observer.display) / glm::dvec2(frame_size(scene.render));
    const double samples = all_samples(scene.render), all = std::sqrt(samples);
    const ReconstructionFilter& filter = scene.render.filter;
    // With a lens, or samples outside of their pixel, rays don't tell to which pixel they belong.
    const bool has_cells = observer.aperture == 0 && filter.is_pixel();
    const double spread = filter_row(filter).equal_box * filter.width;
    const double cells = has_cells ? std::max(std::floor(all / kCellSamples), 1.0) : all / spread;
    const glm::dvec2 step = pixel / cells;
    const double square = std::sqrt(pixel.x * pixel.y) / all * spread;
    const bool is_parallel = shape.projection == SightProjection::parallel;
    Footprint footprint{};
    footprint.middle = to_float4((observer.position - world.origin) / world.voxel_edge);
    footprint.across = to_float4(axes[0] * step.x);
    footprint.down = to_float4(axes[1] * step.y);
    footprint.across.w = float(1 / (step.x * step.x));
    footprint.down.w = float(1 / (step.y * step.y));
    footprint.ahead = to_float4(axes[2]);
    if (has_cells) {
        const glm::dvec2 half = glm::dvec2(frame_size(scene.render)) * cells / 2.0;
        footprint.half_columns = float(half.x);
        footprint.half_rows = float(half.y);
    }
    footprint.spread = is_parallel ? 0.0f : float(square);
    footprint.width = is_parallel ? float(square) : 0.0f;
    footprint.shape = is_parallel              ? VXL_FOOTPRINT_BOX
                      : shape.depth_is_along_z ? VXL_FOOTPRINT_PYRAMID
                                               : VXL_FOOTPRINT_CONE;
    return footprint;
}

void bind(KernelArguments& to, const FootprintArgument& argument) {
    if (argument.footprint) to.add(*argument.footprint);
}

}  // namespace voxelume
