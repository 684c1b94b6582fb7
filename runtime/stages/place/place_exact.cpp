// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/place/place_exact.hpp"

#include "kernels/shared/normal.h"
#include "kernels/shared/solid.h"
#include "kernels/shared/texture.h"
#include "runtime/base/error.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/place/placement_attributes.hpp"
#include "runtime/stages/voxelize/voxelize_textures.hpp"

namespace voxelume {
namespace {

Program program_for(const Device& device, const BrickGrid& grid) {
    return Program(
        device, "place_exact.cl",
        {{"VXL_OBJECT_ATTRIBUTES", !grid.triangle_attributes.empty()}, {"VXL_OBJECT_COLORS", 0}});
}

/// The lengths of all voxels' lists.
Buffer<uint32_t> count_primitives(const Device& device, const Program& program,
                                  std::span<const PlacedObject* const> objects,
                                  const BrickGrid& world) {
    Buffer<uint32_t> counts = allocate_words(device, "primitive counts", world.brick_count);
    counts.fill(0);
    for (const PlacedObject* object : objects)
        program.kernel("count_primitives")
            .launch(WorkItem::heavy, world.brick_count, world.brick_count, world.coordinates,
                    object->grid->slots, object->grid->primitive_first, counts);
    return counts;
}

/// Sets the start of every voxel's list. Afterwards `counts` holds the current end of each list.
void start_lists(const Device& device, const Program& program, const Buffer<uint32_t>& counts,
                 BrickGrid& world) {
    Buffer<uint32_t> sums(device, "primitive sums", world.brick_count);
    program.kernel("sum_counts")
        .launch(WorkItem::heavy, world.brick_count, world.brick_count, counts, sums);
    std::vector<uint32_t> starts = sums.read();
    uint64_t total = 0;
    for (uint32_t& start : starts) {
        const uint32_t sum = start;
        start = static_cast<uint32_t>(total);
        total += sum;
    }
    if (total > UINT32_MAX)
        throw Error(ErrorKind::limit,
                    "the world's exact surfaces need {} list entries, at most {} can be numbered: "
                    "use larger voxels",
                    total, UINT32_MAX);
    const auto end = static_cast<uint32_t>(total);
    const size_t voxels = size_t(world.brick_count) * 4096;
    world.primitives = Buffer<uint32_t>(device, "world primitives", total);
    world.primitive_first =
        allocate_list_starts(device, "world primitive starts", world.brick_count);
    world.primitive_first.write(std::span(&end, 1), voxels);
    program.kernel("start_lists")
        .launch(WorkItem::heavy, world.brick_count, world.brick_count,
                Buffer<uint32_t>(device, "brick starts", starts), counts, world.primitive_first);
}

/// The numbers of triangles and of solids' records that are joined so far.
struct Joined {
    uint32_t triangles = 0, solid_records = 0;
    JoinedTextures textures;
};

void append_object(const Device& device, const PlacedObject& object, const Buffer<uint32_t>& ends,
                   Joined& joined, BrickGrid& world) {
    const BrickGrid& grid = *object.grid;
    const Program program = program_for(device, grid);
    const auto triangles = static_cast<uint32_t>(grid.triangles.size() / kFloatsPerTriangle);
    const auto records = static_cast<uint32_t>(grid.solids.size() / VXL_SOLID_WORDS);
    const AttributeMap packed_attributes = attribute_map(device, object, Surface::exact);
    program.kernel("append_primitives")
        .launch(WorkItem::heavy, world.brick_count, world.brick_count, joined.triangles,
                joined.solid_records, world.coordinates, grid.slots, grid.primitive_first,
                grid.primitives, ends, world.primitives);
    const auto append = [&](uint32_t count, uint32_t start, const auto& from, const auto& to) {
        program.kernel("append_words")
            .launch(WorkItem::light, count, count, start, Words(from), Words(to));
    };
    append(triangles * kFloatsPerTriangle, joined.triangles * kFloatsPerTriangle, grid.triangles,
           world.triangles);
    program.kernel("append_triangle_attributes")
        .launch(WorkItem::light, triangles, triangles, joined.triangles, packed_attributes.map,
                packed_attributes.materials, grid.triangle_attributes, world.triangle_attributes);
    if (!grid.triangle_normals.empty())
        append(triangles * VXL_TRIANGLE_NORMALS, joined.triangles * VXL_TRIANGLE_NORMALS,
               grid.triangle_normals, world.triangle_normals);
    if (!grid.textures.empty()) {
        const uint64_t words = grid.textures.size();
        const bool is_new = joined.textures.add(grid.texture_key, words);
        const auto first_word = uint32_t(joined.textures.first_word(grid.texture_key, words));
        if (is_new) append(uint32_t(words), first_word, grid.textures, world.textures);
        const uint32_t worn = triangles * VXL_WORN_WORDS;
        program.kernel("append_worn")
            .launch(WorkItem::light, worn, worn, joined.triangles * VXL_WORN_WORDS, first_word,
                    grid.triangle_textures, world.triangle_textures);
    }
    append(records * VXL_SOLID_WORDS, joined.solid_records * VXL_SOLID_WORDS, grid.solids,
           world.solids);
    program.kernel("set_solid_attributes")
        .launch(WorkItem::light, records, records, joined.solid_records, packed_attributes.map,
                packed_attributes.materials, world.solids);
    joined.triangles += triangles;
    joined.solid_records += records;
}

}  // namespace

void allocate_sources(const Device& device, const SourceCounts& counts, BrickGrid& world) {
    const size_t triangles = counts.floats / kFloatsPerTriangle;
    world.triangles = Buffer<float>(device, "world triangles", counts.floats);
    world.triangle_attributes = Buffer<uint32_t>(device, "world triangle attributes", triangles);
    if (counts.normals)
        world.triangle_normals =
            Buffer<uint32_t>(device, "world normals", VXL_TRIANGLE_NORMALS * triangles);
    if (counts.textures.words() > 0) {
        if (counts.textures.words() > kMaxTextureWords)
            throw Error(ErrorKind::limit,
                        "the world's textures have {} texels, of which 2^31 can be numbered",
                        counts.textures.words());
        world.triangle_textures =
            Buffer<uint32_t>(device, "world texture places", VXL_WORN_WORDS * triangles);
        world.textures = Buffer<uint32_t>(device, "world textures", counts.textures.words());
        world.texture_alpha = counts.texture_alpha;
        world.texture_maps = counts.texture_maps;
    }
    world.solids = Buffer<uint32_t>(device, "world solids", counts.solid_words);
}

void join_exact_surfaces(const Device& device, std::span<const PlacedObject> objects,
                         BrickGrid& world) {
    std::vector<const PlacedObject*> exact;
    SourceCounts sources;
    for (const PlacedObject& object : objects) {
        if (object.grid->primitive_first.empty()) continue;
        exact.push_back(&object);
        sources.add(*object.grid);
    }
    world.primitive_first = world.primitives = {};
    world.triangles = {};
    world.triangle_attributes = world.triangle_normals = world.solids = {};
    world.triangle_textures = world.textures = {};
    if (exact.empty()) return;
    allocate_sources(device, sources, world);
    if (sources.normals) world.triangle_normals.fill(VXL_NO_NORMAL);
    if (!world.triangle_textures.empty()) world.triangle_textures.fill(VXL_NO_TEXTURE);
    const Program program = program_for(device, *exact.front()->grid);
    const Buffer<uint32_t> counts = count_primitives(device, program, exact, world);
    start_lists(device, program, counts, world);
    Joined joined;
    for (const PlacedObject* object : exact) append_object(device, *object, counts, joined, world);
}

}  // namespace voxelume
