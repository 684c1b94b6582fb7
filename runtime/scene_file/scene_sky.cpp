// SPDX-License-Identifier: Apache-2.0
// The sky around the scene's world.
#include <fmt/format.h>

#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {

Sky read_sky(const SceneValue& value, const AssetSearch& search) {
    Sky sky;
    sky.kind = SkyKind(kind_of(value, "kind", "sky"));
    const SkyType& type = sky_types()[size_t(sky.kind)];
    const SceneFields fields(value, fmt::format("sky:{}", type.name));
    if (sky.kind == SkyKind::map) {
        const SceneValue file = fields.get("file");
        sky.file = find_asset(file.text(), search.scene_folder, search.assets, file.where());
        sky.where = file.where();
        sky.map.room = std::make_shared<SkyMapRoom>();
    }
    if (sky.kind == SkyKind::sun) sky.color = {1.0f, 0.95f, 0.88f};
    fields.read_kind(type.keys, sky_rows(), sky);
    check_sky(sky, fields.refusal());
    return sky;
}

}  // namespace voxelume
