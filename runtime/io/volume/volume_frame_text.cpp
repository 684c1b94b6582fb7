// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/volume/volume_frame_text.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "runtime/base/error.hpp"
#include "runtime/base/json_text.hpp"
#include "runtime/image/volume_geometry.hpp"

namespace voxelume {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 2> kLayouts = {"rays", "lattice"};

template <class Vector>
Json numbers(const Vector& v) {
    Json list = Json::array();
    for (int i = 0; i < Vector::length(); ++i) list.push_back(v[i]);
    return list;
}

[[noreturn]] void refuse(const char* key) {
    throw Json::other_error::create(501, key, nullptr);
}

void take_number(const Json& value, const char* key, int& number) {
    if (!is_json_integer<int>(value) || value < 0) refuse(key);
    number = json_integer<int>(value);
}

void take_number(const Json& value, const char*, double& number) {
    number = value.get<double>();
}

template <class Vector>
Vector take(const Json& json, const char* key) {
    const Json& list = json.at(key);
    if (list.size() != size_t(Vector::length())) refuse(key);
    Vector v;
    for (int i = 0; i < Vector::length(); ++i) take_number(list.at(size_t(i)), key, v[i]);
    return v;
}

template <class Enum, size_t count>
Enum take_name(const Json& json, const char* key, const std::array<const char*, count>& names) {
    const auto& name = json.at(key).get_ref<const std::string&>();
    for (size_t i = 0; i < count; ++i)
        if (name == names[i]) return static_cast<Enum>(i);
    refuse(key);
}

DisplayShape take_shape(const Json& json) {
    const auto& name = json.at("shape").get_ref<const std::string&>();
    for (const DisplayShapeRow& row : display_shapes())
        if (name == row.name) return row.shape;
    refuse("shape");
}

VolumeFrame take_frame(const Json& json) {
    VolumeFrame frame;
    frame.layout = take_name<VolumeLayout>(json, "layout", kLayouts);
    Display& display = frame.display;
    display.shape = take_shape(json);
    display.half_angles = take<glm::dvec2>(json, "half_angles");
    display.half_size = take<glm::dvec2>(json, "half_size");
    display.near = json.at("near").get<double>();
    display.far = json.at("far").get<double>();
    display.voxels = take<glm::ivec3>(json, "voxels");
    frame.size = take<glm::ivec3>(json, "size");
    frame.origin = take<glm::dvec3>(json, "origin");
    frame.edge = take<glm::dvec3>(json, "edge");
    frame.step = json.at("step").get<double>();
    const Json& rows = json.at("world_from_observer");
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            frame.world_from_observer[column][row] =
                rows.at(size_t(row)).at(size_t(column)).get<double>();
    return frame;
}

}  // namespace

std::string write_frame_text(const VolumeFrame& frame) {
    Json rows = Json::array();
    for (int row = 0; row < 4; ++row) {
        const glm::dmat4& m = frame.world_from_observer;
        rows.push_back({m[0][row], m[1][row], m[2][row], m[3][row]});
    }
    const Display& display = frame.display;
    return Json{{"layout", kLayouts[size_t(frame.layout)]},
                {"shape", shape_row(display).name},
                {"half_angles", numbers(display.half_angles)},
                {"half_size", numbers(display.half_size)},
                {"near", display.near},
                {"far", display.far},
                {"voxels", numbers(display.voxels)},
                {"size", numbers(frame.size)},
                {"origin", numbers(frame.origin)},
                {"edge", numbers(frame.edge)},
                {"step", frame.step},
                {"world_from_observer", rows}}
        .dump();
}

VolumeFrame read_frame_text(std::string_view text, const std::string& where) {
    try {
        const auto json = parse_json_text<Json>(text);
        if (json.is_discarded())
            throw Error(ErrorKind::input, "{}: its {} is damaged: no JSON of at most {} levels",
                        where, kFrameKey, kMaxJsonLevels);
        const VolumeFrame frame = take_frame(json);
        const std::string fault = find_fault(frame);
        if (fault.empty()) return frame;
        throw Error(ErrorKind::input, "{}: {}", where, fault);
    } catch (const Json::exception& error) {
        throw Error(ErrorKind::input, "{}: its {} is damaged: {}", where, kFrameKey, error.what());
    }
}

}  // namespace voxelume
