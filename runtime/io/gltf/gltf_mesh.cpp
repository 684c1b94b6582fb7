// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "runtime/base/error.hpp"
#include "runtime/base/make_room.hpp"
#include "runtime/geometry/mesh_points.hpp"
#include "runtime/io/gltf/gltf_accessor.hpp"
#include "runtime/io/gltf/gltf_nodes.hpp"
#include "runtime/io/gltf/gltf_primitives.hpp"
#include "runtime/io/gltf/gltf_skin.hpp"
#include "runtime/io/gltf/gltf_textures.hpp"
#include "runtime/io/gltf/gltf_unshown.hpp"
#include "runtime/io/mesh/alpha_ramp.hpp"
#include "runtime/io/mesh/mesh_polygon.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"

namespace voxelume {
namespace {

enum Mode : uint64_t { kPoints, kLines, kLineLoop, kLineStrip, kTriangles, kStrip, kFan };

/// Appends the points or lines that vertices make in one of the modes.
void append_strokes(const std::vector<uint32_t>& order, uint64_t mode, uint32_t base, Mesh& mesh) {
    const size_t count = order.size(), step = mode == kLines ? 2 : 1;
    make_room(mesh.triangles, count);
    const auto add = [&](size_t a, size_t b) {
        mesh.triangles.push_back(line_triangle(order[a], order[b]) + base);
    };
    if (mode == kPoints)
        for (size_t i = 0; i < count; ++i) add(i, i);
    else
        for (size_t i = 0; i + 2 <= count; i += step) add(i, i + 1);
    if (mode == kLineLoop && count > 2) add(count - 1, 0);
}

/// Appends the triangles that vertices make in one of the modes.
void append_triangles(const std::vector<uint32_t>& order, uint64_t mode, uint32_t base,
                      bool is_mirrored, Mesh& mesh) {
    const auto add = [&](size_t a, size_t b, size_t c) {
        glm::uvec3 t(order[a], order[b], order[c]);
        if (is_mirrored) std::swap(t.y, t.z);
        mesh.triangles.push_back(t + base);
    };
    const size_t count = order.size();
    make_room(mesh.triangles, mode == kTriangles ? count / 3 : count);
    if (mode == kTriangles)
        for (size_t i = 0; i + 3 <= count; i += 3) add(i, i + 1, i + 2);
    else if (mode == kStrip)
        for (size_t i = 0; i + 3 <= count; ++i) add(i, i + 1 + i % 2, i + 2 - i % 2);
    else
        for (size_t i = 1; i + 2 <= count; ++i) add(i, i + 1, 0);
}

/// What the reading of a primitive takes, in vertices.
constexpr uint64_t kPrimitiveCost = 512;

/// The vertices and indices that the primitives of a file's nodes may have together: a small file
/// can repeat one of them without end. Files of scenes that people make stay far below.
class SceneBudget {
  public:
    explicit SceneBudget(const GltfFile& file)
        : file_(file), left_((uint64_t{1} << 25) + 128 * file.bytes()) {}
    void take(uint64_t elements) {
        if (elements > left_)
            throw Error(ErrorKind::limit,
                        "{}: its nodes show more vertices and indices than {} bytes may stand for: "
                        "fewer of them may show one mesh",
                        SourcePlace(file_.path().string()), file_.bytes());
        left_ -= elements;
    }

  private:
    const GltfFile& file_;
    uint64_t left_;
};

class MeshBuilder {
  public:
    explicit MeshBuilder(const GltfFile& file) : file_(file), textures_(file), budget_(file) {}

    /// Prepares for a mesh. All meshes are to be expected before the first is added.
    void expect_mesh(int number) { textures_.expect_mesh(number); }

    void add_mesh(int number, const glm::dmat4& map) {
        const GltfValue mesh = file_.root().item("meshes", size_t(number));
        const std::vector<GltfValue> shown = gltf_primitives(mesh);
        for (const GltfValue& primitive : shown) add_primitive(primitive, map);
        if (!shown.empty() && !is_gltf_stroke(shown[0]))
            skipped_ += size_t(std::ranges::count_if(mesh.items("primitives"), is_gltf_stroke));
    }

    /// Adds a mesh whose joints stand where the file's nodes do.
    void add_skinned_mesh(const GltfNode& node) {
        const size_t first = mesh_.positions.size();
        add_mesh(node.mesh, glm::dmat4(1));
        GltfSkin(file_, node.mesh + 1, node.skin, "").move(mesh_, first, 0);
        for (size_t i = first; i < mesh_.positions.size(); ++i) check_finite(mesh_.positions[i]);
    }

    Mesh mesh() {
        if (mesh_.triangles.empty())
            throw Error(ErrorKind::input, "{}: has no triangles, points or lines to show",
                        SourcePlace(file_.path().string()));
        fill(mesh_.positions.size());
        if (mesh_.textures.empty()) {
            mesh_.uvs = {};
            mesh_.group_textures = {};
        }
        for (const std::string& note : file_.notes()) mesh_.notes.push_back(note);
        if (skipped_ > 0)
            mesh_.notes.push_back(
                fmt::format("{} of its primitives are points or lines, which aren't shown in a "
                            "mesh with triangles",
                            skipped_));
        return std::move(mesh_);
    }

  private:
    void add_primitive(const GltfValue& primitive, const glm::dmat4& map) {
        uint64_t mode = primitive.count("mode", kTriangles);
        if (mode > kFan) primitive.fail(fmt::format("{} is no mode", mode));
        if (primitive.has_extension("KHR_draco_mesh_compression")) mode = kTriangles;  // by now
        const GltfValue attributes = primitive.at("attributes");
        budget_.take(kPrimitiveCost + count_gltf_values(file_, attributes, "POSITION"));
        if (primitive.has("indices")) budget_.take(count_gltf_values(file_, primitive, "indices"));
        const GltfValues positions = gltf_values(file_, attributes, "POSITION", {3});
        const size_t base = mesh_.positions.size();
        if (base + positions.count >= kMaxGltfElements) fail_size();
        add_positions(positions, map);
        add_normals(attributes, positions.count, base, map);
        add_colors(attributes, positions.count, base);
        const int material = primitive.index("material", file_.root().size("materials"));
        if (textures_.shows_vertex_alpha(material))
            add_alphas(positions.count, base);
        else
            add_uvs(attributes, material, positions.count, base);
        if (lets_through(alphas_)) textures_.note_lost_alpha(material, mesh_);
        add_faces(primitive, mode, positions.count, base, glm::determinant(glm::dmat3(map)) < 0);
        make_room(mesh_.triangle_group, mesh_.triangles.size() - mesh_.triangle_group.size());
        mesh_.triangle_group.resize(mesh_.triangles.size(), group_of(material));
    }

    [[noreturn]] void fail_size() const {
        throw Error(ErrorKind::limit, "{}: its scene has more than 2^31 vertices or {} triangles",
                    SourcePlace(file_.path().string()), kMaxTriangles);
    }

    void check_finite(const glm::vec3& p) const {
        if (!std::isfinite(p.x + p.y + p.z))
            throw Error(ErrorKind::input, "{}: a vertex isn't finite",
                        SourcePlace(file_.path().string()));
    }

    void add_positions(const GltfValues& positions, const glm::dmat4& map) {
        make_room(mesh_.positions, positions.count);
        for (size_t i = 0; i < positions.count; ++i) {
            const float* const p = &positions.values[3 * i];
            const glm::vec3 at(map * glm::dvec4(p[0], p[1], p[2], 1));
            check_finite(at);
            mesh_.positions.push_back(at);
        }
    }

    /// Reads values; their number must be that of the primitive's vertices.
    GltfValues values(const GltfValue& attributes, const char* key, size_t vertices,
                      std::initializer_list<int> components) const {
        GltfValues found = gltf_values(file_, attributes, key, components);
        if (found.count != vertices)
            attributes.fail(fmt::format("{} vertices, and {} of {}", vertices, found.count, key));
        return found;
    }

    void add_normals(const GltfValue& attributes, size_t vertices, size_t base,
                     const glm::dmat4& map) {
        if (!attributes.has("NORMAL")) return;
        const GltfValues normals = values(attributes, "NORMAL", vertices, {3});
        const glm::dmat3 turn = glm::inverseTranspose(glm::dmat3(map));
        make_room(mesh_.normals, base + vertices - mesh_.normals.size());
        mesh_.normals.resize(base, glm::vec3(0));
        for (size_t i = 0; i < vertices; ++i) {
            const float* const n = &normals.values[3 * i];
            const glm::vec3 normal(turn * glm::dvec3(n[0], n[1], n[2]));
            mesh_.normals.push_back(std::isfinite(normal.x + normal.y + normal.z) ? normal
                                                                                  : glm::vec3(0));
        }
    }

    /// Adds linear colours, as glTF has them. `alphas_` becomes their alpha.
    void add_colors(const GltfValue& attributes, size_t vertices, size_t base) {
        alphas_.clear();
        if (!attributes.has("COLOR_0")) return;
        const GltfValues colors = values(attributes, "COLOR_0", vertices, {3, 4});
        mesh_.vertex_colors.resize(base, glm::vec3(1));
        for (size_t i = 0; i < vertices; ++i) {
            const float* const c = &colors.values[size_t(colors.components) * i];
            const glm::vec3 color(c[0], c[1], c[2]);
            const bool is_color = std::isfinite(color.x + color.y + color.z);
            mesh_.vertex_colors.push_back(is_color ? glm::clamp(color, glm::vec3(0), glm::vec3(1))
                                                   : glm::vec3(1));
            if (colors.components == 4) alphas_.push_back(c[3]);
        }
    }

    /// Gives vertices the UVs of their alpha; vertices of a primitive without alpha are opaque.
    void add_alphas(size_t vertices, size_t base) {
        mesh_.uvs.resize(base, glm::vec2(0));
        for (size_t i = 0; i < vertices; ++i)
            mesh_.uvs.push_back(place_on_ramp(alphas_.empty() ? 1 : alphas_[i]));
    }

    void add_uvs(const GltfValue& attributes, int material, size_t vertices, size_t base) {
        const GltfTextureUse use = textures_.of_material(material);
        const std::string key = fmt::format("TEXCOORD_{}", use.set);
        if (use.texture < 0 || !attributes.has(key.c_str())) return;
        const GltfValues uvs = values(attributes, key.c_str(), vertices, {2});
        mesh_.uvs.resize(base, glm::vec2(0));
        for (size_t i = 0; i < vertices; ++i)
            mesh_.uvs.push_back(use.moved({uvs.values[2 * i], uvs.values[2 * i + 1]}));
    }

    void add_faces(const GltfValue& primitive, uint64_t mode, size_t vertices, size_t base,
                   bool is_mirrored) {
        std::vector<uint32_t> order;
        if (primitive.has("indices")) {
            order = gltf_indices(file_, primitive, "indices", vertices);
        } else {
            order.resize(vertices);
            for (size_t i = 0; i < vertices; ++i) order[i] = uint32_t(i);
        }
        if (mesh_.triangles.size() + order.size() > kMaxTriangles) fail_size();
        if (mode < kTriangles)
            append_strokes(order, mode, uint32_t(base), mesh_);
        else
            append_triangles(order, mode, uint32_t(base), is_mirrored, mesh_);
    }

    /// The group of a material. A group begins to exist with its first primitive.
    uint32_t group_of(int material) {
        const auto [entry, is_new] =
            groups_.try_emplace(material, uint32_t(mesh_.group_names.size()));
        if (is_new) {
            mesh_.group_names.push_back(file_.material_name(material));
            mesh_.group_textures.push_back(textures_.append(material, mesh_));
            if (material >= 0)
                note_unshown(file_.root().item("materials", size_t(material)), mesh_.notes);
        }
        return entry->second;
    }

    /// Fills the lists of colours, UVs and normals with neutral values up to the last vertex.
    void fill(size_t vertices) {
        if (!mesh_.vertex_colors.empty()) mesh_.vertex_colors.resize(vertices, glm::vec3(1));
        if (!mesh_.normals.empty()) mesh_.normals.resize(vertices, glm::vec3(0));
        if (!mesh_.uvs.empty() || !mesh_.textures.empty()) mesh_.uvs.resize(vertices, glm::vec2(0));
    }

    const GltfFile& file_;
    GltfTextures textures_;
    SceneBudget budget_;
    Mesh mesh_;
    std::map<int, uint32_t> groups_;
    std::vector<float> alphas_;  ///< alphas of the current primitive's vertices
    size_t skipped_ = 0;
};

}  // namespace

Mesh read_mesh_file(const std::filesystem::path& path) {
    return is_gltf_file(path) ? gltf_mesh(GltfFile(read_mesh_bytes(path), path), 0)
                              : read_mesh(path);
}

Mesh gltf_mesh(const GltfFile& file, int part) {
    MeshBuilder builder(file);
    const size_t meshes = file.root().size("meshes");
    if (size_t(part) > meshes)
        throw Error(ErrorKind::input, "{}: has {} meshes, and none of number {}",
                    SourcePlace(file.path().string()), meshes, part);
    if (part > 0) {
        builder.expect_mesh(part - 1);
        builder.add_mesh(part - 1, glm::dmat4(1));
        return builder.mesh();
    }
    const std::vector<GltfNode> nodes = gltf_nodes(file);
    for (const GltfNode& node : nodes)
        if (node.mesh >= 0) builder.expect_mesh(node.mesh);
    for (const GltfNode& node : nodes)
        if (node.skin >= 0)
            builder.add_skinned_mesh(node);
        else if (node.mesh >= 0)
            builder.add_mesh(node.mesh, node.world_from_node);
    return builder.mesh();
}

}  // namespace voxelume
