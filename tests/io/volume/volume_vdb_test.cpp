// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <openvdb/openvdb.h>

#include <glm/trigonometric.hpp>

#include "tests/io/volume/volume_damage.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

/// The expected middle of a voxel, computed again without the library's geometry.
glm::dvec3 expected_position(const VolumeFrame& frame, glm::dvec3 cell) {
    glm::dvec3 p;
    if (frame.layout == VolumeLayout::lattice) {
        p = frame.origin + frame.edge * (cell + 0.5);
    } else {
        const double z = frame.display.near + frame.step * (cell.z + 0.5);
        const double u = (2 * cell.x + 1) / frame.size.x - 1,
                     v = (2 * cell.y + 1) / frame.size.y - 1;
        p = {-u * std::tan(frame.display.half_angles.x) * z,
             -v * std::tan(frame.display.half_angles.y) * z, z};
        if (frame.display.shape == DisplayShape::box)
            p = {-u * frame.display.half_size.x, -v * frame.display.half_size.y, z};
    }
    return glm::dvec3(frame.world_from_observer * glm::dvec4(p, 1));
}

}  // namespace

class VolumeVdbTest : public FileTest {
  protected:
    std::filesystem::path path() const { return folder / "a.vdb"; }
};

TEST_F(VolumeVdbTest, EveryBitComesBack) {
    for (const Volume& volume : {lattice_volume(), rays_volume(), rays_volume(DisplayShape::box)}) {
        write_volume(path(), volume);
        expect_same_volume(read_volume(path()), volume);
    }
}

TEST_F(VolumeVdbTest, AnEmptyVolumeComesBack) {
    write_volume(path(), lattice_volume({7, 5, 3}, 0));
    EXPECT_TRUE(read_volume(path()).indices.empty());
}

TEST_F(VolumeVdbTest, OpenVdbFindsTheDisplaysVoxelsAndNoOthers) {
    const Volume volume = lattice_volume();
    write_volume(path(), volume);
    openvdb::initialize();
    openvdb::io::File file(path().string());
    file.open();
    const auto alpha = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("alpha"));
    const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("density"));
    const auto color = openvdb::gridPtrCast<openvdb::Vec3SGrid>(file.readGrid("Cd"));
    EXPECT_EQ(alpha->activeVoxelCount(), volume.indices.size());
    EXPECT_EQ(density->getGridClass(), openvdb::GRID_FOG_VOLUME);
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const auto index = int(volume.indices[i]);
        const openvdb::Coord c(index % 7, index / 7 % 5, index / 35);
        EXPECT_EQ(alpha->tree().getValue(c), volume.opacities[i]);
        EXPECT_EQ(color->tree().getValue(c).y(), volume.colors[i].g);
        const double through = std::exp(-2.0 * double(density->tree().getValue(c)));
        EXPECT_NEAR(through, std::max(1.0 - double(volume.opacities[i]), 1.0 / 1024), 1e-6);
    }
}

TEST_F(VolumeVdbTest, TheTransformIsTheDisplays) {
    for (const Volume& volume : {lattice_volume(), rays_volume(), rays_volume(DisplayShape::box)}) {
        write_volume(path(), volume);
        openvdb::initialize();
        openvdb::io::File file(path().string());
        file.open();
        for (const char* name : {"density", "Cd", "object"}) {
            const auto grid = file.readGrid(name);
            for (const glm::dvec3 cell : {glm::dvec3(0, 0, 0), glm::dvec3(6, 4, 2),
                                          glm::dvec3(1, 3, 0), glm::dvec3(5, 0, 2)}) {
                const openvdb::Vec3d found =
                    grid->indexToWorld(openvdb::Vec3d(cell.x, cell.y, cell.z));
                const glm::dvec3 expected = expected_position(volume.frame, cell);
                EXPECT_LT(glm::length(glm::dvec3(found.x(), found.y(), found.z()) - expected),
                          1e-12);
            }
        }
    }
}

TEST_F(VolumeVdbTest, AnUnturnedCubicLatticeHasTheSimplestTransform) {
    Volume volume = lattice_volume();
    volume.frame.edge = glm::dvec3(0.25);
    volume.frame.world_from_observer = glm::dmat4(1);
    write_volume(path(), volume);
    openvdb::initialize();
    openvdb::io::File file(path().string());
    file.open();
    EXPECT_TRUE(file.readGrid("density")->hasUniformVoxels());
}

TEST_F(VolumeVdbTest, TheSameVolumeGivesTheSameBytes) {
    for (const Volume& volume : {lattice_volume(), rays_volume()}) {
        write_volume(path(), volume);
        write_volume(folder / "b.vdb", volume);
        EXPECT_TRUE(bytes_of(path()) == bytes_of(folder / "b.vdb"));
    }
}

TEST_F(VolumeVdbTest, VdbPrintReadsIt) {
    const Volume volume = lattice_volume();
    write_volume(path(), volume);
    const ProgramResult result = run_tool(folder, "vdb_print -l a.vdb");
    if (result.exit_code == 127) GTEST_SKIP() << "vdb_print isn't installed";
    EXPECT_EQ(result.exit_code, 0);
    for (const char* name : {"density", "alpha", "Cd", "depth", "object", "kind"})
        EXPECT_THAT(result.out, HasSubstr(fmt::format("Name: {}\n", name)));
    EXPECT_THAT(result.out, HasSubstr("scene: room.json"));
}

TEST_F(VolumeVdbTest, WhatOpenVdbCantHoldIsRefusedWithWhatCan) {
    Volume near_zero = rays_volume();
    near_zero.frame.display.near = 0;
    for (const Volume& volume :
         {rays_volume(DisplayShape::sector), rays_volume(DisplayShape::ball), near_zero}) {
        const Error error = error_of([&] { write_volume(path(), volume); });
        EXPECT_EQ(error.exit_code(), 2);
        EXPECT_THAT(error.what(), HasSubstr("write .exr, .nrrd, .raw or .ply"));
    }
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(VolumeVdbTest, DamagedFilesNeverReachOpenVdb) {
    write_volume(path(), lattice_volume());
    expect_truncations_refused(path(), path(), 97);
    EXPECT_EQ(count_refused_changes(path(), path(), 300), 300u);
}

TEST_F(VolumeVdbTest, AFullDiskLeavesNothing) {
    expect_full_disk_leaves_nothing(path(), lattice_volume());
}

}  // namespace voxelume
