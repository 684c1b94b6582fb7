// SPDX-License-Identifier: Apache-2.0
// The scene's models and the objects that place them in the world.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <unordered_set>

#include "runtime/base/text.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene_file/scene_lattice.hpp"
#include "runtime/scene_file/scene_parts.hpp"
#include "runtime/scene_file/scene_sequence.hpp"

namespace voxelume {
namespace {

using Names = std::vector<std::string_view>;

/// Reads the metres of a file's unit, or of its longest side.
void read_file_size(const SceneFields& fields, Model& model) {
    struct Unit {
        std::string_view name;
        double metres;
    };
    static constexpr std::array<Unit, 9> kUnits = {{{"um", 1e-6},
                                                    {"mm", 1e-3},
                                                    {"cm", 1e-2},
                                                    {"dm", 1e-1},
                                                    {"m", 1},
                                                    {"km", 1e3},
                                                    {"in", 0.0254},
                                                    {"ft", 0.3048},
                                                    {"yd", 0.9144}}};
    if (fields.has("fit") && fields.has("unit"))
        fields.get("unit").fail(
            "\"fit\" decides the size, whatever the file's unit is; leave one of them out");
    model.fit = fields.number("fit", kLength, 0);
    Names names;
    for (const Unit& unit : kUnits) names.push_back(unit.name);
    if (const auto unit = fields.find("unit"))
        model.object_from_file.scale = kUnits[unit->choice(names)].metres;
}

/// Reads the choice of voxels in a file of values.
VoxelValues read_values(const SceneFields& fields) {
    VoxelValues values;
    fields.refuse_both("iso", "label");
    if (const auto iso = fields.find("iso")) values.iso = iso->number({-1e300, 1e300});
    if (const auto label = fields.find("label")) {
        values.each_label = label->is(JsonType::string);
        if (values.each_label)
            label->choice(Names{"each"});
        else
            values.label = label->integer(-1'000'000'000, 1'000'000'000);
    }
    return values;
}

/// The voxels in memory with a model's name; null if it names a file.
std::shared_ptr<const VoxelModel> find_given(const SceneFields& fields, const AssetSearch& search) {
    if (!search.given) return nullptr;
    const auto found = search.given->find(fields.get("voxels").text());
    if (found == search.given->end()) return nullptr;
    for (const std::string_view key : {"sequence", "part", "iso", "label"})
        if (const auto value = fields.find(key))
            value->fail("is of files, and these voxels are in memory; leave it out");
    return found->second;
}

/// Reads a model whose file holds voxels, with a lattice of their own.
void read_voxels(const SceneFields& fields, const ModelContext& context, Model& model) {
    model.given = find_given(fields, context.search);
    if (model.given)
        model.voxels = fields.get("voxels").text();
    else
        model.voxels = first_file(fields, "voxels", context.search);
    model.part = fields.integer("part", 1, 1'000'000, 0);
    model.values = read_values(fields);
    read_file_size(fields, model);
    read_surface(fields, Surface::cubes, model);
}

/// Reads the number of a mesh in a glTF file.
void read_mesh_part(const SceneFields& fields, Model& model) {
    const auto part = fields.find("part");
    if (!part) return;
    const std::string ending = ending_of(model.mesh);
    if (ending != ".gltf" && ending != ".glb")
        part->fail("only a glTF file has several meshes; leave it out");
    model.part = part->integer(1, 1'000'000);
}

/// Reads the motion in the mesh's own file: weights of its targets, a skin, or both.
void read_file_morph(const SceneFields& fields, Morph& morph) {
    const bool has_skin = fields.has("skin");
    for (const std::string_view key : {"mesh", "center", "radius", "amount"})
        if (const auto found = fields.find(key))
            found->fail(fmt::format("is no part of a morph by \"{}\"; leave it out",
                                    has_skin ? "skin" : "weights"));
    if (const auto weights = fields.find("weights")) {
        if (weights->items().empty()) weights->fail("needs a number for each target");
        weights->read_into(&morph.weights, find_row(morph_rows(), "weights")->range, false);
    }
    for (const std::string_view key : {"clip", "time"})
        if (const auto found = fields.find(key); found && !has_skin)
            found->fail("moves a \"skin\", and there is none");
    morph.skin = fields.integer("skin", 1, 1'000'000, 0);
    if (const auto clip = fields.find("clip")) morph.clip = clip->text();
    morph.time = fields.number("time", find_row(morph_rows(), "time")->range, 0);
}

Morph read_morph(const SceneValue& value, const AssetSearch& search) {
    const SceneFields fields(value, "morph");
    Morph morph;
    if (fields.has("weights") || fields.has("skin")) {
        read_file_morph(fields, morph);
        return morph;
    }
    for (const std::string_view key : {"clip", "time"})
        if (const auto found = fields.find(key)) found->fail("moves a \"skin\", and there is none");
    morph.amount = fields.number("amount", kRatio, 0);
    if (const auto mesh = fields.find("mesh")) {
        for (const std::string_view key : {"center", "radius"}) {
            if (const auto found = fields.find(key))
                found->fail("is of a sphere; give the morph either a \"mesh\" or a sphere");
        }
        morph.mesh = find_asset(mesh->text(), search.scene_folder, search.assets, mesh->where());
        return morph;
    }
    if (!fields.has("center") && !fields.has("radius"))
        value.fail("needs a \"mesh\" to end as, or the \"center\" and \"radius\" of a sphere");
    fields.get("center");
    fields.get("radius");
    fields.read_rows(morph_rows(), morph);
    return morph;
}

void read_materials_of(const SceneFields& fields, const NameTable& materials, Object& object) {
    if (const auto material = fields.find("material")) object.material = materials.find(*material);
    if (const auto groups = fields.find("materials")) {
        for (const auto& [group, member] : groups->named_members()) {
            object.groups.push_back({group, materials.find(member), member.where()});
        }
    }
}

/// Refuses light samples for an object without emission.
void check_light_samples(const SceneValue& value, const Scene& scene, const Object& object) {
    if (!object.light_samples || has_emission(scene, object)) return;
    SceneFields(value, "object")
        .get("spots")
        .fail("none of the object's materials has emission, so it can have no light samples");
}

}  // namespace

Model read_model(const std::string& name, const SceneValue& value, const ModelContext& context) {
    Model model;
    model.name = name;
    model.where = value.where();
    bool has_mesh = false;
    bool has_voxels = false;
    bool has_shape = false;
    for (const JsonMember& member : value.json().members) {
        has_mesh = has_mesh || member.key == "mesh";
        has_voxels = has_voxels || member.key == "voxels";
        has_shape = has_shape || member.key == "shape";
    }
    if (has_mesh && has_shape) value.fail("has a \"mesh\" and a \"shape\"; leave one of them out");
    if (has_voxels && (has_mesh || has_shape))
        value.fail(fmt::format("has \"voxels\" and a \"{}\"; leave one of them out",
                               has_mesh ? "mesh" : "shape"));
    if (!has_mesh && !has_voxels && !has_shape && value.is(JsonType::object)) {
        value.fail("needs a \"mesh\" or \"voxels\" (a file) or a \"shape\" (sphere, box, ...)");
    }
    if (has_voxels) {
        read_voxels(SceneFields(value, "model:voxels"), context, model);
    } else if (has_shape) {
        model.solid = read_solid(value);
        const std::string_view shape = scene_kinds("part")[kind_of(value, "shape", "part")];
        read_lattice(SceneFields(value, fmt::format("model:{}", shape)), context.world_voxel_size,
                     model);
    } else {
        const SceneFields fields(value, "model:mesh");
        model.mesh = first_file(fields, "mesh", context.search);
        read_mesh_part(fields, model);
        read_file_size(fields, model);
        if (const auto morph = fields.find("morph"))
            model.morph = read_morph(*morph, context.search);
        if (model.morph && model.morph->is_of_file() && model.part == 0)
            fields.get("morph").fail(
                fmt::format("has {}, which {} of one mesh of a glTF file; name its \"part\"",
                            model.morph->skin > 0 ? "a skin" : "weights",
                            model.morph->skin > 0 ? "is that" : "are those"));
        read_lattice(fields, context.world_voxel_size, model);
        model.shading = read_shading(fields);
        if (const auto cut = fields.find("cut")) {
            model.cuts = read_cuts(*cut);
            if (lists_primitives(model.surface))
                cut->fail(
                    "an \"exact\" mesh shows its triangles and can't be cut; make its surface "
                    "\"smooth\" or \"cubes\"");
        }
    }
    return model;
}

std::vector<Model> read_models(const SceneValue& value, const ModelContext& context) {
    std::vector<Model> models;
    for (const auto& [name, member] : value.named_members()) {
        models.push_back(read_model(name, member, context));
    }
    return models;
}

ObjectReader::ObjectReader(const Scene& scene) : scene_(scene) {
    for (const Model& model : scene.models) models_.add(model.name);
    for (const Material& material : scene.materials) materials_.add(material.name);
}

Object ObjectReader::read(const SceneValue& value, size_t number) const {
    const SceneFields fields(value, "object");
    Object object;
    object.where = value.where();
    const auto name = fields.find("name");
    object.name = name ? name->text() : fmt::format("objects[{}]", number);
    object.model = models_.find(fields.get("model"));
    read_materials_of(fields, materials_, object);
    if (!object.groups.empty() && scene_.models[object.model].solid)
        fields.get("materials")
            .fail("only a mesh has groups of faces; give this object one \"material\"");
    object.priority = fields.integer("priority", -1'000'000, 1'000'000, 0);
    if (const auto light_samples = fields.find("spots"))
        object.light_samples = light_samples->integer(0, kMaxLightSamples);
    if (const auto placement = fields.find("placement"))
        object.placement =
            static_cast<Placement>(placement->choice(Names{"auto", "world", "instance"}));
    if (const auto visible = fields.find("visible")) object.visible = visible->boolean();
    object.world_from_object = read_object_place(fields);
    return object;
}

std::vector<Object> read_objects(const SceneValue& value, const Scene& scene) {
    const ObjectReader reader(scene);
    std::unordered_set<std::string> taken;
    std::vector<Object> objects;
    for (const SceneValue& item : value.items()) {
        objects.push_back(reader.read(item, objects.size()));
        const Object& object = objects.back();
        const auto name = SceneFields(item, "object").find("name");
        // An object without a name fails at its own place in the text.
        if (!taken.insert(object.name).second)
            (name ? *name : item)
                .fail(fmt::format("another object is named {} already", quote(object.name)));
        check_light_samples(item, scene, object);
    }
    return objects;
}

}  // namespace voxelume
