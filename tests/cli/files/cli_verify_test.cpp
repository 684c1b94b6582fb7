// SPDX-License-Identifier: Apache-2.0
// info --verify of voxels and of raw data.
#include <gmock/gmock.h>

#include "runtime/io/volume_file.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

using testing::HasSubstr;

class CliVerifyTest : public ProgramTest {};

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

}  // namespace voxelume
