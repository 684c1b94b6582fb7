// SPDX-License-Identifier: Apache-2.0
// The lights of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "runtime/base/text.hpp"
#include "runtime/scene/parts/light.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

const LightType& light_type(const SceneValue& value) {
    return light_types()[kind_of(value, "type", "light")];
}

SceneFields light_fields(const SceneValue& value) {
    return {value, fmt::format("light:{}", light_type(value).name)};
}

}  // namespace

LightParameters read_light_parameters(const SceneValue& value) {
    const SceneFields fields = light_fields(value);
    static constexpr KindKey kAll[] = {{"color"}, {"intensity"}};
    LightParameters parameters;
    fields.read_kind(kAll, light_rows(), parameters);
    fields.read_kind(light_type(value).keys, light_rows(), parameters);
    return parameters;
}

/// A name that a channel may have.
std::string channel_name(const SceneValue& value) {
    const std::string& name = value.text();
    const auto is_plain = [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-';
    };
    if (!std::ranges::all_of(name, is_plain))
        value.fail(fmt::format("{} isn't a name for channels: letters, digits, - and _ make one",
                               quote(name)));
    constexpr size_t kMaxNameLength = 200;  // limited because OpenEXR takes 255 for the channel
    if (name.size() > kMaxNameLength)
        value.fail(fmt::format("a name for channels has at most {} characters, and this one {}",
                               kMaxNameLength, name.size()));
    if (name == "rest") value.fail("\"rest\" is what lights without a group are in");
    return name;
}

Light read_light(const SceneValue& value, size_t number) {
    const SceneFields fields = light_fields(value);
    const auto name = fields.find("name");
    Light light;
    light.where = value.where();
    light.name = name ? name->text() : fmt::format("lights[{}]", number);
    if (const auto group = fields.find("group")) light.group = channel_name(*group);
    set_light(light_type(value), read_light_parameters(value), fields.refusal(), light);
    return light;
}

std::vector<Light> read_lights(const SceneValue& value) {
    std::vector<Light> lights;
    for (const SceneValue& item : value.items()) lights.push_back(read_light(item, lights.size()));
    return lights;
}

}  // namespace voxelume
