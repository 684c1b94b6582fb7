// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/disk_cache.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "runtime/base/files/private_folder.hpp"
#include "runtime/base/files/process_tag.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/setting.hpp"

namespace voxelume {
namespace {

using DiskCacheFiles = FileTest;

namespace fs = std::filesystem;

std::string key_of(std::string_view text) {
    const std::string_view parts[] = {text};
    return cache_key(parts);
}

TEST_F(DiskCacheFiles, GivesBackWhatWasWritten) {
    const DiskCache cache(folder / "new" / "deep", 1000);
    const std::string bytes("a\0b\n\xff", 5);
    cache.write(key_of("one"), bytes);
    EXPECT_EQ(cache.read(key_of("one")), bytes);
    EXPECT_EQ(cache.read(key_of("two")), std::nullopt);
}

TEST_F(DiskCacheFiles, SaysWhyItCannotBeWrittenWithoutWriting) {
    EXPECT_EQ(DiskCache(folder / "new" / "deep", 1000).refusal(), "");
    EXPECT_FALSE(fs::exists(folder / "new"));
    EXPECT_EQ(DiskCache({}, 1000).refusal(), "");
    std::ofstream(folder / "file") << "no folder";
    EXPECT_EQ(DiskCache(folder / "file", 1000).refusal(), "Not a directory");
    EXPECT_EQ(DiskCache(folder / "file" / "deep", 1000).refusal(), "Not a directory");
    EXPECT_EQ(DiskCache(folder, 1000).refusal(), "");
    EXPECT_NE(DiskCache("/proc/cache", 1000).refusal(), "");
    if (geteuid() == 0) return;  // for whom all else can be written
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms::owner_read);
    EXPECT_EQ(DiskCache(folder / "locked" / "deep", 1000).refusal(), "Permission denied");
}

TEST_F(DiskCacheFiles, WhatIsMissingIsReadFromBasesToWhichNothingIsWritten) {
    const fs::path base = folder / "base", own = folder / "own";
    const std::string in_base = key_of("base"), in_both = key_of("both"), in_own = key_of("own");
    DiskCache(base, 1000).write(in_base, "from base");
    DiskCache(base, 1000).write(in_both, "from base");
    const DiskCache cache(own, 1000, {folder / "none", base});
    cache.write(in_both, "from own");
    cache.write(in_own, "from own");
    EXPECT_EQ(cache.read(in_base), "from base");
    EXPECT_EQ(cache.read(in_both), "from own");
    EXPECT_EQ(cache.read(in_own), "from own");
    EXPECT_FALSE(fs::exists(base / in_own));
    EXPECT_FALSE(fs::exists(own / in_base));
    EXPECT_EQ(DiskCache({}, 1000, {base}).read(in_base), "from base");
}

TEST_F(DiskCacheFiles, ADamagedEntryOfABaseIsAbsentAndStays) {
    const std::string key = key_of("program");
    DiskCache(folder / "base", 1000).write(key, "whole");
    std::ofstream(folder / "base" / key, std::ios::app) << "more";
    const DiskCache cache(folder / "own", 1000, {folder / "base"});
    EXPECT_EQ(cache.read(key), std::nullopt);
    EXPECT_TRUE(fs::exists(folder / "base" / key));
    cache.write(key, "again");
    EXPECT_EQ(cache.read(key), "again");
}

TEST_F(DiskCacheFiles, ABaseThatOthersMayWriteToIsNotRead) {
    const std::string key = key_of("program");
    DiskCache(folder / "base", 1000).write(key, "whole");
    fs::permissions(folder / "base", fs::perms::group_write, fs::perm_options::add);
    EXPECT_EQ(DiskCache(folder / "own", 1000, {folder / "base"}).read(key), std::nullopt);
}

TEST(DiskCache, TheLastFolderOfTheVariableIsWrittenToAndThoseBeforeItAreBases) {
    {
        const Setting folders("VOXELUME_CACHE_DIR", "/a:/b c::/d");
        EXPECT_EQ(cache_folder(), "/d");
        EXPECT_EQ(cache_bases("x"), (std::vector<fs::path>{"/a/x", "/b c/x"}));
    }
    {
        const Setting folders("VOXELUME_CACHE_DIR", "/a:");
        EXPECT_EQ(cache_folder(), "");
        EXPECT_EQ(cache_bases(), std::vector<fs::path>{"/a"});
    }
    const Setting folders("VOXELUME_CACHE_DIR", "/a");
    EXPECT_EQ(cache_folder(), "/a");
    EXPECT_TRUE(cache_bases().empty());
}

TEST(DiskCache, AKeyDependsOnWhereItsPartsEnd) {
    const std::string_view left[] = {"ab", "c"}, right[] = {"a", "bc"};
    EXPECT_NE(cache_key(left), cache_key(right));
    EXPECT_EQ(cache_key(left).size(), 32u);
}

TEST_F(DiskCacheFiles, AnEntryDamagedAnywhereIsAbsentAndRemoved) {
    const DiskCache cache(folder, 100000);
    const std::string key = key_of("program");
    const fs::path path = folder / key;
    const std::string bytes(300, 'x');
    cache.write(key, bytes);
    const auto whole_size = fs::file_size(path);
    for (uintmax_t size = 0; size < whole_size; size += 7) {
        cache.write(key, bytes);
        fs::resize_file(path, size);
        EXPECT_EQ(cache.read(key), std::nullopt) << "truncated to " << size;
    }
    for (uintmax_t offset = 0; offset < whole_size; offset += 7) {
        cache.write(key, bytes);
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        file.seekg(std::streamoff(offset));
        const char flipped = static_cast<char>(file.get() ^ 1);
        file.seekp(std::streamoff(offset));
        file.put(flipped);
        file.close();
        EXPECT_EQ(cache.read(key), std::nullopt) << "bit flipped at " << offset;
        EXPECT_FALSE(fs::exists(path));
    }
}

TEST_F(DiskCacheFiles, AnEntryUnderAnotherNameIsAbsent) {
    const DiskCache cache(folder, 1000);
    cache.write(key_of("one"), "bytes of one");
    fs::rename(folder / key_of("one"), folder / key_of("two"));
    EXPECT_EQ(cache.read(key_of("two")), std::nullopt);
}

TEST_F(DiskCacheFiles, WhatWasUsedLongestAgoGoesFirst) {
    const DiskCache cache(folder, 3 * 1056 + 100);  // three entries of 1000 bytes
    const auto now = fs::file_time_type::clock::now();
    int age = 30;
    for (const char* name : {"a", "b", "c"}) {
        cache.write(key_of(name), std::string(1000, *name));
        fs::last_write_time(folder / key_of(name), now - std::chrono::seconds(age--));
    }
    EXPECT_TRUE(cache.read(key_of("a")));  // used just now
    cache.write(key_of("d"), std::string(1000, 'd'));
    EXPECT_TRUE(cache.read(key_of("a")));
    EXPECT_FALSE(cache.read(key_of("b")));
    EXPECT_TRUE(cache.read(key_of("c")));
    EXPECT_TRUE(cache.read(key_of("d")));
}

TEST_F(DiskCacheFiles, FoldersAndEntriesAreTheUsersAlone) {
    const DiskCache cache(folder / "new" / "deep", 1000);
    cache.write(key_of("one"), "bytes");
    for (const fs::path& path : {folder / "new", folder / "new" / "deep"})
        EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_all) << path;
    EXPECT_EQ(fs::status(folder / "new" / "deep" / key_of("one")).permissions(),
              fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(DiskCacheFiles, AFolderThatOthersMayWriteToKeepsAndGivesNothing) {
    const DiskCache cache(folder / "cache", 1000);
    cache.write(key_of("one"), "bytes");
    for (const fs::perms others : {fs::perms::group_write, fs::perms::others_write}) {
        fs::permissions(folder / "cache", fs::perms::owner_all | others);
        EXPECT_EQ(cache.read(key_of("one")), std::nullopt);
        cache.write(key_of("two"), "bytes");
        EXPECT_FALSE(fs::exists(folder / "cache" / key_of("two")));
        EXPECT_EQ(cache.refusal(), "other users may write to it; `chmod go-w` forbids them");
    }
    fs::permissions(folder / "cache", fs::perms::owner_all);
    EXPECT_EQ(cache.read(key_of("one")), "bytes");
    if (geteuid() != 0) return;  // who alone can give folders away
    ASSERT_EQ(chown((folder / "cache").c_str(), 1, 1), 0);
    EXPECT_EQ(cache.read(key_of("one")), std::nullopt);
    EXPECT_EQ(cache.refusal(), "it belongs to another user");
}

TEST_F(DiskCacheFiles, LinksAndPipesAreNotFollowed) {
    const DiskCache real(folder / "real", 1000);
    real.write(key_of("one"), "bytes");
    fs::create_directory_symlink(folder / "real", folder / "link");
    for (const char* name : {"link", "link/"}) {
        const DiskCache linked(folder / name, 1000);
        EXPECT_EQ(linked.read(key_of("one")), std::nullopt);
        EXPECT_EQ(linked.refusal(), "a link in the place of a folder isn't followed");
        linked.write(key_of("two"), "bytes");
        EXPECT_FALSE(fs::exists(folder / "real" / key_of("two")));
    }
    fs::rename(folder / "real" / key_of("one"), folder / "one");
    fs::create_symlink(folder / "one", folder / "real" / key_of("one"));
    EXPECT_EQ(real.read(key_of("one")), std::nullopt);
    ASSERT_EQ(mkfifo((folder / "real" / key_of("three")).c_str(), 0600), 0);
    EXPECT_EQ(real.read(key_of("three")), std::nullopt);
}

TEST_F(DiskCacheFiles, AUsersOwnLinkMayLeadToTheCacheAndNoOtherUsers) {
    fs::create_directory(folder / "real");
    for (const char* link : {"link", "foreign"})
        fs::create_directory_symlink(folder / "real", folder / link);
    const DiskCache cache(folder / "link" / "models", 1000);
    cache.write(key_of("one"), "bytes");
    EXPECT_EQ(DiskCache(folder / "real" / "models", 1000).read(key_of("one")), "bytes");
    EXPECT_EQ(cache.refusal(), "");
    EXPECT_EQ(refusal_of_base(folder / "link"), "");
    if (geteuid() != 0) return;  // who alone can give links away
    ASSERT_EQ(lchown((folder / "foreign").c_str(), 1, 1), 0);
    const DiskCache foreign(folder / "foreign" / "models", 1000);
    EXPECT_EQ(foreign.read(key_of("one")), std::nullopt);
    EXPECT_EQ(foreign.refusal(), "another user's link leads to it");
    EXPECT_NE(refusal_of_base(folder / "foreign"), "");
    EXPECT_FALSE(make_safe_parent(folder / "foreign" / ""));
}

TEST_F(DiskCacheFiles, WhatAKilledProcessLeftIsRemoved) {
    const DiskCache cache(folder, 1000);
    const std::string tag = process_tag();
    const std::string host = tag.substr(0, tag.rfind('.', tag.rfind('.') - 1));
    put_bytes(folder / (".a.0." + host + ".4194305.1"), "half");
    put_bytes(folder / (".b.0." + tag), "half");
    cache.write(key_of("one"), "bytes");
    EXPECT_EQ(files_in_folder(), 2u);
    EXPECT_TRUE(fs::exists(folder / (".b.0." + tag)));
}

TEST_F(DiskCacheFiles, AFolderThatCannotBeMadeKeepsNothing) {
    std::ofstream(folder / "file") << "in the way";
    const DiskCache cache(folder / "file" / "cache", 1000);
    cache.write(key_of("one"), "bytes");
    EXPECT_EQ(cache.read(key_of("one")), std::nullopt);
}

TEST(CacheFolder, IsOursThenTheSystemsThenBelowHome) {
    const Setting ours("VOXELUME_CACHE_DIR", "/ours");
    const Setting system("XDG_CACHE_HOME", "/system");
    const Setting home("HOME", "/home/someone");
    EXPECT_EQ(cache_folder(), "/ours");
    const Setting empty("VOXELUME_CACHE_DIR", "");
    EXPECT_EQ(cache_folder(), "");
    const Setting not_ours("VOXELUME_CACHE_DIR", std::nullopt);
    EXPECT_EQ(cache_folder(), "/system/voxelume");
    const Setting not_the_systems("XDG_CACHE_HOME", std::nullopt);
    EXPECT_EQ(cache_folder(), "/home/someone/.cache/voxelume");
    const Setting not_home("HOME", std::nullopt);
    EXPECT_EQ(cache_folder(), "");
}

}  // namespace
}  // namespace voxelume
