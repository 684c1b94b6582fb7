// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/vdb/vdb.hpp"

#include <gmock/gmock.h>
#include <openvdb/openvdb.h>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/geometry/voxel_model.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

/// 7 x 5 x 3 cells across the origin, each with its own value and colour.
struct Voxels {
    std::vector<glm::ivec3> cells;
    std::vector<float> values;
    std::vector<glm::vec3> colors;

    Voxels() {
        for (int z = -1; z < 2; ++z)
            for (int y = 0; y < 5; ++y)
                for (int x = -3; x < 4; ++x) {
                    cells.emplace_back(x, y, z);
                    values.push_back(static_cast<float>(x + 10 * y + 100 * z) + 0.25f);
                    colors.emplace_back(x, y, z);
                }
    }

    VdbVolume volume() const {
        VdbVolume volume;
        volume.name = "surface";
        volume.grid_class = VdbClass::level_set;
        volume.cells = cells;
        volume.values = values;
        volume.colors = colors;
        volume.background = 3.0f;
        volume.voxel_edges = {0.5, 0.25, 2.0};
        volume.origin = {10.0, 20.0, -30.0};
        volume.metadata = {{"scene", "bunny.json"}};
        return volume;
    }
};

class VdbTest : public FileTest {
  protected:
    std::filesystem::path path() const { return folder / "a.vdb"; }
    const Voxels voxels;
};

TEST_F(VdbTest, OpenVdbReadsEveryValueAndColourInItsPlace) {
    write_vdb(path(), voxels.volume());
    openvdb::initialize();
    openvdb::io::File file(path().string());
    file.open();
    const auto values = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"));
    const auto colors = openvdb::gridPtrCast<openvdb::Vec3SGrid>(file.readGrid("Cd"));
    EXPECT_EQ(values->activeVoxelCount(), 105u);
    EXPECT_EQ(values->background(), 3.0f);
    EXPECT_EQ(values->getGridClass(), openvdb::GRID_LEVEL_SET);
    for (size_t i = 0; i < voxels.cells.size(); ++i) {
        const openvdb::Coord cell(voxels.cells[i].x, voxels.cells[i].y, voxels.cells[i].z);
        EXPECT_EQ(values->tree().getValue(cell), voxels.values[i]);
        EXPECT_EQ(colors->tree().getValue(cell).z(), voxels.colors[i].z);
    }
    EXPECT_EQ(values->indexToWorld(openvdb::Coord(-3, 4, 1)), openvdb::Vec3d(8.5, 21.0, -28.0));
    EXPECT_EQ(file.getMetadata()->metaValue<std::string>("scene"), "bunny.json");
}

TEST_F(VdbTest, CubesHaveAUniformScale) {
    VdbVolume volume = voxels.volume();
    volume.voxel_edges = glm::dvec3(0.1);
    write_vdb(path(), volume);
    openvdb::io::File file(path().string());
    file.open();
    const auto grid = file.readGrid("surface");
    EXPECT_TRUE(grid->hasUniformVoxels());
    EXPECT_EQ(grid->indexToWorld(openvdb::Coord(10, 0, 0)).x(), 11.0);
}

TEST_F(VdbTest, TheSameVolumeGivesTheSameBytesAndAnotherValueAnotherIdentifier) {
    write_vdb(path(), voxels.volume());
    write_vdb(folder / "b.vdb", voxels.volume());
    Voxels other;
    other.values[17] += 1.0f;
    write_vdb(folder / "c.vdb", other.volume());
    const std::string bytes = bytes_of(path());
    EXPECT_EQ(bytes, bytes_of(folder / "b.vdb"));
    EXPECT_THAT(bytes.substr(21, 36),
                testing::MatchesRegex(
                    "[0-9a-f]{8}-[0-9a-f]{4}-5[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}"));
    EXPECT_NE(bytes.substr(21, 36), bytes_of(folder / "c.vdb").substr(21, 36));
}

TEST_F(VdbTest, TheSummarySaysWhatIsThere) {
    write_vdb(path(), voxels.volume());
    const std::vector<VdbSummary> grids = read_vdb_summary(path()).grids;
    ASSERT_EQ(grids.size(), 2u);
    const VdbSummary& surface = grids[0].name == "surface" ? grids[0] : grids[1];
    const VdbSummary& colors = grids[0].name == "surface" ? grids[1] : grids[0];
    EXPECT_EQ(surface.value_type, "float");
    EXPECT_EQ(surface.grid_class, "level set");
    EXPECT_EQ(surface.active_voxels, 105u);
    EXPECT_EQ(surface.min, glm::ivec3(-3, 0, -1));
    EXPECT_EQ(surface.max, glm::ivec3(3, 4, 1));
    EXPECT_EQ(surface.voxel_edges, glm::dvec3(0.5, 0.25, 2.0));
    EXPECT_EQ(colors.name, "Cd");
    EXPECT_EQ(colors.value_type, "vec3s");
}

TEST_F(VdbTest, AFullDiskFailsAtEveryLimitAndLeavesNothing) {
    write_vdb(path(), voxels.volume());
    const auto size = std::filesystem::file_size(path());
    std::filesystem::remove(path());
    for (rlim_t limit = 1; limit < size; limit += size / 20) {
        const FileSizeLimit full(limit);
        EXPECT_EQ(error_of([&] { write_vdb(path(), voxels.volume()); }).exit_code(), 5) << limit;
        ASSERT_EQ(files_in_folder(), 0u) << limit;
    }
}

TEST_F(VdbTest, SpansOfDifferentLengthsAreRefused) {
    VdbVolume volume = voxels.volume();
    volume.colors = volume.colors.subspan(1);
    EXPECT_THAT(error_of([&] { write_vdb(path(), volume); }).what(), HasSubstr("a colour"));
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(VdbTest, AnyTruncationIsAnInputError) {
    write_vdb(path(), voxels.volume());
    const std::string bytes = bytes_of(path());
    for (size_t length = 0; length < bytes.size();
         length += bytes.size() / (is_exhaustive() ? 40 : 15)) {
        put_bytes(path(), bytes.substr(0, length));
        EXPECT_EQ(error_of([&] { read_vdb_summary(path()); }).exit_code(), 4) << length;
    }
}

TEST_F(VdbTest, VoxelsAreAsLongAsTheirPlaceCanTell) {
    openvdb::initialize();
    const auto fog = openvdb::FloatGrid::create(0.0f);
    fog->tree().setValue(openvdb::Coord(1, 2, 3), 1.0f);
    fog->setTransform(std::make_shared<openvdb::math::Transform>(openvdb::math::MapBase::Ptr(
        new openvdb::math::UniformScaleTranslateMap(0.25, openvdb::Vec3d(0, 1e12, 0)))));
    openvdb::io::File(path().string()).write({fog});
    EXPECT_THAT(error_of([&] { read_voxel_model(path(), Surface::cubes); }).what(),
                HasSubstr("its voxels are 0.25 m long, and at least 1 m are possible"));
}

// Tiles of each size, behind a background below zero, and runs that end in them.
TEST_F(VdbTest, ALevelSetHasItsSignsInsideTilesToo) {
    openvdb::initialize();
    const auto set = openvdb::FloatGrid::create(-2.0f);
    set->setGridClass(openvdb::GRID_LEVEL_SET);
    set->tree().addTile(2, openvdb::Coord(-128, 0, 0), 2.0f, false);  // 128 cells
    set->tree().addTile(1, openvdb::Coord(8, 0, 0), 2.0f, false);     // 8 cells
    set->tree().setValue(openvdb::Coord(-300, 7, 7), 0.5f);
    set->tree().setValue(openvdb::Coord(40, 7, 7), 0.5f);
    openvdb::io::File(path().string()).write({set});
    const VoxelModel model = read_voxel_model(path(), Surface::smooth);
    const glm::ivec3 bricks = model.frame.bricks();
    const glm::dvec3 first = model.frame.origin / model.frame.voxel_edge;
    size_t inside = 0, outside = 0;
    for (size_t brick = 0; brick < model.slots.size(); ++brick) {
        const glm::ivec3 corner =
            glm::ivec3(first) + 16 * glm::ivec3(int(brick) % bricks.x,
                                                int(brick) / bricks.x % bricks.y,
                                                int(brick) / bricks.x / bricks.y);
        const openvdb::Coord at(corner.x, corner.y, corner.z);
        const bool is_inside = set->tree().getValue(at) < 0;
        if (model.slots[brick] == kBrickInside) EXPECT_TRUE(is_inside) << at;
        if (model.slots[brick] == kBrickOutside) EXPECT_FALSE(is_inside) << at;
        inside += model.slots[brick] == kBrickInside;
        outside += model.slots[brick] == kBrickOutside;
    }
    EXPECT_GT(inside, 5u);
    EXPECT_GE(outside, 5u);
    for (size_t slot = 0; slot < model.coordinates.size(); ++slot) {
        const auto brick = int(model.coordinates[slot]);
        const glm::ivec3 corner =
            glm::ivec3(first) + 16 * glm::ivec3(brick % bricks.x, brick / bricks.x % bricks.y,
                                                brick / bricks.x / bricks.y);
        for (int i = 0; i < 4096; ++i) {
            const openvdb::Coord at(corner.x + (i & 15), corner.y + (i >> 4 & 15),
                                    corner.z + (i >> 8));
            ASSERT_EQ(model.distance[slot * 4096 + size_t(i)] < 0, set->tree().getValue(at) < 0)
                << at;
        }
    }
}

TEST_F(VdbTest, AMissingFileIsAnInputError) {
    EXPECT_THAT(error_of([&] { read_vdb_summary(path()); }).what(), HasSubstr("no such file"));
}

}  // namespace
}  // namespace voxelume
