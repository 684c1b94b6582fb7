// SPDX-License-Identifier: Apache-2.0
// Model files as scenes, for callers.
#include "runtime/voxelume/import.hpp"

#include <algorithm>

#include "runtime/api/border/convert.hpp"
#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/process.hpp"
#include "runtime/api/read_handle.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

glm::dvec3 color_of(const v1::Color& color) {
    return {color[0], color[1], color[2]};
}

ImportOptions options_of(const v1::ImportOptions& options) {
    ImportOptions inside;
    inside.longitude = options.longitude;
    inside.latitude = options.latitude;
    inside.orbit = options.orbit;
    inside.is_parallel = options.parallel;
    inside.is_lattice = options.lattice;
    inside.has_own_camera = options.own_camera;
    inside.clip = options.clip;
    inside.turns = options.turns;
    inside.angle = options.angle;
    inside.has_ground = options.ground;
    if (options.background) inside.background = color_of(*options.background);
    inside.is_transparent = options.transparent;
    inside.fit = options.fit;
    if (options.spacing)
        inside.spacing = {(*options.spacing)[0], (*options.spacing)[1], (*options.spacing)[2]};
    inside.up = static_cast<UpAxis>(options.up);
    inside.size = api::vector_of(options.size);
    return inside;
}

/// The file that a link leads to, or the file itself: scenes name files below their own folder
/// only.
fs::path find_file(const fs::path& file) {
    if (!is_model_file(file))
        throw Error(ErrorKind::usage, "{} isn't the name of a model file", quote(file.string()));
    std::error_code error;
    fs::path found = fs::canonical(file, error);
    if (error)
        throw Error(ErrorKind::input, "{}: {}", file.string(),
                    fs::exists(file, error) ? "can't be opened" : "no such file");
    if (!is_model_file(found))
        throw Error(ErrorKind::input,
                    "{}: leads to {}, whose name doesn't end as a model file's does: give that "
                    "file such a name",
                    file.string(), found.string());
    return found;
}

/// The file's name as a scene in `folder` has it.
std::string name_from(const fs::path& folder, const fs::path& file) {
    std::error_code error;
    const fs::path root = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
    const fs::path name = error ? fs::path() : file.lexically_relative(root);
    const bool is_below = !name.empty() && *name.begin() != "..";
    return (is_below ? name : file.filename()).generic_string();
}

}  // namespace

namespace v1 {

std::vector<std::string> model_file_endings() {
    return voxelume::model_file_endings();
}

std::vector<std::string> mesh_file_endings() {
    return voxelume::mesh_file_endings();
}

bool is_model_file(const fs::path& file) {
    return voxelume::is_model_file(file);
}

std::string import_file(const fs::path& file, const fs::path& folder, const ImportOptions& options,
                        const CacheOptions& cache) {
    return api::guarded([&] {
        api::apply_process_options();
        const fs::path found = find_file(file);
        AssetStore store(api::model_cache(cache));
        return voxelume::scene_of_file(found, name_from(folder, found), options_of(options), store);
    });
}

Scene scene_of_file(const fs::path& file, const ImportOptions& options,
                    const SceneOptions& scene_options) {
    return api::read_handle(scene_options, [&](const api::SceneFiles& files) {
        const fs::path found = find_file(file);
        const std::string text = voxelume::scene_of_file(found, found.filename().string(),
                                                         options_of(options), files.store());
        JsonValue document = parse_json(text, found.string());
        name_parts(document);
        // Messages name the file as the caller does.
        return api::read_with_changes(document, fs::is_symlink(file) ? found : file, files);
    });
}

Scene scene_of_voxels(const VoxelArray& voxels, const ImportOptions& options,
                      const SceneOptions& scene_options) {
    SceneOptions with_voxels = scene_options;
    with_voxels.voxels.push_back(voxels);
    return api::read_handle(with_voxels, [&](const api::SceneFiles& files) {
        const std::string text = voxelume::scene_of_voxels(
            files.given.find(voxels.name)->second, voxels.name, options_of(options), files.store());
        JsonValue document = parse_json(text, voxels.name);
        name_parts(document);
        return api::read_with_changes(document, voxels.name, files);
    });
}

}  // namespace v1
}  // namespace voxelume
