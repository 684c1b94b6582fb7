// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/atomic_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/support/file_fixture.hpp"

namespace voxelume {

namespace fs = std::filesystem;
using testing::HasSubstr;

class AtomicFileTest : public FileTest {};

TEST_F(AtomicFileTest, CommittedBytesAreUnderTheName) {
    AtomicFile file(folder / "a.bin");
    file.write("voxel", 5);
    EXPECT_FALSE(fs::exists(folder / "a.bin"));
    file.commit();
    EXPECT_EQ(bytes_of(folder / "a.bin"), "voxel");
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(AtomicFileTest, WithoutCommitNothingIsLeft) {
    { AtomicFile(folder / "a.bin").write("voxel", 5); }
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(AtomicFileTest, WithoutCommitTheOldFileStays) {
    put_bytes(folder / "a.bin", "old");
    { AtomicFile(folder / "a.bin").write("voxel", 5); }
    EXPECT_EQ(bytes_of(folder / "a.bin"), "old");
}

TEST_F(AtomicFileTest, SeekingBackReplacesBytes) {
    AtomicFile file(folder / "a.bin");
    file.write("0123456789", 10);
    file.seek(2);
    file.write("ab", 2);
    EXPECT_EQ(file.position(), 4u);
    file.commit();
    EXPECT_EQ(bytes_of(folder / "a.bin"), "01ab456789");
}

TEST_F(AtomicFileTest, TheTemporaryFileIsHiddenBesideTheTarget) {
    AtomicFile file(folder / "a.bin");
    EXPECT_EQ(file.temporary().parent_path(), folder);
    EXPECT_THAT(file.temporary().filename().string(),
                testing::MatchesRegex("\\.a\\.bin\\..+\\.[0-9]+\\.tmp"));
}

TEST_F(AtomicFileTest, TwoWritersOfOneNameBothFinishAndTheLastOneWins) {
    AtomicFile first(folder / "a.bin"), second(folder / "a.bin");
    first.write("first", 5);
    second.write("second", 6);
    second.commit();
    first.commit();
    EXPECT_EQ(bytes_of(folder / "a.bin"), "first");
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(AtomicFileTest, AFullDiskIsAnOutputErrorAndLeavesNothing) {
    {
        AtomicFile file(folder / "a.bin");
        const std::string block(4096, 'x');
        const FileSizeLimit limit(10000);
        file.write(block.data(), block.size());
        file.write(block.data(), block.size());
        const Error error = error_of([&] { file.write(block.data(), block.size()); });
        EXPECT_EQ(error.exit_code(), 5);
        EXPECT_THAT(error.what(), HasSubstr("a.bin: can't be written: the file grows"));
    }
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(AtomicFileTest, AFailureThatWasSwallowedStillPreventsTheCommit) {
    {
        AtomicFile file(folder / "a.bin");
        {
            const FileSizeLimit limit(2);
            EXPECT_THROW(file.write("voxel", 5), Error);
        }
        EXPECT_EQ(error_of([&] { file.commit(); }).exit_code(), 5);
    }
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(AtomicFileTest, ALaterFailureDoesntHideTheFirst) {
    AtomicFile file(folder / "a.bin");
    {
        const FileSizeLimit limit(2);
        EXPECT_THROW(file.write("voxel", 5), Error);
    }
    const Error error = error_of([&] { file.fail("Error writing to stream"); });
    EXPECT_THAT(error.what(), HasSubstr("a.bin: can't be written: the file grows"));
}

TEST_F(AtomicFileTest, AFolderThatTakesNoFilesIsToldFromAMissingOne) {
    const Error error = error_of([&] { AtomicFile("/proc/a.bin"); });
    EXPECT_EQ(error.exit_code(), 5);
    EXPECT_THAT(error.what(), HasSubstr("the folder /proc "));
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("there is no folder")));
}

TEST_F(AtomicFileTest, AMissingFolderIsNamed) {
    const Error error = error_of([&] { AtomicFile(folder / "frames" / "a.bin"); });
    EXPECT_EQ(error.exit_code(), 5);
    EXPECT_THAT(error.what(), HasSubstr("there is no folder " + (folder / "frames").string()));
}

TEST_F(AtomicFileTest, AFileInPlaceOfTheFolderIsNamed) {
    put_bytes(folder / "frames", "");
    const Error error = error_of([&] { AtomicFile(folder / "frames" / "a.bin"); });
    EXPECT_THAT(error.what(), HasSubstr("frames isn't a folder"));
}

TEST_F(AtomicFileTest, AFolderUnderTheNameIsRefused) {
    fs::create_directory(folder / "a.bin");
    EXPECT_THAT(error_of([&] { AtomicFile(folder / "a.bin"); }).what(),
                HasSubstr("a folder has this name"));
}

TEST_F(AtomicFileTest, APipeIsRefusedAndNotReplaced) {
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(error_of([&] { AtomicFile(folder / "pipe"); }).exit_code(), 5);
    EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST_F(AtomicFileTest, ALinkIsFollowed) {
    fs::create_directory(folder / "store");
    fs::create_symlink("store/a.bin", folder / "latest");
    AtomicFile file(folder / "latest");
    file.write("voxel", 5);
    file.commit();
    EXPECT_TRUE(fs::is_symlink(folder / "latest"));
    EXPECT_EQ(bytes_of(folder / "store" / "a.bin"), "voxel");
}

TEST_F(AtomicFileTest, AFolderWithoutPermissionIsAnOutputError) {
    constexpr uid_t kNobody = 65534;
    const bool is_root = geteuid() == 0;  // root may write everywhere
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    ASSERT_TRUE(!is_root || seteuid(kNobody) == 0);
    const Error error = error_of([&] { AtomicFile(folder / "a.bin"); });
    ASSERT_TRUE(!is_root || seteuid(0) == 0);
    fs::permissions(folder, fs::perms::owner_all);
    EXPECT_EQ(error.exit_code(), 5);
    EXPECT_THAT(error.what(), HasSubstr("doesn't allow it"));
}

TEST_F(AtomicFileTest, ALongNameIsWritten) {
    const std::string name(250, 'n');
    AtomicFile file(folder / name);
    file.commit();
    EXPECT_TRUE(fs::exists(folder / name));
}

}  // namespace voxelume
