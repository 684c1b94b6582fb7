// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/idle_cores.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

class IdleCores : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        put("load", "0.20 0.18 0.12 1/80 11206");
        put("groups", "0::/job/step");
    }
    void put(const std::filesystem::path& file, const std::string& line) const {
        std::filesystem::create_directories((folder / file).parent_path());
        put_bytes(folder / file, line + "\n");
    }
    int idle() const { return count_idle_cores({folder / "groups", folder}, folder / "load"); }

    const int cores = [] {
        cpu_set_t bound;
        EXPECT_EQ(sched_getaffinity(0, sizeof bound, &bound), 0);
        return CPU_COUNT(&bound);
    }();
};

TEST_F(IdleCores, AreThoseOnWhichNothingElseRuns) {
    EXPECT_EQ(idle(), cores - 1);
    put("load", "0.20 0.18 0.12 3/80 11206");
    EXPECT_EQ(idle(), cores - 3);
    put("load", "9.00 9.00 9.00 900/1000 11206");
    EXPECT_LE(idle(), 0);
}

/// Cores that a limit takes away from.
class LimitedIdleCores : public IdleCores {
  protected:
    void SetUp() override {
        IdleCores::SetUp();
        if (cores < 2) GTEST_SKIP() << "no limit shows on the one core that this process has";
    }
    /// Version 1 is mounted, too.
    void mount_both() const { put("unified/cgroup.controllers", "cpu memory"); }
};

TEST_F(LimitedIdleCores, AreThoseThatAControlGroupAllows) {
    put("job/cpu.max", "max 100000");
    EXPECT_EQ(idle(), cores - 1);
    put("job/step/cpu.max", "100000 100000");
    EXPECT_EQ(idle(), 0) << "the process itself takes the one core";
    put("job/step/cpu.max", "150000 100000");
    EXPECT_EQ(idle(), 0) << "half a core is left";
    put("job/step/cpu.max", "max 100000");
    put("job/cpu.max", "50000 100000");
    EXPECT_LT(idle(), 0) << "the group around it counts too";
}

TEST_F(LimitedIdleCores, AreThoseThatAContainersRootAllows) {
    put("groups", "0::/");
    EXPECT_EQ(idle(), cores - 1) << "the machine's root has no quota";
    put("cpu.max", "max 100000");
    EXPECT_EQ(idle(), cores - 1);
    put("cpu.max", "100000 100000");
    EXPECT_EQ(idle(), 0);
    put("groups", "0::/system.slice/docker-5f.scope");
    EXPECT_EQ(idle(), 0) << "the path is as it is outside of the container";
}

TEST_F(LimitedIdleCores, AreThoseOfTheFirstVersionsGroups) {
    mount_both();
    put("groups", "5:memory:/job\n4:cpu,cpuacct:/job");
    put("cpu/job/cpu.cfs_quota_us", "-1");
    put("cpu/job/cpu.cfs_period_us", "100000");
    EXPECT_EQ(idle(), cores - 1);
    put("cpu/job/cpu.cfs_quota_us", "100000");
    EXPECT_EQ(idle(), 0);
    put("groups", "5:cpuset:/job\n4:cpu:/");
    EXPECT_EQ(idle(), cores - 1) << "the group of another controller has no cores";
    put("cpu/cpu.cfs_quota_us", "100000");
    put("cpu/cpu.cfs_period_us", "100000");
    EXPECT_EQ(idle(), 0) << "a container's root";
}

/// Systemd mounts both versions unless it is told otherwise; either may have the cores.
TEST_F(LimitedIdleCores, AreThoseOfBothVersionsGroups) {
    mount_both();
    put("groups", "4:cpu,cpuacct:/job\n1:name=systemd:/job/step\n0::/job/step");
    put("cpu/job/cpu.cfs_quota_us", "-1");
    put("cpu/job/cpu.cfs_period_us", "100000");
    put("unified/job/step/cgroup.controllers", "");
    EXPECT_EQ(idle(), cores - 1);
    put("cpu/job/cpu.cfs_quota_us", "100000");
    EXPECT_EQ(idle(), 0);
    put("cpu/job/cpu.cfs_quota_us", "-1");
    put("unified/job/cpu.max", "100000 100000");
    EXPECT_EQ(idle(), 0);
    put("groups", "4:cpu,cpuacct:/\n0::/");
    EXPECT_EQ(idle(), cores - 1);
    put("unified/cpu.max", "100000 100000");
    EXPECT_EQ(idle(), 0);
}

TEST_F(LimitedIdleCores, AreThoseThatTheProcessIsBoundTo) {
    cpu_set_t before, first;
    ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
    CPU_ZERO(&first);
    for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&first) == 0; ++i)
        if (CPU_ISSET(i, &before)) CPU_SET(i, &first);
    ASSERT_EQ(sched_setaffinity(0, sizeof first, &first), 0);
    EXPECT_EQ(idle(), 0);
    ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}

}  // namespace
}  // namespace voxelume
