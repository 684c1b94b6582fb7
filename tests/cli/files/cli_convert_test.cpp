// SPDX-License-Identifier: Apache-2.0
// The command `voxelume convert`, and the output of `info` for volumes.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "runtime/io/volume_file.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/volume_samples.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {

using testing::HasSubstr;

class CliConvertTest : public ProgramTest {};

TEST_F(CliConvertTest, AWayThroughAllFormatsLosesNothing) {
    const Volume volume = rays_volume(DisplayShape::box);
    write_volume(folder / "original.vdb", volume);
    for (const char* arguments : {"original.vdb a.vdb", "a.vdb b.raw", "b.json c.nrrd --all",
                                  "c.nrrd d.nrrd --all --uncompressed", "d.nrrd e.vdb"})
        EXPECT_EQ(run(fmt::format("convert {}", arguments)).exit_code, 0) << arguments;
    EXPECT_TRUE(bytes_of(folder / "a.vdb") == bytes_of(folder / "e.vdb"));
    EXPECT_EQ(run("convert e.vdb f.exr").exit_code, 0);
    EXPECT_EQ(run("convert f.exr g.raw").exit_code, 0);
    EXPECT_EQ(read_volume(folder / "g.raw").depths, volume.depths);
}

TEST_F(CliConvertTest, DisplaysFormatsTakeTheirOptions) {
    write_volume(folder / "a.vdb", lattice_volume({9, 5, 7}));
    const auto size_of = [&](const char* name) {
        return std::filesystem::file_size(folder / name);
    };
    for (const char* arguments :
         {"a.vdb b.planes --dither none --sweep z", "a.vdb c.bin --format color-planes",
          "--angles 10 --radii 4 a.vdb d.rgb565 --exposure -1.5", "a.vdb s.##.png", "a.vdb p.ply",
          "a.vdb k.kv6"})
        EXPECT_EQ(run(fmt::format("convert {}", arguments)).exit_code, 0) << arguments;
    EXPECT_EQ(size_of("b.planes"), 2u * 5 * 7);
    EXPECT_EQ(size_of("c.bin"), 2u * 7 * 5 * 3);
    EXPECT_EQ(size_of("d.rgb565"), 2u * 10 * 4 * 5);
    EXPECT_TRUE(std::filesystem::exists(folder / "s.06.png"));
}

TEST_F(CliConvertTest, WhatCantBeConvertedSaysWhy) {
    write_volume(folder / "a.vdb", lattice_volume());
    const auto failure = [&](const char* arguments, int code) {
        const ProgramResult result = run(fmt::format("convert {}", arguments));
        EXPECT_EQ(result.exit_code, code) << arguments;
        return result.err;
    };
    EXPECT_THAT(failure("a.vdb b.exr", 2), HasSubstr("b.exr: a deep image holds sight rays"));
    EXPECT_THAT(failure("a.vdb b.vdx", 2), HasSubstr("ends in one of .vdb"));
    EXPECT_THAT(failure("a.vdb b.vdb --format vbd", 2), HasSubstr("did you mean \"vdb\"?"));
    EXPECT_THAT(failure("a.vdb b.planes --dither floyd", 2), HasSubstr("--dither"));
    put_bytes(folder / "a.npy", npy_bytes("|u1", "2, 1, 1, 4", "\xff\xff\xff\xff\1\2\3\xff"));
    EXPECT_THAT(failure("a.npy b.qb", 2), HasSubstr("voxels are written as .vox"));
    EXPECT_THAT(failure("b.vdb c.vdb", 4), HasSubstr("no such file"));
    failure("a.vdb", 2);
    failure("a.vdb nowhere/b.vdb", 5);
    put_bytes(folder / "a.vdb", bytes_of(folder / "a.vdb") + "x");
    EXPECT_THAT(failure("a.vdb b.raw", 4), HasSubstr("damaged"));
}

TEST_F(CliConvertTest, InfoDescribesVolumes) {
    const Volume lattice = lattice_volume(), rays = rays_volume();
    const auto info = [&](const char* name) {
        const ProgramResult result = run(fmt::format("info --json {}", name));
        EXPECT_EQ(result.exit_code, 0) << name << result.err;
        return nlohmann::json::parse(result.out);
    };
    for (const char* name : {"a.vdb", "a.nrrd", "a.raw", "a.planes", "a.kv6"})
        write_volume(folder / name, lattice);
    write_volume(folder / "a.exr", rays);
    for (const char* name : {"a.vdb", "a.nrrd", "a.json"}) {
        const auto report = info(name);
        EXPECT_EQ(report["layout"], "lattice") << name;
        EXPECT_EQ(report["size"], nlohmann::json({7, 5, 3})) << name;
        EXPECT_EQ(report["attributes"]["scene"], "room.json") << name;
    }
    EXPECT_EQ(info("a.vdb")["grids"].size(), 6u);
    EXPECT_EQ(info("a.vdb")["voxels"], lattice.indices.size());
    EXPECT_EQ(info("a.exr")["kind"], "deep OpenEXR volume");
    EXPECT_EQ(info("a.exr")["step"], 0.3);
    EXPECT_EQ(info("a.planes.json")["format"], "planes");
    EXPECT_EQ(info("a.kv6")["size"], nlohmann::json({7, 3, 5}));
    put_bytes(folder / "other.json", "{\"volume\": 1}");
    EXPECT_EQ(run("info other.json").exit_code, 4);
}

}  // namespace voxelume
