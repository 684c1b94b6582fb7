// SPDX-License-Identifier: Apache-2.0
// Parts that tests of MagicaVoxel files share: an oracle that follows voxels' middles through the
// file's matrices, and the voxels that a scene of a file shows.
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/voxel_cells.hpp"
#include "tests/support/writers/vox_writer.hpp"

namespace voxelume {

inline std::array<uint32_t, 256> odd_palette() {
    std::array<uint32_t, 256> colors{};
    for (uint32_t i = 1; i < 256; ++i)
        colors[i] = 0xFF000000 | (i * 37 & 255) << 16 | (255 - i) << 8 | (i * 91 & 255);
    return colors;
}

/// A model of 7 x 4 x 3 without any symmetry.
struct VoxSample {
    std::array<int, 3> size{7, 4, 3};
    std::vector<VoxWriter::Voxel> voxels = {{0, 0, 0, 1},  {6, 0, 0, 2}, {6, 3, 0, 3},
                                            {6, 3, 2, 4},  {2, 1, 1, 5}, {3, 1, 2, 77},
                                            {0, 3, 1, 255}};
};

/// The map of a transform with this rotation byte, as the format defines it: bits 0-1 and 2-3 are
/// the columns of the entries in the first two rows, and bits 4 to 6 are the signs of all three.
inline glm::dmat4 oracle_matrix(int byte, const glm::dvec3& translation) {
    const int first = byte & 3, second = byte >> 2 & 3;
    int third = 0;
    while (third == first || third == second) ++third;
    glm::dmat4 m(0);
    m[first][0] = byte & 16 ? -1 : 1;
    m[second][1] = byte & 32 ? -1 : 1;
    m[third][2] = byte & 64 ? -1 : 1;
    m[3] = {translation, 1};
    return m;
}

/// Adds a sample's voxels after a map, with Y up. Voxels that already exist stay.
inline void add_oracle(const VoxSample& sample, const glm::dmat4& map,
                       const std::array<uint32_t, 256>& colors, VoxelCells& cells) {
    const glm::dvec3 pivot(sample.size[0] / 2, sample.size[1] / 2, sample.size[2] / 2);
    for (const VoxWriter::Voxel& v : sample.voxels) {
        const glm::dvec3 middle(v[0] + 0.5, v[1] + 0.5, v[2] + 0.5);
        const glm::dvec3 p(map * glm::dvec4(middle - pivot, 1));
        const std::array<int, 3> cell = {int(std::floor(p.x)), int(std::floor(p.z)),
                                         int(std::floor(-p.y))};
        cells.try_emplace(cell, ShownVoxel{colors[v[3]] & 0xFFFFFF, ""});
    }
}

/// All bytes that are rotations, including mirrored ones.
inline std::vector<int> all_rotations() {
    std::vector<int> bytes;
    for (int byte = 0; byte < 128; ++byte) {
        const int first = byte & 3, second = byte >> 2 & 3;
        if (first < 3 && second < 3 && first != second) bytes.push_back(byte);
    }
    return bytes;
}

inline std::string text_of(const glm::dvec3& t) {
    return fmt::format("{} {} {}", int(t.x), int(t.y), int(t.z));
}

/// A test that writes a MagicaVoxel file.
class VoxFileTest : public FileTest {
  protected:
    std::filesystem::path put(const std::string& bytes) const {
        put_bytes(folder / "a.vox", bytes);
        return folder / "a.vox";
    }

    Scene scene_of(const std::filesystem::path& file, AssetStore& assets,
                   const ImportOptions& options = {}) const {
        const std::string text = scene_of_file(file, "a.vox", options, assets);
        return parse_scene(text, file, {}, [&](const Model& model, bool keeps) {
            return assets.box_of_file(model, keeps);
        });
    }

    /// The cells of all visible objects of the scene of a file, by their models' voxels and maps.
    VoxelCells shown_cells(const std::filesystem::path& file) const {
        AssetStore assets;
        const Scene scene = scene_of(file, assets);
        VoxelCells cells;
        for (const Object& object : scene.objects) {
            const Model& model = scene.models[size_t(object.model)];
            if (model.solid || !object.visible) continue;
            for (const auto& [cell, shown] : cells_of(assets.voxels(model))) {
                const glm::dvec4 middle(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5, 1);
                const glm::dvec3 p(object.world_from_object * middle);
                cells.try_emplace(
                    {int(std::floor(p.x)), int(std::floor(p.y)), int(std::floor(p.z))}, shown);
            }
        }
        return cells;
    }
};

}  // namespace voxelume
