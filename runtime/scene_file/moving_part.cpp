// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "runtime/scene/parts/solid.hpp"
#include "runtime/scene_file/document_part.hpp"
#include "runtime/scene_file/scene_sequence.hpp"

namespace voxelume {
namespace {

using Steps = std::span<const PathStep>;

std::string path_of(Steps steps) {
    std::string path;
    for (const PathStep& step : steps)
        path += step.key.empty() ? fmt::format("[{}]", step.item)
                                 : (path.empty() ? "" : ".") + step.key;
    return path;
}

/// The value inside of a part at the end of these steps.
const JsonValue& value_of(const JsonValue& part, Steps steps) {
    const JsonValue* at = &part;
    for (const PathStep& step : steps)
        at = step.key.empty() ? &at->items[step.item]
                              : &std::ranges::find(at->members, step.key, &JsonMember::key)->value;
    return *at;
}

/// Adds the text positions of the members of a value, and of those inside of them.
void add_origins(const JsonValue& value, const std::string& path,
                 std::vector<ValueOrigin>& origins) {
    origins.push_back({path, value.at});
    for (const JsonMember& member : value.members)
        add_origins(member.value, path.empty() ? member.key : path + "." + member.key, origins);
    for (size_t i = 0; i < value.items.size(); ++i)
        if (value.items[i].type == JsonType::object)
            add_origins(value.items[i], fmt::format("{}[{}]", path, i), origins);
}

/// Makes a part's values from its text.
class PartMaker {
  public:
    PartMaker(const DocumentPart& from, const Scene& scene, const AssetSearch& search)
        : from_(from), scene_(scene), search_(search), file_(scene.file.string()) {
        part_.part = from.part;
        part_.index = from.index;
        part_.path = from.path;
        part_.only_placed = from.only_placed;
    }

    MovingPart make() {
        add_origins(*from_.value, "", part_.origins);
        const SceneValue value(*from_.value, part_.path, file_);
        if (part_.part == ScenePart::light) part_.parameters = read_light_parameters(value);
        if (part_.part == ScenePart::observer) part_.parameters = read_observer_parameters(value);
        if (part_.part == ScenePart::object) part_.links = read_links(SceneFields(value, "object"));
        for (const DocumentTrack& track : from_.tracks) add_track(track);
        if (part_.part == ScenePart::model) add_mesh_sequence(value);
        if (part_.part == ScenePart::world) add_density_sequence(value);
        return std::move(part_);
    }

  private:
    void add_track(const DocumentTrack& from) {
        Steps steps = from.target.steps;
        Track track;
        const bool is_number = steps.back().key.empty();
        if (is_number) track.item = int(steps.back().item);
        if (is_number) steps = steps.first(steps.size() - 1);
        track.path = path_of(steps);
        track.solid = solid_of(steps);
        track.value = reference_to(steps);
        if (std::holds_alternative<const ValueRow<Factors>*>(track.value))
            add_placement(steps.first(steps.size() - 1), track.solid);
        track.keys = from.keys;
        for (const JsonValue& value : from.values) add_key(value, steps.back().key, track);
        track.keys.width = track.keys.values.size() / track.keys.frames.size();
        part_.tracks.push_back(std::move(track));
    }

    void add_key(const JsonValue& value, std::string_view key, Track& track) const {
        track.at.push_back(value.at);
        if (value.type == JsonType::boolean) track.keys.values.push_back(value.boolean ? 1 : 0);
        if (value.type != JsonType::string) return;
        if (part_.part == ScenePart::object) {
            const auto index = key == "model" ? index_of(scene_.models, value.text)
                                              : index_of(scene_.materials, value.text);
            track.keys.values.push_back(double(index));
        } else {
            const SceneValue file(value, part_.path + "." + track.path, file_);
            track.files.push_back(
                find_asset(value.text, search_.scene_folder, search_.assets, file.where()));
        }
    }

    template <class Named>
    static std::ptrdiff_t index_of(const std::vector<Named>& list, const std::string& name) {
        return std::ranges::find(list, name, &Named::name) - list.begin();
    }

    /// The path to the solid that contains a value.
    static SolidPath solid_of(Steps steps) {
        SolidPath path;
        path.is_cut = steps.front().key == "cut";
        for (const PathStep& step : steps)
            if (step.key.empty()) path.parts.push_back(step.item);
        return path;
    }

    /// The first of the lists of rows that contains the key.
    template <class... Rows>
    static ValueReference row_of(std::string_view key, const Rows&... rows) {
        ValueReference reference;
        const auto look = [&](const auto& list) {
            const auto found = std::ranges::find(list, key, [](auto& row) { return row.key; });
            if (found != list.end()) reference = &*found;
            return found != list.end();
        };
        (look(rows) || ...);
        return reference;
    }

    ValueReference reference_to(Steps steps) const {
        const std::string_view first = steps.front().key, key = steps.back().key;
        switch (part_.part) {
            case ScenePart::world:
                if (steps.size() == 1) return row_of(key, world_rows());
                return steps.size() == 2 ? row_of(key, medium_rows()) : density_value(key);
            case ScenePart::material:
                return steps.size() == 1 ? row_of(key, material_rows())
                                         : row_of(key, checker_rows());
            case ScenePart::model:
                return first == "morph" ? row_of(key, morph_rows())
                                        : row_of(key, solid_rows(), factor_rows(), model_rows());
            case ScenePart::object:
                return row_of(key, factor_rows(), object_rows());
            case ScenePart::light:
                return row_of(key, light_rows());
            case ScenePart::observer:
                return steps.size() == 1 ? row_of(key, observer_rows())
                                         : row_of(key, display_rows());
        }
        return {};
    }

    ValueReference density_value(std::string_view key) const {
        const Density& density = scene_.world.medium.density;
        if (std::holds_alternative<HeightDensity>(density))
            return row_of(key, height_density_rows());
        if (std::holds_alternative<BallDensity>(density)) return row_of(key, ball_density_rows());
        return row_of(key, factor_rows(), grid_density_rows());
    }

    /// Stores the placement of the object, density or solid at `steps` without its tracks.
    void add_placement(Steps steps, const SolidPath& solid) {
        if (std::ranges::find(part_.placements, solid, &MovingPlacement::solid) !=
            part_.placements.end())
            return;
        const JsonValue& json = value_of(*from_.value, steps);
        const std::string path = path_of(steps);
        const SceneValue value(json, path.empty() ? part_.path : part_.path + "." + path, file_);
        std::string table = solid.parts.empty() ? "object" : "parent";
        if (part_.part == ScenePart::world) table = "density:grid";
        if (part_.part == ScenePart::model)
            table = fmt::format("part:{}", scene_kinds("part")[kind_of(value, "shape", "part")]);
        part_.placements.push_back(
            {solid, path.empty() ? "" : path + ".", read_factors(SceneFields(value, table))});
    }

    void add_mesh_sequence(const SceneValue& value) {
        const Model& model = scene_.models[part_.index];
        if (model.solid) return;
        const std::string_view key = model.voxels.empty() ? "mesh" : "voxels";
        const SceneFields fields(value, fmt::format("model:{}", key));
        if (!fields.has("sequence")) return;
        part_.sequences.push_back(read_files(fields, key, row_of(key, model_rows()), search_));
    }

    void add_density_sequence(const SceneValue& world) {
        if (!std::holds_alternative<GridDensity>(scene_.world.medium.density)) return;
        const SceneFields medium(SceneFields(world, "world").get("medium"), "medium");
        const SceneFields fields(medium.get("density"), "density:grid");
        if (!fields.has("sequence")) return;
        part_.sequences.push_back(
            read_files(fields, "file", row_of("file", grid_density_rows()), search_));
    }

    const DocumentPart& from_;
    const Scene& scene_;
    const AssetSearch& search_;
    std::string file_;
    MovingPart part_;
};

}  // namespace

MovingPart moving_part(const DocumentPart& part, const Scene& scene, const AssetSearch& search) {
    return PartMaker(part, scene, search).make();
}

}  // namespace voxelume
