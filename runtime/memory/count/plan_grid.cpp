// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/plan_grid.hpp"

#include <array>

namespace voxelume {
namespace {

/// A part of buffers' names, and the words that messages use for such buffers.
struct BufferWords {
    const char* part;
    const char* what;
    BufferGrowth growth = BufferGrowth::surface;
};

/// A buffer is described by the first row whose part its name contains.
constexpr std::array kWords = {
    BufferWords{"slots", "the table of its bricks", BufferGrowth::table},
    BufferWords{"bin numbers", "the table of its bricks", BufferGrowth::table},
    BufferWords{"bin cursors", "the table of its bricks", BufferGrowth::table},
    BufferWords{"brick states", "the table of its bricks", BufferGrowth::table},
    BufferWords{"sectors", "the table of its bricks", BufferGrowth::table},
    BufferWords{"winding numbers", "its winding numbers"},
    BufferWords{"distance", "its distances"},
    BufferWords{"nearest surfaces", "its distances"},
    BufferWords{"occupancy", "its voxels"},
    BufferWords{"undecided voxels", "its voxels"},
    BufferWords{"masks", "its voxels"},
    BufferWords{"voxel fields", "its voxels' fields"},
    BufferWords{"texture", "its textures", BufferGrowth::triangles},
    BufferWords{"corner colors", "its faces' colors", BufferGrowth::triangles},
    BufferWords{"attributes of", "its triangles", BufferGrowth::triangles},
    BufferWords{"triangle", "its triangles", BufferGrowth::triangles},
    BufferWords{"source normals", "its triangles' normals", BufferGrowth::triangles},
    BufferWords{"world normals", "its triangles' normals", BufferGrowth::triangles},
    BufferWords{"corner normals", "its triangles' normals", BufferGrowth::triangles},
    BufferWords{"voxel normals", "its voxels' normals"},
    BufferWords{"lattice", "its triangles", BufferGrowth::triangles},
    BufferWords{"bin lists", "its triangles", BufferGrowth::triangles},
    BufferWords{"starts", "the starts of its voxels' lists"},
    BufferWords{"primitive_first", "the starts of its voxels' lists"},
    BufferWords{"primitive counts", "the starts of its voxels' lists"},
    BufferWords{"primitives", "its voxels' lists"},
    BufferWords{"world attributes", "its voxels' materials"},
    BufferWords{"world colors", "its voxels' colors"},
    BufferWords{"attributes", "its voxels' materials and colors"},
    BufferWords{"colors", "its voxels' materials and colors"},
};

}  // namespace

BufferPlan described_buffer(const std::string& name, double bytes) {
    if (name == "nearest triangles") return {"its voxels' materials and colors", bytes};
    for (const BufferWords& attributes : kWords)
        if (name.find(attributes.part) != std::string::npos)
            return {attributes.what, bytes, attributes.growth};
    return {"its voxels", bytes};
}

void keep_larger(BufferPlan& largest, const BufferPlan& buffer) {
    if (buffer.bytes > largest.bytes) largest = buffer;
}

double brick_table(const GridFrame& frame) {
    const glm::dvec3 bricks(frame.bricks());
    return bricks.x * bricks.y * bricks.z;
}

}  // namespace voxelume
