// SPDX-License-Identifier: Apache-2.0
// PLY -> Mesh.
#include "runtime/io/mesh/mesh_color.hpp"
#include "runtime/io/mesh/mesh_ply_rows.hpp"
#include "runtime/io/mesh/mesh_polygon.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace voxelume {
namespace {

/// The purpose of a vertex property. All but the last are also indices into a row of numbers.
enum Role : size_t { kX, kY, kZ, kNx, kNy, kNz, kRed, kGreen, kBlue, kRoles, kSkipped = kRoles };

constexpr std::string_view kRoleNames[kRoles] = {"x",  "y",   "z",     "nx",  "ny",
                                                 "nz", "red", "green", "blue"};

bool is_normal(Role role) {
    return role >= kNx && role <= kNz;
}

Role role_of(const PlyProperty& property) {
    std::string_view name = property.name;
    if (name.starts_with("diffuse_")) {
        name.remove_prefix(8);
    }
    const auto* const found = std::ranges::find(kRoleNames, name);
    return property.is_list ? kSkipped : static_cast<Role>(found - kRoleNames);
}

/// The largest value of a colour's type, which stands for full intensity; 0 if colours can't have
/// the type.
double color_scale(PlyType type) {
    switch (type) {
        case PlyType::uint8:
            return 255.0;
        case PlyType::uint16:
            return 65535.0;
        case PlyType::float32:
        case PlyType::float64:
            return 1.0;
        default:
            return 0.0;
    }
}

/// The properties of a vertex, classified once before the rows are read.
struct VertexLayout {
    std::vector<Role> roles;  ///< one per property
    std::array<double, kRoles> scale{};
    bool has_color = false;
    bool has_normal = false;
};

VertexLayout vertex_layout(const MeshSource& source, const PlyElement& element) {
    VertexLayout layout;
    std::array<int, kRoles> found{};
    for (const PlyProperty& property : element.properties) {
        const Role role = role_of(property);
        layout.roles.push_back(role);
        if (role == kSkipped) {
            continue;
        }
        layout.scale[role] = role >= kRed ? color_scale(property.type) : 1.0;
        if (++found[role] > 1) {
            source.fail(fmt::format("the vertices have two properties '{}'", property.name));
        }
        if (layout.scale[role] == 0.0) {
            source.fail(fmt::format("the vertices' '{}' must be uchar, ushort, float or double",
                                    property.name));
        }
    }
    for (const Role role : {kX, kY, kZ}) {
        if (found[role] == 0) {
            source.fail(fmt::format("the vertices have no property '{}'", kRoleNames[role]));
        }
    }
    layout.has_normal = found[kNx] != 0 && found[kNy] != 0 && found[kNz] != 0;
    layout.has_color = found[kRed] != 0 && found[kGreen] != 0 && found[kBlue] != 0;
    return layout;
}

template <class Rows>
class BodyParser {
  public:
    BodyParser(const MeshSource& source, const PlyHeader& header)
        : source_(source), rows_(source, header.body) {}

    Mesh parse(const PlyHeader& header) {
        for (const PlyElement& element : header.elements) {
            if (element.name == "vertex") {
                parse_vertices(element);
            } else if (element.name == "face") {
                parse_faces(element);
            } else {
                skip_element(element);
            }
        }
        require_end();
        return std::move(mesh_);
    }

  private:
    void parse_vertices(const PlyElement& element) {
        if (!mesh_.positions.empty()) {
            source_.fail("the PLY header has two elements 'vertex'");
        }
        const VertexLayout layout = vertex_layout(source_, element);
        mesh_.positions.reserve(element.count);
        mesh_.normals.reserve(layout.has_normal ? element.count : 0);
        mesh_.vertex_colors.reserve(layout.has_color ? element.count : 0);
        for (uint64_t i = 0; i < element.count; ++i) {
            std::array<double, kRoles> values{};
            rows_.begin_row();
            for (size_t k = 0; k < layout.roles.size(); ++k) {
                const PlyProperty& property = element.properties[k];
                if (layout.roles[k] == kSkipped) {
                    skip_property(property);
                } else if (is_normal(layout.roles[k])) {
                    values[layout.roles[k]] = rows_.number_or_nan(property.type);
                } else {
                    values[layout.roles[k]] = rows_.number(property.type);
                }
            }
            append_vertex(values, layout);
            rows_.end_row();
        }
    }

    void append_vertex(const std::array<double, kRoles>& values, const VertexLayout& layout) {
        glm::vec3 position;
        for (int i = 0; i < 3; ++i) {
            const double value = values[static_cast<size_t>(i)];
            if (!(std::abs(value) <= std::numeric_limits<float>::max())) {
                rows_.fail(
                    fmt::format("vertex {} has the coordinate {}; it must be finite as float",
                                mesh_.positions.size(), value));
            }
            position[i] = static_cast<float>(value);
        }
        mesh_.positions.push_back(position);
        if (layout.has_normal) {
            append_normal(values);
        }
        if (!layout.has_color) {
            return;
        }
        glm::dvec3 color;
        for (size_t i = 0; i < 3; ++i) {
            const double value = values[kRed + i] / layout.scale[kRed + i];
            if (!(value >= 0.0 && value <= 1.0)) {
                rows_.fail(fmt::format("the vertex's colour has a {}; colours are from 0 to {}",
                                       values[kRed + i], layout.scale[kRed + i]));
            }
            color[static_cast<int>(i)] = value;
        }
        mesh_.vertex_colors.push_back(linear_from_srgb(color));
    }

    /// A normal that isn't three finite numbers becomes a vector of length 0.
    void append_normal(const std::array<double, kRoles>& values) {
        const glm::vec3 normal(values[kNx], values[kNy], values[kNz]);
        const bool is_finite = std::isfinite(normal.x + normal.y + normal.z);
        mesh_.normals.push_back(is_finite ? normal : glm::vec3(0));
    }

    void parse_faces(const PlyElement& element) {
        const auto is_corners = [](const PlyProperty& property) {
            return property.is_list &&
                   (property.name == "vertex_indices" || property.name == "vertex_index");
        };
        const auto corners = std::ranges::find_if(element.properties, is_corners);
        if (corners == element.properties.end() || !is_integer(corners->type)) {
            source_.fail("the faces have no list of whole numbers 'vertex_indices'");
        }
        require_triangle_count(source_, element.count);
        mesh_.triangles.reserve(mesh_.triangles.size() + element.count);
        for (uint64_t i = 0; i < element.count; ++i) {
            rows_.begin_row();
            for (const PlyProperty& property : element.properties) {
                if (&property == &*corners) {
                    parse_corners(property);
                } else {
                    skip_property(property);
                }
            }
            rows_.end_row();
        }
    }

    void parse_corners(const PlyProperty& property) {
        const uint64_t count = list_count(property);
        if (count < 3) {
            rows_.fail(fmt::format("a face has {} corners; it needs at least three", count));
        }
        corners_.resize(count);
        for (uint32_t& corner : corners_) {
            const int64_t index = rows_.integer(property.type);
            if (index < 0 || static_cast<uint64_t>(index) >= mesh_.positions.size()) {
                rows_.fail(
                    fmt::format("a face names vertex {}, and {} vertices (from 0) precede it",
                                index, mesh_.positions.size()));
            }
            corner = static_cast<uint32_t>(index);
        }
        cutter_.append(source_, corners_, mesh_);
    }

    /// The count of a list. Fails where the list's values don't fit into the rest of the file.
    uint64_t list_count(const PlyProperty& property) {
        const int64_t count = rows_.integer(property.count_type);
        if (count < 0 || !rows_.holds(property.type, static_cast<uint64_t>(count))) {
            rows_.fail(
                fmt::format("a list of {} values doesn't fit into the rest of the file", count));
        }
        return static_cast<uint64_t>(count);
    }

    void skip_property(const PlyProperty& property) {
        rows_.skip(property.type, property.is_list ? list_count(property) : 1);
    }

    void skip_element(const PlyElement& element) {
        if (element.properties.empty()) {
            return;  // such elements take no bytes, however many there are
        }
        for (uint64_t i = 0; i < element.count; ++i) {
            rows_.begin_row();
            for (const PlyProperty& property : element.properties) {
                skip_property(property);
            }
            rows_.end_row();
        }
    }

    /// Fails unless only white space follows the last element: anything else shows that the counts
    /// are wrong.
    void require_end() {
        const auto is_padding = [](char c) { return c == '\n' || c == '\0' || is_blank(c); };
        if (!std::all_of(rows_.at(), source_.end(), is_padding)) {
            rows_.begin_row();
            rows_.fail("data behind the last element; the counts in the PLY header are wrong");
        }
    }

    const MeshSource& source_;
    Rows rows_;
    Mesh mesh_;
    PolygonCutter cutter_;
    std::vector<uint32_t> corners_;
};

template <class Rows>
Mesh parse_body(const MeshSource& source, const PlyHeader& header) {
    return BodyParser<Rows>(source, header).parse(header);
}

}  // namespace

Mesh parse_ply(const MeshSource& source) {
    const PlyHeader header = parse_ply_header(source);
    Mesh mesh;
    switch (header.format) {
        case PlyFormat::ascii:
            source.require_text();
            mesh = parse_body<PlyAsciiRows>(source, header);
            break;
        case PlyFormat::binary_little_endian:
            mesh = parse_body<PlyBinaryRows<std::endian::little>>(source, header);
            break;
        case PlyFormat::binary_big_endian:
            mesh = parse_body<PlyBinaryRows<std::endian::big>>(source, header);
            break;
    }
    if (mesh.triangles.empty()) {
        source.fail("the mesh has no triangles: no element 'face' with corners in the file");
    }
    mesh.texture = header.texture;
    return mesh;
}

}  // namespace voxelume
