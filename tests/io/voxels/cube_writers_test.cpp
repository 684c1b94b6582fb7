// SPDX-License-Identifier: Apache-2.0
// Written files of voxels are read back equal; what a format can't hold is said.
#include <gmock/gmock.h>

#include <random>
#include <set>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/voxel_art/median_cut.hpp"
#include "runtime/io/voxel_output_table.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/voxel_cells.hpp"

namespace voxelume {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class CubeWritersTest : public FileTest {
  protected:
    /// The voxels that a file has, in the smallest box around them.
    VoxelCells read_back(const std::string& name) {
        VoxelModel model = read_voxel_model(folder / name, Surface::cubes);
        edge = model.frame.voxel_edge;
        const CubeList cubes = cube_list(model);
        origin = cubes.origin;
        return cells_in_list(cubes);
    }
    static VoxelCells cells_in_list(const CubeList& cubes) {
        VoxelCells cells;
        for (size_t i = 0; i < cubes.cells.size(); ++i) {
            const glm::ivec3& c = cubes.cells[i];
            cells[{c.x, c.y, c.z}] = {cubes.colors.empty() ? 0xFFFFFF : cubes.colors[i], ""};
        }
        return cells;
    }
    std::string write(const CubeList& cubes, const std::string& name) {
        const WriterNotes notes = check_voxel_output(folder / name).write(folder / name, cubes);
        std::string all;
        for (const std::string& note : notes) all += note + "\n";
        return all;
    }

    glm::dvec3 edge{0}, origin{0};
};

/// Voxels in 70 x 33 x 20, some of them at each end of the box, in `colors` different colours.
CubeList odd_cubes(size_t count, uint32_t colors) {
    std::mt19937 random(11);
    std::set<std::array<int, 3>> places = {{0, 7, 3}, {69, 0, 5}, {4, 32, 0}, {9, 9, 19}};
    while (places.size() < count)
        places.insert({int(random() % 70), int(random() % 33), int(random() % 20)});
    CubeList cubes;
    cubes.size = {70, 33, 20};
    cubes.origin = {1.5, -20, 4};
    cubes.voxel_edge = glm::dvec3(0.25);
    for (const auto& [x, y, z] : places) {
        cubes.cells.emplace_back(x, y, z);
        if (colors > 0)
            cubes.colors.push_back((uint32_t(random() % colors) * 0x010307 + 0x000102) & 0xFFFFFF);
    }
    return cubes;
}

TEST_F(CubeWritersTest, NumpyAndNrrdKeepEverything) {
    for (const uint32_t colors : {0u, 7u, 5000u}) {
        CubeList cubes = odd_cubes(3000, colors);
        if (colors > 0) cubes.colors[5] |= 0x80000000u;  // half clear
        for (const char* name : {"a.npy", "a.nrrd"}) {
            EXPECT_THAT(write(cubes, name), IsEmpty());
            EXPECT_EQ(read_back(name), cells_in_list(cubes)) << name << colors;
        }
        EXPECT_EQ(edge, glm::dvec3(0.25));
        EXPECT_EQ(origin, cubes.origin);
    }
}

TEST_F(CubeWritersTest, BinvoxKeepsPlacesAndLosesColours) {
    CubeList cubes = odd_cubes(2000, 9);
    EXPECT_THAT(write(cubes, "a.binvox"), HasSubstr("no colours"));
    cubes.colors.clear();
    EXPECT_EQ(read_back("a.binvox"), cells_in_list(cubes));
    EXPECT_EQ(edge, glm::dvec3(0.25));
    EXPECT_EQ(origin, cubes.origin);
    EXPECT_THAT(write(cubes, "b.binvox"), IsEmpty());
    cubes.size.z = 1291;  // 1291^3 is more than 2^31
    EXPECT_THAT(error_of([&] { write(cubes, "c.binvox"); }).what(),
                HasSubstr("1291 x 1291 x 1291"));
}

TEST_F(CubeWritersTest, Kv6KeepsTheVoxelsOfTheSurface) {
    CubeList cubes = odd_cubes(400, 50);
    EXPECT_THAT(write(cubes, "a.kv6"), HasSubstr("surfaces alone"));
    EXPECT_EQ(read_back("a.kv6"), cells_in_list(cubes));
    // A block of 5 x 4 x 3: what is inside is left out.
    CubeList block;
    block.size = {5, 4, 3};
    VoxelCells shell;
    for (int i = 0; i < 60; ++i) {
        const glm::ivec3 c(i % 5, i / 5 % 4, i / 20);
        block.cells.push_back(c);
        if (c.x % 4 == 0 || c.y % 3 == 0 || c.z % 2 == 0) shell[{c.x, c.y, c.z}] = {0xFFFFFF, ""};
    }
    write(block, "b.kv6");
    EXPECT_EQ(read_back("b.kv6"), shell);
}

TEST_F(CubeWritersTest, MagicaVoxelKeepsUpTo255Colours) {
    for (const uint32_t colors : {0u, 1u, 255u}) {
        const CubeList cubes = odd_cubes(4000, colors);
        EXPECT_THAT(write(cubes, "a.vox"), IsEmpty());
        EXPECT_EQ(read_back("a.vox"), cells_in_list(cubes)) << colors;
    }
    const CubeList many = odd_cubes(4000, 2000);
    EXPECT_THAT(write(many, "b.vox"), HasSubstr("colours became 255 by median cut"));
    const VoxelCells found = read_back("b.vox"), given = cells_in_list(many);
    ASSERT_EQ(found.size(), given.size());
    double sum = 0;
    for (const auto& [at, shown] : given) {
        ASSERT_TRUE(found.contains(at));
        for (int c = 0; c < 3; ++c)
            sum +=
                std::abs(int(shown.color >> 8 * c & 255) - int(found.at(at).color >> 8 * c & 255));
    }
    EXPECT_LT(sum / double(3 * given.size()), 12);
}

/// A material of a kind, whose values tell it from others.
CubeMaterial material_of(VoxMaterialKind kind, float value) {
    CubeMaterial material;
    material.vox = {kind, value, 0, value / 2, 0.25F, 1 + value, value / 4, 0};
    if (kind == VoxMaterialKind::emit) material.vox.flux = 3 * value;
    if (kind == VoxMaterialKind::media) material.vox.weight = 1;
    if (kind == VoxMaterialKind::blend || kind == VoxMaterialKind::metal)
        material.vox.metal = kind == VoxMaterialKind::metal ? value : value / 3;
    return material;
}

TEST_F(CubeWritersTest, MagicaVoxelKeepsMaterials) {
    CubeList cubes = odd_cubes(4000, 8);
    for (const VoxMaterialKind kind :
         {VoxMaterialKind::diffuse, VoxMaterialKind::metal, VoxMaterialKind::glass,
          VoxMaterialKind::emit, VoxMaterialKind::blend, VoxMaterialKind::media})
        cubes.materials.push_back(material_of(kind, 0.375F + 0.0625F * float(kind)));
    cubes.materials[3].color = 0x123456;
    for (size_t i = 0; i < cubes.cells.size(); ++i)
        cubes.material_numbers.push_back(uint16_t(cubes.cells[i].x % 6));
    EXPECT_THAT(write(cubes, "a.vox"), IsEmpty());
    const VoxFile file = read_vox_file(folder / "a.vox");
    ASSERT_EQ(file.models.size(), 1u);
    std::map<std::array<int, 3>, int> entries;
    const VoxelModel model = read_voxel_model(folder / "a.vox", Surface::cubes);
    std::set<int> kinds;
    for (size_t entry = 1; entry < 256; ++entry) {
        const VoxMaterial& found = file.materials[entry];
        if (found.kind == VoxMaterialKind::diffuse) continue;
        kinds.insert(int(found.kind));
        const VoxMaterial& given = cubes.materials[size_t(found.kind)].vox;
        EXPECT_EQ(found.weight, given.weight) << entry;
        EXPECT_EQ(found.metal, given.metal) << entry;
        EXPECT_EQ(found.rough, given.rough) << entry;
        EXPECT_EQ(found.specular, given.specular) << entry;
        EXPECT_EQ(found.ior, given.ior) << entry;
        EXPECT_EQ(found.density, given.density) << entry;
        EXPECT_EQ(found.flux, given.flux) << entry;
        if (found.kind == VoxMaterialKind::emit) {
            EXPECT_EQ(file.palette[entry] & 0xFFFFFF, 0x123456u);
        }
    }
    EXPECT_EQ(kinds, (std::set<int>{1, 2, 3, 4, 5}));
    // Voxel by voxel, the kind is that of its column.
    std::map<std::array<int, 3>, std::string> shown;
    for (const auto& [at, cell] : cells_of(model)) shown[at] = cell.group;
    ASSERT_EQ(shown.size(), cubes.cells.size());
    const std::array kNames = {"", "metal", "glass", "emit", "blend", "media"};
    for (const glm::ivec3& c : cubes.cells) {
        const std::string kind = kNames[size_t(c.x % 6)];
        EXPECT_EQ(shown.at({c.x, c.y, c.z}).substr(0, kind.size()), kind);
    }
}

TEST_F(CubeWritersTest, LightThatAMaterialCantHaveIsNoted) {
    CubeList cubes = odd_cubes(100, 4);
    cubes.materials = {{}, material_of(VoxMaterialKind::emit, 1)};
    cubes.materials[1].vox.flux = kMaxFlux;
    cubes.materials[1].vox.is_flux_cut = true;
    cubes.material_numbers.assign(cubes.cells.size(), 0);
    EXPECT_THAT(write(cubes, "a.vox"), IsEmpty()) << "no voxel has it";
    cubes.material_numbers[7] = 1;
    EXPECT_THAT(write(cubes, "a.vox"), HasSubstr("emission above 81 became 81"));
}

TEST_F(CubeWritersTest, MagicaVoxelSharesItsColoursAmongMaterials) {
    CubeList cubes = odd_cubes(4000, 2000);
    cubes.materials = {
        {}, material_of(VoxMaterialKind::metal, 0.5F), material_of(VoxMaterialKind::glass, 0.5F)};
    for (const glm::ivec3& c : cubes.cells)
        cubes.material_numbers.push_back(uint16_t(c.x == 9 ? 2 : c.x % 2));
    EXPECT_THAT(write(cubes, "a.vox"), HasSubstr("by median cut"));
    const VoxFile file = read_vox_file(folder / "a.vox");
    std::array<int, 6> entries{};
    for (size_t entry = 1; entry < 256; ++entry) ++entries[size_t(file.materials[entry].kind)];
    EXPECT_GT(entries[1], 100);
    EXPECT_GE(entries[2], 1);
}

TEST_F(CubeWritersTest, MagicaVoxelHasNoMoreMaterialsThanColours) {
    CubeList cubes = odd_cubes(4000, 8);
    cubes.materials.assign(300, {});
    for (size_t i = 0; i < cubes.cells.size(); ++i)
        cubes.material_numbers.push_back(uint16_t(i % 300));
    EXPECT_THAT(write(cubes, "a.vox"), IsEmpty()) << "plain ones are one";
    cubes.materials.assign(300, material_of(VoxMaterialKind::glass, 0.5F));
    EXPECT_THAT(write(cubes, "b.vox"), HasSubstr("became plain colours, since there are more"));
    EXPECT_EQ(read_back("b.vox"), read_back("a.vox"));
}

TEST_F(CubeWritersTest, MagicaVoxelHasPartsOf256) {
    CubeList cubes;
    cubes.size = {600, 300, 257};
    std::mt19937 random(3);
    std::set<std::array<int, 3>> places = {{0, 0, 0},   {599, 299, 256}, {255, 0, 0},
                                           {256, 0, 0}, {0, 256, 255},   {511, 255, 256}};
    while (places.size() < 3000)
        places.insert({int(random() % 600), int(random() % 300), int(random() % 257)});
    for (const auto& [x, y, z] : places) {
        cubes.cells.emplace_back(x, y, z);
        cubes.colors.push_back(uint32_t(x * 7 + y) % 200 * 0x10101);
    }
    EXPECT_THAT(write(cubes, "a.vox"), HasSubstr(" models of 256 voxels a side"));
    EXPECT_EQ(read_back("a.vox"), cells_in_list(cubes));
}

TEST_F(CubeWritersTest, MedianCutKeepsFewColoursAndCutsWhereVoxelsAre) {
    EXPECT_EQ(median_cut({{5, 1}, {0xFF, 9}}, 2).colors, (std::vector<uint32_t>{5, 0xFF}));
    // Red 0, 10 and 200 with 5, 5 and 10 voxels: the cut lies after half of the voxels.
    const Palette two = median_cut({{0, 5}, {10, 5}, {200, 10}}, 2);
    EXPECT_EQ(two.colors, (std::vector<uint32_t>{5, 200}));
    EXPECT_EQ(two.numbers.at(0), two.numbers.at(10));
    EXPECT_EQ(median_cut({{0, 1}, {0x0A0000, 3}}, 1).colors, (std::vector<uint32_t>{0x080000}));
}

TEST_F(CubeWritersTest, FullBricksAreWrittenVoxelByVoxel) {
    VoxelModel model;
    model.frame.size = {16, 16, 16};  // two bricks along each axis
    model.slots.assign(8, kBrickOutside);
    model.slots[1] = kBrickInside;
    const CubeList cubes = cube_list(model);
    EXPECT_EQ(cubes.cells.size(), 4096u);
    EXPECT_EQ(cubes.size, glm::ivec3(16));
    EXPECT_EQ(cubes.origin, glm::dvec3(16, 0, 0));
    write(cubes, "a.npy");
    EXPECT_EQ(read_back("a.npy").size(), 4096u);
    model.slots[1] = kBrickOutside;
    EXPECT_THAT(error_of([&] { cube_list(model); }).what(), HasSubstr("no voxels"));
}

TEST_F(CubeWritersTest, AFullDiskLeavesNoFile) {
    const CubeList cubes = odd_cubes(3000, 100);
    for (const char* name : {"a.vox", "a.npy", "a.nrrd", "a.binvox", "a.kv6"}) {
        const FileSizeLimit limit(100);
        EXPECT_EQ(error_of([&] { write(cubes, name); }).kind(), ErrorKind::output) << name;
        EXPECT_EQ(files_in_folder(), 0u) << name;
    }
}

}  // namespace voxelume
