// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/atomic_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "runtime/base/files/process_tag.hpp"
#include "runtime/base/files/stamp.hpp"
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

TEST_F(AtomicFileTest, TheTemporaryFileIsHiddenNextToTheTarget) {
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

TEST_F(AtomicFileTest, OtherBytesThanWereWrittenGetNoName) {
    const std::string bytes(200000, 'v');
    for (const size_t at : {size_t(0), size_t(65536), bytes.size() - 1, bytes.size()}) {
        AtomicFile file(folder / "a.bin");
        file.write(bytes.data(), bytes.size());
        std::string changed = bytes + (at == bytes.size() ? "v" : "");
        changed[at] = 'w';
        put_bytes(file.temporary(), changed);
        const Error error = error_of([&] { file.commit(); });
        EXPECT_EQ(error.exit_code(), 5) << at;
        EXPECT_THAT(error.what(), HasSubstr("a.bin: can't be written: other bytes are read back"));
    }
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(AtomicFileTest, AStampSealsNoOtherBytesThanWereWritten) {
    {
        AtomicFile file(folder / "a.bin");
        const std::string bytes = stamp_of(kNoFrame) + std::string(200000, 'v');
        file.write(bytes.data(), bytes.size());
        put_bytes(file.temporary(), stamp_of(kNoFrame) + std::string(200000, 'w'));
        EXPECT_EQ(error_of([&] { file.commit(); }).exit_code(), 5);
    }
    EXPECT_EQ(files_in_folder(), 0u);
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

/// Tests of what killed processes leave.
class AtomicFileLeftovers : public AtomicFileTest {
  protected:
    /// Has another process begin to write two files of one name, and kills it.
    void kill_a_writer() const {
        GTEST_FLAG_SET(death_test_style, "fast");
        EXPECT_EXIT(
            {
                AtomicFile first(folder / "a.bin");
                const AtomicFile second(folder / "a.bin");
                first.write("voxel", 5);
                std::raise(SIGKILL);
            },
            testing::KilledBySignal(SIGKILL), "");
    }
    /// Makes a temporary file with the tag of some process.
    fs::path put_temporary(const std::string& tag) const {
        const fs::path path = folder / (".b.bin." + tag + ".tmp");
        put_bytes(path, "half");
        return path;
    }
    void write_one() const { AtomicFile(folder / "c.bin").commit(); }

    const std::string own = process_tag();
    const std::string host = own.substr(0, own.rfind('.', own.rfind('.') - 1));
};

TEST_F(AtomicFileLeftovers, AreRemovedByTheNextWriterOfTheFolder) {
    kill_a_writer();
    EXPECT_EQ(files_in_folder(), 2u);
    write_one();
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(AtomicFileLeftovers, OfProcessesThatNobodyAskedForTheirEndAreRemoved) {
    const pid_t ended = fork();
    if (ended == 0) {
        const AtomicFile file(folder / "a.bin");
        std::raise(SIGKILL);
    }
    siginfo_t info{};
    ASSERT_EQ(waitid(P_PID, id_t(ended), &info, WEXITED | WNOWAIT), 0);
    write_one();
    EXPECT_EQ(files_in_folder(), 1u);
    waitpid(ended, nullptr, 0);
}

TEST_F(AtomicFileLeftovers, OfProcessesWhoseNumberIsUsedAgainAreRemoved) {
    put_temporary(fmt::format("{}.{}.12345", host, getpid()));
    put_temporary(fmt::format("{}.{}.12345-17", host, getpid()));
    put_temporary(host + ".4194305.12345");  // above all numbers of processes
    write_one();
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(AtomicFileLeftovers, ThatMayBeAnothersWorkStay) {
    const fs::path kept[] = {put_temporary(own),
                             put_temporary(own + "-2"),
                             put_temporary("x" + host + ".4194305.12345"),
                             put_temporary(host + ".4194305"),
                             put_temporary(host + ".0.1"),
                             put_temporary("4194305.12345")};
    write_one();
    for (const fs::path& path : kept) EXPECT_TRUE(fs::exists(path)) << path;
}

TEST_F(AtomicFileLeftovers, StayWhileTheirWriterHoldsThem) {
    // This stands for a writer in another container of the same name, whose processes can't be
    // seen.
    const fs::path path = put_temporary(host + ".4194305.12345");
    const int held = open(path.c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(flock(held, LOCK_EX), 0);
    write_one();
    EXPECT_TRUE(fs::exists(path));
    close(held);
}

TEST_F(AtomicFileLeftovers, AWriterHoldsItsFileUntilItHasItsName) {
    AtomicFile file(folder / "a.bin");
    const int other = open(file.temporary().c_str(), O_RDONLY | O_CLOEXEC);
    EXPECT_NE(flock(other, LOCK_EX | LOCK_NB), 0);
    file.commit();
    EXPECT_EQ(flock(other, LOCK_EX | LOCK_NB), 0);
    close(other);
}

}  // namespace voxelume
