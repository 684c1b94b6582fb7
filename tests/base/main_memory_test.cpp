// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/main_memory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <limits>

#include "runtime/base/sanitizers.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kNone = std::numeric_limits<uint64_t>::max();

class MainMemory : public FileTest {
  protected:
    void TearDown() override {
        limit_main_memory(0);
        FileTest::TearDown();
    }
    /// The memory that the groups of `lines` allow; `folder` holds all groups.
    uint64_t allowed(const std::string& lines) {
        put_bytes(folder / "groups", lines);
        return control_group_memory({folder / "groups", folder});
    }
    void limit(const std::filesystem::path& file, const std::string& bytes) {
        std::filesystem::create_directories((folder / file).parent_path());
        put_bytes(folder / file, bytes + "\n");
    }
};

TEST_F(MainMemory, IsAtMostThatOfTheMachine) {
    const uint64_t machine = uint64_t(sysconf(_SC_PHYS_PAGES)) * uint64_t(sysconf(_SC_PAGE_SIZE));
    EXPECT_GT(main_memory(), 0u);
    EXPECT_LE(main_memory(), machine);
}

TEST_F(MainMemory, IsLessByWhatIsClaimed) {
    const uint64_t whole = main_memory();
    {
        const MainMemoryClaim claim(1000), other(24);
        EXPECT_EQ(main_memory(), whole - 1024);
        const MainMemoryClaim all(whole);
        EXPECT_EQ(main_memory(), 0u);
        EXPECT_EQ(claimed_memory(), whole + 1024);
        EXPECT_TRUE(has_room_for(1)) << "what is held of a claim would count twice";
    }
    EXPECT_EQ(main_memory(), whole);
}

TEST_F(MainMemory, IsAtMostTheLimitThatIsChosen) {
    const uint64_t whole = main_memory();
    EXPECT_EQ(chosen_memory_limit(), kNone);
    limit_main_memory(123456789);
    EXPECT_EQ(main_memory(), std::min<uint64_t>(whole, 123456789));
    limit_main_memory(kNone - 1);
    EXPECT_EQ(main_memory(), whole);
    limit_main_memory(0);
    EXPECT_EQ(main_memory(), whole);
}

TEST_F(MainMemory, HasNoRoomForMoreThanTheProcessLeavesOfIt) {
    if (kHasSanitizer) GTEST_SKIP() << "a sanitizer takes memory of its own";
    EXPECT_TRUE(has_room_for(1));
    EXPECT_FALSE(has_room_for(double(main_memory())));
    limit_main_memory(uint64_t{1} << 28);
    const std::vector<char> held(size_t{1} << 26, 'x');
    EXPECT_FALSE(has_room_for(double((uint64_t{1} << 28) - (uint64_t{1} << 26))));
    EXPECT_EQ(held.back(), 'x');  // so that no compiler leaves them out
    EXPECT_NO_THROW(require_room("a.png", "a picture", 1));
    EXPECT_THROW(require_room("a.png", "a picture", 1e10), Error);
    limit_main_memory(0);
}

TEST_F(MainMemory, OfAGroupIsTheMinimumOverItsParents) {
    limit("slurm/job_1/memory.max", "3000000");
    limit("slurm/job_1/step/memory.max", "max");
    limit("slurm/memory.max", "5000000");
    EXPECT_EQ(allowed("0::/slurm/job_1/step\n"), 3000000u);
    EXPECT_EQ(allowed("0::/slurm\n"), 5000000u);
    EXPECT_EQ(allowed("0::/other\n"), kNone);
    EXPECT_EQ(allowed("0::/\n"), kNone);
}

TEST_F(MainMemory, OfAGroupOfVersion1IsThatOfItsMemoryController) {
    limit("memory/docker/memory.limit_in_bytes", "2000000");
    limit("memory/memory.limit_in_bytes", "9223372036854771712");
    EXPECT_EQ(allowed("9:name=systemd:/\n4:memory:/docker\n1:cpu:/docker\n"), 2000000u);
    EXPECT_EQ(allowed("4:cpuset,memory:/docker/inner\n"), 2000000u);
    EXPECT_EQ(allowed("4:cpuset:/docker\n"), kNone);
}

TEST_F(MainMemory, OfGroupsOfBothVersionsIsTheirMinimum) {
    limit("unified/cgroup.controllers", "memory");
    limit("unified/job/memory.max", "4000000");
    limit("memory/job/memory.limit_in_bytes", "6000000");
    EXPECT_EQ(allowed("4:memory:/job\n1:cpu:/job\n0::/job\n"), 4000000u);
    limit("memory/job/memory.limit_in_bytes", "3000000");
    EXPECT_EQ(allowed("4:memory:/job\n1:cpu:/job\n0::/job\n"), 3000000u);
}

TEST_F(MainMemory, OfAContainerIsThatOfTheRootThatItSees) {
    limit("memory.max", "7000000");
    EXPECT_EQ(allowed("0::/../../a-path-of-outside\n"), 7000000u);
}

TEST_F(MainMemory, HasNoLimitWhereFilesAreMissingOrDamaged) {
    EXPECT_EQ(control_group_memory({folder / "none", folder}), kNone);
    EXPECT_EQ(allowed("no colons\n:\n\n"), kNone);
    limit("memory.max", "lots");
    EXPECT_EQ(allowed("0::/\n"), kNone);
}

}  // namespace
}  // namespace voxelume
