// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/scene_choices.hpp"

#include "runtime/analysis/object_lattice.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"

namespace voxelume {

void make_choices(Scene& scene, AssetStore& meshes) {
    const bool may_appear = moves(scene);
    bool has_instances = false;
    for (Object& object : scene.objects) {
        const bool is_open = object.placement == Placement::automatic &&
                             !is_instanced(scene, object) && (object.visible || may_appear);
        if (!is_open || !can_be_instance(scene, object) || !is_finer_field(scene, object, meshes))
            continue;
        object.placement = Placement::instance;
        has_instances = true;
    }
    if (has_instances) find_extents(scene);
}

}  // namespace voxelume
