// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/mesh_textures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/image/picture.hpp"
#include "runtime/io/mesh/companion_file.hpp"
#include "runtime/io/mesh/material_library.hpp"
#include "runtime/io/mesh/mesh_maps.hpp"
#include "runtime/io/mesh/mesh_paint.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/io/mesh/texture_levels.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

uint64_t first_level_texels(const Mesh& mesh) {
    uint64_t count = 0;
    for (const Texture& texture : mesh.textures)
        count += uint64_t(texture.image->width) * uint64_t(texture.image->height);
    return count;
}

/// Gives the corners of a group's triangles places of their own: `offset` + `scale` · the old ones,
/// whose v counts upwards.
void move_uvs(Mesh& mesh, uint32_t group, const MtlTexture& map) {
    if (map.offset == glm::dvec2(0) && map.scale == glm::dvec2(1)) return;
    for (size_t i = 0; i < mesh.triangle_uvs.size(); ++i) {
        if ((mesh.triangle_group.empty() ? 0 : mesh.triangle_group[i]) != group) continue;
        glm::uvec3& t = mesh.triangle_uvs[i];
        for (int k = 0; k < 3; ++k) {
            if (t[k] >= mesh.uvs.size()) continue;
            const glm::dvec2 old(mesh.uvs[t[k]].x, 1 - double(mesh.uvs[t[k]].y));
            const glm::dvec2 at = map.offset + map.scale * old;
            t[k] = uint32_t(mesh.uvs.size());
            mesh.uvs.push_back(upright_uv(at.x, at.y));
        }
    }
}

std::string without_places(const std::string& texture) {
    return fmt::format("its texture {} isn't shown: no face says which part of it is its own",
                       quote(texture));
}

/// The first picture that a material names.
std::string first_file(const MtlMaterial& m) {
    for (const MtlTexture* map : {&m.diffuse_map, &m.emission_map, &m.roughness_map})
        if (!map->file.empty()) return map->file;
    return m.metallic_map.file;
}

/// Gives the materials of a library the textures of a mesh, each picture once.
class LibraryTextures {
  public:
    LibraryTextures(const fs::path& name, Mesh& mesh)
        : name_(name), mesh_(mesh), maps_(name, mesh) {}

    /// The number of a material's texture, or kNoTexture.
    uint32_t of(const MtlMaterial& material) {
        const MtlTexture& map = material.diffuse_map;
        uint32_t colors = kNoTexture;
        if (!map.file.empty()) {
            const auto [entry, is_new] = known_.try_emplace({map.file, map.clamps}, kNoTexture);
            if (is_new)
                entry->second = append_texture(
                    name_, map.file, map.clamps ? TextureWrap::clamp : TextureWrap::repeat, mesh_);
            colors = entry->second;
        }
        return has_maps(material) ? with_maps(material, colors) : colors;
    }

  private:
    /// A texture with the material's maps, and the colours of another one, or white.
    uint32_t with_maps(const MtlMaterial& material, uint32_t colors) {
        Texture texture;
        if (colors != kNoTexture)
            texture = mesh_.textures[colors];
        else
            texture.image = std::make_shared<const TextureImage>(one_texel(255, 255, 255));
        maps_.add(material, texture);
        mesh_.textures.push_back(texture);
        return uint32_t(mesh_.textures.size() - 1);
    }

    const fs::path& name_;
    Mesh& mesh_;
    LibraryMaps maps_;
    std::map<std::pair<std::string, bool>, uint32_t> known_;
};

/// True for the names by which programs say that faces have no material.
bool names_no_material(const std::string& name) {
    return name.empty() || name == "None" || name == "Default" || name == "(null)";
}

void read_library_textures(const fs::path& name, Mesh& mesh) {
    const std::vector<MtlMaterial> library =
        read_material_libraries(name, mesh.material_libraries, mesh.library_faults);
    const size_t groups = std::max<size_t>(mesh.group_names.size(), 1);
    LibraryTextures textures(name, mesh);
    for (uint32_t group = 0; group < groups && group < mesh.group_names.size(); ++group) {
        const std::string& wanted = mesh.group_names[group];
        const auto material = std::ranges::find(library, wanted, &MtlMaterial::name);
        if (material == library.end()) {
            if (!names_no_material(wanted)) mesh.missing_materials.push_back(wanted);
            continue;
        }
        const MtlTexture& map = material->diffuse_map;
        if (map.file.empty() && !has_maps(*material)) continue;
        if (mesh.uvs.empty()) {
            mesh.notes.push_back(without_places(first_file(*material)));
            continue;
        }
        const uint32_t number = textures.of(*material);
        mesh.group_textures.resize(groups, kNoTexture);
        mesh.group_textures[group] = number;
        if (number != kNoTexture) move_uvs(mesh, group, map);
    }
}

void read_ply_texture(const fs::path& name, Mesh& mesh) {
    if (mesh.uvs.empty()) {
        if (mesh.vertex_colors.empty()) mesh.notes.push_back(without_places(mesh.texture));
        return;
    }
    mesh.group_textures = {append_texture(name, mesh.texture, TextureWrap::repeat, mesh)};
    if (mesh.textures.empty()) return;
    // Programs write into vertices what the texture has more of.
    mesh.vertex_colors = {};
    mesh.triangle_colors = {};
}

/// Whether a line has nothing but blanks before `at`.
bool begins_line(const std::string& text, size_t at) {
    while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t')) --at;
    return at == 0 || text[at - 1] == '\n';
}

/// The names that statements mtllib of an OBJ file have.
std::vector<std::string> library_names(const std::string& bytes) {
    constexpr std::string_view kWord = "mtllib";
    std::vector<std::string> names;
    for (size_t at = bytes.find(kWord); at != std::string::npos; at = bytes.find(kWord, at + 1)) {
        if (!begins_line(bytes, at)) continue;
        const size_t begin = bytes.find_first_not_of(" \t", at + kWord.size());
        const size_t end = std::min(bytes.find('\n', at), bytes.size());
        if (begin == std::string::npos || begin >= end || begin == at + kWord.size()) continue;
        const std::string name = bytes.substr(begin, end - begin);
        append_library(name.substr(0, name.find_last_not_of(" \t\r") + 1), names);
    }
    return names;
}

/// The name after the first "comment TextureFile" of a PLY file's header.
std::string ply_texture_name(const std::string& bytes) {
    constexpr std::string_view kMark = "comment TextureFile ";
    const size_t at = std::min(bytes.find(kMark), bytes.size());
    if (at >= std::min(bytes.find("end_header"), bytes.size())) return {};
    const size_t begin = at + kMark.size(), end = bytes.find_first_of("\r\n", begin);
    return bytes.substr(begin, end == std::string::npos ? end : end - begin);
}

}  // namespace

std::optional<Picture> companion_picture(const fs::path& mesh_file, const std::string& texture_file,
                                         Mesh& mesh) {
    const auto file = companion_file(mesh_file, texture_file);
    if (!file) {
        mesh.notes.push_back(
            fmt::format("its texture {} isn't in its folder", quote(texture_file)));
        return std::nullopt;
    }
    try {
        Picture picture = read_picture(*file);
        const uint64_t texels = uint64_t(picture.width) * uint64_t(picture.height);
        if (first_level_texels(mesh) + texels > kMaxMeshTexels) {
            mesh.notes.push_back(
                fmt::format("its texture {} isn't read: all textures of a mesh have at most 2^28 "
                            "texels",
                            quote(texture_file)));
            return std::nullopt;
        }
        return picture;
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input) throw;
        mesh.notes.push_back(fmt::format("its texture isn't read: {}", error.what()));
        return std::nullopt;
    }
}

uint32_t append_texture(const fs::path& mesh_file, const std::string& texture_file,
                        TextureWrap wrap, Mesh& mesh) {
    const std::optional<Picture> picture = companion_picture(mesh_file, texture_file, mesh);
    if (!picture) return kNoTexture;
    mesh.textures.push_back(
        {std::make_shared<const TextureImage>(with_levels(*picture)), wrap, wrap});
    return uint32_t(mesh.textures.size() - 1);
}

void read_textures(const fs::path& name, Mesh& mesh) {
    if (!mesh.texture.empty())
        read_ply_texture(name, mesh);
    else if (ending_of(name) == ".obj")
        read_library_textures(name, mesh);
    if (!mesh.textures.empty()) return;
    mesh.uvs = {};
    mesh.triangle_uvs = {};
    mesh.group_textures = {};
}

std::vector<fs::path> companion_files(const std::string& bytes, const fs::path& name) {
    std::vector<fs::path> files;
    const auto add = [&](const std::string& named) {
        if (const auto file = companion_file(name, named)) files.push_back(*file);
    };
    if (looks_like_ply(bytes)) {
        const std::string texture = ply_texture_name(bytes);
        if (!texture.empty()) add(texture);
    } else if (ending_of(name) == ".obj") {
        const std::vector<std::string> libraries = library_names(bytes);
        files = material_library_files(name, libraries);
        std::vector<std::string> faults;
        for (const MtlMaterial& material : read_material_libraries(name, libraries, faults))
            for (const MtlTexture* map : {&material.diffuse_map, &material.emission_map,
                                          &material.roughness_map, &material.metallic_map})
                if (!map->file.empty()) add(map->file);
    }
    return files;
}

}  // namespace voxelume
