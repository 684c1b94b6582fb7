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

Buffer<uint32_t> upload(const Device& device, const char* name,
                        const std::vector<uint32_t>& values) {
    return Buffer<uint32_t>(device, name, std::span<const uint32_t>(values));
}

}  // namespace

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
    TriangleBins bins;
    bins.size = glm::ivec4(bricks.x + 1, bricks.y, bricks.z, 0);
    const size_t bin_count = size_t(bins.size.x) * size_t(bins.size.y) * size_t(bins.size.z);
    Buffer<uint32_t> cursors(device, "bin cursors", bin_count);
    cursors.fill(0);
    const glm::ivec4 reach4(reach, 0);
    program.kernel("count_pairs")
        .launch(WorkItem::light, triangles.count, bins.size, reach4, extent, triangles, cursors);
    const BinLayout layout = lay_out_bins(cursors.read(), static_cast<uint32_t>(bins.size.x));
    bins.count = static_cast<uint32_t>(layout.occupied.size());
    bins.stored = layout.stored;
    bins.occupied = upload(device, "occupied bins", layout.occupied);
    bins.number_of_bin = upload(device, "bin numbers", layout.number_of_bin);
    bins.coordinates = upload(device, "brick coordinates", layout.coordinates);
    bins.first = upload(device, "bin starts", layout.first);
    cursors.write(layout.cursors);
    bins.lists = Buffer<uint32_t>(device, "bin lists", layout.first.back());
    if (layout.first.back() == 0) return bins;
    program.kernel("list_pairs")
        .launch(WorkItem::light, triangles.count, bins.size, reach4, extent, triangles, cursors,
                bins.lists);
    return bins;
}

}  // namespace voxelume
