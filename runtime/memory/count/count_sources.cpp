// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/count_sources.hpp"

#include "runtime/analysis/cube_steps.hpp"
#include "runtime/analysis/source_objects.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/lookup/source_mesh.hpp"

namespace voxelume {

SourceMeshes count_sources(const Device& device, const Scene& scene, AssetStore& meshes) {
    const ListedSources sources = list_sources(scene, meshes);
    if (sources.objects.empty()) return {};
    SourceMeshes counted;
    std::vector<SourceSize> sizes;
    for (const int model : sources.models) {
        const MeshSummary& mesh = *meshes.summary_of(scene.models[size_t(model)]);
        sizes.push_back({mesh.triangles, mesh.paint, sizes.size()});
        counted.has_maps |= mesh.paint.mapped > 0;
    }
    counted.words = allocate_source_words(device, sizes);
    counted.objects = Buffer<SourceRecord>(device, "source objects", scene.objects.size());
    return counted;
}

Buffer<float> count_cube_steps(const Device& device, const Scene& scene, AssetStore& meshes,
                               std::span<const VoxelBox> boxes) {
    const size_t numbers = cube_steps(scene, meshes, boxes).size();
    return numbers == 0 ? Buffer<float>() : Buffer<float>(device, "cube steps", numbers);
}

Buffer<uint32_t> count_order(const Device& device, const Scene& scene) {
    const size_t objects = coincidence_order(scene).size();
    return objects == 0 ? Buffer<uint32_t>()
                        : Buffer<uint32_t>(device, "order of objects", objects);
}

}  // namespace voxelume
