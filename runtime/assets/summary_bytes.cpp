// SPDX-License-Identifier: Apache-2.0
// Summaries of meshes as CBOR, in which numbers keep all their bits.
#include "runtime/assets/summary_bytes.hpp"

#include "runtime/base/json_text.hpp"

namespace voxelume {
namespace {

nlohmann::json json_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

glm::dvec3 vector_of(const nlohmann::json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

nlohmann::json json_of(const SurfaceArea& area) {
    return {json_of(area.shadows), area.total, area.triangles, json_of(area.widths),
            area.half_edges};
}

SurfaceArea area_of(const nlohmann::json& json) {
    return {vector_of(json.at(0)), json.at(1).get<double>(), json.at(2).get<double>(),
            vector_of(json.at(3)), json.at(4).get<double>()};
}

/// A name consists of the file's bytes, in whatever encoding.
nlohmann::json json_of(const std::string& name) {
    return nlohmann::json::binary({name.begin(), name.end()});
}

std::string text_of(const nlohmann::json& json) {
    const auto& bytes = json.get_binary();
    return {bytes.begin(), bytes.end()};
}

nlohmann::json json_of(const std::vector<std::string>& names) {
    nlohmann::json list = nlohmann::json::array();
    for (const std::string& name : names) list.push_back(json_of(name));
    return list;
}

std::vector<std::string> texts_of(const nlohmann::json& list) {
    std::vector<std::string> texts;
    for (const nlohmann::json& text : list) texts.push_back(text_of(text));
    return texts;
}

nlohmann::json json_of(const MeshPaint& paint) {
    return {paint.colors, paint.has_corner_colors, paint.texels,    paint.textures,
            paint.uvs,    paint.has_corner_uvs,    paint.has_alpha, paint.mapped};
}

MeshPaint read_paint(const nlohmann::json& json) {
    return {json_integer<uint64_t>(json.at(0)),
            json.at(1).get<bool>(),
            json_integer<uint64_t>(json.at(2)),
            json_integer<uint64_t>(json.at(3)),
            json_integer<uint64_t>(json.at(4)),
            json.at(5).get<bool>(),
            json.at(6).get<bool>(),
            json_integer<uint64_t>(json.at(7))};
}

MeshSummary read_summary(const nlohmann::json& json) {
    MeshSummary summary;
    summary.triangles = json_integer<uint64_t>(json.at(0));
    summary.surface = {vector_of(json.at(1).at(0)), vector_of(json.at(1).at(1))};
    summary.vertices = {vector_of(json.at(2).at(0)), vector_of(json.at(2).at(1))};
    summary.area = area_of(json.at(3).at(0));
    summary.min_area = area_of(json.at(3).at(1));
    summary.paint = read_paint(json.at(4));
    summary.corners = json_integer<uint64_t>(json.at(6));
    summary.group_names = texts_of(json.at(5));
    const nlohmann::json& topology = json.at(7);
    summary.topology = {json_integer<uint64_t>(topology.at(0)), topology.at(1).get<double>(),
                        topology.at(2).get<double>()};
    summary.material_libraries = texts_of(json.at(8).at(0));
    summary.missing_materials = texts_of(json.at(8).at(1));
    summary.library_faults = texts_of(json.at(8).at(2));
    summary.texture = text_of(json.at(8).at(3));
    summary.has_normals = json.at(9).get<bool>();
    summary.longest_edge = json.at(10).get<double>();
    summary.notes = texts_of(json.at(11));
    summary.strokes = json_integer<uint64_t>(json.at(12));
    return summary;
}

std::string cbor_of(const nlohmann::json& json) {
    const std::vector<uint8_t> bytes = nlohmann::json::to_cbor(json);
    return {bytes.begin(), bytes.end()};
}

/// The value that `read` makes of the bytes; empty where they aren't what was written.
template <typename Value>
std::optional<Value> value_of(const std::string& bytes, Value (*read)(const nlohmann::json&)) {
    try {
        return read(nlohmann::json::from_cbor(bytes));
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

}  // namespace

std::string bytes_of(const MeshSummary& summary) {
    return cbor_of(
        {summary.triangles,
         {json_of(summary.surface.min), json_of(summary.surface.max)},
         {json_of(summary.vertices.min), json_of(summary.vertices.max)},
         {json_of(summary.area), json_of(summary.min_area)},
         json_of(summary.paint),
         json_of(summary.group_names),
         summary.corners,
         {summary.topology.open_edges, summary.topology.hole_area, summary.topology.volume},
         {json_of(summary.material_libraries), json_of(summary.missing_materials),
          json_of(summary.library_faults), json_of(summary.texture)},
         summary.has_normals,
         summary.longest_edge,
         json_of(summary.notes),
         summary.strokes});
}

std::optional<MeshSummary> summary_of_bytes(const std::string& bytes) {
    return value_of(bytes, read_summary);
}

std::string bytes_of(const MeshShape& shape) {
    const MeshCreases& creases = shape.creases;
    const MeshThickness& thickness = shape.thickness;
    return cbor_of({creases.length, creases.round_width, creases.round_length, thickness.body,
                    thickness.part, thickness.hint, thickness.sheet});
}

std::optional<MeshShape> shape_of_bytes(const std::string& bytes) {
    return value_of<MeshShape>(bytes, [](const nlohmann::json& json) {
        const auto number = [&](size_t i) { return json.at(i).get<double>(); };
        return MeshShape{{number(0), number(1), number(2)},
                         {number(3), number(4), number(5), number(6)}};
    });
}

}  // namespace voxelume
