// The table of all keys of the scene format: the parser accepts these and no others.
#include "runtime/scene_file/scene_keys.hpp"

#include <algorithm>
#include <stdexcept>

namespace voxelume {
namespace {

using Keys = std::vector<std::string_view>;

Keys operator+(Keys a, const Keys& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::vector<KeyTable> make_tables() {
    const Keys placement = {"position", "turn", "scale", "matrix"};
    const Keys lattice = {"voxel_size", "resolution", "surface", "set"};
    const Keys light = {"name", "type", "color", "intensity"};
    const std::vector<KeyTable> shapes = {
        {"sphere", {"shape", "radius"}},
        {"ellipsoid", {"shape", "radii"}},
        {"box", {"shape", "size"}},
        {"cylinder", {"shape", "radius", "height"}},
        {"cone", {"shape", "radius", "height", "top_radius"}},
        {"torus", {"shape", "radius", "tube"}},
        {"capsule", {"shape", "radius", "height"}},
        {"slab", {"shape", "thickness"}},
        {"union", {"shape", "parts"}},
        {"intersection", {"shape", "parts"}},
        {"difference", {"shape", "parts"}},
    };
    std::vector<KeyTable> tables = {
        {"scene",
         {"$schema", "voxelume", "world", "materials", "models", "objects", "lights", "observer",
          "animation", "render"}},
        {"world", {"voxel_size", "bounds", "background", "ambient", "medium"}},
        {"bounds", {"min", "max"}},
        {"medium", {"absorption", "color", "density"}},
        {"density:height", {"kind", "base", "scale_height"}},
        {"density:ball", {"kind", "center", "radius", "falloff"}},
        {"density:grid", Keys{"kind", "file", "sequence", "grid"} + placement},
        {"material",
         {"color", "diffuse", "specular", "shininess", "reflection", "refraction", "ior", "fresnel",
          "opacity", "absorption", "emission", "checker"}},
        {"checker", {"color", "size", "origin"}},
        {"model:mesh", Keys{"mesh", "sequence", "morph", "cut"} + lattice},
        {"model:voxels", {"voxels", "sequence", "surface"}},
        {"sequence", {"first", "last", "start", "loop"}},
        {"morph", {"mesh", "center", "radius", "amount"}},
    };
    for (const KeyTable& shape : shapes)
        tables.push_back({"model:" + shape.name, shape.keys + lattice});
    for (const KeyTable& shape : shapes)
        tables.push_back({"part:" + shape.name, shape.keys + placement});
    tables.push_back({"object", Keys{"name", "model", "material", "materials", "priority", "spots",
                                     "placement", "visible"} +
                                    placement});
    tables.push_back({"light:point", light + Keys{"position"}});
    tables.push_back(
        {"light:spot", light + Keys{"position", "direction", "look_at", "angle", "inner_angle"}});
    tables.push_back({"light:directional", light + Keys{"direction"}});
    tables.push_back(
        {"light:disk", light + Keys{"position", "direction", "look_at", "radius", "spots"}});
    tables.push_back({"light:rectangle",
                      light + Keys{"position", "direction", "look_at", "up", "size", "spots"}});
    tables.push_back({"observer", {"position", "look_at", "up", "turn", "display"}});
    const Keys display = {"shape", "voxels", "layout", "visibility", "clip"};
    tables.push_back({"display:pyramid", display + Keys{"angles", "angle", "near", "far"}});
    tables.push_back({"display:sector", display + Keys{"angle", "near", "far"}});
    tables.push_back({"display:ball", display + Keys{"radius"}});
    tables.push_back({"display:box", display + Keys{"size", "near"}});
    tables.push_back({"animation", {"frames", "fps", "tracks"}});
    tables.push_back({"track", {"target", "keys", "interpolation"}});
    tables.push_back({"key", {"frame", "time", "value"}});
    tables.push_back({"render", {"size", "samples", "depth", "shadows", "shadow", "least_weight"}});
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
