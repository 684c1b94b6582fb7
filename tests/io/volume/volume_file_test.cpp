// SPDX-License-Identifier: Apache-2.0
// The common entry of all formats, and the formats for pictures and points.
#include "runtime/io/volume_file.hpp"

#include <gmock/gmock.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/image/png.hpp"
#include "tests/io/volume/volume_damage.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

using testing::HasSubstr;

class VolumeFileTest : public FileTest {
  protected:
    Error refusal(const char* name, const Volume& volume, const VolumeOptions& options = {}) {
        return error_of([&] { write_volume(folder / name, volume, options); });
    }
};

TEST_F(VolumeFileTest, EndingsAndNamesStandForFormats) {
    EXPECT_EQ(volume_format_of("a/b.vdb"), VolumeFormat::vdb);
    EXPECT_EQ(volume_format_of("b.####.png"), VolumeFormat::slices);
    EXPECT_EQ(volume_format_of("b.json"), VolumeFormat::raw);
    EXPECT_EQ(volume_format_of("b.rgb565"), VolumeFormat::rgb565);
    for (int i = 0; i < 11; ++i) {
        const auto format = static_cast<VolumeFormat>(i);
        EXPECT_EQ(volume_format_named(volume_format_name(format)), format);
    }
    EXPECT_THAT(error_of([] { volume_format_of("b.vdp"); }).what(), HasSubstr(".vdb .exr"));
    EXPECT_THAT(error_of([] { volume_format_named("colour-planes"); }).what(),
                HasSubstr("did you mean \"color-planes\"?"));
}

TEST_F(VolumeFileTest, DisplaysFormatsRefuseSightRays) {
    for (const char* name : {"a.kv6", "a.planes", "a.cplanes", "a.rgb332", "a.rgb565"}) {
        const Error error = refusal(name, rays_volume());
        EXPECT_EQ(error.exit_code(), 2);
        EXPECT_THAT(error.what(), HasSubstr("hold a lattice")) << name;
    }
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(VolumeFileTest, SizesBeyondAFormatAreRefusedBeforeMemoryIsTaken) {
    Volume huge = lattice_volume({1, 1, 1}, 0);
    huge.frame.size = glm::ivec3(65536);
    for (const char* name : {"a.nrrd", "a.raw", "a.####.png", "a.kv6", "a.planes", "a.cplanes",
                             "a.rgb332", "a.rgb565"})
        EXPECT_EQ(refusal(name, huge).exit_code(), 8) << name;
    write_volume(folder / "a.vdb", huge);  // it holds only voxels that show something
    EXPECT_EQ(refusal("a.kv6", lattice_volume({257, 1, 1}, 0)).exit_code(), 8);
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(VolumeFileTest, FaultyVolumesAreRefused) {
    const auto refused = [&](auto change, const char* reason) {
        Volume volume = lattice_volume();
        change(volume);
        const Error error = refusal("a.vdb", volume);
        EXPECT_EQ(error.exit_code(), 5);
        EXPECT_THAT(error.what(), HasSubstr(reason));
    };
    refused([](Volume& v) { v.colors.pop_back(); }, "not every voxel");
    refused([](Volume& v) { std::swap(v.indices[0], v.indices[1]); }, "ascending");
    refused([](Volume& v) { v.indices.back() = 105; }, "outside");
    refused([](Volume& v) { v.opacities[3] = 1.5f; }, "opacity");
    refused([](Volume& v) { v.colors[2].g = NAN; }, "colour");
    refused([](Volume& v) { v.frame.edge.y = 0; }, "no size");
    refused([](Volume& v) { v.frame.size.z = 0; }, "0 voxels along an axis");
    refused([](Volume& v) { v.frame.world_from_observer[0][0] += 0.01; }, "rigid");
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(VolumeFileTest, MissingFilesAndOtherFormatsAreRefused) {
    for (const char* name : {"a.vdb", "a.exr", "a.nrrd", "a.raw", "a.json"})
        EXPECT_EQ(error_of([&] { read_volume(folder / name); }).exit_code(), 4) << name;
    EXPECT_EQ(error_of([&] { read_volume(folder / "a.kv6"); }).exit_code(), 2);
    EXPECT_EQ(refusal("nowhere/a.vdb", lattice_volume()).exit_code(), 5);
    EXPECT_EQ(refusal("a.png", lattice_volume()).exit_code(), 2);
}

TEST_F(VolumeFileTest, GeometryAgreesWithTheMatrix) {
    for (const Volume& volume : {lattice_volume(), rays_volume(DisplayShape::box)}) {
        const glm::dmat4 world = *world_from_voxels(volume.frame);
        for (const glm::ivec3 cell : {glm::ivec3(0), glm::ivec3(6, 1, 2), glm::ivec3(2, 4, 0)}) {
            const glm::dvec4 expected = world * glm::dvec4(glm::dvec3(cell) + 0.5, 1);
            EXPECT_LT(glm::length(voxel_center(volume.frame, cell) - glm::dvec3(expected)), 1e-12);
        }
    }
    EXPECT_FALSE(world_from_voxels(rays_volume().frame));
}

TEST_F(VolumeFileTest, SlicesShowWhatTheObserverSees) {
    // The lattice's X_E points left and its Y_E up, so voxel (6, 4) is at the top left.
    write_volume(folder / "s.####.png", single_voxel({7, 5, 3}, {5, 4, 2}, {1, 0.25f, 0}, 0.5f));
    EXPECT_EQ(files_in_folder(), 4u);
    const Picture empty = read_png(folder / "s.0000.png"), last = read_png(folder / "s.0002.png");
    EXPECT_EQ(last.width, 7);
    EXPECT_EQ(last.height, 5);
    for (size_t i = 0; i < 35; ++i) {
        EXPECT_EQ(empty.pixels[i][3], 0);
        EXPECT_EQ(last.pixels[i][3], i == 1 ? 128 : 0);
    }
    EXPECT_EQ(last.pixels[1][0], 255);
    EXPECT_EQ(last.pixels[1][1], 137);
    const auto header = nlohmann::json::parse(bytes_of(folder / "s.json"));
    EXPECT_EQ(header["axes"], nlohmann::json({"-X_E", "-Y_E", "+Z_E"}));

    Volume rays = rays_volume(DisplayShape::pyramid, 0);
    const Volume one = single_voxel({7, 5, 9}, {1, 0, 8}, {1, 1, 1});
    rays.indices = one.indices, rays.colors = one.colors, rays.opacities = one.opacities;
    rays.depths = {3.2f}, rays.objects = one.objects, rays.kinds = one.kinds;
    write_volume(folder / "r_%03d.png", rays);
    EXPECT_EQ(read_png(folder / "r_008.png").pixels[1][3], 255);
    EXPECT_TRUE(std::filesystem::exists(folder / "r.json"));
}

TEST_F(VolumeFileTest, AHeaderReplacesNothingButItsLike) {
    const Volume volume = lattice_volume();
    const auto expect_refused = [&](const char* name) {
        const Error error = refusal(name, volume);
        EXPECT_EQ(error.kind(), ErrorKind::output) << name;
        EXPECT_THAT(error.what(), HasSubstr("this file isn't one")) << name;
    };
    const std::string scene = R"({"voxelume": 1})";
    put_bytes(folder / "a.json", scene);
    for (const char* name : {"a.raw", "a.json", "a.####.png"}) expect_refused(name);
    EXPECT_EQ(bytes_of(folder / "a.json"), scene);
    EXPECT_EQ(files_in_folder(), 1u);

    write_volume(folder / "b.raw", volume);
    expect_refused("b.####.png");
    write_volume(folder / "b.raw", volume);
    EXPECT_EQ(read_volume(folder / "b.raw").indices, volume.indices);
    write_volume(folder / "c.####.png", volume);
    write_volume(folder / "c.####.png", volume);
    expect_refused("c.raw");
}

TEST_F(VolumeFileTest, PlyPointsStandInTheWorld) {
    Volume rays = rays_volume();
    write_volume(folder / "a.ply", rays);
    const std::string bytes = bytes_of(folder / "a.ply");
    const size_t end = bytes.find("end_header\n") + 11;
    EXPECT_THAT(bytes.substr(0, end),
                HasSubstr("format binary_little_endian 1.0\ncomment voxelume volume\n"));
    size_t at = end, count = 0;
    for (size_t i = 0; i < rays.indices.size(); ++i) {
        if (rays.opacities[i] == 0) continue;
        float p[3];
        std::memcpy(p, bytes.data() + at, sizeof p);
        const auto index = int(rays.indices[i]);
        const double u = index % 7, v = index / 7 % 5, k = index / 35;
        const double depth =
            rays.kinds[i] == VoxelKind::object ? double(rays.depths[i]) : 0.7 + 0.3 * (k + 0.5);
        const glm::dvec4 expected =
            turned_observer() * glm::dvec4(-((2 * u + 1) / 7 - 1) * std::tan(0.5) * depth,
                                           -((2 * v + 1) / 5 - 1) * std::tan(0.3) * depth, depth,
                                           1);
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(p[axis], expected[axis], 2e-6);
        EXPECT_EQ(uint8_t(bytes[at + 15]), std::lround(rays.opacities[i] * 255));
        at += 20;
        ++count;
    }
    EXPECT_EQ(at, bytes.size());
    EXPECT_THAT(bytes.substr(0, end), HasSubstr(fmt::format("element vertex {}\n", count)));
}

TEST_F(VolumeFileTest, TheSameVolumeGivesTheSameBytes) {
    const Volume volume = lattice_volume();
    for (const char* ending : {"ply", "kv6", "planes", "cplanes", "rgb332", "rgb565"}) {
        const auto path = folder / fmt::format("a.{}", ending);
        write_volume(path, volume);
        const std::string first = bytes_of(path);
        write_volume(path, volume);
        EXPECT_TRUE(bytes_of(path) == first) << ending;
        std::filesystem::remove(path);
        expect_full_disk_leaves_nothing(path, volume);
    }
}

}  // namespace voxelume
