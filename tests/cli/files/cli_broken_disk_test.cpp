// SPDX-License-Identifier: Apache-2.0
// Disks on which one call fails, or writes another byte, and all others go well.
#include <gmock/gmock.h>

#include "runtime/io/volume_file.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

class CliBrokenDisk : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        Volume volume = lattice_volume();
        volume.attributes["stamp"] =
            "voxelume-frame=0123456789abcdef0123456789abcdef check=0000000000000000";
        write_volume(folder / "v.nrrd", volume);
    }

    /// Converts to out/v.nrrd with a fault of call `number`.
    ProgramResult convert(long number, const std::string& fault) const {
        std::filesystem::remove_all(folder / "out");
        std::filesystem::create_directory(folder / "out");
        return run_line(
            fmt::format("env LD_PRELOAD='{}' VXL_WRITE_FAULT='{}':{}:{} VXL_WRITE_COUNTS=counts "
                        "voxelume convert v.nrrd out/v.nrrd",
                        VXL_WRITE_FAULTS, (folder / "out").string(), number, fault));
    }
    size_t files() const {
        const std::filesystem::directory_iterator all(folder / "out");
        return size_t(std::distance(begin(all), end(all)));
    }
};

TEST_F(CliBrokenDisk, ACallThatFailsOnceLeavesNoFile) {
    ASSERT_EQ(convert(0, "5").exit_code, 0) << bytes_of(folder / "stderr.txt");
    const std::string whole = bytes_of(folder / "out" / "v.nrrd");
    const long count = std::stol(bytes_of(folder / "counts"));
    ASSERT_GE(count, 6);  // header, values, stamp, file, name, folder
    for (long number = 1; number <= count; ++number) {
        const ProgramResult result = convert(number, "5:once");
        EXPECT_EQ(result.exit_code, 5) << number;
        EXPECT_THAT(result.err, HasSubstr("out/v.nrrd: ")) << number;
        EXPECT_THAT(result.err, HasSubstr("Input/output error")) << number;
        if (number < count) {
            EXPECT_THAT(result.err, HasSubstr("can't be written: ")) << number;
            EXPECT_EQ(files(), 0u) << number;
        } else {  // the folder's entry isn't known to be on the disk
            EXPECT_THAT(result.err, HasSubstr("is written and whole, but may be lost"));
            EXPECT_TRUE(bytes_of(folder / "out" / "v.nrrd") == whole);
        }
    }
}

TEST_F(CliBrokenDisk, AByteThatIsWrittenWronglyLeavesNoFile) {
    ASSERT_EQ(convert(0, "5").exit_code, 0) << bytes_of(folder / "stderr.txt");
    const long count = std::stol(bytes_of(folder / "counts"));
    size_t refused = 0;
    for (long number = 1; number <= count; ++number) {
        const ProgramResult result = convert(number, "wrong");
        if (result.exit_code == 0) continue;  // this call writes no bytes
        ++refused;
        EXPECT_EQ(result.exit_code, 5) << number;
        EXPECT_THAT(result.err, HasSubstr("other bytes are read back than were written")) << number;
        EXPECT_EQ(files(), 0u) << number;
    }
    EXPECT_EQ(refused, size_t(count - 3));  // syncs of the file and the folder, and its name
}

}  // namespace
}  // namespace voxelume
