// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/scene_lattice.hpp"

#include <string_view>
#include <vector>

#include "runtime/scene/predicates.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

using Names = std::vector<std::string_view>;

constexpr Range kCreaseAngle{0, 180};  // degrees

}  // namespace

void read_surface(const SceneFields& fields, Surface usual, Model& model) {
    Names names;
    for (const SurfaceKind& kind : kSurfaceKinds) names.push_back(kind.name);
    names.push_back("auto");
    const auto value = fields.find("surface");
    const size_t choice = value ? value->choice(names) : kSurfaceKinds.size();
    model.is_surface_open = choice == kSurfaceKinds.size() && !model.solid;
    if (choice < kSurfaceKinds.size())
        model.surface = kSurfaceKinds[choice].surface;
    else
        model.surface = model.solid ? Surface::exact : usual;
}

void read_lattice(const SceneFields& fields, glm::dvec3 world_voxel_size, Model& model) {
    fields.refuse_both("voxel_size", "resolution");
    model.is_sized = fields.has("resolution") || fields.has("voxel_size");
    if (const auto resolution = fields.find("resolution")) {
        if (model.solid && is_infinite(*model.solid)) {
            resolution->fail(
                "an infinite solid has no longest side; give a \"voxel_size\" instead");
        }
        model.resolution = resolution->integer(1, 65536);
    } else {
        const auto size = fields.find("voxel_size");
        model.voxel_size = size ? size->number_or_vector(kLength) : world_voxel_size;
    }
    read_surface(fields, Surface::smooth, model);
    if (const auto set = fields.find("set")) {
        model.set = static_cast<VoxelSet>(set->choice(Names{"supercover", "thin", "solid"}));
        if (!shows_voxels(model.surface)) {
            set->fail("only a model with \"surface\": \"cubes\" has a set; leave it out");
        }
    }
    if (const auto normals = fields.find("normals")) {
        model.normals = static_cast<CubeNormals>(normals->choice(Names{"faces", "surface"}));
        if (!shows_voxels(model.surface))
            normals->fail(
                "only a model with \"surface\": \"cubes\" has a choice of normals; leave it out");
    }
}

Shading read_shading(const SceneFields& fields) {
    Shading shading;
    if (const auto kind = fields.find("shading"))
        shading.kind = static_cast<ShadingKind>(kind->choice(Names{"auto", "flat", "smooth"}));
    if (const auto angle = fields.find("crease_angle")) {
        shading.crease_angle = angle->number(kCreaseAngle);
        if (shading.kind != ShadingKind::smooth)
            angle->fail("only a mesh with \"shading\": \"smooth\" has creases; leave it out");
    }
    return shading;
}

}  // namespace voxelume
