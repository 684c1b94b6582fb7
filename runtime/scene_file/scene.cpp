// scene.json -> Scene: the order in which its parts are read, and what joins them.
#include "runtime/scene/scene.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/error.hpp"
#include "runtime/scene_file/scene_animation.hpp"
#include "runtime/scene_file/scene_motion.hpp"
#include "runtime/scene_file/scene_parts.hpp"
#include "runtime/world/instances.hpp"

namespace voxelume {
namespace {

constexpr size_t kMaxSceneBytes = size_t{64} << 20;

std::string read_text(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) {
        throw Error(ErrorKind::input, "{}: this is a folder, not a scene file", file.string());
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw Error(
            ErrorKind::input, "{}: the scene can't be opened: {}", file.string(),
            std::filesystem::exists(file, error) ? "no permission to read it" : "no such file");
    }
    std::string text;
    std::vector<char> block(size_t{1} << 16);
    while (stream.read(block.data(), static_cast<std::streamsize>(block.size())),
           stream.gcount() > 0) {
        text.append(block.data(), static_cast<size_t>(stream.gcount()));
        if (text.size() > kMaxSceneBytes) {
            throw Error(ErrorKind::limit,
                        "{}: a scene file has at most 64 MiB; keep meshes in files of their own",
                        file.string());
        }
    }
    if (stream.bad()) throw Error(ErrorKind::input, "{}: reading the scene failed", file.string());
    return text;
}

void check_version(const SceneFields& fields) {
    const SceneValue version = fields.get("voxelume");
    if (version.integer(1, 1'000'000) != 1) {
        version.fail("this program reads version 1 of the format; write \"voxelume\": 1");
    }
}

}  // namespace

void find_extents(Scene& scene) {
    const Bounds world = lattice_bounds(scene.world);
    std::array<glm::dvec4, 8> corners;
    for (int i = 0; i < 8; ++i) corners[size_t(i)] = glm::dvec4(corner(world, i), 1);
    for (Model& model : scene.models) model.extent = {};
    std::vector<bool> is_used(scene.models.size(), false), is_baked(scene.models.size(), false);
    const auto baked = [&](const Object& object) { return !is_instanced(scene, object); };
    for (const Object& object : scene.objects)
        if (object.visible && baked(object)) is_baked[object.model] = true;
    for (const Object& object : scene.objects) {
        // Where instances go doesn't matter to voxels that are shown in the world.
        if (!object.visible || (is_baked[object.model] && !baked(object))) continue;
        const glm::dmat4 object_from_world = glm::inverse(object.world_from_object);
        Bounds& extent = scene.models[object.model].extent;
        for (const glm::dvec4& world_corner : corners) {
            const glm::dvec3 p(object_from_world * world_corner);
            const bool is_first = !is_used[object.model];
            extent.min = is_first ? p : glm::min(extent.min, p);
            extent.max = is_first ? p : glm::max(extent.max, p);
            is_used[object.model] = true;
        }
    }
}

int NameTable::find(const SceneValue& value) const {
    const std::string& name = value.text();
    if (const auto found = indices_.find(name); found != indices_.end()) return found->second;
    std::vector<std::string_view> names;
    for (const auto& [known, index] : indices_) names.push_back(known);
    std::sort(names.begin(), names.end());
    value.fail(fmt::format("no {} named {}{}", kind_, quote(name), suggest(name, names)));
}

Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                  const AssetFolders& assets) {
    const std::string file_name = file.string();
    const JsonValue document = parse_json(text, file_name);
    const SceneValue root(document, "", file_name);
    const SceneFields fields(root, "scene");
    check_version(fields);
    if (const auto schema = fields.find("$schema")) schema->text();

    Scene scene;
    scene.file = file;
    scene.materials.emplace_back().name = "default";
    const AssetSearch search{file.parent_path(), assets};
    scene.world = read_world(fields.get("world"), search);
    if (const auto value = fields.find("materials")) scene.materials = read_materials(*value);
    if (const auto value = fields.find("models")) {
        scene.models = read_models(*value, {search, scene.world.voxel_size});
    }
    if (const auto value = fields.find("objects")) scene.objects = read_objects(*value, scene);
    if (const auto value = fields.find("lights")) scene.lights = read_lights(*value);
    if (const auto value = fields.find("render")) scene.render = read_render(*value);
    if (const auto value = fields.find("animation")) scene.animation = read_animation(*value);
    scene.observer = read_observer(fields.get("observer"), scene);
    find_extents(scene);
    scene.motion = read_motion(root, assets, scene);
    return scene.motion ? scene_at(scene, 1) : scene;
}

Scene read_scene(const std::filesystem::path& file, const AssetFolders& assets) {
    return parse_scene(read_text(file), file, assets);
}

void resize(Scene& scene, glm::ivec2 size) {
    if (size.x < 1 || size.y < 1 || size.x > kMaxImageSide || size.y > kMaxImageSide) {
        throw Error(ErrorKind::usage, "an image has from 1 to {} pixels on a side, not {}x{}",
                    kMaxImageSide, size.x, size.y);
    }
    scene.render.size = size;
    Display& display = scene.observer.display;
    if (display.square_pixels) {
        display.half_angles.y = square_pixel_half_angle(display.half_angles.x, size);
    }
}

std::vector<int> materials_of_groups(const Object& object,
                                     const std::vector<std::string>& group_names) {
    const std::vector<std::string_view> known(group_names.begin(), group_names.end());
    std::vector<int> materials(std::max<size_t>(known.size(), 1), object.material);
    for (const GroupMaterial& entry : object.groups) {
        const auto found = std::find(known.begin(), known.end(), entry.group);
        if (found == known.end()) {
            throw Error(ErrorKind::scene, "{}: the mesh has no group of faces named {}{}",
                        entry.where, quote(entry.group), suggest(entry.group, known));
        }
        materials[found - known.begin()] = entry.material;
    }
    return materials;
}

bool transmits(const Material& material) {
    return material.refraction > 0 || material.opacity < 1;
}

bool transmits(const Scene& scene, const Object& object) {
    return transmits(scene.materials[size_t(object.material)]) ||
           std::ranges::any_of(object.groups, [&](const GroupMaterial& group) {
               return transmits(scene.materials[size_t(group.material)]);
           });
}

}  // namespace voxelume
