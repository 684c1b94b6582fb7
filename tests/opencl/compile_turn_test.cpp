// SPDX-License-Identifier: Apache-2.0
// Who compiles what a cache lacks, and that nobody waits for a process that has ended.
#include "runtime/opencl/source/compile_turn.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <future>

#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

constexpr std::chrono::milliseconds kMoment(100);

class CompileTurnTest : public FileTest {
  protected:
    DiskCache cache() const { return {folder / "programs", 1 << 20}; }

    int hidden_files() const {
        int count = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "programs"))
            count += entry.path().filename().string().starts_with('.');
        return count;
    }
};

TEST_F(CompileTurnTest, TheSecondWaitsForTheEntryOfTheFirst) {
    CompileTurn first;
    ASSERT_FALSE(first.read(cache(), "a"));
    EXPECT_TRUE(first.is_taken());
    CompileTurn second;
    auto waiting = std::async(std::launch::async, [&] { return second.read(cache(), "a"); });
    EXPECT_EQ(waiting.wait_for(kMoment), std::future_status::timeout);
    cache().write("a", "compiled");
    first.release();
    EXPECT_EQ(waiting.get(), "compiled");
    EXPECT_FALSE(second.is_taken());
    EXPECT_EQ(hidden_files(), 0);
}

TEST_F(CompileTurnTest, TheSecondCompilesWhereTheFirstKeptNothing) {
    CompileTurn first, second;
    first.read(cache(), "a");
    auto waiting = std::async(std::launch::async, [&] { return second.read(cache(), "a"); });
    EXPECT_EQ(waiting.wait_for(kMoment), std::future_status::timeout);
    first.release();
    EXPECT_FALSE(waiting.get());
    EXPECT_TRUE(second.is_taken());
    EXPECT_EQ(hidden_files(), 1);
}

TEST_F(CompileTurnTest, NobodyWaitsForAnotherEntryNorWithATurn) {
    CompileTurn first, second;
    first.read(cache(), "a");
    EXPECT_FALSE(second.read(cache(), "b"));
    EXPECT_TRUE(second.is_taken());
    EXPECT_FALSE(first.read(cache(), "b"));  // as `second.read(cache(), "a")` they would both wait
    EXPECT_FALSE(second.read(cache(), "a"));
}

TEST_F(CompileTurnTest, WaitingEndsInAll) {
    CompileTurn first, other;
    first.read(cache(), "a");
    other.read(cache(), "b");
    CompileTurn second(kMoment);
    EXPECT_FALSE(second.read(cache(), "a"));
    EXPECT_FALSE(second.is_taken());
    EXPECT_FALSE(second.read(cache(), "b"));
    EXPECT_FALSE(second.is_taken());
    EXPECT_FALSE(second.read(cache(), "c"));
}

TEST_F(CompileTurnTest, AKilledProcessHasNoTurn) {
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
        CompileTurn turn;
        turn.read(cache(), "a");
        const char is_taken = turn.is_taken() ? 1 : 0;
        if (write(ready[1], &is_taken, 1) != 1) _exit(1);
        pause();
        _exit(1);
    }
    char is_taken = 0;
    ASSERT_EQ(read(ready[0], &is_taken, 1), 1);
    EXPECT_EQ(is_taken, 1);
    CompileTurn second;
    auto waiting = std::async(std::launch::async, [&] { return second.read(cache(), "a"); });
    EXPECT_EQ(waiting.wait_for(kMoment), std::future_status::timeout);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_FALSE(waiting.get());
    EXPECT_TRUE(second.is_taken());
    second.release();
    EXPECT_EQ(hidden_files(), 0);
    close(ready[0]);
    close(ready[1]);
}

TEST_F(CompileTurnTest, ThereAreNoTurnsWhereNoFileCanBeMade) {
    CompileTurn turn;
    for (const char* place : {"", "/proc/none", "/dev/null/programs"}) {
        EXPECT_FALSE(turn.read(DiskCache(place, 1 << 20), "a")) << place;
        EXPECT_FALSE(turn.is_taken()) << place;
    }
    std::filesystem::create_directories(folder / "programs" / ".a.turn");
    std::filesystem::permissions(folder / "programs", std::filesystem::perms::owner_all);
    EXPECT_FALSE(turn.read(cache(), "a"));
    EXPECT_FALSE(turn.is_taken());
}

}  // namespace
}  // namespace voxelume
