// SPDX-License-Identifier: Apache-2.0
// Volumetric image -> KV6, the voxel models of Voxlap, Slab6 and displays that read them.
//
// The file is little-endian: "Kvxl", the three sizes (i32), the pivot in voxels (f32), the number
// of voxels (i32); for each voxel blue, green, red, 128, z (u16), the visible faces and the index
// of the normal; then the number of voxels of each x (u32) and of each x, y (u16). x is image right
// (-X_E), y points towards the observer (-Z_E), z points down (-Y_E).
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/volume/volume_formats.hpp"

namespace voxelume {

namespace {

struct Kv6Voxel {
    uint8_t blue, green, red, alpha;
    uint16_t z;
    uint8_t faces;   ///< bits of the visible faces: x-, x+, y-, y+, z-, z+
    uint8_t normal;  ///< index in the spiral of 255 directions, 255 for none
};
static_assert(sizeof(Kv6Voxel) == 8);

/// The voxels of at least half opacity, in KV6's axes.
class SolidCells {
  public:
    explicit SolidCells(const Volume& volume)
        : size_(volume.frame.size.x, volume.frame.size.z, volume.frame.size.y),
          bits_(size_t(voxel_count(volume.frame))) {
        for (size_t i = 0; i < volume.indices.size(); ++i)
            if (volume.opacities[i] >= 0.5f)
                bits_[index(from_volume(cell_of(volume.frame, volume.indices[i])))] = true;
    }
    const glm::ivec3& size() const { return size_; }
    glm::ivec3 from_volume(const glm::ivec3& cell) const {
        return {size_.x - 1 - cell.x, size_.y - 1 - cell.z, size_.z - 1 - cell.y};
    }
    bool has(const glm::ivec3& cell) const {
        for (int axis = 0; axis < 3; ++axis)
            if (cell[axis] < 0 || cell[axis] >= size_[axis]) return false;
        return bits_[index(cell)];
    }
    uint8_t faces_of(const glm::ivec3& cell) const {
        int faces = 0;
        for (int face = 0; face < 6; ++face) {
            glm::ivec3 neighbour = cell;
            neighbour[face / 2] += face % 2 == 0 ? -1 : 1;
            if (!has(neighbour)) faces |= 1 << face;
        }
        return uint8_t(faces);
    }
    /// A vector that points away from the solid voxels of the 5 x 5 x 5 around a cell; not a unit
    /// vector.
    glm::vec3 normal_of(const glm::ivec3& cell) const {
        glm::vec3 normal(0);
        for (int z = -2; z <= 2; ++z)
            for (int y = -2; y <= 2; ++y)
                for (int x = -2; x <= 2; ++x)
                    if (has(cell + glm::ivec3(x, y, z))) normal -= glm::vec3(x, y, z);
        return normal;
    }

  private:
    size_t index(const glm::ivec3& cell) const {
        return size_t(cell.x) +
               size_t(size_.x) * (size_t(cell.y) + size_t(size_.y) * size_t(cell.z));
    }

    glm::ivec3 size_;
    std::vector<bool> bits_;
};

/// Voxlap's 255 directions: even steps in z, the golden angle around z.
const std::array<glm::vec3, 255>& directions() {
    static const std::array<glm::vec3, 255> table = [] {
        std::array<glm::vec3, 255> list;
        constexpr double kGoldenTurn = 0.3819660112501052 * 2 * 3.141592653589793;
        for (size_t i = 0; i < list.size(); ++i) {
            const double z = double(2 * i + 1) / 255 - 1, r = std::sqrt(1 - z * z);
            list[i] = {r * std::cos(double(i) * kGoldenTurn), r * std::sin(double(i) * kGoldenTurn),
                       z};
        }
        return list;
    }();
    return table;
}

uint8_t normal_number(const glm::vec3& normal) {
    if (normal == glm::vec3(0)) return 255;
    const auto along = [&](const glm::vec3& direction) { return glm::dot(direction, normal); };
    return uint8_t(std::ranges::max_element(directions(), {}, along) - directions().begin());
}

/// A voxel and its cell, to be sorted by x, y, z.
struct PlacedVoxel {
    glm::ivec3 cell;
    Kv6Voxel voxel;
};

std::vector<PlacedVoxel> surface_voxels(const Volume& volume, float exposure) {
    const SolidCells solid(volume);
    const float gain = std::exp2(exposure);
    std::vector<PlacedVoxel> voxels;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        if (volume.opacities[i] < 0.5f) continue;
        const glm::ivec3 cell = solid.from_volume(cell_of(volume.frame, volume.indices[i]));
        const uint8_t faces = solid.faces_of(cell);
        if (faces == 0) continue;
        const glm::vec3 color = volume.colors[i] * gain;
        voxels.push_back({cell,
                          {srgb_code(color.b), srgb_code(color.g), srgb_code(color.r), 128,
                           uint16_t(cell.z), faces, normal_number(solid.normal_of(cell))}});
    }
    std::ranges::sort(voxels, {}, [](const PlacedVoxel& v) {
        return std::array{v.cell.x, v.cell.y, v.cell.z};
    });
    return voxels;
}

}  // namespace

void write_volume_kv6(const VolumePath& path, const Volume& volume, const DeviceOptions& options) {
    AtomicFile file(path);
    const std::vector<PlacedVoxel> voxels = surface_voxels(volume, options.exposure);
    const glm::ivec3 size(volume.frame.size.x, volume.frame.size.z, volume.frame.size.y);
    std::vector<uint32_t> of_x(size_t(size.x));
    std::vector<uint16_t> of_xy(size_t(size.x) * size_t(size.y));
    std::vector<Kv6Voxel> records;
    for (const auto& [cell, voxel] : voxels) {
        ++of_x[size_t(cell.x)];
        ++of_xy[size_t(cell.x) * size_t(size.y) + size_t(cell.y)];
        records.push_back(voxel);
    }
    const glm::vec3 pivot = glm::vec3(size) * 0.5f;
    const auto count = int32_t(records.size());
    file.write("Kvxl", 4);
    file.write(&size, sizeof size);
    file.write(&pivot, sizeof pivot);
    file.write(&count, sizeof count);
    file.write(records.data(), records.size() * sizeof records[0]);
    file.write(of_x.data(), of_x.size() * sizeof of_x[0]);
    file.write(of_xy.data(), of_xy.size() * sizeof of_xy[0]);
    file.commit();
}

}  // namespace voxelume
