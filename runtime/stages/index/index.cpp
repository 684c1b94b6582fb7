// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/index/index.hpp"

#include <glm/vec4.hpp>

#include <algorithm>
#include <utility>

#include "kernels/shared/voxel.h"
#include "runtime/base/error.hpp"
#include "runtime/grid/grid_arguments.hpp"
#include "runtime/grid/sector_table.hpp"
#include "runtime/stages/index/index_fields.hpp"
#include "runtime/stages/index/index_marks.hpp"
#include "runtime/stages/index/numbering.hpp"

namespace voxelume {
namespace {

bool has_two_sorts(const BrickGrid& grid) {
    return !grid.occupancy.empty() && !grid.distance.empty();
}

Numbering number_voxels(const BrickGrid& grid, const VoxelMarks& marks) {
    const std::vector<uint32_t> coordinates = grid.coordinates.read();
    Numbering numbers = number_bricks(grid.frame, {coordinates, marks.leaf_mask, marks.counts, 2});
    check_numbers(!grid.distance.empty(), numbers.totals[0], numbers.totals[1]);
    return numbers;
}

Surface occupied_kind(const BrickGrid& grid) {
    return grid.primitive_first.empty() ? Surface::cubes : Surface::exact;
}

Pyramid upload(const Device& device, const BrickGrid& grid, const Numbering& numbers) {
    Pyramid pyramid = allocate_pyramid(device, grid,
                                       {numbers.bricks.size() / kWordsPerRecord / kRecordsPerSector,
                                        numbers.leaf_count, numbers.totals[0], numbers.totals[1]});
    pyramid.sectors.write(numbers.sectors);
    pyramid.bricks.write(numbers.bricks);
    return pyramid;
}

}  // namespace

void bind(KernelArguments& to, const WrittenVoxels& written) {
    const Pyramid& p = written.pyramid;
    to.add(p.leaves, p.leaf_voxels, p.attributes, p.colors, p.normals, p.fields, p.primitive_first,
           p.primitives);
}

Pyramid allocate_pyramid(const Device& device, const BrickGrid& grid, const PyramidCounts& counts) {
    const PyramidParts parts{.attributes = !grid.attributes.empty() || has_two_sorts(grid),
                             .colors = !grid.colors.empty(),
                             .normals = !grid.normals.empty(),
                             .fields = !grid.distance.empty(),
                             .exact = !grid.primitive_first.empty()};
    return allocate_pyramid(device, grid, parts, counts);
}

Pyramid allocate_pyramid(const Device& device, const BrickGrid& grid, const PyramidParts& parts,
                         const PyramidCounts& counts) {
    const size_t voxels = counts.voxels, records = voxels + parts.listed_fields;
    const Surface kind = parts.fields ? Surface::smooth : occupied_kind(grid);
    const glm::ivec3 sectors = grid.frame.sectors();
    Pyramid pyramid;
    pyramid.frame = grid.frame;
    pyramid.leaf_count = uint32_t(counts.leaves);
    pyramid.voxel_count = uint32_t(voxels);
    pyramid.listed_fields = uint32_t(parts.listed_fields);
    pyramid.sectors = Buffer<uint32_t>(device, "sectors",
                                       size_t(sectors.x) * size_t(sectors.y) * size_t(sectors.z));
    pyramid.bricks = Buffer<uint32_t>(device, "brick records",
                                      counts.sectors * kRecordsPerSector * kWordsPerRecord);
    pyramid.leaves = Buffer<uint32_t>(device, "leaves", counts.leaves * 2);
    pyramid.leaf_voxels = Buffer<uint32_t>(device, "leaf voxels", counts.leaves);
    if (parts.attributes)
        pyramid.attributes = Buffer<uint32_t>(device, "voxel attributes", records);
    else
        pyramid.attribute = (grid.attribute & ~(~0u << VXL_KIND_SHIFT)) |
                            static_cast<uint32_t>(kind) << VXL_KIND_SHIFT;
    pyramid.transparent = grid.transparent;
    pyramid.cubes = grid.cubes;
    if (parts.colors) pyramid.colors = Buffer<uint32_t>(device, "voxel colors", records);
    if (parts.normals) pyramid.normals = Buffer<uint32_t>(device, "voxel normals", records);
    if (parts.fields)
        pyramid.fields = Buffer<uint32_t>(device, "voxel fields", records * VXL_FIELD_WORDS);
    if (parts.exact) {
        pyramid.primitive_first = Buffer<uint32_t>(device, "primitive starts", voxels + 1);
        pyramid.primitives = Buffer<uint32_t>(device, "primitives", counts.primitives);
    }
    pyramid.triangles = grid.triangles;
    pyramid.triangle_attributes = grid.triangle_attributes;
    pyramid.triangle_normals = grid.triangle_normals;
    pyramid.triangle_textures = grid.triangle_textures;
    pyramid.textures = grid.textures;
    pyramid.texture_key = grid.texture_key;
    pyramid.texture_alpha = grid.texture_alpha;
    pyramid.texture_maps = grid.texture_maps;
    pyramid.solids = grid.solids;
    return pyramid;
}

namespace {

/// The pyramid of a grid whose voxels are marked.
Pyramid write_pyramid(const Device& device, const Program& program, const BrickGrid& grid,
                      const VoxelMarks& marks) {
    const Numbering numbers = number_voxels(grid, marks);
    Pyramid pyramid = upload(device, grid, numbers);
    const glm::uvec2 kinds{static_cast<uint32_t>(occupied_kind(grid)) << VXL_KIND_SHIFT,
                           VXL_KIND_SMOOTH << VXL_KIND_SHIFT};
    const Buffer<uint32_t> starts(device, "index starts", numbers.starts);
    program.kernel("write_voxels")
        .launch(WorkItem::heavy, grid.brick_count, grid.brick_count, kinds, grid, marks.masks,
                starts, WrittenVoxels{pyramid});
    const auto end = uint32_t(numbers.totals[1]);
    if (!pyramid.primitive_first.empty())
        pyramid.primitive_first.write(std::span(&end, 1), pyramid.voxel_count);
    return pyramid;
}

}  // namespace

Defines index_defines(const BrickGrid& grid) {
    return {{"VXL_OCCUPANCY", !grid.occupancy.empty()},
            {"VXL_SMOOTH", !grid.distance.empty()},
            {"VXL_ATTRIBUTES", !grid.attributes.empty()},
            {"VXL_WRITE_ATTRIBUTES", !grid.attributes.empty() || has_two_sorts(grid)},
            {"VXL_COLORS", !grid.colors.empty()},
            {"VXL_VOXEL_NORMALS", !grid.normals.empty()},
            {"VXL_PRIMITIVES", !grid.primitive_first.empty()}};
}

VoxelMarks mark_grid(const Device& device, const BrickGrid& grid) {
    return mark_voxels(device, Program(device, "index.cl", index_defines(grid)), grid);
}

Pyramid build_index(const Device& device, const BrickGrid& grid) {
    const Program program(device, "index.cl", index_defines(grid));
    return write_pyramid(device, program, grid, mark_voxels(device, program, grid));
}

struct Indexer::Kept {
    VoxelMarks marks;
    Pyramid pyramid;
};

Indexer::Indexer(const Device& device) : device_(device), fields_(device) {}
Indexer::~Indexer() = default;
Indexer::Indexer(Indexer&&) noexcept = default;
Indexer& Indexer::operator=(Indexer&&) noexcept = default;

Pyramid Indexer::index(const PlacedWorld& world, const std::vector<uint32_t>* changed) {
    if (kept_ && changed && changed->empty()) return kept_->pyramid;
    if (world.fields.empty()) return index(world.voxels, changed);
    kept_.reset();
    kept_ = std::make_unique<Kept>(Kept{{}, fields_.index(world)});
    return kept_->pyramid;
}

Pyramid Indexer::index(const BrickGrid& grid, const std::vector<uint32_t>* changed) {
    if (kept_ && changed && changed->empty()) return kept_->pyramid;
    const Program program(device_, "index.cl", index_defines(grid));
    std::unique_ptr<Kept> before = std::move(kept_);
    if (before) before->pyramid = {};
    const bool continues = before && changed && !before->marks.slots.empty();
    VoxelMarks marks =
        continues ? mark_changed_voxels(device_, program, grid, *changed, std::move(before->marks))
                  : mark_voxels(device_, program, grid);
    Pyramid pyramid = write_pyramid(device_, program, grid, marks);
    marks.slots = grid.slots.read();
    kept_ = std::make_unique<Kept>(Kept{std::move(marks), pyramid});
    return pyramid;
}

}  // namespace voxelume
