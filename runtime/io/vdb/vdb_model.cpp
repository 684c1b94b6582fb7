// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/vdb/vdb_model.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/io/vdb/vdb_tree.hpp"

namespace voxelume::vdb {
namespace {

/// Whether cells around the model's voxels count, too.
bool has_grid(Surface surface) {
    return stores_distances(surface);
}

bool are_finite(const VdbVoxels& voxels) {
    const auto is_finite = [](const auto& vector) {
        return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
    };
    const glm::dvec3& edges = voxels.voxel_edges;
    return is_finite(edges) && std::min({edges.x, edges.y, edges.z}) > 0 &&
           is_finite(voxels.origin) && std::ranges::all_of(voxels.colors, is_finite) &&
           std::ranges::all_of(voxels.values, [](float value) { return std::isfinite(value); });
}

}  // namespace

void send_model(WireSender& sender, const VdbModel& model, Surface surface) {
    sender.value(model.voxels.voxel_edges);
    sender.value(model.voxels.origin);
    sender.values(model.voxels.cells);
    sender.values(model.voxels.values);
    sender.values(model.voxels.colors);
    sender.value(uint32_t{has_grid(surface)});
    if (has_grid(surface)) send_grid(sender, *model.grid);
}

VdbModel receive_model(WireReceiver& receiver, Surface surface, uint64_t max_bytes) {
    VdbModel model;
    VdbVoxels& voxels = model.voxels;
    voxels.voxel_edges = receiver.value<glm::dvec3>();
    voxels.origin = receiver.value<glm::dvec3>();
    voxels.cells = receiver.values<glm::ivec3>(kMaxVdbVoxels);
    voxels.values = receiver.values<float>(kMaxVdbVoxels);
    voxels.colors = receiver.values<glm::vec3>(kMaxVdbVoxels);
    const size_t count = voxels.cells.size();
    if (voxels.values.size() != count || (!voxels.colors.empty() && voxels.colors.size() != count))
        WireReceiver::fail();
    if (!are_finite(voxels)) WireReceiver::fail();
    if (receiver.value<uint32_t>() != uint32_t{has_grid(surface)}) WireReceiver::fail();
    if (has_grid(surface)) model.grid = receive_grid(receiver, max_bytes);
    return model;
}

}  // namespace voxelume::vdb
