// SPDX-License-Identifier: Apache-2.0
#include "cli/files/view_volume.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include "cli/shared/checks.hpp"
#include "cli/shared/scene_options.hpp"
#include "cli/shared/slice_names.hpp"

namespace voxelume::cli {
namespace {

/// What a model file holds, before a display that is a lattice.
Scene scene_of_model(const std::string& from) {
    ImportOptions options;
    options.lattice = true;
    return scene_of_file(from, options);
}

Volume volume_of_scene(const ViewSource& source, const Scene& scene) {
    return render_volume(scene, {Device::open(source.device)});
}

bool is_scene(const Facts& facts) {
    const auto& members = std::get<std::vector<Facts>>(facts.value);
    const auto kind = std::ranges::find(members, "kind", &Facts::name);
    const auto* const text =
        kind == members.end() ? nullptr : std::get_if<std::string>(&kind->value);
    return text != nullptr && *text == "scene";
}

/// A file of JSON is the header of a volumetric image, or a scene that shows one.
Volume volume_of_json(const ViewSource& source, const std::string& from) {
    v1::SceneOptions options;
    options.assets = source.assets;
    if (!is_scene(describe_file(from, options))) return Volume::read(from);
    return volume_of_scene(source, load_scene(from, options));
}

/// An OpenVDB file is a volumetric image, or else a model. Where it is neither, the first says why.
Volume volume_of_vdb(const ViewSource& source, const std::string& from) {
    std::optional<Error> refusal;
    try {
        return Volume::read(from);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input) throw;
        refusal = error;
    }
    std::optional<Scene> scene;
    try {
        scene = scene_of_model(from);
    } catch (const Error&) {
        throw Error(*refusal);
    }
    return volume_of_scene(source, *scene);
}

}  // namespace

Volume volume_of(const ViewSource& source) {
    const std::string from = first_slice(source.from);
    if (ending_of(from) == ".vdb") return volume_of_vdb(source, from);
    if (ending_of(from) == ".json") return volume_of_json(source, from);
    if (!is_model_file(from)) return Volume::read(from);
    return volume_of_scene(source, scene_of_model(from));
}

}  // namespace voxelume::cli
