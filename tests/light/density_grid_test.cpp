// SPDX-License-Identifier: Apache-2.0
// The medium's density at every voxel, from the scene: grids of files, collapsed bricks, memory,
// and refusals.
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/scene_file/read_scene.hpp"

#include <gmock/gmock.h>
#include <openvdb/openvdb.h>

#include <map>

#include "runtime/grid/density_field.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/render/renderer.hpp"
#include "tests/light/medium_fixture.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {

using testing::Contains;
using testing::HasSubstr;
using testing::Key;
using testing::Not;

namespace {

/// The density at a voxel, read back from a grid's buffers.
class DensityReader {
  public:
    explicit DensityReader(const DensityGrid& grid)
        : shape_(grid.shape), bricks_(grid.bricks.read()), values_(grid.values.read()) {}

    float at(const glm::ivec3& voxel) const {
        const glm::ivec3 cell(voxel.x >> shape_.shift_x, voxel.y >> shape_.shift_y,
                              voxel.z >> shape_.shift_z);
        const glm::ivec3 brick = cell / 16, inside = cell % 16;
        const uint32_t word =
            bricks_.at((size_t(brick.z) * shape_.bricks_y + brick.y) * shape_.bricks_x + brick.x);
        if (word >> 31) return values_.at(word & 0x3FFFFFF);
        return values_.at(size_t(word) * 4096 + inside.x + 16 * inside.y + 256 * inside.z);
    }
    /// The number of bricks by the log2 size of the cube that shares their density; 0 means stored.
    std::map<int, int> sizes() const {
        std::map<int, int> sizes;
        for (const uint32_t word : bricks_) ++sizes[word >> 31 ? int(word >> 26 & 31) : 0];
        return sizes;
    }

  private:
    DensityShape shape_;
    std::vector<uint32_t> bricks_;
    std::vector<float> values_;
};

}  // namespace

class DensityGridTest : public FileTest {
  protected:
    /// Writes `smoke.vdb`, which has one value at each of 9 x 7 x 5 cells with the given edges.
    void write_smoke(const glm::dvec3& edges, const glm::dvec3& origin) {
        std::vector<glm::ivec3> cells;
        std::vector<float> values;
        for (int z = 0; z < 5; ++z)
            for (int y = 0; y < 7; ++y)
                for (int x = 0; x < 9; ++x) {
                    cells.emplace_back(x, y, z);
                    values.push_back(smoke(x, y, z));
                }
        VdbVolume volume;
        volume.cells = cells;
        volume.values = values;
        volume.voxel_edges = edges;
        volume.origin = origin;
        write_vdb(path(), volume);
    }
    static float smoke(int x, int y, int z) { return float(1 + x + 10 * y + 100 * z) / 64; }

    std::filesystem::path path() const { return folder / "smoke.vdb"; }
    GridDensity grid_density(const std::string& name = "density") const {
        return {.file = path(), .grid = name, .where = "fog.json:3:4: world.medium.density.file"};
    }
    World smoky_world() const {
        World world = medium_world({70, 50, 30});
        world.medium.density = grid_density();
        return world;
    }
    Error refusal(const World& world) {
        return error_of([&] { plan_density(world); });
    }
};

TEST_F(DensityGridTest, AGridOfTheWorldsOwnVoxelsKeepsItsValues) {
    // Cell (0, 0, 0) lies at the centre of voxel (20, 10, 15).
    World world = smoky_world();
    write_smoke(world.voxel_size,
                world.bounds.min + world.voxel_size * glm::dvec3(20.5, 10.5, 15.5));
    const DensityReader read(form_density_grid(test_device(), world));
    for (int z = 0; z < 30; ++z)
        for (int y = 0; y < 50; ++y)
            for (int x = 0; x < 70; ++x) {
                const glm::ivec3 c = glm::ivec3(x, y, z) - glm::ivec3(20, 10, 15);
                const bool there =
                    c.x >= 0 && c.x < 9 && c.y >= 0 && c.y < 7 && c.z >= 0 && c.z < 5;
                ASSERT_NEAR(read.at({x, y, z}), there ? smoke(c.x, c.y, c.z) : 0.0f, 1e-5f)
                    << x << "," << y << "," << z;
            }
}

TEST_F(DensityGridTest, APlacedGridIsLinearBetweenItsValues) {
    // The values are a linear function of position, so trilinear samples inside reproduce it.
    write_smoke({2, 1, 3}, {0, 0, 0});
    World world = smoky_world();
    GridDensity density = grid_density();
    // The grid's x runs along the world's z, its y along y, its z along -x; then it is shifted.
    density.world_from_grid = glm::dmat4({0, 0, 1, 0}, {0, 1, 0, 0}, {-1, 0, 0, 0}, {20, 1, 5, 1});
    world.medium.density = density;
    const DensityReader read(form_density_grid(test_device(), world));
    int inside = 0;
    for (int z = 0; z < 30; ++z)
        for (int y = 0; y < 50; ++y)
            for (int x = 0; x < 70; ++x) {
                const glm::dvec3 p =
                    world.bounds.min + world.voxel_size * (glm::dvec3(x, y, z) + 0.5);
                const glm::dvec3 i((p.z - 5) / 2, p.y - 1, (20 - p.x) / 3);
                if (glm::any(glm::lessThan(i, glm::dvec3(0))) || i.x > 8 || i.y > 6 || i.z > 4)
                    continue;
                ++inside;
                ASSERT_NEAR(double(read.at({x, y, z})), (1 + i.x + 10 * i.y + 100 * i.z) / 64, 1e-5)
                    << x << "," << y << "," << z;
            }
    EXPECT_GT(inside, 1000);
}

TEST_F(DensityGridTest, RaysLoseWhatAGridsVoxelsTake) {
    World world = smoky_world();
    write_smoke({3, 1.5, 4}, {1, 2, 10});
    const DensityReader read(form_density_grid(test_device(), world));
    const std::vector<MediumRay> rays = medium_rays(world.voxels, 2000, 11);
    MediumBatch batch(world, rays);
    const std::vector<float> transmittance = batch.sight(1);
    int changed = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const double tau = depth_of(world, rays[i],
                                    [&](const glm::dvec3&, const glm::ivec3& voxel) {
                                        return double(read.at(voxel));
                                    }) /
                           32;
        const float green = transmittance[batch.batch.stride + i];
        changed += green < 1;
        ASSERT_NEAR(green, std::exp(-tau), std::exp(-tau) * std::max(1e-6, 2.5e-7 * tau)) << i;
    }
    EXPECT_GT(changed, 500);
}

TEST_F(DensityGridTest, SpaceOfOneDensityIsOneBlock) {
    World world = medium_world({300, 300, 300});
    world.medium.density = BallDensity{{20, 40, 180}, 12, 2};
    const DensityGrid grid = form_density_grid(test_device(), world);
    const DensityReader read(grid);
    const DensityPlan plan = plan_density(world);
    const auto sizes = read.sizes();
    EXPECT_EQ(plan.bricks, glm::ivec3(19));
    EXPECT_GT(sizes.at(0), 10);
    EXPECT_LE(sizes.at(0), plan.stored_bricks);
    EXPECT_GT(sizes.at(4), 0);
    EXPECT_GT(sizes.at(6), 3000);
    EXPECT_EQ(plan.bytes, double(4 * (grid.bricks.size() + grid.values.size())));
    // The points are the centre, just outside the ball, and just inside it.
    EXPECT_EQ(read.at({46, 164, 178}), 1.0f);
    EXPECT_EQ(read.at({46, 164, 165}), 0.0f) << "z 167.5";
    EXPECT_GT(read.at({46, 164, 166}), 0.0f);
    EXPECT_LT(read.at({46, 164, 166}), 1.0f);
}

TEST_F(DensityGridTest, AHeightTakesNoMoreMemoryInAWiderWorld) {
    World narrow = medium_world({16, 500, 16}), wide = medium_world({5000, 500, 5000});
    narrow.medium.density = wide.medium.density = HeightDensity{3, 40};
    EXPECT_EQ(plan_density(wide).bytes, plan_density(narrow).bytes);
    const DensityReader read(form_density_grid(test_device(), wide));
    EXPECT_EQ(read.at({4999, 15, 1234}), 1.0f) << "y 2.875";
    EXPECT_EQ(read.at({17, 16, 4999}), float(std::exp(-0.125 / 40))) << "y 3.125";
    EXPECT_EQ(read.at({17, 499, 4999}), float(std::exp((3 - 123.875) / 40)));
}

TEST_F(DensityGridTest, NothingIsPlannedForAMediumThatAbsorbsNothingOrAlike) {
    World world = medium_world({300, 300, 300});
    EXPECT_EQ(plan_density(world).bytes, 0);
    world.medium.absorption = glm::vec3(0);
    world.medium.density = BallDensity{{20, 40, 180}, 12, 2};
    EXPECT_EQ(plan_density(world).bytes, 0);
}

TEST_F(DensityGridTest, ADamagedFileIsRefusedWithThePlaceInTheScene) {
    write_smoke({1, 1, 1}, {0, 0, 0});
    const std::string bytes = bytes_of(path());
    const size_t lengths = is_exhaustive() ? 200 : 40;
    for (size_t length = 0; length < bytes.size(); length += bytes.size() / lengths) {
        put_bytes(path(), bytes.substr(0, length));
        const Error error = refusal(smoky_world());
        EXPECT_EQ(error.exit_code(), 4) << length;
        EXPECT_THAT(error.what(), HasSubstr("fog.json:3:4: world.medium.density.file: "));
    }
}

TEST_F(DensityGridTest, AMissingGridIsRefusedWithTheNamesThatAreThere) {
    write_smoke({1, 1, 1}, {0, 0, 0});
    World world = smoky_world();
    world.medium.density = grid_density("smoke");
    EXPECT_THAT(refusal(world).what(), HasSubstr("has no grid \"smoke\"; its grids: \"density\""));
}

TEST_F(DensityGridTest, OnlyFloatGridsOfNumbersAreDensities) {
    write_smoke({1, 1, 1}, {0, 0, 0});
    const auto write_one = [&](const openvdb::GridBase::Ptr& grid) {
        grid->setName("density");
        openvdb::io::File(path().string()).write({grid});
    };
    write_one(openvdb::Vec3SGrid::create());
    EXPECT_THAT(refusal(smoky_world()).what(), HasSubstr("holds vec3s values"));
    const auto with_nan = openvdb::FloatGrid::create();
    with_nan->getAccessor().setValue({1, 2, 3}, std::nanf(""));
    write_one(with_nan);
    EXPECT_THAT(refusal(smoky_world()).what(), HasSubstr("has a value that is no number"));
    const auto negative = openvdb::FloatGrid::create();
    negative->getAccessor().setValue({4, 4, 4}, -2.0f);
    write_one(negative);
    const DensityReader read(form_density_grid(test_device(), smoky_world()));
    EXPECT_EQ(read.at({15, 21, 2}), 0.0f);
}

namespace {

constexpr const char* kSceneWithMedium = R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}}{}}},
"lights": [{{"type": "point", "position": [0, 0.9, 0]}}],
"models": {{"ball": {{"shape": "sphere", "radius": 0.4, "surface": "cubes"}}}}, "objects": [{{"model": "ball"}}],
"observer": {{"position": [0, 0, -3], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 50}}}},
"render": {{"size": [16, 12]}}}})";

}  // namespace

TEST_F(DensityGridTest, AMediumThatIsAlikeEverywhereHasNoGrid) {
    const auto counters_of = [&](const std::string& medium) {
        const Device device = test_device();
        RenderReport report;
        render(device, parse_scene(fmt::format(kSceneWithMedium, medium), folder / "s.json", {}),
               report);
        return device.counters();
    };
    const DeviceCounters alike = counters_of(R"(, "medium": {"absorption": [1, 1, 1]})");
    EXPECT_THAT(alike.launches, Contains(Key(std::string("absorb_shadows"))));
    EXPECT_THAT(alike.allocated_bytes, Not(Contains(Key(std::string("medium densities")))));
    const DeviceCounters fog = counters_of(
        R"(, "medium": {"absorption": [1, 1, 1],
                        "density": {"kind": "height", "base": 0, "scale_height": 1}})");
    EXPECT_THAT(fog.allocated_bytes, Contains(Key(std::string("medium densities"))));
    EXPECT_THAT(fog.allocated_bytes, Contains(Key(std::string("medium bricks"))));
}

TEST_F(DensityGridTest, ADeviceWithoutRoomForItIsRefusedBeforeItIsTaken) {
    const Scene scene =
        parse_scene(fmt::format(kSceneWithMedium, R"(, "medium": {"absorption": [1, 1, 1],
                    "density": {"kind": "ball", "center": [0, 0, 0], "radius": 1, "falloff": 1}})"),
                    "s.json", {});
    AssetStore meshes;
    const ScenePlan plan = plan_scene(scene, meshes);
    DeviceInfo device;
    device.name = "Small One";
    device.memory = 1'000'000'000;
    device.max_allocation = 400'000;
    const Error error = error_of([&] { check_memory(scene, plan, device); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(),
                HasSubstr("world.medium: a density at each of 40x40x40 voxels needs"));
}

}  // namespace voxelume
