// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/voxelize_bins.hpp"

#include "runtime/base/error.hpp"
#include "runtime/grid/grid.hpp"

namespace voxelume {
namespace {

/// The numbers of the bins with triangles, and where their lists start.
struct BinLayout {
    std::vector<uint32_t> occupied, number_of_bin, coordinates, first, cursors;
    uint32_t stored = 0;
};

void check_total(uint64_t total) {
    if (total > UINT32_MAX)
        throw Error(ErrorKind::limit,
                    "the mesh's triangles and the grid meet more than 4 billion times: use larger "
                    "voxels");
}

void add_bin(BinLayout& layout, uint32_t bin, uint32_t count, uint64_t& total) {
    layout.number_of_bin[bin] = static_cast<uint32_t>(layout.occupied.size());
    layout.occupied.push_back(bin);
    layout.cursors[bin] = static_cast<uint32_t>(total);
    layout.first.push_back(static_cast<uint32_t>(total));
    total += count;
    check_total(total);
}

BinLayout lay_out_bins(const std::vector<uint32_t>& counts, uint32_t columns) {
    BinLayout layout;
    layout.number_of_bin.assign(counts.size(), kBrickOutside);
    layout.cursors.assign(counts.size(), 0);
    uint64_t total = 0;
    for (uint32_t bin = 0; bin < counts.size(); ++bin) {
        if (counts[bin] == 0 || bin % columns == 0) continue;
        const uint32_t row = bin / columns;
        layout.coordinates.push_back(bin - row - 1);
        add_bin(layout, bin, counts[bin], total);
    }
    layout.stored = static_cast<uint32_t>(layout.occupied.size());
    for (uint32_t bin = 0; bin < counts.size(); bin += columns)
        if (counts[bin] != 0) add_bin(layout, bin, counts[bin], total);
    layout.first.push_back(static_cast<uint32_t>(total));
    return layout;
}

TriangleBins upload(const Device& device, const BinLayout& layout) {
    TriangleBins bins = allocate_bins(device, {layout.number_of_bin.size(), layout.occupied.size(),
                                               layout.stored, layout.first.back()});
    bins.occupied.write(layout.occupied);
    bins.number_of_bin.write(layout.number_of_bin);
    bins.coordinates.write(layout.coordinates);
    bins.first.write(layout.first);
    return bins;
}

}  // namespace

DeviceTriangles allocate_triangles(const Device& device, size_t vertices, size_t triangles) {
    DeviceTriangles d;
    d.count = uint32_t(triangles);
    d.vertices = Buffer<int32_t>(device, "lattice vertices", 3 * vertices);
    d.triangles = Buffer<uint32_t>(device, "lattice triangles", 3 * triangles);
    return d;
}

TriangleBins allocate_bins(const Device& device, const BinCounts& counts) {
    TriangleBins bins;
    bins.count = uint32_t(counts.occupied);
    bins.stored = uint32_t(counts.stored);
    bins.occupied = Buffer<uint32_t>(device, "occupied bins", counts.occupied);
    bins.number_of_bin = Buffer<uint32_t>(device, "bin numbers", counts.bins);
    bins.coordinates = Buffer<uint32_t>(device, "brick coordinates", counts.stored);
    bins.first = Buffer<uint32_t>(device, "bin starts", counts.occupied + 1);
    bins.lists = Buffer<uint32_t>(device, "bin lists", counts.pairs);
    return bins;
}

Buffer<uint32_t> allocate_cursors(const Device& device, size_t bins) {
    return {device, "bin cursors", bins};
}

void bind(KernelArguments& to, const DeviceTriangles& triangles) {
    to.add(triangles.first, triangles.count, triangles.vertices, triangles.triangles);
}

void bind(KernelArguments& to, const TriangleBins& bins) {
    to.add(bins.size, bins.count, bins.stored, bins.occupied, bins.number_of_bin, bins.coordinates,
           bins.first, bins.lists);
}

uint64_t starts_of_counts(std::vector<uint32_t>& counts) {
    uint64_t total = 0;
    for (uint32_t& count : counts) {
        const uint32_t own = count;
        count = static_cast<uint32_t>(total);
        total += own;
        check_total(total);
    }
    return total;
}

TriangleBins bin_triangles(const Device& device, const Program& program,
                           const DeviceTriangles& triangles, const glm::ivec3& bricks,
                           const glm::ivec3& reach, int extent) {
    const glm::ivec4 size(bricks.x + 1, bricks.y, bricks.z, 0);
    Buffer<uint32_t> cursors =
        allocate_cursors(device, size_t(size.x) * size_t(size.y) * size_t(size.z));
    cursors.fill(0);
    const glm::ivec4 reach4(reach, 0);
    program.kernel("count_pairs")
        .launch(WorkItem::light, triangles.count, size, reach4, extent, triangles, cursors);
    const BinLayout layout = lay_out_bins(cursors.read(), static_cast<uint32_t>(size.x));
    TriangleBins bins = upload(device, layout);
    bins.size = size;
    cursors.write(layout.cursors);
    if (layout.first.back() == 0) return bins;
    program.kernel("list_pairs")
        .launch(WorkItem::light, triangles.count, bins.size, reach4, extent, triangles, cursors,
                bins.lists);
    return bins;
}

}  // namespace voxelume
