// SPDX-License-Identifier: Apache-2.0
// scene.json -> Scene: the order in which its parts are read, and what joins them.
#include "runtime/scene_file/read_scene.hpp"

#include <algorithm>
#include <fstream>

#include "runtime/base/error.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_motion.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

constexpr size_t kMaxSceneBytes = size_t{64} << 20;

std::string read_text(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) {
        throw Error(ErrorKind::input, "{}: this is a folder, not a scene file",
                    SourcePlace(file.string()));
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw Error(
            ErrorKind::input, "{}: the scene can't be opened: {}", SourcePlace(file.string()),
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
                        SourcePlace(file.string()));
        }
    }
    if (stream.bad())
        throw Error(ErrorKind::input, "{}: reading the scene failed", SourcePlace(file.string()));
    return text;
}

void check_version(const SceneFields& fields) {
    const SceneValue version = fields.get("voxelume");
    if (version.integer(1, 1'000'000) != 1) {
        version.fail("this program reads version 1 of the format; write \"voxelume\": 1");
    }
}

}  // namespace

int NameTable::find(const SceneValue& value) const {
    const std::string& name = value.text();
    if (const auto found = indices_.find(name); found != indices_.end()) return found->second;
    std::vector<std::string_view> names;
    for (const auto& [known, index] : indices_) names.push_back(known);
    std::sort(names.begin(), names.end());
    value.fail(fmt::format("no {} named {}{}", kind_, quote(name), suggest(name, names)));
}

Scene read_scene(const JsonValue& document, const std::filesystem::path& file,
                 const AssetFolders& assets) {
    const std::string file_name = file.string();
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
    scene.motion = read_motion(root, search, scene);
    return scene.motion ? scene_at(scene, 1) : scene;
}

Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                  const AssetFolders& assets) {
    return read_scene(parse_json(text, file.string()), file, assets);
}

Scene read_scene(const std::filesystem::path& file, const AssetFolders& assets) {
    return parse_scene(read_text(file), file, assets);
}

}  // namespace voxelume
