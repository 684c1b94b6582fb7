// SPDX-License-Identifier: Apache-2.0
// Helpers answer, end early, hang, or are missing; shells stand in for them.
#include "runtime/base/helper/helper_process.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/helper/helper_limits.hpp"
#include "runtime/base/helper/helper_program.hpp"
#include "runtime/base/helper/helper_wire.hpp"
#include "runtime/base/sanitizers.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {

using testing::HasSubstr;
using testing::Not;

namespace {

using Cause = HelperFailure::Cause;

class HelperProcessTest : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        put_bytes(folder / "in", "seven\n");
    }

    /// The answer, of `size` bytes, of a shell that runs `script`, within `seconds`.
    std::string answer_of(const std::string& script, size_t size, double seconds = 20) const {
        const InputFile input(folder / "in");
        HelperProcess helper("/bin/sh", {"-c", script}, input.descriptor(), seconds);
        std::string answer(size, '\0');
        for (size_t done = 0; done < size;) done += helper.read(answer.data() + done, size - done);
        return answer;
    }
    HelperFailure failure_of(const std::string& script, double seconds = 20) const {
        try {
            answer_of(script, 1, seconds);
        } catch (const HelperFailure& failure) {
            return failure;
        }
        ADD_FAILURE() << script << " answers";
        return {Cause::died, ""};
    }
};

TEST_F(HelperProcessTest, ReadsTheFileAndAnswersThroughThePipe) {
    EXPECT_EQ(answer_of("cat >&3; echo and more >&3", 15), "seven\nand more\n");
}

TEST_F(HelperProcessTest, HasNoOtherDescriptorsAndPrintsNothing) {
    const int file = open("/dev/null", O_RDONLY | O_CLOEXEC);
    const int leaked = fcntl(file, F_DUPFD, 100);  // without O_CLOEXEC, as a driver may have it
    EXPECT_EQ(answer_of("for d in /proc/self/fd/*; do echo -n ${d##*/} >&3; done; echo lost", 5),
              "0123" + std::to_string(4));  // 4 is the list of the folder itself
    close(file);
    close(leaked);
}

TEST_F(HelperProcessTest, ThatEndsBySignalSaysWhich) {
    const HelperFailure failure = failure_of("kill -SEGV $$");
    EXPECT_EQ(failure.cause(), Cause::died);
    EXPECT_THAT(failure.what(), HasSubstr("Segmentation fault"));
}

TEST_F(HelperProcessTest, ThatExitsWithoutAnAnswerIsNoHelper) {
    const HelperFailure failure = failure_of("exit 3");
    EXPECT_EQ(failure.cause(), Cause::missing);
    EXPECT_THAT(failure.what(), HasSubstr("/bin/sh ended with exit code 3"));
}

TEST_F(HelperProcessTest, ThatHangsIsEndedInTime) {
    const auto start = std::chrono::steady_clock::now();
    const std::filesystem::path file = folder / "pid";
    const HelperFailure failure = failure_of("echo $$ >" + file.string() + "; sleep 100", 0.2);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_EQ(failure.cause(), Cause::too_long);
    EXPECT_THAT(failure.what(), HasSubstr("more than 0.2 s"));
    const pid_t helper = std::stoi(bytes_of(file));
    EXPECT_EQ(kill(helper, 0), -1) << "the helper is gone";
}

TEST_F(HelperProcessTest, ThatStopsMidwayIsEndedInTime) {
    EXPECT_THROW(answer_of("printf half >&3; sleep 100", 8, 0.2), HelperFailure);
    EXPECT_THROW(answer_of("printf half >&3", 8), HelperFailure);
}

TEST_F(HelperProcessTest, ThatIsMissingIsNamed) {
    const InputFile input(folder / "in");
    try {
        const HelperProcess helper(folder / "gone", {}, input.descriptor(), 1);
        FAIL();
    } catch (const HelperFailure& failure) {
        EXPECT_EQ(failure.cause(), Cause::missing);
        EXPECT_THAT(failure.what(), HasSubstr((folder / "gone can't be started").string()));
    }
}

TEST_F(HelperProcessTest, ThatIsntInstalledIsNotTakenFromTheCurrentFolder) {
    const std::filesystem::path program = helper_program("voxelume-nothing");
    EXPECT_TRUE(program.is_absolute()) << program;
    const InputFile input(folder / "in");
    try {
        const HelperProcess helper(program, {}, input.descriptor(), 1);
        FAIL();
    } catch (const HelperFailure& failure) {
        EXPECT_THAT(failure.what(), HasSubstr("voxelume-nothing can't be started"));
        EXPECT_THAT(failure.what(), Not(HasSubstr("/voxelume-nothing")));
    }
}

TEST_F(HelperProcessTest, IsHeardByManyThreadsAtOnce) {
    std::atomic<int> right = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i)
        threads.emplace_back([&] {
            for (int turn = 0; turn < 20; ++turn) right += answer_of("cat >&3", 6) == "seven\n";
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(right, 160);
}

TEST_F(HelperProcessTest, CountsBeyondTheirLimitTakeNoMemory) {
    const auto receive = [&](const std::string& script, uint64_t max) {
        const InputFile input(folder / "in");
        HelperProcess helper("/bin/sh", {"-c", script}, input.descriptor(), 20);
        WireReceiver receiver(helper);
        return receiver.values<float>(max).size();
    };
    const std::string two = "printf '\\2\\0\\0\\0\\0\\0\\0\\0' >&3; ";
    EXPECT_EQ(receive(two + "printf 12345678 >&3", 2), 2u);
    EXPECT_THROW(receive(two + "printf 12345678 >&3", 1), HelperFailure);
    EXPECT_THROW(receive("printf '\\0\\0\\0\\0\\0\\0\\0\\1' >&3", UINT64_MAX), HelperFailure);
}

TEST(HelperLimitsDeathTest, MemoryComputingAndFilesEnd) {
    // Each case runs in its own process, which keeps its limits.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto limited = [] { return limit_helper({1u << 30, 2u << 30, 1}); };
    EXPECT_EXIT(
        {
            limited();
            while (getppid() >= 0) {
            }
        },
        testing::KilledBySignal(SIGXCPU), "");
    EXPECT_EXIT(
        {
            limited();
            const int file = open("/tmp", O_TMPFILE | O_RDWR, 0600);
            _exit(file >= 0 && write(file, "x", 1) == 1 ? 0 : 1);
        },
        testing::KilledBySignal(SIGXFSZ), "");
    if (kHasSanitizer) return;  // which takes more memory than there is
    EXPECT_EXIT(
        {
            const auto fits = [](size_t size) {
                void* volatile taken = std::malloc(size);  // which no compiler leaves out
                return taken != nullptr;
            };
            limited();
            const bool before = fits(size_t{1} << 30);
            raise_memory_limit();
            _exit(!before && fits(size_t{1} << 30) && !fits(size_t{2} << 30) ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace voxelume
