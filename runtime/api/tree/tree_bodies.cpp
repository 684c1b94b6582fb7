// SPDX-License-Identifier: Apache-2.0
// Solids, models and objects as the scene format has them.
#include <array>

#include "runtime/api/tree/tree.hpp"

namespace voxelume::api {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
    using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

JsonValue list_of_parts(const std::vector<v1::Part>& parts);

void add_solid(const v1::Solid& solid, ObjectTree& object) {
    constexpr std::array kOperations = {"union", "intersection", "difference"};
    const auto shape = [&object](const char* name) -> ObjectTree& {
        return object.add("shape", name);
    };
    std::visit(
        Overloaded{
            [&](const v1::Sphere& s) { shape("sphere").add("radius", s.radius); },
            [&](const v1::Ellipsoid& s) { shape("ellipsoid").add("radii", s.radii); },
            [&](const v1::Box& s) { shape("box").add("size", s.size); },
            [&](const v1::Cylinder& s) {
                shape("cylinder").add("radius", s.radius).add("height", s.height);
            },
            [&](const v1::Cone& s) {
                shape("cone").add("radius", s.radius).add("height", s.height);
                object.add("top_radius", s.top_radius);
            },
            [&](const v1::Torus& s) { shape("torus").add("radius", s.radius).add("tube", s.tube); },
            [&](const v1::Capsule& s) {
                shape("capsule").add("radius", s.radius).add("height", s.height);
            },
            [&](const v1::Slab& s) { shape("slab").add("thickness", s.thickness); },
            [&](const v1::Combination& s) {
                shape(kOperations.at(size_t(s.operation)));
                object.put("parts", list_of_parts(s.parts));
            },
        },
        solid);
}

JsonValue list_of_parts(const std::vector<v1::Part>& parts) {
    std::vector<JsonValue> items;
    for (const v1::Part& part : parts) {
        ObjectTree object;
        add_solid(part.solid, object);
        add_pose(part, object);
        items.push_back(object.take());
    }
    return list_of(std::move(items));
}

/// Adds the keys that scale a file's content to metres.
void add_file_size(const std::optional<double>& fit, const std::optional<v1::Unit>& unit,
                   ObjectTree& object) {
    constexpr std::array kUnits = {"um", "mm", "cm", "dm", "m", "km", "in", "ft", "yd"};
    object.add("fit", fit);
    if (unit) object.add("unit", kUnits.at(size_t(*unit)));
}

JsonValue tree_of_morph(const v1::Morph& morph) {
    ObjectTree object;
    const bool is_of_file = !morph.weights.empty() || morph.skin;
    if (!morph.weights.empty()) object.add("weights", morph.weights);
    object.add("skin", morph.skin).add_text("clip", morph.clip).add("time", morph.time);
    if (!is_of_file || morph.amount != 0) object.add("amount", morph.amount);
    object.add_text("mesh", morph.mesh.string());
    return object.add("center", morph.center).add("radius", morph.radius).take();
}

JsonValue list_of_parents(const std::vector<v1::Parent>& parents) {
    std::vector<JsonValue> items;
    for (const v1::Parent& parent : parents) {
        ObjectTree object;
        add_pose(parent, object);
        items.push_back(object.take());
    }
    return list_of(std::move(items));
}

void add_mesh(const v1::MeshFile& mesh, ObjectTree& object) {
    object.add("mesh", mesh.file.string()).add("part", mesh.part);
    add_file_size(mesh.fit, mesh.unit, object);
    if (mesh.sequence) object.put("sequence", tree(*mesh.sequence));
    if (mesh.morph) object.put("morph", tree_of_morph(*mesh.morph));
    if (!mesh.cuts.empty()) object.put("cut", list_of_parts(mesh.cuts));
    constexpr std::array kShadings = {"auto", "flat", "smooth"};
    if (mesh.shading) object.add("shading", kShadings.at(size_t(*mesh.shading)));
    object.add("crease_angle", mesh.crease_angle);
}

void add_voxels(const v1::VoxelFile& voxels, ObjectTree& object) {
    object.add("voxels", voxels.file.string()).add("part", voxels.part);
    add_file_size(voxels.fit, voxels.unit, object);
    if (voxels.sequence) object.put("sequence", tree(*voxels.sequence));
    object.add("iso", voxels.iso).add("label", voxels.label);
    if (voxels.each_label) object.add("label", "each");
}

}  // namespace

JsonValue tree(const v1::Sequence& sequence) {
    ObjectTree object;
    object.add("first", sequence.first).add("last", sequence.last);
    return object.add("start", sequence.start).add("loop", sequence.loop).take();
}

JsonValue tree(const v1::Model& model) {
    constexpr std::array kSurfaces = {"cubes", "smooth", "exact"};
    constexpr std::array kSets = {"supercover", "thin", "solid"};
    constexpr std::array kNormals = {"faces", "surface"};
    ObjectTree object;
    std::visit(Overloaded{[&](const v1::Solid& solid) { add_solid(solid, object); },
                          [&](const v1::MeshFile& mesh) { add_mesh(mesh, object); },
                          [&](const v1::VoxelFile& voxels) { add_voxels(voxels, object); }},
               model.source);
    object.add("voxel_size", model.voxel_size).add("resolution", model.resolution);
    if (model.surface) object.add("surface", kSurfaces.at(size_t(*model.surface)));
    if (model.set) object.add("set", kSets.at(size_t(*model.set)));
    if (model.normals) object.add("normals", kNormals.at(size_t(*model.normals)));
    return object.take();
}

JsonValue tree(const v1::Object& placed) {
    constexpr std::array kPlacements = {"auto", "world", "instance"};
    ObjectTree object;
    object.add_text("name", placed.name).add("model", placed.model);
    object.add_text("material", placed.material);
    if (!placed.group_materials.empty()) {
        ObjectTree groups;
        for (const auto& [group, material] : placed.group_materials) groups.add(group, material);
        object.put("materials", groups.take());
    }
    add_pose(placed, object);
    if (!placed.parents.empty()) object.put("parents", list_of_parents(placed.parents));
    object.add("priority", placed.priority).add("visible", placed.visible);
    object.add("spots", placed.light_samples);
    return object.add("placement", kPlacements.at(size_t(placed.placement))).take();
}

}  // namespace voxelume::api
