// SPDX-License-Identifier: Apache-2.0
// The parts of meshes that are too thin for distances.
#include "runtime/assets/asset_store.hpp"
#include "runtime/assets/load_timer.hpp"

namespace voxelume {

AssetStore::ThinPartOfMesh& AssetStore::thin_part(const Model& model) {
    return file({model.mesh, model.part}).thin[{key_of(model.object_from_file), model.thin_edge}];
}

const ThinPart& AssetStore::thin_part_of(const Model& model) {
    std::optional<ThinPart>& part = thin_part(model).part;
    if (part) return *part;
    const Mesh& whole = mesh(model.mesh, model.object_from_file, model.part);
    const LoadTimer timer(load_seconds_);
    part = voxelume::thin_part_of(whole, model.thin_edge);
    return *part;
}

}  // namespace voxelume
