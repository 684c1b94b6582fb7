// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/gltf_sight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/import/contents.hpp"
#include "runtime/import/gltf_tracks.hpp"
#include "runtime/scene/parts/observer.hpp"

namespace voxelume {
namespace {

glm::dvec3 unit(const glm::dvec4& v) {
    const double length = glm::length(glm::dvec3(v));
    return length > 0 ? glm::dvec3(v) / length : glm::dvec3(0, 0, 1);
}

glm::dvec3 position_of(const GltfNode& node) {
    return glm::dvec3(node.world_from_node[3]);
}

/// The direction of a node's sight: cameras and lights look along -Z.
glm::dvec3 direction_of(const glm::dmat4& world_from_node) {
    return -unit(world_from_node[2]);
}
glm::dvec3 direction_of(const GltfNode& node) {
    return direction_of(node.world_from_node);
}

/// True if a node's map still defines its camera's sight direction and up direction.
bool has_directions(const glm::dmat4& map) {
    return glm::length(glm::cross(direction_of(map), unit(map[1]))) > kMinUpSine;
}

/// The maps of a camera or light at all frames. A map that a clip flattens keeps the directions of
/// the map before.
std::vector<glm::dmat4> with_directions(std::vector<glm::dmat4> maps) {
    const auto first = std::ranges::find_if(maps, has_directions);
    if (first == maps.end()) return maps;
    glm::dmat4 last = *first;
    for (glm::dmat4& map : maps) {
        if (has_directions(map))
            last = map;
        else
            for (int i = 0; i < 3; ++i) map[i] = last[i];
    }
    return maps;
}

/// Appends a track of the values of a node's maps, unless they are all alike.
template <class Value>
void add_track(const std::string& target, const std::vector<glm::dmat4>& maps, const Value& value,
               std::vector<std::string>& tracks) {
    std::vector<glm::dvec3> values;
    values.reserve(maps.size());
    for (const glm::dmat4& map : maps) values.push_back(value(map));
    if (std::ranges::all_of(values, [&](const glm::dvec3& v) { return v == values.front(); }))
        return;
    tracks.push_back(baked_track(target, values));
}

std::vector<glm::dmat4> all_maps(const GltfFrames& frames, const GltfNode& node) {
    std::vector<glm::dmat4> maps;
    maps.reserve(size_t(frames.count));
    for (int frame = 1; frame <= frames.count; ++frame) maps.push_back(frames.map_at(node, frame));
    return maps;
}

std::vector<GltfNode>::const_iterator first_camera(const std::vector<GltfNode>& nodes) {
    return std::ranges::find_if(nodes, [](const GltfNode& n) { return n.camera >= 0; });
}

/// The distance before a camera at which its picture with parallel rays begins.
double near_of(const GltfValue& camera) {
    if (camera.text("type") != "orthographic") return 0;
    return std::max(camera.at("orthographic").number("znear", 0), 0.0);
}

std::string perspective_display(const GltfValue& camera, const glm::ivec2& size) {
    const double height = std::tan(std::clamp(camera.number("yfov", 0.8), 0.01, 3.1) / 2);
    const double angle = 2 * glm::degrees(std::atan(height * size.x / size.y));
    return fmt::format("\"shape\": \"pyramid\", \"angle\": {}",
                       rounded(std::clamp(angle, 1.0, 170.0), 8));
}

/// The display of a camera with parallel rays: a box as deep as the camera's range, behind its near
/// plane.
std::string parallel_display(const GltfValue& camera, const glm::ivec2& size, double scale,
                             double depth) {
    const double height = 2 * scale * std::max(std::abs(camera.number("ymag", 1)), 1e-6);
    return fmt::format("\"shape\": \"box\", \"size\": [{}, {}, {}]",
                       rounded(height * size.x / size.y, 8), rounded(height, 8), rounded(depth, 8));
}

/// A light's luminous intensity or illuminance, in its colour. A metre of the file has `scale`
/// metres in the scene. Light from a position falls off over these, so its intensity grows by the
/// square of `scale`.
double brightness(const GltfValue& light, double scale) {
    const double own = std::clamp(light.number("intensity", 1), 0.0, 1e9);
    return light.text("type") == "directional" ? own : own * scale * scale;
}

double irradiance_at(const glm::dvec3& p, const GltfNode& node, const GltfValue& light,
                     double nearest, double scale) {
    if (light.text("type") == "directional") return brightness(light, scale);
    const double distance = std::max(glm::length(p - position_of(node)), nearest);
    return brightness(light, scale) / (distance * distance);
}

/// The opening angle of a cone in degrees; `half` is half of it in radians.
double opening(double half) {
    return std::clamp(2 * glm::degrees(half), 0.01, 179.9);
}

/// `intensity` is in the units of the scene.
std::string light_item(const GltfNode& node, const GltfValue& light, const std::string& name,
                       double intensity) {
    const std::string type = light.text("type");
    std::string text =
        fmt::format("{{\"name\": {}, \"type\": {}", json_text(name), json_text(type));
    if (type != "directional")
        text += fmt::format(", \"position\": {}", json_list(rounded(position_of(node), 9)));
    if (type != "point")
        text += fmt::format(", \"direction\": {}", json_list(rounded(direction_of(node), 9)));
    if (type == "spot") {
        const GltfValue spot = light.at("spot");
        const double outer = opening(spot.number("outerConeAngle", 0.7853981633974483));
        const double inner = std::min(opening(spot.number("innerConeAngle", 0)), outer);
        text += fmt::format(", \"angle\": {}, \"inner_angle\": {}", rounded(outer, 9),
                            rounded(inner, 9));
    }
    const std::vector<double> color = light.numbers("color", 3);
    if (!color.empty())
        text += fmt::format(", \"color\": [{}, {}, {}]", std::max(color[0], 0.0),
                            std::max(color[1], 0.0), std::max(color[2], 0.0));
    return text + fmt::format(", \"intensity\": {}}}", rounded(intensity, 6));
}

void add_light_tracks(const std::string& target, const std::string& type,
                      const std::vector<glm::dmat4>& maps, std::vector<std::string>& tracks) {
    if (type != "directional")
        add_track(
            target + ".position", maps, [](const glm::dmat4& m) { return glm::dvec3(m[3]); },
            tracks);
    if (type != "point")
        add_track(
            target + ".direction", maps, [](const glm::dmat4& m) { return direction_of(m); },
            tracks);
}

bool is_shown(const GltfValue& light) {
    const std::string type = light.text("type");
    return (type == "point" || type == "spot" || type == "directional") && brightness(light, 1) > 0;
}

}  // namespace

int frame_count(double seconds) {
    constexpr int kMaxFrames = 1'000'000;
    const double last = std::floor(seconds * kGltfFrameRate + 1e-4);
    return 1 + int(std::clamp(last, 0.0, double(kMaxFrames - 1)));
}

std::vector<glm::dmat4> GltfFrames::maps_of(const GltfNode& node) const {
    constexpr int kMaxMaps = 500;
    if (!motion.moves(node.number)) return {node.world_from_node};
    std::vector<glm::dmat4> maps;
    const int some = std::min(count, kMaxMaps);
    maps.reserve(size_t(some));
    for (int i = 0; i < some; ++i)
        maps.push_back(map_at(node, 1 + int(int64_t(i) * (count - 1) / std::max(some - 1, 1))));
    return maps;
}

FileObserver gltf_observer(const GltfFile& file, const std::vector<GltfNode>& nodes,
                           const Bounds& box, const glm::ivec2& size, const GltfFrames& frames) {
    const auto node = first_camera(nodes);
    if (node == nodes.end()) return {};
    const double scale = frames.scale();
    const GltfValue camera = file.root().item("cameras", size_t(node->camera));
    const bool is_flat = !has_directions(node->world_from_node);  // its tracks may have them
    const glm::dvec3 towards = is_flat ? glm::dvec3(0, 0, -1) : direction_of(*node);
    const glm::dvec3 up = is_flat ? glm::dvec3(0, 1, 0) : unit(node->world_from_node[1]);
    glm::dvec3 position = position_of(*node);
    double depth = 0;
    for (int i = 0; i < 8; ++i)
        depth = std::max(depth, glm::dot(corner(box, i) - position, towards));
    std::string display;
    if (camera.text("type") == "orthographic") {
        const GltfValue values = camera.at("orthographic");
        const double near = scale * near_of(camera);
        position += near * towards;
        const double far = scale * values.number("zfar", (near + depth) / scale) - near;
        depth = std::max(std::min(far, 1.01 * depth), 1e-3 * scale);
        display = parallel_display(values, size, scale, depth);
    } else {
        display = perspective_display(camera.at("perspective"), size);
    }
    const double distance = depth > 0 ? depth / 2 : scale;
    FileObserver observer;
    observer.height = position.y;
    for (const glm::dmat4& map : frames.maps_of(*node))
        observer.height = std::min(observer.height, map[3].y);
    observer.text = fmt::format(
        "  \"observer\": {{\"position\": {}, \"look_at\": {}, \"up\": {},\n"
        "               \"display\": {{{}}}}},\n",
        json_list(rounded(position, 9)), json_list(rounded(position + distance * towards, 9)),
        json_list(rounded(up, 9)), display);
    return observer;
}

void add_observer_tracks(const GltfFile& file, const std::vector<GltfNode>& nodes,
                         const GltfFrames& frames, std::vector<std::string>& tracks) {
    const auto node = first_camera(nodes);
    if (node == nodes.end() || !frames.motion.moves(node->number)) return;
    const double near = frames.scale() * near_of(file.root().item("cameras", size_t(node->camera)));
    const std::vector<glm::dmat4> maps = with_directions(all_maps(frames, *node));
    const auto position = [near](const glm::dmat4& map) {
        return glm::dvec3(map[3]) + near * direction_of(map);
    };
    add_track("observer.position", maps, position, tracks);
    add_track(
        "observer.look_at", maps,
        [&](const glm::dmat4& map) { return position(map) + direction_of(map); }, tracks);
    add_track(
        "observer.up", maps, [](const glm::dmat4& map) { return unit(map[1]); }, tracks);
}

std::vector<std::string> gltf_light_items(const GltfFile& file, const std::vector<GltfNode>& nodes,
                                          const Bounds& box, const GltfFrames& frames,
                                          std::vector<std::string>& tracks) {
    const std::vector<GltfValue> lights = gltf_lights(file);
    const glm::dvec3 middle = (box.min + box.max) / 2.0;
    double sum = 0;
    for (const GltfNode& node : nodes)
        if (node.light >= 0 && is_shown(lights[size_t(node.light)]))
            sum += irradiance_at(middle, node, lights[size_t(node.light)], longest_side(box) / 8,
                                 frames.scale());
    std::vector<std::string> items;
    NameList names({});
    for (const GltfNode& node : nodes) {
        if (node.light < 0 || !is_shown(lights[size_t(node.light)])) continue;
        const GltfValue& light = lights[size_t(node.light)];
        const std::string name = names.unique(node.name.empty() ? "light" : node.name);
        items.push_back(light_item(node, light, name, brightness(light, frames.scale()) / sum));
        if (frames.motion.moves(node.number))
            add_light_tracks("lights." + target_name(name), light.text("type"),
                             with_directions(all_maps(frames, node)), tracks);
    }
    return items;
}

}  // namespace voxelume
