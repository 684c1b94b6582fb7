// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/input_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "runtime/base/files/file_hash.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

using InputFileTest = FileTest;

TEST_F(InputFileTest, ReadsAllUpToALimit) {
    const std::string bytes("a\0b", 3);
    put_bytes(folder / "a", bytes);
    EXPECT_EQ(InputFile(folder / "a").read_all(3), bytes);
    const Error error = error_of([&] { InputFile(folder / "a").read_all(2); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), HasSubstr("/a: 3 bytes, and such a file has at most 2"));
    std::filesystem::resize_file(folder / "a", uintmax_t{1} << 40);  // takes no room on the disk
    EXPECT_EQ(error_of([&] { InputFile(folder / "a").read_all(1 << 20); }).kind(),
              ErrorKind::limit);
}

TEST_F(InputFileTest, RefusesWhatIsNoPlainFileWithoutWaiting) {
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("/proc/kmsg", folder / "link");
    for (const std::filesystem::path& file :
         {folder, folder / "pipe", folder / "link", std::filesystem::path("/dev/zero"),
          std::filesystem::path("/proc/self/mem"), std::filesystem::path("/proc/self/environ"),
          std::filesystem::path("/sys/kernel/profiling")}) {
        EXPECT_EQ(error_of([&] { InputFile input(file); }).exit_code(), 4) << file;
        EXPECT_EQ(hash_of_file(file), "") << file;
    }
}

}  // namespace
}  // namespace voxelume
