// SPDX-License-Identifier: Apache-2.0
// The helper program reads the same bits from OpenVDB files as OpenVDB in this process, and damage
// stays in the helper.
#include <gmock/gmock.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <thread>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/vdb/vdb_density.hpp"
#include "runtime/io/vdb/vdb_model.hpp"
#include "runtime/io/vdb/vdb_tree.hpp"
#include "runtime/io/vdb/vdb_voxels.hpp"
#include "runtime/io/volume_file.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/volume_samples.hpp"
#include "tests/support/writers/art_writer.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;

class VdbReaderTest : public FileTest {
  protected:
    void TearDown() override {
        isolate_vdb_readers(true);
        FileTest::TearDown();
    }

    std::filesystem::path path() const { return folder / "a.vdb"; }

    /// Writes a fog with tiles of three sizes and leaves, under a transform.
    void write_fog(const openvdb::math::MapBase::Ptr& map) const {
        openvdb::initialize();
        const auto fog = openvdb::FloatGrid::create(0.125f);
        fog->setName("density");
        fog->setTransform(std::make_shared<openvdb::math::Transform>(map));
        fog->tree().addTile(2, Coord(128, 0, 0), 0.75f, true);
        fog->tree().addTile(1, Coord(-8, 16, 0), 0.25f, false);
        fog->tree().addTile(3, Coord(8192, 0, 0), 0.5f, true);
        for (int i = 0; i < 300; ++i)
            fog->tree().setValue(Coord(i % 13 - 6, i % 7, i % 41), float(i) / 64);
        fog->tree().setValueOff(Coord(3, 3, 3), 9.0f);
        openvdb::io::File(path().string()).write({fog});
    }

    /// The densities of a field at many points of a box, as bits.
    static std::vector<uint32_t> samples(const DensityField& field) {
        std::vector<uint32_t> bits;
        std::array<float, 4096> densities{};
        for (const double size : {0.37, 1.0, 9.3, 700.0}) {
            field.sample(glm::dvec3(-3.1, -2.2, -1.3) * size, glm::dvec3(0.7, 0.3, 0.5) * size,
                         densities);
            for (const float density : densities) bits.push_back(std::bit_cast<uint32_t>(density));
            const Bounds box{glm::dvec3(1.0) * size, glm::dvec3(5.0) * size};
            bits.push_back(std::bit_cast<uint32_t>(field.constant_in(box).value_or(-1)));
        }
        bits.push_back(field.is_zero());
        return bits;
    }

    template <class Read>
    static auto read_both(const Read& read) {
        isolate_vdb_readers(true);
        auto isolated = read();
        isolate_vdb_readers(false);
        return std::pair(std::move(isolated), read());
    }
};

TEST_F(VdbReaderTest, ADensityHasTheBitsOfOneThatIsReadHere) {
    using namespace openvdb::math;
    openvdb::Mat4d turned = rotation<openvdb::Mat4d>(Vec3d(1, 2, 3).unit(), 0.7);
    openvdb::Mat4d bent = turned;
    bent.postScale(Vec3d(0.3, 1.7, 0.9));
    bent.postTranslate(Vec3d(0.1, 0.2, 0.3));
    for (const MapBase::Ptr& map :
         {MapBase::Ptr(new UniformScaleMap(0.3)), MapBase::Ptr(new ScaleMap(Vec3d(0.3, 0.7, 1.1))),
          MapBase::Ptr(new TranslationMap(Vec3d(0.1, 0.2, 0.3))),
          MapBase::Ptr(new UniformScaleTranslateMap(0.3, Vec3d(0.1, 0.2, 0.3))),
          MapBase::Ptr(new ScaleTranslateMap(Vec3d(0.3, 0.7, 1.1), Vec3d(0.1, 0.2, 0.3))),
          MapBase::Ptr(new UnitaryMap(turned)), MapBase::Ptr(new AffineMap(bent))}) {
        write_fog(map);
        const GridDensity density{.file = path(), .grid = "density"};
        const auto [isolated, here] = read_both([&] { return read_vdb_density(density); });
        EXPECT_EQ(samples(*isolated), samples(*here)) << map->type();
        EXPECT_EQ(isolated->bytes(), here->bytes()) << map->type();
    }
}

TEST_F(VdbReaderTest, AModelHasTheVoxelsOfOneThatIsReadHere) {
    openvdb::initialize();
    const auto ball = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        7.3f, openvdb::Vec3f(1.5f, -2.5f, 100.25f), 0.5f);
    const auto fog = openvdb::FloatGrid::create(0.0f);
    fog->setName("density");
    fog->tree().fill(CoordBBox(Coord(-5, 3, 2), Coord(20, 11, 9)), 0.5f);
    const auto colors = openvdb::Vec3SGrid::create();
    colors->setName("Cd");
    colors->tree().fill(CoordBBox(Coord(-5, 3, 2), Coord(2, 11, 9)), openvdb::Vec3s(1, 2, 3));
    openvdb::io::File(path().string()).write({ball, fog, colors});
    for (const Surface surface : {Surface::cubes, Surface::smooth}) {
        const auto [isolated, here] = read_both([&] { return read_vdb_voxels(path(), surface); });
        EXPECT_GT(here.cells.size(), 1000u);
        EXPECT_EQ(isolated.cells, here.cells);
        EXPECT_EQ(isolated.values, here.values);
        EXPECT_EQ(isolated.colors, here.colors);
        EXPECT_EQ(isolated.voxel_edges, here.voxel_edges);
        EXPECT_EQ(isolated.origin, here.origin);
        if (surface == Surface::cubes) continue;
        for (int i = 0; i < 64000; ++i) {
            const glm::ivec3 cell(i % 40 - 20, i / 40 % 40 - 25, i / 1600 + 180);
            const ValueRun run = isolated.run_at(cell);
            ASSERT_EQ(run.value, here.run_at(cell).value) << i;
            ASSERT_GE(run.cells, 1) << i;
            for (const int x : {1, run.cells / 2, run.cells - 1})
                ASSERT_EQ(here.run_at(cell + glm::ivec3(x % run.cells, 0, 0)).value, run.value)
                    << i;
        }
    }
}

TEST_F(VdbReaderTest, TwoVoxelsFarApartDontTakeAnIndexOfGigabytes) {
    openvdb::initialize();
    for (const int place : {4000, 8000}) {
        const auto fog = openvdb::FloatGrid::create(0.0f);
        fog->setName("density");
        fog->tree().setValue(Coord(0, 0, 0), 1.0f);
        fog->tree().setValue(Coord(place, place, place), 1.0f);
        openvdb::io::File(path().string()).write({fog});
        const auto read = [&] { return read_voxel_model(path(), Surface::cubes); };
        if (place == 4000)
            EXPECT_EQ(read().voxels(), 2u);
        else
            EXPECT_THAT(error_of(read).what(), HasSubstr("bricks of 16 are possible in a file of"));
    }
}

TEST_F(VdbReaderTest, ASummaryAndAVolumeAreThoseThatAreReadHere) {
    write_volume(path(), rays_volume());
    const auto [isolated, here] = read_both([&] { return read_vdb_summary(path()); });
    EXPECT_EQ(isolated.metadata, here.metadata);
    ASSERT_EQ(isolated.grids.size(), 6u);
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(isolated.grids[i].name, here.grids[i].name);
        EXPECT_EQ(isolated.grids[i].value_type, here.grids[i].value_type);
        EXPECT_EQ(isolated.grids[i].active_voxels, here.grids[i].active_voxels);
        EXPECT_EQ(isolated.grids[i].max, here.grids[i].max);
        EXPECT_EQ(isolated.grids[i].voxel_edges, here.grids[i].voxel_edges);
    }
    const auto [volume, volume_here] = read_both([&] { return read_volume(path()); });
    expect_same_volume(volume, volume_here);
}

TEST_F(VdbReaderTest, DamageAnywhereEndsTheHelperAtMost) {
    write_fog(std::make_shared<openvdb::math::UniformScaleMap>(0.3));
    const std::string bytes = bytes_of(path());
    std::mt19937 random(25);
    for (int i = 0; i < (is_exhaustive() ? 40 : 10); ++i) {
        std::string changed = bytes;
        for (int change = 0; change < 3; ++change)
            changed[random() % bytes.size()] = char(random());
        put_bytes(path(), changed);
        for (int question = 0; question < 3; ++question) try {
                if (question == 0) read_vdb_summary(path());
                if (question == 1) read_vdb_density({.file = path(), .grid = "density"});
                if (question == 2) read_vdb_voxels(path(), Surface::cubes);
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), ErrorKind::input) << i << ": " << error.what();
                EXPECT_THAT(error.what(), HasSubstr("a.vdb: ")) << i;
            }
    }
}

TEST_F(VdbReaderTest, DistancesOfInactiveCellsAreNumbersToo) {
    openvdb::initialize();
    const auto ball =
        openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(7.3f, openvdb::Vec3f(0), 0.5f);
    ball->tree().setValueOff(Coord(40, 0, 0), std::nanf(""));
    openvdb::io::File(path().string()).write({ball});
    EXPECT_THAT(error_of([&] { read_vdb_voxels(path(), Surface::smooth); }).what(),
                HasSubstr("has a value that is no number"));
}

/// What a helper answers that was taken over.
class VdbAnswerTest : public FileTest {
  protected:
    /// A grid under a map, with tiles far apart.
    static std::string answer_of(int type, const std::array<double, 16>& map, int32_t tiles,
                                 int32_t in_one_place = 0) {
        std::string answer = bytes_of_all(0.0f, type, 0, map, uint64_t(tiles + in_one_place));
        for (int32_t i = 0; i < in_one_place; ++i) answer += bytes_of_all(0, 0, 0, 1u, 1.0f, 1u);
        for (int32_t i = 0; i < tiles; ++i) answer += bytes_of_all(i * 4096, 0, 0, 1u, 1.0f, 1u);
        return answer + bytes_of_all(uint64_t{0});
    }
    template <class Receive>
    auto receive(const std::string& answer, const Receive& receive) const {
        put_bytes(folder / "answer", answer);
        HelperProcess helper("/bin/sh", {"-c", "cat " + (folder / "answer").string() + " >&3"}, 0,
                             60);
        WireReceiver receiver(helper);
        return receive(receiver);
    }
    openvdb::FloatGrid::Ptr receive(const std::string& answer) const {
        return receive(answer, [](WireReceiver& receiver) {
            return vdb::receive_grid(receiver, 100'000'000);
        });
    }
};

constexpr int kScaleShifted = 4, kAffine = 5;
constexpr std::array<double, 16> kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// Each tile of 24 bytes makes the receiver's tree grow by 300 kB.
TEST_F(VdbAnswerTest, TreesDontOutgrowTheHelpersLimit) {
    EXPECT_GT(receive(answer_of(kAffine, kIdentity, 200))->tree().memUsage(), 50'000'000u);
    EXPECT_GT(receive(answer_of(kAffine, kIdentity, 200, 9000))->tree().memUsage(), 50'000'000u);
    for (const int32_t in_one_place : {0, 350, 9000})
        EXPECT_THROW(receive(answer_of(kAffine, kIdentity, 350, in_one_place)), HelperFailure);
}

/// OpenVDB throws where it simplifies such maps.
TEST_F(VdbAnswerTest, MapsThatOpenVdbDoesntTakeAreRefused) {
    std::array<double, 16> far = kIdentity;
    far[12] = 3.5e151;
    far[15] = -1.7e212;
    EXPECT_THROW(receive(answer_of(kScaleShifted, far, 0)), HelperFailure);
    EXPECT_THROW(receive(answer_of(kAffine, {}, 0)), HelperFailure);
    EXPECT_THROW(receive(answer_of(7, kIdentity, 0)), HelperFailure);
}

/// Distances of cells outside the listed voxels are asked of the grid.
TEST_F(VdbAnswerTest, OnlyModelsWithDistancesHaveAGridAndTheyAllDo) {
    for (const Surface surface : {Surface::cubes, Surface::smooth})
        for (const bool has_grid : {false, true}) {
            std::string answer =
                bytes_of_all(glm::dvec3(1), glm::dvec3(0), uint64_t{1}, glm::ivec3(0), uint64_t{1},
                             0.5f, uint64_t{0}, uint32_t{has_grid});
            if (has_grid) answer += answer_of(kAffine, kIdentity, 0);
            const auto model = [&] {
                return receive(answer, [&](WireReceiver& receiver) {
                    return vdb::receive_model(receiver, surface, 100'000'000);
                });
            };
            if (has_grid != (surface == Surface::smooth))
                EXPECT_THROW(model(), HelperFailure) << has_grid;
            else
                EXPECT_EQ(model().voxels.cells.size(), 1u) << has_grid;
        }
}

TEST_F(VdbReaderTest, AFileOfEightBytesIsRefused) {
    put_bytes(path(), std::string(" BDV\0\0\0\0", 8));
    EXPECT_THAT(error_of([&] { read_vdb_summary(path()); }).what(),
                HasSubstr("a.vdb: not a readable OpenVDB file: it ends too early"));
}

TEST_F(VdbReaderTest, ManyThreadsReadWhileOthersTakeMemory) {
    write_fog(std::make_shared<openvdb::math::UniformScaleMap>(0.3));
    std::atomic<bool> is_done = false;
    std::thread taker([&] {
        while (!is_done) std::vector<std::string>(100, std::string(1000, 'x')).clear();
    });
    std::atomic<int> read = 0;
    std::vector<std::thread> readers;
    for (int i = 0; i < 4; ++i)
        readers.emplace_back([&] {
            for (int turn = 0; turn < 10; ++turn)
                read += read_vdb_summary(path()).grids.size() == 1;
        });
    for (std::thread& reader : readers) reader.join();
    is_done = true;
    taker.join();
    EXPECT_EQ(read, 40);
}

}  // namespace
}  // namespace voxelume
