// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/voxelize_textures.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "kernels/shared/texture.h"
#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

/// Areas of triangles in squares of the voxels' shortest edge.
class VoxelAreas {
  public:
    explicit VoxelAreas(const VoxelizeJob& job) : lattice_(job.triangles.vertices.read()) {
        const glm::vec4 scale = edge_scale(job.grid.frame);
        unit_ = glm::dvec3(scale) / double(kLatticePerVoxel);
    }

    double of(const glm::uvec3& t) const {
        const glm::dvec3 a = corner(t.x);
        return glm::length(glm::cross(corner(t.y) - a, corner(t.z) - a)) / 2;
    }

  private:
    glm::dvec3 corner(uint32_t vertex) const {
        const int32_t* const p = &lattice_[3 * size_t(vertex)];
        return glm::dvec3(p[0], p[1], p[2]) * unit_;
    }

    std::vector<int32_t> lattice_;
    glm::dvec3 unit_;
};

/// The share of a texture that a triangle covers; negative if a corner has no UV.
double uv_area(const Mesh& mesh, size_t triangle) {
    const glm::uvec3& t =
        mesh.triangle_uvs.empty() ? mesh.triangles[triangle] : mesh.triangle_uvs[triangle];
    if (std::max({t.x, t.y, t.z}) >= mesh.uvs.size()) return -1;
    const glm::dvec2 a(mesh.uvs[t.x]), u = glm::dvec2(mesh.uvs[t.y]) - a,
                                       v = glm::dvec2(mesh.uvs[t.z]) - a;
    return std::abs(u.x * v.y - u.y * v.x) / 2;
}

std::vector<uint32_t> words_of(const VoxelizeJob& job, const Mesh& mesh) {
    const VoxelAreas areas(job);
    std::vector<uint32_t> words(mesh.triangles.size(), VXL_NO_TEXTURE);
    for (size_t i = 0; i < words.size(); ++i) {
        const uint32_t group = mesh.triangle_group.empty() ? 0 : mesh.triangle_group[i];
        const uint32_t texture =
            group < mesh.group_textures.size() ? mesh.group_textures[group] : kNoTexture;
        const double area = uv_area(mesh, i);
        if (texture >= mesh.textures.size() || area < 0) continue;
        const TextureImage& image = *mesh.textures[texture].image;
        const uint32_t level = texture_level(area * image.width * image.height,
                                             areas.of(mesh.triangles[i]), level_count(image));
        words[i] = texture | level << VXL_TEXTURE_LEVEL_SHIFT;
    }
    return words;
}

}  // namespace

uint32_t texture_level(double texels, double voxels, int levels) {
    uint32_t level = 0;
    // A level has a quarter of the texels of the one before, so the geometric mean is a half.
    for (; int(level) + 1 < levels && texels > 2 * voxels; ++level) texels /= 4;
    return level;
}

DeviceTextures upload_textures(const VoxelizeJob& job, const Mesh& mesh) {
    DeviceTextures device;
    if (mesh.textures.empty()) return device;
    uint64_t count = 0;
    for (const Texture& texture : mesh.textures) count += texture.image->texels.size();
    if (count > UINT32_MAX || mesh.textures.size() > VXL_TEXTURE_MASK)
        throw Error(ErrorKind::limit, "the mesh has {} textures of {} texels, more than 2^32",
                    mesh.textures.size(), count);
    device.texels = Buffer<uint32_t>(job.device, kTexels, count);
    std::vector<uint32_t> records;
    uint32_t first = 0;
    for (const Texture& texture : mesh.textures) {
        const TextureImage& image = *texture.image;
        records.insert(records.end(), {first, uint32_t(image.width), uint32_t(image.height),
                                       uint32_t(texture.wrap_u) | uint32_t(texture.wrap_v)
                                                                      << VXL_TEXTURE_WRAP_V_SHIFT});
        device.texels.write(image.texels, first);
        first += uint32_t(image.texels.size());
    }
    device.records = Buffer<uint32_t>(job.device, "texture records", std::span(records));
    const std::vector<uint32_t> words = words_of(job, mesh);
    device.words = Buffer<uint32_t>(job.device, kTextureWords, std::span(words));
    return device;
}

}  // namespace voxelume
