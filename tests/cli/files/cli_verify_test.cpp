// SPDX-License-Identifier: Apache-2.0
// info --verify of voxels and of raw data.
#include <gmock/gmock.h>

#include "runtime/io/volume_file.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

using testing::HasSubstr;

class CliVerifyTest : public ProgramTest {
  protected:
    void write_statistics() const {
        put_bytes(
            folder / "empty.json",
            R"({"voxelume": 1, "world": {"bounds": {"min": [0, 0, 0], "max": [1, 1, 1]}, "resolution": 16}, "objects": []})");
        const ProgramResult result =
            run("render empty.json -q --size 8x8 -o e.exr --stats-json s.json");
        EXPECT_EQ(result.exit_code, 0) << result.err;
    }
};

TEST_F(CliVerifyTest, TakesVoxelsWhereTheirFormatHasAPlaceForAChecksum) {
    const std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, 1), }";
    put_bytes(folder / "a.npy", std::string("\x93NUMPY\1\0", 8) + char(header.size() + 1) + '\0' +
                                    header + '\n' + std::string("\1\0\1\1\0\1", 6));
    for (const std::string name : {"b.nrrd", "b.vdb", "b.vxm"}) {
        EXPECT_EQ(run("convert a.npy " + name).exit_code, 0) << name;
        EXPECT_EQ(run("info --verify " + name).exit_code, 0) << name;
    }
    for (const std::string name : {"b.vox", "b.kv6", "b.binvox", "b.npy"}) {
        EXPECT_EQ(run("convert a.npy " + name).exit_code, 0) << name;
        const ProgramResult result = run("info --verify " + name);
        EXPECT_EQ(result.exit_code, 4) << name;
        EXPECT_THAT(result.err, HasSubstr("its format has no place for a checksum")) << name;
    }
}

TEST_F(CliVerifyTest, TakesRawDataByTheirHeader) {
    write_volume(folder / "v.raw", lattice_volume());
    const ProgramResult whole = run("info --verify v.raw");
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_THAT(whole.out, HasSubstr("raw volume"));
    std::string bytes = bytes_of(folder / "v.raw");
    bytes[1656] ^= 4;
    put_bytes(folder / "v.raw", bytes);
    const ProgramResult damaged = run("info --verify v.raw");
    EXPECT_EQ(damaged.exit_code, 4);
    EXPECT_THAT(damaged.err, HasSubstr("v.raw: is damaged, or the header or data beside it"));
}

TEST_F(CliVerifyTest, FindsAChangedByteOfPicturesPagesAndStatistics) {
    write_volume(folder / "v.nrrd", lattice_volume());
    EXPECT_EQ(run("view v.nrrd -o v.png -o v.html --size 64x64").exit_code, 0);
    EXPECT_EQ(run("diff v.png v.png -o d.png --flip-map f.exr").exit_code, 0);
    EXPECT_EQ(run("convert v.nrrd v.ply").exit_code, 0);
    write_statistics();
    for (const std::string name : {"v.png", "v.html", "d.png", "f.exr", "v.ply", "s.json"}) {
        const ProgramResult whole = run("info --verify " + name);
        // The program describes no volumetric .ply, which it doesn't read.
        if (name != "v.ply") EXPECT_EQ(whole.exit_code, 0) << name << ": " << whole.err;
        EXPECT_THAT(whole.err, testing::Not(HasSubstr("checksum"))) << name;
        std::string bytes = bytes_of(folder / name);
        bytes[bytes.size() - 5] ^= 1;
        put_bytes(folder / name, bytes);
        const ProgramResult damaged = run("info --verify " + name);
        EXPECT_EQ(damaged.exit_code, 4) << name;
        EXPECT_THAT(damaged.err, HasSubstr(name + ": is damaged")) << name;
    }
}

TEST_F(CliVerifyTest, DescribesPagesAndStatistics) {
    write_volume(folder / "v.nrrd", lattice_volume());
    EXPECT_EQ(run("view v.nrrd -o v.html").exit_code, 0);
    EXPECT_THAT(run("info v.html").out, HasSubstr("page of a volumetric image"));
    write_statistics();
    EXPECT_THAT(run("info s.json").out, HasSubstr("statistics of a run"));
    put_bytes(folder / "foreign.html", "<!doctype html><title>a</title>");
    EXPECT_THAT(run("info foreign.html").err, HasSubstr("is no page of a volumetric image"));
}

}  // namespace voxelume
