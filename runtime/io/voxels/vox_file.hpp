// SPDX-License-Identifier: Apache-2.0
// MagicaVoxel .vox -> the file's content without the voxels themselves.
//
// A file is a list of chunks: four letters, the bytes of its content and of chunks inside it, then
// both. Numbers are little-endian. Coordinates here are the file's: right-handed with Z up, a voxel
// is 1 long. An object stands so that the corner of voxel floor(size / 2) of its model lies on its
// translation, and rotations leave that corner where it is.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "runtime/io/voxels/vox_render.hpp"

namespace voxelume {

class InputFile;

/// A signed permutation of axes, one of 48: row r of the result is sign[r] * v[axis[r]].
struct VoxRotation {
    std::array<int, 3> axis{0, 1, 2};
    std::array<int, 3> sign{1, 1, 1};

    glm::ivec3 operator*(const glm::ivec3& v) const;
    VoxRotation operator*(const VoxRotation& inner) const;
    bool is_mirrored() const;
    friend bool operator==(const VoxRotation&, const VoxRotation&) = default;
};

struct VoxModel {
    glm::ivec3 size{0};      ///< 0..256 voxels
    uint64_t voxels_at = 0;  ///< of the first voxel in the file: x, y, z and palette index, a byte
                             ///< each
    uint32_t voxels = 0;
};

enum class VoxMaterialKind : uint8_t { diffuse, metal, glass, emit, blend, media };

/// A palette entry's material. Values are those of MagicaVoxel.
struct VoxMaterial {
    VoxMaterialKind kind = VoxMaterialKind::diffuse;
    float weight = 1;    ///< 0..1: weight of the kind
    float metal = 0;     ///< 0..1, of a blend
    float rough = 0.1f;  ///< 0..1
    float specular = 1;
    float ior = 1.3f;
    float density = 0;         ///< density of the medium inside
    float flux = 0;            ///< exponent of emission: light is (1 + flux)² times as strong
    bool is_flux_cut = false;  ///< the file's value exceeds kMaxFlux
    bool absorbs = true;       ///< for media; false: they scatter or emit light
};

/// A limit above the values of MagicaVoxel.
inline constexpr float kMaxFlux = 8;

/// The placement of an object from a frame on.
struct VoxPose {
    int frame = 0;
    VoxRotation rotation;
    glm::ivec3 translation{0};

    friend bool operator==(const VoxPose&, const VoxPose&) = default;
};

/// The model that an object shows from a frame on.
struct VoxShown {
    int frame = 0;
    int model = 0;  ///< index into VoxFile::models

    friend bool operator==(const VoxShown&, const VoxShown&) = default;
};

/// A model with its placement: a leaf of the scene graph, after all transforms above it.
struct VoxObject {
    std::string name;             ///< the object's own or the nearest one above; may be empty
    bool hidden = false;          ///< the object, a group above it or a layer of them is hidden
    std::vector<VoxPose> poses;   ///< by frame; at least one, the first for frame 0
    std::vector<VoxShown> shown;  ///< by frame; at least one, the first for frame 0
};

struct VoxFile {
    std::filesystem::path path;
    uint32_t version = 0;
    std::vector<VoxModel> models;
    std::vector<VoxObject> objects;
    /// 0xAABBGGRR in sRGB, by palette index; index 0 is an empty cell.
    std::array<uint32_t, 256> palette{};
    bool has_palette = false;  ///< false: MagicaVoxel's default palette
    std::array<VoxMaterial, 256> materials;
    int frames = 1;  ///< frames of the animation
    int layers = 0, hidden_layers = 0;
    std::vector<VoxCamera> cameras;
    VoxRender render;
    std::map<std::string, int> not_read;  ///< numbers of unread chunks, by their letters
};

/// Reads all but the voxels. Throws Error::input for a file that is damaged, truncated, of another
/// format, or beyond the limits.
VoxFile read_vox_file(const std::filesystem::path& path);

/// MagicaVoxel's palette for files without one.
const std::array<uint32_t, 256>& default_vox_palette();

/// "glass 12": the name of a palette entry's material; empty for a diffuse one.
std::string material_name(const VoxFile& file, int entry);

const char* name_of(VoxMaterialKind kind);

}  // namespace voxelume
