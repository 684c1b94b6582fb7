// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/beam.hpp"

#include <array>
#include <utility>

#include "kernels/shared/beam.h"
#include "runtime/grid/grid_arguments.hpp"
#include "runtime/grid/sector_table.hpp"

namespace voxelume {
namespace {

/// The leaf masks of a table of sectors; empty sectors take no room.
class LeafMasks {
  public:
    explicit LeafMasks(const glm::ivec3& sectors)
        : sectors_(sectors), block_of_(size_t(sectors.x) * sectors.y * sectors.z, kNone) {}

    /// Adds leaves to brick `b`, or does nothing if it lies outside of the table.
    void add(const glm::ivec3& b, uint64_t mask) {
        const glm::ivec3 size = sectors_ * kBricksPerSector;
        if (mask == 0 || b.x < 0 || b.y < 0 || b.z < 0) return;
        if (b.x >= size.x || b.y >= size.y || b.z >= size.z) return;
        const glm::uvec2 slot = sector_and_bit(b, sectors_);
        uint32_t& block = block_of_[slot.x];
        if (block == kNone) {
            block = uint32_t(blocks_.size());
            blocks_.emplace_back();
        }
        blocks_[block][slot.y] |= mask;
    }

    DilatedOccupancy dilated_occupancy(const Device& device) const {
        std::vector<bool> occupied(block_of_.size());
        for (size_t i = 0; i < occupied.size(); ++i) occupied[i] = block_of_[i] != kNone;
        std::vector<uint32_t> sectors(block_of_.size());
        const size_t stored = number_sectors(sectors_, occupied, sectors);
        std::vector<uint32_t> bricks(stored * kRecordsPerSector * kWordsPerRecord);
        for (size_t i = 0; i < occupied.size(); ++i) {
            if (!occupied[i]) continue;
            uint32_t* record = &bricks[sectors[i] * kRecordsPerSector * kWordsPerRecord];
            for (const uint64_t mask : blocks_[block_of_[i]]) {
                record[0] = uint32_t(mask);
                record[1] = uint32_t(mask >> 32);
                record += kWordsPerRecord;
            }
        }
        write_empty_cubes(bricks);
        DilatedOccupancy dilated_occupancy =
            allocate_dilated_occupancy(device, sectors.size(), stored);
        dilated_occupancy.sectors.write(sectors);
        dilated_occupancy.bricks.write(bricks);
        return dilated_occupancy;
    }

  private:
    static constexpr uint32_t kNone = UINT32_MAX;
    glm::ivec3 sectors_;
    std::vector<uint32_t> block_of_;
    std::vector<std::array<uint64_t, kRecordsPerSector>> blocks_;
};

/// A mask dilated by one leaf along an axis whose coordinate has a stride of `step` bits: the
/// leaves in the brick before, in the brick itself, and in the brick after it. `low` holds the bits
/// of coordinate 0.
std::array<uint64_t, 3> dilated(uint64_t mask, int step, uint64_t low) {
    const uint64_t high = low << 3 * step;
    return {(mask & low) << 3 * step, mask | (mask & ~high) << step | (mask & ~low) >> step,
            (mask & high) >> 3 * step};
}

void add_dilated(const glm::ivec3& brick, uint64_t mask, LeafMasks& masks) {
    if (mask == 0) return;
    const auto along_x = dilated(mask, 1, 0x1111111111111111ull);
    for (int x = 0; x < 3; ++x) {
        const auto along_y = dilated(along_x[size_t(x)], 4, 0x000F000F000F000Full);
        for (int y = 0; y < 3; ++y) {
            const auto along_z = dilated(along_y[size_t(y)], 16, 0x000000000000FFFFull);
            for (int z = 0; z < 3; ++z)
                masks.add(brick + glm::ivec3(x, y, z) - 1, along_z[size_t(z)]);
        }
    }
}

/// Calls `visit` with each stored sector of a pyramid and its 64 brick records.
template <class Visit>
void for_each_sector(const Pyramid& pyramid, const Visit& visit) {
    const glm::ivec3 table = pyramid.frame.sectors();
    const std::vector<uint32_t> sectors = pyramid.sectors.read(), bricks = pyramid.bricks.read();
    for (size_t i = 0; i < sectors.size(); ++i) {
        if (sectors[i] & kEmptyCube) continue;
        const int number = int(i);
        visit(
            glm::ivec3(number % table.x, number / table.x % table.y, number / (table.x * table.y)),
            &bricks[sectors[i] * kRecordsPerSector * kWordsPerRecord]);
    }
}

uint64_t leaves_of(const uint32_t* record) {
    return record[0] | uint64_t(record[1]) << 32;
}

/// The size of a frame in voxels that are four times as long.
glm::ivec3 coarse_size(const GridFrame& frame) {
    return (frame.size + 3) / 4;
}

glm::ivec3 coarse_sectors(const GridFrame& frame) {
    return (coarse_size(frame) + kSectorSize - 1) / kSectorSize;
}

}  // namespace

PyramidShape dilated_shape(const Pyramid& pyramid, DilationLevel of) {
    PyramidShape shape = shape_of(pyramid);
    if (of == DilationLevel::leaves) return shape;
    const glm::ivec3 size = coarse_size(pyramid.frame), sectors = coarse_sectors(pyramid.frame);
    shape.size_x = size.x, shape.size_y = size.y, shape.size_z = size.z;
    shape.sectors_x = sectors.x, shape.sectors_y = sectors.y;
    return shape;
}

DilatedOccupancy allocate_dilated_occupancy(const Device& device, size_t sectors, size_t stored) {
    DilatedOccupancy dilated_occupancy;
    dilated_occupancy.sectors = Buffer<uint32_t>(device, "dilated sectors", sectors);
    dilated_occupancy.bricks =
        Buffer<uint32_t>(device, "dilated bricks", stored * kRecordsPerSector * kWordsPerRecord);
    return dilated_occupancy;
}

Buffer<uint32_t> allocate_beams(const Device& device, uint32_t rays) {
    return {device, "beams", size_t(VXL_BEAM_SLOTS(rays)) * VXL_BEAM_COMPONENTS};
}

DilatedOccupancy build_dilated_occupancy(const Device& device, const Pyramid& pyramid,
                                         DilationLevel of) {
    // In the coarse pyramid of a dilated occupancy of bricks, a sector of the world is a brick, and
    // a brick of the world is a leaf.
    LeafMasks masks(of == DilationLevel::leaves ? pyramid.frame.sectors()
                                                : coarse_sectors(pyramid.frame));
    std::vector<glm::ivec3> sectors;
    for_each_sector(pyramid, [&](const glm::ivec3& sector, const uint32_t* records) {
        sectors.push_back(sector);
        uint64_t bricks = 0;
        for (int bit = 0; bit < int(kRecordsPerSector); ++bit) {
            const uint64_t leaves = leaves_of(&records[size_t(bit) * kWordsPerRecord]);
            bricks |= uint64_t{leaves != 0} << bit;
            if (of == DilationLevel::leaves)
                add_dilated(sector * kBricksPerSector + glm::ivec3(bit & 3, bit >> 2 & 3, bit >> 4),
                            leaves, masks);
        }
        if (of == DilationLevel::bricks) add_dilated(sector, bricks, masks);
    });
    DilatedOccupancy dilated_occupancy = masks.dilated_occupancy(device);
    dilated_occupancy.of = of;
    dilated_occupancy.sectors_with_voxels = std::move(sectors);
    return dilated_occupancy;
}

std::optional<DilationLevel> dilation_for(double voxels_a_pixel) {
    const double radius = 1.5 * voxels_a_pixel;  // radius of the rays of 4 x 4 pixels
    if (radius <= VXL_BEAM_RADIUS) return DilationLevel::leaves;
    if (radius <= 4 * VXL_BEAM_RADIUS) return DilationLevel::bricks;
    return std::nullopt;
}

std::optional<DilationLevel> dilation_that_pays(const Features& features, const Pyramid& world,
                                                uint64_t rays, double voxels_a_pixel) {
    constexpr uint64_t kFewRays = 65536;
    constexpr int kLargest = 16384;
    const glm::ivec3& size = world.frame.size;
    if (features.instances || features.solids_ahead || world.voxel_count == 0 || rays < kFewRays ||
        std::max({size.x, size.y, size.z}) > kLargest)
        return std::nullopt;
    const std::optional<DilationLevel> of = dilation_for(voxels_a_pixel);
    // One ray per leaf pays for the dilated occupancy of leaves; that of bricks takes a seventh of
    // the time.
    const uint32_t needed = of == DilationLevel::bricks ? world.leaf_count / 7 : world.leaf_count;
    return rays >= needed ? of : std::nullopt;
}

BeamStage::BeamStage(const Device& device, const Features& features, const Pyramid& pyramid,
                     DilatedOccupancy dilated_occupancy)
    : device_(device),
      shape_(dilated_shape(pyramid, dilated_occupancy.of)),
      dilated_occupancy_(std::move(dilated_occupancy)),
      cleared_(device, "clear beams", 2),
      program_(device, "sight.cl", features.defines(device)),
      start_(program_.kernel("start_beams")) {
    cleared_.fill(0);
}

uint64_t BeamStage::cleared() const {
    return cleared_.read_one(0) | uint64_t(cleared_.read_one(1)) << 32;
}

void BeamStage::start(RayBatch& batch, uint32_t count) {
    if (batch.beams.empty()) batch.beams = allocate_beams(device_, batch.stride);
    const uint32_t beams = (count + VXL_BEAM_RAYS - 1) / VXL_BEAM_RAYS;
    start_.launch_packets(beams, shape_, dilated_occupancy_.sectors, dilated_occupancy_.bricks,
                          scale_of(dilated_occupancy_.of), batch.rays, beams, batch.stride,
                          batch.beams, cleared_);
    sent_ += beams;
}

}  // namespace voxelume
