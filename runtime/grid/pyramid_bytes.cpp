// SPDX-License-Identifier: Apache-2.0
#include "runtime/grid/pyramid_bytes.hpp"

#include <cstring>

#include "runtime/opencl/packed_buffers.hpp"

namespace voxelume {
namespace {

struct PyramidHeader {
    GridFrame frame;
    uint32_t leaf_count = 0, voxel_count = 0;
    uint32_t attribute = 0, transparent = 0;
    uint32_t listed_fields = 0, reserved = 0;
};
static_assert(std::is_trivially_copyable_v<PyramidHeader>);

/// Calls `visit` with the buffers of a pyramid's voxels, in the order of their bytes.
template <class AnyPyramid, class Visit>
void visit_pyramid(AnyPyramid& pyramid, const Visit& visit) {
    visit("sectors", pyramid.sectors);
    visit("brick records", pyramid.bricks);
    visit("leaves", pyramid.leaves);
    visit("leaf voxels", pyramid.leaf_voxels);
    visit("voxel attributes", pyramid.attributes);
    visit("voxel colors", pyramid.colors);
    visit("voxel fields", pyramid.fields);
    visit("primitive starts", pyramid.primitive_first);
    visit("primitives", pyramid.primitives);
    visit("source triangles", pyramid.triangles);
    visit("source attributes", pyramid.triangle_attributes);
    visit("source normals", pyramid.triangle_normals);
    visit("source solids", pyramid.solids);
}

}  // namespace

uint64_t bytes_of(const Pyramid& pyramid) {
    uint64_t sum = 0;
    const auto add = [&]<class T>(const char*, const Buffer<T>& buffer) {
        sum += uint64_t(buffer.size() * sizeof(T));
    };
    visit_pyramid(pyramid, add);
    add("", pyramid.instances.records);
    add("", pyramid.instances.nodes);
    add("", pyramid.instances.materials);
    return sum;
}

std::string bytes_of_pyramid(const Pyramid& pyramid) {
    PyramidHeader header;
    std::memset(static_cast<void*>(&header), 0, sizeof header);  // the padding is cleared, too
    header.frame.origin = pyramid.frame.origin;
    header.frame.voxel_edge = pyramid.frame.voxel_edge;
    header.frame.size = pyramid.frame.size;
    header.leaf_count = pyramid.leaf_count;
    header.voxel_count = pyramid.voxel_count;
    header.listed_fields = pyramid.listed_fields;
    header.attribute = pyramid.attribute;
    header.transparent = pyramid.transparent;
    PackedWriter writer;
    writer.put(header);
    visit_pyramid(pyramid, [&](const char*, const auto& buffer) { writer.put(buffer); });
    return writer.take();
}

std::optional<Pyramid> pyramid_of_bytes(const Device& device, std::string_view bytes) {
    PackedReader reader(bytes);
    PyramidHeader header;
    reader.take(header);
    Pyramid pyramid;
    pyramid.frame = header.frame;
    pyramid.leaf_count = header.leaf_count;
    pyramid.voxel_count = header.voxel_count;
    pyramid.listed_fields = header.listed_fields;
    pyramid.attribute = header.attribute;
    pyramid.transparent = header.transparent != 0;
    visit_pyramid(pyramid,
                  [&](const char* name, auto& buffer) { reader.take(device, name, buffer); });
    const bool fits = pyramid.leaves.size() == size_t(pyramid.leaf_count) * 2 &&
                      pyramid.leaf_voxels.size() == pyramid.leaf_count;
    if (!reader.is_done() || !fits) return std::nullopt;
    return pyramid;
}

}  // namespace voxelume
