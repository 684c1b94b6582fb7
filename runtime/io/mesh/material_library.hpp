// SPDX-License-Identifier: Apache-2.0
// The material library that an OBJ file names (Wavefront MTL).
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

/// A texture of a material, with the options that are supported.
struct MtlTexture {
    std::string file;  ///< name in the library; empty: none
    bool clamps = false;
    glm::dvec2 offset{0}, scale{1};  ///< UV on the texture: `offset` + `scale` · (u, v)

    friend bool operator==(const MtlTexture&, const MtlTexture&) = default;
};

/// A material with the values of the format. Colours are sRGB.
struct MtlMaterial {
    std::string name;
    glm::dvec3 diffuse{0.8}, specular{0}, emission{0};  ///< Kd, Ks, Ke
    double exponent = 0;                                ///< Ns
    double opacity = 1;                                 ///< d, or 1 - Tr
    double ior = 1;                                     ///< Ni
    int illumination = 2;                               ///< illum
    std::optional<double> roughness, metallic;          ///< Pr, Pm
    MtlTexture diffuse_map;                             ///< map_Kd
    MtlTexture emission_map;                            ///< map_Ke
    MtlTexture roughness_map, metallic_map;             ///< map_Pr, map_Pm
    MtlTexture opacity_map;                             ///< map_d
    bool has_bumps = false;                             ///< map_Bump, norm, disp: not shown
    bool has_specular_maps = false;                     ///< map_Ks, map_Ns: not shown

    /// True if the material has a roughness or metalness.
    bool is_physical() const {
        return roughness || metallic || !roughness_map.file.empty() || !metallic_map.file.empty();
    }
};

/// Reads the statements that MtlMaterial has. Other statements are skipped, and so are values that
/// aren't numbers, so that a library never keeps a mesh from being read. At most 16,384 materials
/// are read.
std::vector<MtlMaterial> parse_material_library(std::string_view text);

/// Adds the name in a statement mtllib, unless it is empty or known. At most 64 names are kept.
void append_library(const std::string& name, std::vector<std::string>& names);

/// The materials of the libraries of the OBJ file `mesh`. A name with spaces that isn't a file is
/// split into several names. `faults` gets a sentence for each library that companion_file()
/// doesn't find, and for each above 64 MiB.
std::vector<MtlMaterial> read_material_libraries(const std::filesystem::path& mesh,
                                                 const std::vector<std::string>& names,
                                                 std::vector<std::string>& faults);

/// The files that read_material_libraries() reads.
std::vector<std::filesystem::path> material_library_files(const std::filesystem::path& mesh,
                                                          const std::vector<std::string>& names);

}  // namespace voxelume
