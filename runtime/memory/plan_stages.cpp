#include "runtime/memory/plan_stages.hpp"

#include <algorithm>

namespace voxelume {
namespace {

constexpr double kIndexMarks = 544;  // bytes for each brick: masks, counts, starts, while indexing

// Bytes for each voxel of the pyramid.
constexpr double kField = 32, kWord = 4;
constexpr double kVoxelsPerLeaf = 16, kLeaf = 12;
constexpr double kVoxelsPerSector = 4096, kSectorRecords = 1024;

/// The table of sectors, and the records of those with voxels.
double sector_bytes(const GridFrame& frame, double voxels) {
    const glm::dvec3 sectors(frame.sectors());
    const double table = sectors.x * sectors.y * sectors.z;
    const double stored = 8 + voxels / kVoxelsPerSector;
    return 4 * table + std::min(table, stored) * kSectorRecords;
}

double pyramid_bytes(const WorldContents& contents, const WorldExtent& extent, double instanced) {
    const auto& instances = contents.instances;
    double voxel = kLeaf / kVoxelsPerLeaf;
    if (contents.smooth || instances.smooth) voxel += kField;
    if (contents.has_attributes()) voxel += kWord;
    if (contents.colors || instances.colors) voxel += kWord;
    const double exact_voxels = extent.exact_voxels + instances.exact_voxels;
    const double triangles = contents.exact_triangles + instances.exact_triangles;
    return sector_bytes(contents.frame, extent.voxels) + (extent.voxels + instanced) * voxel +
           exact_voxels * (kWord + kListBytes) + triangles * kExactTriangleBytes;
}

double brick_bytes(const WorldContents& contents) {
    double brick = 0;
    if (contents.occupied) brick += kOccupancyBytes;
    if (contents.smooth) brick += kDistanceBytes;
    if (contents.attributes) brick += kWordBytes;
    if (contents.colors) brick += kWordBytes;
    if (contents.lists) brick += kWordBytes;
    return brick;
}

}  // namespace

StageBytes stage_bytes(const WorldContents& contents, const WorldExtent& extent, double instanced,
                       double kept) {
    const double table = brick_table(contents.frame);
    const bool measures_nearest =
        contents.smooth && (contents.attributes || contents.colors || contents.occupied);
    const double lists =
        extent.exact_voxels * kListBytes + contents.exact_triangles * kExactTriangleBytes;
    const double world = 4 * table + extent.bricks * brick_bytes(contents) + lists;
    StageBytes bytes;
    bytes.place = kept + world + (kWorldTable - 4) * table +
                  (measures_nearest ? extent.bricks * kDistanceBytes : 0) +
                  (contents.lists ? extent.bricks * kWordBytes : 0);
    bytes.world = pyramid_bytes(contents, extent, instanced);
    bytes.index = world + extent.bricks * kIndexMarks + bytes.world;
    if (contents.instances.any) bytes.index += bytes.world;  // before they are joined
    bytes.dilated_occupancy =
        contents.instances.any ? 0 : sector_bytes(contents.frame, extent.voxels);
    return bytes;
}

BufferPlan largest_buffer(const WorldContents& contents, const WorldExtent& minimum) {
    const auto& instances = contents.instances;
    const double bricks = std::min(minimum.bricks, brick_table(contents.frame));
    const double voxels = minimum.voxels + instances.min_voxels;
    const double exact_voxels = minimum.exact_voxels + instances.exact_voxels;
    BufferPlan largest;
    const auto keep = [&](bool is_there, const BufferPlan& buffer) {
        if (is_there) keep_larger(largest, buffer);
    };
    keep(contents.occupied, {"its voxels", bricks * kOccupancyBytes});
    keep(contents.smooth, {"its distances", bricks * kDistanceBytes});
    keep(contents.attributes, {"its voxels' materials", bricks * kWordBytes});
    keep(contents.colors, {"its voxels' colors", bricks * kWordBytes});
    keep(contents.lists, {"the starts of its voxels' lists", bricks * kWordBytes});
    keep(true, {"its voxels' lists", exact_voxels * kListBytes});
    keep(true,
         {"its triangles", (contents.exact_triangles + instances.exact_triangles) * kTriangleBytes,
          BufferGrowth::triangles});
    keep(contents.smooth || instances.smooth, {"its voxels' fields", voxels * kField});
    keep(contents.has_attributes(), {"its voxels' attributes", voxels * kWord});
    return largest;
}

}  // namespace voxelume
