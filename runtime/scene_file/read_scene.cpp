// SPDX-License-Identifier: Apache-2.0
// scene.json -> Scene: the order in which its parts are read, and their connections.
#include "runtime/scene_file/read_scene.hpp"

#include <algorithm>
#include <string_view>
#include <variant>
#include <vector>

#include "runtime/base/error.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/scene/fitted.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/scene_motion.hpp"
#include "runtime/scene_file/read_motion.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

constexpr size_t kMaxSceneBytes = size_t{64} << 20;

std::string read_text(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    // Opening a pipe would wait for its writer.
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw Error(ErrorKind::input, "{}: this is a {}, not a scene file",
                    SourcePlace(file.string()),
                    std::filesystem::is_directory(status) ? "folder" : "pipe or device");
    }
    if (!std::filesystem::exists(status))
        throw Error(ErrorKind::input, "{}: the scene can't be opened: no such file",
                    SourcePlace(file.string()));
    const InputFile input(file);
    if (input.size() > kMaxSceneBytes)
        throw Error(ErrorKind::limit,
                    "{}: a scene file has at most 64 MiB; keep meshes in files of their own",
                    SourcePlace(file.string()));
    return input.read_all(kMaxSceneBytes);
}

void check_version(const SceneFields& fields) {
    const SceneValue version = fields.get("voxelume");
    if (version.integer(1, 1'000'000) != 1) {
        version.fail("this program reads version 1 of the format; write \"voxelume\": 1");
    }
}

/// Reads the world; parts that it leaves out are marked as to be fitted.
void read_or_leave_world(const SceneFields& fields, const AssetSearch& search, Scene& scene) {
    const auto value = fields.find("world");
    if (value) scene.world = read_world(*value, search);
    if (!value) {
        scene.world.where = fields.value().where();
        scene.world.where.key = "world";
    }
    const auto has = [&](std::string_view key) {
        return value && SceneFields(*value, "world").has(key);
    };
    scene.fitted.voxel_size = !has("voxel_size");
    scene.fitted.bounds = !has("bounds");
}

void read_or_frame_observer(const SceneFields& fields, Scene& scene) {
    if (const auto value = fields.find("observer")) {
        scene.observer = read_observer(*value, scene);
        return;
    }
    scene.observer.where = fields.value().where();
    scene.observer.where.key = "observer";
    scene.observer.display.voxels = {scene.render.size, 256};
    frame_observer(scene);
}

/// Calls `action` with the numbers that tracks give a part's value at their keys.
template <class Part, class Action>
void for_tracks(const SceneMotion& motion, ScenePart kind, size_t index, std::string_view key,
                const Action& action) {
    for (const MovingPart& part : motion.parts) {
        if (part.part != kind || part.index != index) continue;
        for (const Track& track : part.tracks) {
            const auto* row = std::get_if<const ValueRow<Part>*>(&track.value);
            if (row && (*row)->key == key) action(track.keys.values);
        }
    }
}

bool has_other_than_0(const std::vector<double>& numbers) {
    return std::ranges::any_of(numbers, [](double number) { return number != 0; });
}

/// True if some object is visible in some frame and has a material that shines in some frame.
bool shows_emission(const Scene& scene, const SceneMotion& motion) {
    std::vector<bool> shines(scene.materials.size());
    for (size_t i = 0; i < shines.size(); ++i) {
        bool is_bright = scene.materials[i].emission != glm::vec3(0);
        for_tracks<Material>(motion, ScenePart::material, i, "emission",
                             [&](const auto& values) { is_bright |= has_other_than_0(values); });
        shines[i] = is_bright;
    }
    if (std::ranges::find(shines, true) == shines.end()) return false;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        bool is_visible = object.visible, can_shine = shines[size_t(object.material)];
        for (const GroupMaterial& group : object.groups)
            can_shine = can_shine || shines[size_t(group.material)];
        for_tracks<Object>(motion, ScenePart::object, i, "visible",
                           [&](const auto& values) { is_visible = has_other_than_0(values); });
        for_tracks<Object>(motion, ScenePart::object, i, "material",
                           [&](const std::vector<double>& values) {
                               for (const double material : values)
                                   can_shine = can_shine || shines[size_t(material)];
                           });
        if (is_visible && can_shine) return true;
    }
    return false;
}

/// Throws if settings for a single moment are combined with a shutter that shows several.
void check_shutter(const SceneFields& fields, const Scene& scene) {
    if (scene.observer.shutter == 0 || scene.render.adaptive == 0) return;
    SceneFields(fields.get("render"), "render")
        .get("adaptive")
        .fail(
            "compares pixels at one moment, and the observer's \"shutter\" shows several: leave "
            "one of them out");
}

/// Adds a default light, and some ambient light, to a scene without a key for lights.
void add_default_light(const SceneFields& fields, Scene& scene) {
    constexpr float kAmbient = 0.15f;
    scene.has_default_light = true;
    Light& light = scene.lights.emplace_back();
    light.name = "lights[0]";
    light.where = fields.value().where();
    light.where.key = "lights";
    place_default_light(scene);
    const auto world = fields.find("world");
    if (world && SceneFields(*world, "world").has("ambient")) return;
    scene.fitted.ambient = true;
    scene.world.ambient = glm::vec3(kAmbient);
}

}  // namespace

int NameTable::find(const SceneValue& value) const {
    const std::string& name = value.text();
    if (const auto found = indices_.find(name); found != indices_.end()) return found->second;
    std::vector<std::string_view> names;
    names.reserve(indices_.size());
    for (const auto& [known, index] : indices_) names.push_back(known);
    std::sort(names.begin(), names.end());
    value.fail(fmt::format("no {} named {}{}", kind_, quote(name), suggest(name, names)));
}

Scene read_scene(const JsonValue& document, const std::filesystem::path& file,
                 const AssetFolders& assets, const FileBoxes& boxes, const GivenVoxels& given) {
    const std::string file_name = file.string();
    const SceneValue root(document, "", file_name);
    const SceneFields fields(root, "scene");
    check_version(fields);
    if (const auto schema = fields.find("$schema")) schema->text();

    Scene scene;
    scene.file = file;
    scene.materials.emplace_back().name = "default";
    const AssetSearch search{file.parent_path(), assets, true, &given};
    read_or_leave_world(fields, search, scene);
    if (const auto value = fields.find("materials")) scene.materials = read_materials(*value);
    if (const auto value = fields.find("models")) {
        scene.models = read_models(*value, {search, scene.world.voxel_size});
    }
    if (const auto value = fields.find("objects")) scene.objects = read_objects(*value, scene);
    if (const auto value = fields.find("lights")) scene.lights = read_lights(*value);
    if (const auto value = fields.find("render")) scene.render = read_render(*value);
    if (const auto value = fields.find("animation")) scene.animation = read_animation(*value);
    const std::vector<DocumentPart> parts = moving_parts(root, scene);
    SceneMotion motion{file_name, {}};
    const auto is_observer = [](const DocumentPart& part) {
        return part.part == ScenePart::observer;
    };
    for (const DocumentPart& part : parts)
        if (!is_observer(part)) add_part(part, search, scene, motion);
    fit_models(boxes, scene);
    scene.fitted.observer = !fields.has("observer");
    fit_to_objects(motion, boxes, scene);
    read_or_frame_observer(fields, scene);
    check_shutter(fields, scene);
    for (const DocumentPart& part : parts)
        if (is_observer(part)) add_part(part, search, scene, motion);
    if (!fields.has("lights") && !scene.world.sky && !shows_emission(scene, motion))
        add_default_light(fields, scene);
    if (!parts.empty()) {
        scene.motion = std::make_shared<const SceneMotion>(std::move(motion));
        return scene_at(scene, 1);
    }
    find_extents(scene);
    return scene;
}

Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                  const AssetFolders& assets, const FileBoxes& boxes) {
    return read_scene(parse_json(text, file.string()), file, assets, boxes);
}

JsonValue read_document(const std::filesystem::path& file) {
    return parse_json(read_text(file), file.string());
}

Scene read_scene(const std::filesystem::path& file, const AssetFolders& assets,
                 const FileBoxes& boxes) {
    return read_scene(read_document(file), file, assets, boxes);
}

}  // namespace voxelume
