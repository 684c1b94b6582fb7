// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/mesh_textures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/image/picture.hpp"
#include "runtime/io/image_codec/image_codec.hpp"
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

/// Gives the corners of a group's triangles UVs of their own: `offset` + `scale` · the old UVs,
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

std::string without_uvs(const std::string& texture) {
    return fmt::format("its texture {} isn't shown: no face says which part of it is its own",
                       quote(texture));
}

/// The first picture of a material.
std::string first_file(const MtlMaterial& m) {
    for (const MtlTexture* map :
         {&m.diffuse_map, &m.opacity_map, &m.emission_map, &m.roughness_map})
        if (!map->file.empty()) return map->file;
    return m.metallic_map.file;
}

/// The material with the options of map_d for its colours, too, where it has no picture of colours:
/// the UVs of all its textures follow from the colours' UVs.
MtlMaterial with_base(MtlMaterial m) {
    if (!m.diffuse_map.file.empty()) return m;
    m.diffuse_map = m.opacity_map;
    m.diffuse_map.file.clear();
    return m;
}

/// Gives the materials of a library the textures of a mesh, each picture once.
class LibraryTextures {
  public:
    LibraryTextures(const fs::path& name, Mesh& mesh)
        : name_(name), mesh_(mesh), maps_(name, mesh) {}

    /// The number of a material's texture, or kNoTexture.
    uint32_t of(const MtlMaterial& material) {
        const MtlTexture& map = material.diffuse_map;
        const std::string cover = cover_of(material);
        uint32_t colors = kNoTexture;
        if (!map.file.empty() || !cover.empty()) {
            const auto [entry, is_new] =
                known_.try_emplace({map.file, cover, map.clamps}, kNoTexture);
            if (is_new) entry->second = append_colors(map, cover);
            colors = entry->second;
        }
        if (colors != kNoTexture) note_missing_alpha(material, mesh_.textures[colors]);
        return has_maps(material) ? with_maps(material, colors) : colors;
    }

  private:
    /// The picture of the material's opacity, apart from the alpha of its colours.
    std::string cover_of(const MtlMaterial& material) {
        const MtlTexture &map = material.diffuse_map, &cover = material.opacity_map;
        const bool is_plain = cover == MtlTexture{cover.file};
        if (cover.file.empty() || (cover.file == map.file && is_plain)) return "";
        if (cover.offset == map.offset && cover.scale == map.scale && cover.clamps == map.clamps)
            return cover.file == map.file ? "" : cover.file;
        note(
            fmt::format("its texture {} isn't shown as map_d says, which has other options than "
                        "map_Kd",
                        quote(cover.file)));
        return "";
    }

    /// Adds a note once, even if several materials need it.
    void note(const std::string& sentence) {
        if (std::ranges::find(mesh_.notes, sentence) == mesh_.notes.end())
            mesh_.notes.push_back(sentence);
    }

    void note_missing_alpha(const MtlMaterial& material, const Texture& texture) {
        const std::string& file = material.opacity_map.file;
        if (file.empty() || file != material.diffuse_map.file || texture.alpha != kAlphaOpaque)
            return;
        note(fmt::format("its texture {} shows no opacity, as map_d wants: it has no alpha",
                         quote(file)));
    }

    /// Appends a texture of colours, white without a file, with an opacity.
    uint32_t append_colors(const MtlTexture& map, const std::string& cover) {
        std::optional<Picture> colors, share;
        if (!map.file.empty()) colors = companion_picture(name_, map.file, mesh_);
        if (!cover.empty()) share = companion_picture(name_, cover, mesh_);
        if (share) colors = covered_by(*share, colors);
        if (!colors) return kNoTexture;
        const TextureWrap wrap = map.clamps ? TextureWrap::clamp : TextureWrap::repeat;
        const uint32_t alpha = lets_through(*colors) ? kAlphaBlend : kAlphaOpaque;
        mesh_.textures.push_back(
            {std::make_shared<const TextureImage>(with_levels(*colors)), wrap, wrap, alpha});
        return uint32_t(mesh_.textures.size() - 1);
    }

    /// A texture with the material's maps, and with the colours of another texture, or white.
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
    /// By the files of colours and of opacity, and by clamping.
    std::map<std::tuple<std::string, std::string, bool>, uint32_t> known_;
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
        const auto found = std::ranges::find(library, wanted, &MtlMaterial::name);
        if (found == library.end()) {
            if (!names_no_material(wanted)) mesh.missing_materials.push_back(wanted);
            continue;
        }
        if (first_file(*found).empty()) continue;
        if (mesh.uvs.empty()) {
            mesh.notes.push_back(without_uvs(first_file(*found)));
            continue;
        }
        const MtlMaterial material = with_base(*found);
        const uint32_t number = textures.of(material);
        mesh.group_textures.resize(groups, kNoTexture);
        mesh.group_textures[group] = number;
        if (number != kNoTexture) move_uvs(mesh, group, material.diffuse_map);
    }
}

void read_ply_texture(const fs::path& name, Mesh& mesh) {
    if (mesh.uvs.empty()) {
        if (mesh.vertex_colors.empty()) mesh.notes.push_back(without_uvs(mesh.texture));
        return;
    }
    mesh.group_textures = {append_texture(name, mesh.texture, TextureWrap::repeat, mesh)};
    if (mesh.textures.empty()) return;
    // Programs store the texture's colours in vertices, too; the texture has more of them.
    mesh.vertex_colors = {};
    mesh.triangle_colors = {};
}

/// True if a line has nothing but blanks before `at`.
bool begins_line(const std::string& text, size_t at) {
    while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t')) --at;
    return at == 0 || text[at - 1] == '\n';
}

/// The names in an OBJ file's statements mtllib.
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
    } catch (const ImageDecoderError&) {
        throw;  // the picture may be whole
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
            for (const MtlTexture* map :
                 {&material.diffuse_map, &material.opacity_map, &material.emission_map,
                  &material.roughness_map, &material.metallic_map})
                if (!map->file.empty()) add(map->file);
    }
    return files;
}

}  // namespace voxelume
