// SPDX-License-Identifier: Apache-2.0
// PLY -> Mesh.
#include "runtime/io/mesh/alpha_ramp.hpp"
#include "runtime/io/mesh/mesh_color.hpp"
#include "runtime/io/mesh/mesh_paint.hpp"
#include "runtime/io/mesh/mesh_polygon.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/io/mesh/mesh_scan.hpp"
#include "runtime/io/mesh/ply/mesh_ply_layout.hpp"
#include "runtime/io/mesh/ply/mesh_ply_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelume {
namespace {

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
            } else if (element.name == "tristrips") {
                parse_strips(element);
            } else {
                skip_element(element);
            }
        }
        require_end();
        fill_corner_lists(mesh_);
        if (has_face_alpha_) mesh_.notes.emplace_back("the alpha of its faces isn't shown");
        show_vertex_alpha(alphas_, !header.texture.empty(), mesh_);
        return std::move(mesh_);
    }

  private:
    void parse_vertices(const PlyElement& element) {
        if (!mesh_.positions.empty()) {
            source_.fail("the PLY header has two elements 'vertex'");
        }
        const PlyLayout layout = ply_vertex_layout(source_, element);
        mesh_.positions.reserve(element.count);
        mesh_.normals.reserve(layout.has_normal ? element.count : 0);
        mesh_.vertex_colors.reserve(layout.has_color ? element.count : 0);
        mesh_.uvs.reserve(layout.has_uv ? element.count : 0);
        for (uint64_t i = 0; i < element.count; ++i) {
            rows_.begin_row();
            for (size_t k = 0; k < layout.roles.size(); ++k) {
                read_property(element.properties[k], layout.roles[k]);
            }
            append_vertex(layout);
            rows_.end_row();
        }
    }

    /// Reads a number of the row, or skips it.
    void read_property(const PlyProperty& property, PlyRole role) {
        if (role == kPlySkipped) {
            skip_property(property);
        } else {
            const bool may_be_any = is_ply_normal(role) || role >= kPlyAlpha;
            row_[role] =
                may_be_any ? rows_.number_or_nan(property.type) : rows_.number(property.type);
        }
    }

    void append_vertex(const PlyLayout& layout) {
        glm::vec3 position;
        for (int i = 0; i < 3; ++i) {
            const double value = row_[static_cast<size_t>(i)];
            if (!(std::abs(value) <= std::numeric_limits<float>::max())) {
                rows_.fail(
                    fmt::format("vertex {} has the coordinate {}; it must be finite as float",
                                mesh_.positions.size(), value));
            }
            position[i] = static_cast<float>(value);
        }
        mesh_.positions.push_back(position);
        if (layout.has_normal) append_normal();
        if (layout.has_uv) mesh_.uvs.push_back(upright_uv(row_[kPlyU], row_[kPlyV]));
        if (layout.has_color) mesh_.vertex_colors.push_back(color_of_row(layout, "vertex"));
        if (layout.has_alpha) alphas_.push_back(float(row_[kPlyAlpha] / layout.scale[kPlyAlpha]));
    }

    glm::vec3 color_of_row(const PlyLayout& layout, const char* what) const {
        const glm::dvec3 color = ply_color(row_, layout);
        if (color.x < 0) {
            rows_.fail(fmt::format("the {}'s colour has a part of {}; colours are from 0 to {}",
                                   what, color.y, color.z));
        }
        return linear_from_srgb(color);
    }

    /// A normal that isn't three finite numbers becomes a vector of length 0.
    void append_normal() {
        const glm::vec3 normal(row_[kPlyNx], row_[kPlyNy], row_[kPlyNz]);
        const bool is_finite = std::isfinite(normal.x + normal.y + normal.z);
        mesh_.normals.push_back(is_finite ? normal : glm::vec3(0));
    }

    void parse_faces(const PlyElement& element) {
        const PlyProperty& corners = corners_of(element, "faces");
        PlyLayout layout = ply_face_layout(element);
        const bool have_vertices = !mesh_.vertex_colors.empty() && mesh_.triangle_colors.empty();
        layout.has_color = layout.has_color && !have_vertices;
        if (!layout.has_color) std::ranges::fill(layout.roles, kPlySkipped);
        require_triangle_count(source_, element.count);
        mesh_.triangles.reserve(mesh_.triangles.size() + element.count);
        for (uint64_t i = 0; i < element.count; ++i) {
            rows_.begin_row();
            corner_uvs_.clear();
            for (size_t k = 0; k < layout.roles.size(); ++k) {
                const PlyProperty& property = element.properties[k];
                if (&property == &corners) {
                    parse_corners(property);
                } else if (property.is_list && property.name == "texcoord") {
                    parse_corner_uvs(property);
                } else {
                    read_property(property, layout.roles[k]);
                }
            }
            append_face(layout);
            rows_.end_row();
        }
    }

    const PlyProperty& corners_of(const PlyElement& element, const char* what) const {
        const auto corners =
            std::ranges::find_if(element.properties, [](const PlyProperty& property) {
                return property.is_list &&
                       (property.name == "vertex_indices" || property.name == "vertex_index");
            });
        if (corners == element.properties.end() || !is_integer(corners->type)) {
            source_.fail(
                fmt::format("the {} have no list of whole numbers 'vertex_indices'", what));
        }
        return *corners;
    }

    void parse_corners(const PlyProperty& property) {
        const uint64_t count = list_count(property);
        if (count < 3) {
            rows_.fail(fmt::format("a face has {} corners; it needs at least three", count));
        }
        corners_.resize(count);
        for (uint32_t& corner : corners_) {
            corner = vertex_index(rows_.integer(property.type), "a face");
        }
    }

    uint32_t vertex_index(int64_t index, const char* what) const {
        if (index < 0 || static_cast<uint64_t>(index) >= mesh_.positions.size()) {
            rows_.fail(fmt::format("{} names vertex {}, and {} vertices (from 0) precede it", what,
                                   index, mesh_.positions.size()));
        }
        return static_cast<uint32_t>(index);
    }

    void parse_corner_uvs(const PlyProperty& property) {
        const uint64_t count = list_count(property);
        for (uint64_t i = 0; i < count; ++i)
            corner_uvs_.push_back(rows_.number_or_nan(property.type));
    }

    /// Appends the face's triangles, its colour, and the UVs of its corners.
    void append_face(const PlyLayout& layout) {
        const size_t before = mesh_.triangles.size();
        cutter_.append(source_, corners_, mesh_);
        if (layout.has_color) {
            append_face_color(mesh_, color_of_row(layout, "face"), before);
        }
        has_face_alpha_ |=
            layout.has_color && layout.has_alpha && row_[kPlyAlpha] < layout.scale[kPlyAlpha];
        if (corner_uvs_.size() != 2 * corners_.size()) return;
        mesh_.triangle_uvs.resize(before, glm::uvec3(kNoUv));
        const auto first = static_cast<uint32_t>(mesh_.uvs.size());
        for (size_t i = 0; i < corners_.size(); ++i)
            mesh_.uvs.push_back(upright_uv(corner_uvs_[2 * i], corner_uvs_[2 * i + 1]));
        for (const glm::uvec3& t : cutter_.triangles()) mesh_.triangle_uvs.push_back(t + first);
    }

    /// Parses triangle strips: each index makes a triangle with the two before it, and -1 ends a
    /// strip.
    void parse_strips(const PlyElement& element) {
        const PlyProperty& corners = corners_of(element, "tristrips");
        for (uint64_t i = 0; i < element.count; ++i) {
            rows_.begin_row();
            for (const PlyProperty& property : element.properties) {
                if (&property == &corners) {
                    parse_strip(property);
                } else {
                    skip_property(property);
                }
            }
            rows_.end_row();
        }
    }

    void parse_strip(const PlyProperty& property) {
        const uint64_t count = list_count(property);
        require_triangle_count(source_, mesh_.triangles.size() + count);
        PlyStrip strip;
        for (uint64_t i = 0; i < count; ++i) {
            const int64_t index = rows_.integer(property.type);
            if (index == -1)
                strip = {};
            else
                strip.add(vertex_index(index, "a strip"), mesh_.triangles);
        }
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
            return;  // such elements take no bytes, whatever their number
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
    std::vector<double> corner_uvs_;  ///< u and v of the face's corners, if it has them
    std::vector<float> alphas_;       ///< one a vertex, if they have any
    bool has_face_alpha_ = false;     ///< some faces aren't opaque
    PlyRow row_{};
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
    const bool has_faces = std::ranges::any_of(header.elements, [](const PlyElement& element) {
        return (element.name == "face" || element.name == "tristrips") && element.count > 0;
    });
    if (mesh.triangles.empty() && has_faces) source.fail("the mesh has faces, and no triangles");
    show_scan(source, mesh);
    mesh.texture = header.texture;
    return mesh;
}

}  // namespace voxelume
