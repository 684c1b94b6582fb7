// SPDX-License-Identifier: Apache-2.0
// The table of all keys of the scene format: the parser accepts these and no others.
#include "runtime/scene_file/document/scene_keys.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <utility>

#include "runtime/base/text.hpp"
#include "runtime/scene/parts/light.hpp"
#include "runtime/scene/parts/material.hpp"
#include "runtime/scene/parts/observer.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/parts/solid.hpp"
#include "runtime/scene/parts/world.hpp"

namespace voxelume {
namespace {

using Keys = std::vector<std::string_view>;

Keys operator+(Keys a, const Keys& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

template <class Row>
Keys keys_of(std::span<const Row> rows) {
    Keys keys;
    for (const Row& row : rows) keys.push_back(row.key);
    return keys;
}

/// The tables of a part that comes in kinds: keys that all kinds have, then those of each.
template <class Kind>
void add_kinds(std::string_view part, const Keys& before, std::span<const Kind> kinds,
               const Keys& after, std::vector<KeyTable>& tables) {
    for (const Kind& kind : kinds)
        tables.push_back({std::string(part) + ":" + std::string(kind.name),
                          before + keys_of(kind.keys) + after});
}

std::vector<KeyTable> make_tables() {
    const Keys placement = keys_of(factor_rows()) + Keys{"matrix"};
    const Keys lattice = {"voxel_size", "resolution", "surface", "set", "normals"};
    std::vector<KeyTable> tables = {
        {"scene",
         {"$schema", "voxelume", "world", "materials", "models", "objects", "lights", "observer",
          "animation", "render"}},
        {"world", Keys{"voxel_size", "resolution", "bounds"} + keys_of(world_rows()) +
                      Keys{"medium", "sky"}},
        {"bounds", {"min", "max"}},
        {"medium", keys_of(medium_rows()) + Keys{"density"}},
    };
    add_kinds("density", {"kind"}, density_kinds(), {}, tables);
    tables.push_back({"scan", Keys{"file", "grid", "transfer", "lit"} + placement});
    tables.push_back({"transfer", {"value", "color", "absorption"}});
    add_kinds("sky", {"kind"}, sky_types(), {}, tables);
    tables.push_back({"material", keys_of(material_rows()) + Keys{"checker"}});
    tables.push_back({"checker", keys_of(checker_rows())});
    tables.push_back(
        {"model:mesh", Keys{"mesh", "part", "fit", "unit", "sequence", "morph", "cut"} + lattice +
                           Keys{"shading", "crease_angle"}});
    tables.push_back(
        {"model:voxels", {"voxels", "part", "fit", "unit", "sequence", "surface", "iso", "label"}});
    tables.push_back({"sequence", {"first", "last", "start", "loop"}});
    tables.push_back(
        {"morph", {"mesh", "center", "radius", "amount", "weights", "skin", "clip", "time"}});
    add_kinds("model", {"shape"}, solid_types(), lattice, tables);
    add_kinds("part", {"shape"}, solid_types(), placement, tables);
    tables.push_back({"object", Keys{"name", "model", "material", "materials", "priority", "spots",
                                     "placement", "visible", "parents"} +
                                    placement});
    tables.push_back({"parent", placement});
    add_kinds("light", {"name", "type", "group", "color", "intensity"}, light_types(), {}, tables);
    tables.push_back({"observer", keys_of(observer_rows()) + Keys{"projection", "display"}});
    add_kinds("display", {"shape", "voxels", "layout", "visibility", "seen_along", "clip"},
              display_shapes(), {}, tables);
    tables.push_back({"animation", {"frames", "fps", "tracks"}});
    tables.push_back({"track", {"target", "keys", "interpolation"}});
    tables.push_back({"key", {"frame", "time", "value", "in", "out"}});
    tables.push_back({"render",
                      {"size", "pixel_aspect", "samples", "adaptive", "depth", "shadows", "shadow",
                       "least_weight", "light", "bounces", "emitters", "filter", "filter_width",
                       "transparent"}});
    return tables;
}

}  // namespace

const std::vector<KeyTable>& scene_key_tables() {
    static const std::vector<KeyTable> tables = make_tables();
    return tables;
}

const KeyTable& scene_keys(std::string_view name) {
    const auto& tables = scene_key_tables();
    const auto found = std::find_if(tables.begin(), tables.end(),
                                    [&](const KeyTable& t) { return t.name == name; });
    if (found == tables.end()) throw std::logic_error("no key table " + std::string(name));
    return *found;
}

std::string suggest_key(std::string_view key, std::span<const std::string_view> keys) {
    using Pair = std::pair<std::string_view, std::string_view>;
    static constexpr std::array<Pair, 26> kOtherWords = {
        {{"rotation", "turn"},       {"rotate", "turn"},
         {"euler", "turn"},          {"translation", "position"},
         {"translate", "position"},  {"location", "position"},
         {"origin", "position"},     {"transform", "matrix"},
         {"to_world", "matrix"},     {"target", "look_at"},
         {"fov", "angle"},           {"camera", "observer"},
         {"shapes", "objects"},      {"instances", "objects"},
         {"emitters", "lights"},     {"albedo", "color"},
         {"diffuse_color", "color"}, {"transparency", "opacity"},
         {"alpha", "opacity"},       {"power", "intensity"},
         {"energy", "intensity"},    {"file", "mesh"},
         {"filename", "mesh"},       {"units", "unit"},
         {"pitch", "voxel_size"},    {"spp", "samples"}}};
    for (const auto& [other, ours] : kOtherWords)
        if (key == other && std::ranges::find(keys, ours) != keys.end())
            return "; did you mean " + quote(ours) + "?";
    return suggest(key, keys);
}

std::vector<std::string_view> scene_kinds(std::string_view prefix) {
    std::vector<std::string_view> kinds;
    for (const KeyTable& table : scene_key_tables()) {
        const std::string_view name = table.name;
        const size_t colon = name.find(':');
        if (colon != name.npos && name.substr(0, colon) == prefix)
            kinds.push_back(name.substr(colon + 1));
    }
    return kinds;
}

}  // namespace voxelume
