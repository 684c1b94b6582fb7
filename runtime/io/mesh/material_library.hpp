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

/// A texture that a material names, with the options of the statement that count here.
struct MtlTexture {
    std::string file;  ///< as the library has it; empty: none
    bool clamps = false;
    glm::dvec2 offset{0}, scale{1};  ///< a place on the texture is `offset` + `scale` · (u, v)

    friend bool operator==(const MtlTexture&, const MtlTexture&) = default;
};

/// A material, with the values of the format, which has colours as screens show them (sRGB).
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

    /// True if it is described by roughness and metalness.
    bool is_physical() const {
        return roughness || metallic || !roughness_map.file.empty() || !metallic_map.file.empty();
    }
};

/// Reads the statements that MtlMaterial has. Others are skipped, and so are values that are no
/// numbers: a library never keeps a mesh from being read. At most 16,384 materials are read.
std::vector<MtlMaterial> parse_material_library(std::string_view text);

/// Adds what a statement mtllib names to what others did, unless one of them did, or it is empty.
/// At most 64 are kept.
void append_library(const std::string& name, std::vector<std::string>& names);

/// The materials of the libraries that the OBJ file `mesh` names. A name with spaces that is no
/// file is taken for several. `faults` gets a sentence for each that companion_file() doesn't find,
/// and for each above 64 MiB.
std::vector<MtlMaterial> read_material_libraries(const std::filesystem::path& mesh,
                                                 const std::vector<std::string>& names,
                                                 std::vector<std::string>& faults);

/// The files that read_material_libraries() reads.
std::vector<std::filesystem::path> material_library_files(const std::filesystem::path& mesh,
                                                          const std::vector<std::string>& names);

}  // namespace voxelume
