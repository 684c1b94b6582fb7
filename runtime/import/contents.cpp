// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/contents.hpp"

#include <charconv>
#include <cmath>

#include "runtime/geometry/mesh_points.hpp"

namespace voxelume {

std::string json_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", int(c));
        else
            out += c;
    }
    return out + '"';
}

std::string target_name(const std::string& name) {
    if (name.find_first_of(".[]\"") == std::string::npos) return name;
    return json_text(name);
}

std::string json_size(const glm::dvec3& v) {
    return v.x == v.y && v.y == v.z ? fmt::format("{}", v.x) : json_list(v);
}

double rounded(double x, int digits) {
    const std::string text = fmt::format("{:.{}g}", x, digits);
    double value = x;  // the value if the decimal exceeds 64-bit floats
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value + 0.0;  // -0 becomes 0
}

glm::dvec3 rounded(const glm::dvec3& v, int digits) {
    return {rounded(v.x, digits), rounded(v.y, digits), rounded(v.z, digits)};
}

std::string NameList::unique(const std::string& wanted) {
    std::string name = wanted;
    int& last = numbers_.try_emplace(wanted, 1).first->second;
    while (!names_.insert(name).second) name = fmt::format("{} {}", wanted, ++last);
    return name;
}

std::string stem_of(const ImportedFile& file) {
    std::string stem = file.path.stem().string();
    return stem == "default" || stem == "ground" ? stem + " model" : stem;
}

std::string fit_member(const ImportOptions& options) {
    return options.fit > 0 ? fmt::format(", \"fit\": {}", options.fit) : "";
}

glm::dvec3 mesh_voxel_size(const Bounds& box, bool is_textured) {
    const double edge = longest_side(box) / (is_textured ? 512 : 256);
    // The edge is rounded up, so that there are no more voxels than that.
    return glm::dvec3(rounded(edge * 1.0005, 4));
}

glm::dvec3 point_voxel_size(const Mesh& mesh, const Contents& contents, double scale) {
    const double edge = voxel_edge_of_points(mesh, contents.voxel_size.x / scale) * scale;
    return glm::dvec3(rounded(edge, 4));
}

std::string surface_members(const MeshSummary& mesh, bool is_smooth) {
    if (!has_area(mesh)) return "\"surface\": \"cubes\"";
    return is_smooth ? "\"surface\": \"exact\", \"shading\": \"smooth\"" : "\"surface\": \"exact\"";
}

Bounds fitted_box(const Bounds& box, const ImportOptions& options) {
    if (options.fit == 0) return box;
    const glm::dvec3 half = (box.max - box.min) * (options.fit / longest_side(box) / 2);
    return {-half, half};
}

}  // namespace voxelume
