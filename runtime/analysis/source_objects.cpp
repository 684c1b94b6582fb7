// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/source_objects.hpp"

#include <algorithm>

#include "runtime/assets/model_frame.hpp"

namespace voxelume {
namespace {

bool has_textures(const Model& model, AssetStore& meshes) {
    if (!stores_distances(model.surface) || !model.voxels.empty()) return false;
    const MeshSummary* const mesh = meshes.summary_of(model);
    return mesh && mesh->paint.textures > 0 && mesh->paint.uvs > 0 && mesh->triangles > 0;
}

}  // namespace

ListedSources list_sources(const Scene& scene, AssetStore& meshes) {
    ListedSources listed;
    for (uint32_t number = 0; number < scene.objects.size(); ++number) {
        const Object& object = scene.objects[number];
        if (!is_potentially_visible(scene, object)) continue;
        if (!has_textures(scene.models[size_t(object.model)], meshes)) continue;
        const auto found = std::ranges::find(listed.models, object.model);
        listed.objects.push_back({number, uint32_t(found - listed.models.begin())});
        if (found == listed.models.end()) listed.models.push_back(object.model);
    }
    return listed;
}

}  // namespace voxelume
