// SPDX-License-Identifier: Apache-2.0
// Media of scans: values that are missing, that are negative, and that have no room.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "runtime/base/main_memory.hpp"
#include "runtime/grid/density_field.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/scene/parts/world.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/medium/density_source.hpp"
#include "tests/light/medium_fixture.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

class ScanDensityTest : public FileTest {
  protected:
    void TearDown() override {
        limit_main_memory(0);
        FileTest::TearDown();
    }

    /// Writes a NRRD file of 32^3 values in cells of 1 m, whose first begins at the origin.
    void write_scan(const std::function<float(const glm::ivec3&)>& value_at) const {
        std::ofstream out(folder / "scan.nrrd", std::ios::binary);
        out << "NRRD0004\ntype: float\ndimension: 3\nsizes: 32 32 32\n"
               "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace dimension: 3\n"
               "space origin: (0.5,0.5,0.5)\nendian: little\nencoding: raw\n\n";
        for (int i = 0; i < 32 * 32 * 32; ++i) {
            const float value = value_at({i & 31, i >> 5 & 31, i >> 10});
            out.write(reinterpret_cast<const char*>(&value), sizeof value);
        }
    }

    World world_of(const char* file, const std::vector<TransferPoint>& transfer = {}) const {
        World world;
        world.voxel_size = glm::dvec3(1);
        world.bounds = {glm::dvec3(0), glm::dvec3(32)};
        world.voxels = glm::ivec3(32);
        world.medium.absorption = glm::vec3(1);
        world.medium.density = GridDensity{.file = folder / file,
                                           .grid = "density",
                                           .transfer = transfer,
                                           .where = "s.json:3:4: world.medium.density.file"};
        return world;
    }
};

/// The density at a voxel of a world that is 2 bricks wide.
float density_in(const DensityGrid& grid, const glm::ivec3& voxel) {
    const glm::ivec3 brick = voxel / 16, inside = voxel % 16;
    const uint32_t word = grid.bricks.read().at(size_t((brick.z * 2 + brick.y) * 2 + brick.x));
    const std::vector<float> values = grid.values.read();
    if ((word & VXL_DENSITY_CONSTANT) != 0) return values.at(word & VXL_DENSITY_SLOT);
    return values.at(size_t(word) * 4096 + size_t(inside.x + 16 * inside.y + 256 * inside.z));
}

}  // namespace

TEST_F(ScanDensityTest, NothingIsWhereValuesAreMissing) {
    // All cells with values are alike. Even so, no brick with both kinds of cells becomes constant.
    write_scan([](const glm::ivec3& cell) { return cell.x < 8 ? 1.0F : NAN; });
    const DensityGrid grid = form_density_grid(test_device(), world_of("scan.nrrd"));
    for (const int yz : {0, 5, 17, 31})
        for (const int x : {0, 6, 7, 8, 9, 15, 16, 31})
            EXPECT_EQ(density_in(grid, {x, yz, yz}), x < 8 ? 1.0F : 0.0F) << x << "," << yz;
    EXPECT_EQ(plan_density(world_of("scan.nrrd")).stored_bricks, 4);
    write_scan([](const glm::ivec3&) { return NAN; });
    EXPECT_TRUE(plan_density(world_of("scan.nrrd")).is_zero);
}

TEST_F(ScanDensityTest, WithoutRoomIsRefusedBeforeItIsRead) {
    write_scan([](const glm::ivec3&) { return 1.0F; });
    limit_main_memory(4 * 32 * 32 * 32);
    EXPECT_FALSE(plan_density(world_of("scan.nrrd")).is_zero);
    limit_main_memory(4 * 32 * 32 * 32 - 1);
    const Error error = error_of([&] { plan_density(world_of("scan.nrrd")); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), HasSubstr("s.json:3:4: world.medium.density.file: "));
    EXPECT_THAT(error.what(), HasSubstr("scan.nrrd: its 32768 values take 0.1311 MB of main "
                                        "memory, of which this process may take 0.1311 MB: "
                                        "allow it more, or use a smaller file"));
}

TEST_F(ScanDensityTest, NegativeValuesOfOpenVdbReachTheTransfer) {
    std::vector<glm::ivec3> cells;
    std::vector<float> values;
    for (int i = 0; i < 16 * 16 * 16; ++i) {
        cells.emplace_back(i & 15, i >> 4 & 15, i >> 8);
        values.push_back(float(cells.back().x) - 8);
    }
    VdbVolume volume;
    volume.cells = cells;
    volume.values = values;
    volume.background = -40;
    write_vdb(folder / "scan.vdb", volume);
    // Between the points lies -5.5, the mean of voxel 2 from -6 to -5, and 0.5.
    const World world = world_of(
        "scan.vdb",
        {{-30, 8, {1, 1, 1}}, {-20, 0, {1, 1, 1}}, {-10, 0, {1, 1, 1}}, {0, 1, {1, 1, 1}}});
    const DensityGrid grid = form_density_grid(test_device(), world);
    EXPECT_NEAR(density_in(grid, {2, 5, 5}), 0.45, 1e-6);
    EXPECT_NEAR(density_in(grid, {0, 5, 5}), 0.25, 1e-6);
    EXPECT_NEAR(density_in(grid, {12, 5, 5}), 1, 1e-6);
    EXPECT_NEAR(density_in(grid, {20, 20, 20}), 8, 1e-6) << "the background";
    World plain = world_of("scan.vdb");
    const DensityGrid clamped = form_density_grid(test_device(), plain);
    EXPECT_EQ(density_in(clamped, {2, 5, 5}), 0);
    EXPECT_NEAR(density_in(clamped, {12, 5, 5}), 4.5, 1e-6);
}

}  // namespace voxelume
