// SPDX-License-Identifier: Apache-2.0
// The system calls that a helper program can no longer make, and those that it still can.
#include "runtime/base/helper/helper_calls.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "runtime/base/helper/helper_limits.hpp"
#include "runtime/base/sanitizers.hpp"

namespace voxelume {
namespace {

/// Each case runs in its own process, which keeps its filter, and ends with 0.
class HelperCallsDeathTest : public testing::Test {
  protected:
    void SetUp() override {
        if (kHasSanitizer || (prctl(PR_GET_SECCOMP) < 0 && errno == EINVAL))
            GTEST_SKIP() << "sanitizers need all calls, or the kernel has no filter";
        GTEST_FLAG_SET(death_test_style, "threadsafe");
    }
};

/// Ends the process with 0 if a call failed because it is forbidden.
[[noreturn]] void end_if_forbidden(bool failed) {
    _exit(failed && errno == EPERM ? 0 : 1);
}

#define EXPECT_FORBIDDEN(call)                    \
    EXPECT_EXIT(                                  \
        {                                         \
            if (!forbid_system_calls()) _exit(2); \
            end_if_forbidden((call));             \
        },                                        \
        testing::ExitedWithCode(0), "")

TEST_F(HelperCallsDeathTest, NoFileIsOpenedOrChanged) {
    EXPECT_FORBIDDEN(open("/etc/passwd", O_RDONLY) < 0);
    EXPECT_FORBIDDEN(open("/tmp", O_TMPFILE | O_RDWR, 0600) < 0);
    EXPECT_FORBIDDEN(unlink("/tmp/there_is_none") < 0);
    EXPECT_FORBIDDEN(rename("/tmp/there_is_none", "/tmp/nor_this") < 0);
    EXPECT_FORBIDDEN(mkdir("/tmp/there_is_none", 0700) < 0);
    EXPECT_FORBIDDEN(chmod("/tmp/there_is_none", 0777) < 0);
}

TEST_F(HelperCallsDeathTest, NothingIsToldToOthers) {
    EXPECT_FORBIDDEN(socket(AF_INET, SOCK_STREAM, 0) < 0);
    EXPECT_FORBIDDEN(socket(AF_UNIX, SOCK_STREAM, 0) < 0);
    EXPECT_FORBIDDEN(kill(getppid(), 0) < 0);
    EXPECT_FORBIDDEN(prctl(PR_SET_PDEATHSIG, 0) < 0);
}

TEST_F(HelperCallsDeathTest, ThreadsOfBeforeAndAfterCompute) {
    EXPECT_EXIT(
        {
            std::atomic<bool> is_forbidden = false;
            std::atomic<int> refused = 0;
            const auto refuse = [&] { refused += open("/", O_RDONLY) < 0 && errno == EPERM; };
            std::thread before([&] {
                while (!is_forbidden) std::this_thread::yield();
                refuse();
            });
            if (!forbid_system_calls()) _exit(2);
            is_forbidden = true;
            before.join();
            std::thread(refuse).join();
            _exit(refused == 2 ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

TEST_F(HelperCallsDeathTest, NoProgramStarts) {
    EXPECT_FORBIDDEN(fork() < 0);
    EXPECT_FORBIDDEN(execl("/bin/true", "true", nullptr) < 0);
}

TEST_F(HelperCallsDeathTest, NoMemoryBecomesCode) {
    EXPECT_FORBIDDEN(mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC,
                          MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED);
    EXPECT_FORBIDDEN(mprotect(std::aligned_alloc(4096, 4096), 4096, PROT_READ | PROT_EXEC) < 0);
}

TEST_F(HelperCallsDeathTest, ItsFilesAndItsMemoryStayInUse) {
    EXPECT_EXIT(
        {
            const int file = open("/proc/self/exe", O_RDONLY);
            int ends[2] = {};
            const bool is_ready =
                pipe(ends) == 0 && limit_helper({1u << 30, 2u << 30, 9}) && forbid_system_calls();
            char bytes[4] = {};
            bool is_right = is_ready && pread(file, bytes, 4, 0) == 4;
            is_right &= std::memcmp(bytes, "\177ELF", 4) == 0;
            is_right &= write(ends[1], bytes, 4) == 4 && read(ends[0], bytes, 4) == 4;
            const auto fits = [](size_t size) {
                void* volatile taken = std::malloc(size);  // which no compiler leaves out
                return taken != nullptr;
            };
            is_right &= fits(size_t{1} << 28) && !fits(size_t{1} << 30);
            raise_memory_limit();
            is_right &= fits(size_t{1} << 30);
            _exit(is_right ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

TEST_F(HelperCallsDeathTest, ItEndsAsADamagedProgramDoes) {
    EXPECT_EXIT(if (forbid_system_calls()) std::abort(), testing::KilledBySignal(SIGABRT), "");
    EXPECT_EXIT(
        {
            if (!forbid_system_calls()) _exit(2);
            try {
                throw std::bad_alloc();
            } catch (const std::exception&) {
                _exit(0);
            }
        },
        testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace voxelume
