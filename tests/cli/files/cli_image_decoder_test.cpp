// SPDX-License-Identifier: Apache-2.0
// Commands have images decoded by the helper program: without it none is read.
#include <gmock/gmock.h>

#include "runtime/io/image/exr.hpp"
#include "runtime/io/volume_file.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/volume_samples.hpp"
#include "tests/support/writers/png_writer.hpp"

namespace voxelume {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

using CliImageDecoderTest = ProgramTest;

TEST_F(CliImageDecoderTest, CommandsDecodeNoImageThemselves) {
    const std::filesystem::path alone = folder / "bin/voxelume";  // where no helper is
    create_directory(alone.parent_path());
    copy_file(VXL_BINARY, alone);
    Image image{2, 1, {{"R", {1.0f, 2.0f}}}, {}, {}};
    write_exr(folder / "a.exr", image);
    write_volume(folder / "deep.exr", rays_volume());
    put_bytes(folder / "a.png", png_of_rows(1, 8, 0, {"1"}));
    put_bytes(folder / "slice1.png", png_of_rows(1, 8, 0, {"1"}));
    put_bytes(folder / "a.mtl", "newmtl skin\nmap_Kd a.png\n");
    put_bytes(folder / "a.obj",
              "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
              "usemtl skin\nf 1/1 2/2 3/3\n");
    const auto expect_refusal = [&](const std::string& arguments, const std::string& file) {
        const ProgramResult result = run_line(fmt::format("bin/voxelume {}", arguments));
        EXPECT_EQ(result.exit_code, 4) << arguments;
        EXPECT_THAT(result.err, HasSubstr(file + ": can't be read: "));
        EXPECT_THAT(result.err, EndsWith("voxelume-image-decoder can't be started: No such file "
                                         "or directory; install voxelume again\n"));
    };
    expect_refusal("info a.exr", "a.exr");
    expect_refusal("info a.png", "a.png");
    expect_refusal("info deep.exr", "deep.exr");
    expect_refusal("info 'slice#.png'", "slice1.png");
    expect_refusal("info a.obj", "a.png");
    expect_refusal("diff a.exr a.exr", "a.exr");
    expect_refusal("convert deep.exr b.nrrd", "deep.exr");
}

/// A thread's stack is as large as this limit by default.
TEST_F(CliImageDecoderTest, LargeStacksTakeNoneOfTheMemory) {
    write_exr(folder / "a.exr", {2, 1, {{"R", {1.0f, 2.0f}}}, {}, {}});
    const ProgramResult result =
        run_line("bash -c 'ulimit -s 400000 || exit 0; voxelume diff a.exr a.exr'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
}  // namespace voxelume
