// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "runtime/base/files/process_tag.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/setting.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

using TemporaryFolderTest = FileTest;

TEST_F(TemporaryFolderTest, IsTheUsersAloneAndGoesWithItsOwner) {
    const Setting setting("TMPDIR", folder.c_str());
    {
        const TemporaryFolder one, two;
        EXPECT_NE(one.path(), two.path());
        EXPECT_EQ(one.path().parent_path(), folder);
        EXPECT_EQ(fs::status(one.path()).permissions(), fs::perms::owner_all);
        put_bytes(one.path() / "a", "bytes");
    }
    EXPECT_EQ(files_in_folder(), 0u);
    const TemporaryFolder unfinished;
    delete_temporary_files();
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(TemporaryFolderTest, WhatAKilledProcessLeftGoesWithTheNextOne) {
    const Setting setting("TMPDIR", folder.c_str());
    const pid_t child = fork();
    if (child == 0) _exit(0);
    const std::string tag = process_tag(), own = std::to_string(getpid());
    const size_t at = tag.find("." + own + ".");
    const std::string dead = std::string(tag).replace(at + 1, own.size(), std::to_string(child));
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    const std::string left = "voxelume." + dead + "-a1B2c3", living = "voxelume." + tag + "-a1B2c3";
    fs::create_directory(folder / left);
    put_bytes(folder / left / "a", "bytes");
    fs::create_directory(folder / living);
    fs::create_directory(folder / "voxelume-doctor-a1B2c3");
    fs::create_directory(folder / "target");
    put_bytes(folder / "target" / "a", "bytes");
    fs::create_directory_symlink("target", folder / ("voxelume." + dead + "-d4E5f6"));
    { const TemporaryFolder next; }
    EXPECT_FALSE(fs::exists(folder / left));
    EXPECT_TRUE(fs::exists(folder / living)) << "its process lives";
    EXPECT_TRUE(fs::exists(folder / "voxelume-doctor-a1B2c3"));
    EXPECT_TRUE(fs::exists(folder / "target" / "a")) << "a link was followed";
}

}  // namespace
}  // namespace voxelume
