// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/count_grids.hpp"

#include "kernels/shared/normal.h"
#include "kernels/shared/solid.h"
#include "kernels/shared/texture.h"
#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/voxelize/voxelize_steps.hpp"
#include "runtime/stages/voxelize/voxelize_textures.hpp"

namespace voxelume {
namespace {

/// The number of bricks that a small triangle passes through, and the number that it is near.
constexpr double kBinsPerTriangle = 1.3, kBinsInBand = 2.5;

/// Follows bin_triangles.
TriangleBins sort_triangles(const Device& device, const GridCounts& counts, double per_triangle) {
    const glm::ivec3 bricks = counts.frame.bricks();
    const size_t bins = size_t(bricks.x + 1) * size_t(bricks.y) * size_t(bricks.z);
    const Buffer<uint32_t> cursors = allocate_cursors(device, bins);
    const auto pairs = size_t(per_triangle * double(counts.triangles)) + counts.bricks;
    return allocate_bins(device, {bins, counts.bricks, counts.bricks, pairs});
}

/// Follows find_inside.
Buffer<uint16_t> count_inside(const Device& device, const GridCounts& counts) {
    const Windings windings =
        allocate_windings(device, counts.bricks, counts.bricks, brick_slots(counts.frame));
    return allocate_inside(device, counts.bricks);
}

/// Follows label_voxels.
void count_labels(const Device& device, const GridCounts& counts, BrickGrid& grid) {
    const TriangleBins lists = sort_triangles(device, counts, kBinsInBand);
    const Buffer<uint32_t> nearest = allocate_words(device, "nearest triangles", counts.bricks);
    const Buffer<float> shapes = allocate_shapes(device, counts.triangles);
    if (counts.words) {
        const Buffer<uint32_t> words(device, "triangle attributes", counts.triangles);
        grid.attributes = allocate_words(device, "voxel attributes", counts.bricks);
    }
    if (counts.paint.is_there()) {
        const MeshPaint& paint = counts.paint;
        const Buffer<float> colors(device, "vertex colors", 3 * paint.colors);
        const Buffer<uint32_t> indices(device, "corner colors",
                                       paint.has_corner_colors ? 3 * counts.triangles : 0);
        const Buffer<uint32_t> texels(device, kTexels, paint.texels);
        const Buffer<float> uvs(device, kUvs, 2 * paint.uvs);
        const Buffer<uint32_t> corners(device, kCornerUvs,
                                       paint.has_corner_uvs ? 3 * counts.triangles : 0);
        const Buffer<uint32_t> words(device, kTextureWords,
                                     paint.texels > 0 ? counts.triangles : 0);
        grid.colors = allocate_words(device, "voxel colors", counts.bricks);
    }
    if (!counts.cube_normals) return;
    const Buffer<uint32_t> corners(device, "corner normals",
                                   counts.normals ? VXL_TRIANGLE_NORMALS * counts.triangles : 0);
    grid.normals = allocate_words(device, "voxel normals", counts.bricks);
}

BrickGrid empty_grid(const GridCounts& counts) {
    BrickGrid grid;
    grid.frame = counts.frame;
    grid.brick_count = uint32_t(counts.bricks);
    return grid;
}

void count_surface(const Device& device, const GridCounts& counts, BrickGrid& grid) {
    if (stores_distances(counts.surface)) {
        const Buffer<uint16_t> inside = count_inside(device, counts);
        const Buffer<float> shapes = allocate_shapes(device, counts.triangles);
        grid.distance = allocate_distances(device, "distances", counts.bricks);
        return;
    }
    const bool is_solid = shows_voxels(counts.surface) && counts.set == VoxelSet::solid;
    const Buffer<uint16_t> inside = is_solid ? count_inside(device, counts) : Buffer<uint16_t>();
    grid.occupancy = allocate_masks(device, "occupancy", counts.bricks);
}

/// Follows list_primitives, keep_triangles, keep_normals and keep_textures.
void count_triangles(const Device& device, const GridCounts& counts, BrickGrid& grid) {
    grid.primitive_first = allocate_list_starts(device, "primitive starts", counts.bricks);
    grid.primitives = Buffer<uint32_t>(device, "primitives", counts.listed);
    grid.triangles =
        Buffer<float>(device, "source triangles", kFloatsPerTriangle * counts.triangles);
    grid.triangle_attributes = Buffer<uint32_t>(device, "source attributes", counts.triangles);
    if (counts.normals)
        grid.triangle_normals =
            Buffer<uint32_t>(device, "source normals", VXL_TRIANGLE_NORMALS * counts.triangles);
    if (counts.paint.texels == 0) return;
    grid.triangle_textures =
        Buffer<uint32_t>(device, "source texture places", VXL_WORN_WORDS * counts.triangles);
    grid.textures = Buffer<uint32_t>(device, "source textures", texture_words(counts.paint));
    grid.texture_key = counts.texture_key;
    grid.texture_alpha = counts.paint.has_alpha;
    grid.texture_maps = counts.paint.mapped > 0;
}

}  // namespace

BrickGrid count_mesh_grid(const Device& device, const GridCounts& counts) {
    BrickGrid grid = empty_grid(counts);
    const DeviceTriangles mesh = allocate_triangles(device, counts.vertices, counts.triangles);
    const TriangleBins bins = sort_triangles(
        device, counts, stores_distances(counts.surface) ? kBinsInBand : kBinsPerTriangle);
    grid.coordinates = bins.coordinates;
    grid.slots = allocate_slots(device, "brick slots", counts.frame);
    count_surface(device, counts, grid);
    if (lists_primitives(counts.surface)) count_triangles(device, counts, grid);
    if (counts.words || counts.paint.is_there() || counts.cube_normals)
        count_labels(device, counts, grid);
    return grid;
}

BrickGrid count_solid_grid(const Device& device, const GridCounts& counts) {
    BrickGrid grid = empty_grid(counts);
    const Buffer<uint32_t> solids(device, "solids", counts.shapes * VXL_SOLID_WORDS);
    {
        const Buffer<uint32_t> states(device, "brick states", brick_slots(counts.frame));
        grid.slots = allocate_slots(device, "slots", counts.frame);
        grid.coordinates = Buffer<uint32_t>(device, "coordinates", counts.bricks);
    }
    for (size_t part = 1; part < counts.parts; ++part) {  // their bricks are among those of `grid`
        BrickGrid of_part;
        of_part.slots = allocate_slots(device, "slots", counts.frame);
        grid.parts.push_back({std::make_shared<const BrickGrid>(std::move(of_part)), {}});
    }
    if (stores_distances(counts.surface)) {
        grid.distance = allocate_distances(device, "distance", counts.bricks);
        return grid;
    }
    {
        grid.occupancy = allocate_masks(device, "occupancy", counts.bricks);
        const Buffer<uint64_t> undecided =
            allocate_masks(device, "undecided voxels", counts.bricks);
    }
    if (counts.cube_normals) grid.normals = allocate_words(device, "voxel normals", counts.bricks);
    if (!lists_primitives(counts.surface)) return grid;
    grid.primitive_first = allocate_list_starts(device, "primitive_first", counts.bricks);
    grid.primitives = Buffer<uint32_t>(device, "primitives", counts.voxels);
    grid.solids = solids;
    return grid;
}

namespace {

/// Follows cut_field: the body's grid stays, with those of the cuts.
BrickGrid count_cut_field(const Device& device, const BrickGrid& whole, const GridCounts& counts) {
    GridCounts of_cuts = counts;
    of_cuts.bricks = counts.cut_bricks;
    of_cuts.parts = counts.parts - 1;
    BrickGrid cuts = count_solid_grid(device, of_cuts);
    BrickGrid grid = whole;
    grid.parts = std::move(cuts.parts);
    cuts.parts.clear();
    grid.parts.push_back({std::make_shared<const BrickGrid>(std::move(cuts)), {}});
    return grid;
}

}  // namespace

BrickGrid count_cut_grid(const Device& device, const BrickGrid& whole, const GridCounts& counts) {
    if (stores_distances(counts.surface)) return count_cut_field(device, whole, counts);
    GridCounts space = counts;
    space.words = false;
    space.paint = {};
    const bool is_shell = counts.set != VoxelSet::solid;
    const BrickGrid rest = count_solid_grid(device, space);
    const BrickGrid body = is_shell ? count_mesh_grid(device, space) : BrickGrid();
    const BrickGrid inside = is_shell ? count_solid_grid(device, space) : BrickGrid();
    BrickGrid grid = empty_grid(counts);
    grid.slots = allocate_slots(device, "slots", counts.frame);
    grid.coordinates = Buffer<uint32_t>(device, "coordinates", counts.bricks);
    grid.occupancy = allocate_masks(device, "occupancy", counts.bricks);
    const Buffer<uint32_t> sources(device, "source slots", 4 * counts.bricks);
    if (!whole.attributes.empty())
        grid.attributes = allocate_words(device, "voxel attributes", counts.bricks);
    if (!whole.colors.empty()) grid.colors = allocate_words(device, "voxel colors", counts.bricks);
    if (!whole.normals.empty())
        grid.normals = allocate_words(device, "voxel normals", counts.bricks);
    return grid;
}

}  // namespace voxelume
