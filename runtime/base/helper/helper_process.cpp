// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/helper/helper_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

namespace voxelume {
namespace {

using Clock = std::chrono::steady_clock;
using Cause = HelperFailure::Cause;

/// Owns a descriptor and closes it in its destructor.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() {
        if (number_ >= 0) close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }
    int release() { return std::exchange(number_, -1); }

  private:
    int number_;
};

/// A copy of a descriptor, with a number that none of the helper's own descriptors will have.
int moved_away(int descriptor) {
    return fcntl(descriptor, F_DUPFD_CLOEXEC, kHelperAnswer + 1);
}

[[noreturn]] void fail_to_start(const std::filesystem::path& program, int code) {
    throw HelperFailure(
        Cause::missing,
        fmt::format("{} can't be started: {}; install voxelume again",
                    (program.parent_path() == "/" ? program.filename() : program).string(),
                    std::strerror(code)));
}

/// Everything that posix_spawn is told: descriptors and signals of the new process.
class SpawnPlan {
  public:
    SpawnPlan(int input, int answer) {
        posix_spawn_file_actions_init(&files_);
        posix_spawn_file_actions_adddup2(&files_, input, kHelperInput);
        posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&files_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&files_, answer, kHelperAnswer);
        posix_spawn_file_actions_addclosefrom_np(&files_, kHelperAnswer + 1);
        posix_spawnattr_init(&attributes_);
        sigset_t all, terminal;
        sigfillset(&all);
        sigemptyset(&terminal);
        // The terminal and schedulers signal whole groups: the helper ends with the process that
        // started it, not before it.
        for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&terminal, number);
        posix_spawnattr_setsigdefault(&attributes_, &all);
        posix_spawnattr_setsigmask(&attributes_, &terminal);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    }
    ~SpawnPlan() {
        posix_spawnattr_destroy(&attributes_);
        posix_spawn_file_actions_destroy(&files_);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;

    /// Returns the code of the failure, or 0.
    int start(const std::filesystem::path& program, const std::vector<std::string>& arguments,
              pid_t& process) const {
        std::vector<char*> words = {const_cast<char*>(program.c_str())};
        for (const std::string& argument : arguments)
            words.push_back(const_cast<char*>(argument.c_str()));
        words.push_back(nullptr);
        return posix_spawn(&process, program.c_str(), &files_, &attributes_, words.data(), environ);
    }

  private:
    posix_spawn_file_actions_t files_{};
    posix_spawnattr_t attributes_{};
};

}  // namespace

HelperProcess::HelperProcess(const std::filesystem::path& program,
                             const std::vector<std::string>& arguments, int input, double seconds)
    : program_(program),
      seconds_(seconds),
      deadline_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(seconds))) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail_to_start(program, errno);
    Descriptor reading(ends[0]);
    const Descriptor writing(ends[1]), answer(moved_away(ends[1])), file(moved_away(input));
    if (answer.number() < 0 || file.number() < 0) fail_to_start(program, errno);
    const int code = SpawnPlan(file.number(), answer.number()).start(program, arguments, process_);
    if (code != 0) fail_to_start(program, code);
    answer_ = reading.release();
    fcntl(answer_, F_SETPIPE_SZ, 1 << 20);  // fewer turns; unimportant where it isn't allowed
}

HelperProcess::~HelperProcess() {
    if (process_ > 0) {
        kill(process_, SIGKILL);
        while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    close(answer_);
}

void HelperProcess::wait_for_bytes() {
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now());
        pollfd bytes{answer_, POLLIN, 0};
        const int64_t milliseconds = std::clamp<int64_t>(left.count(), 0, INT_MAX);
        const int ready = poll(&bytes, 1, int(milliseconds));
        if (ready > 0) return;
        if (ready == 0)
            throw HelperFailure(Cause::too_long,
                                fmt::format("reading it took more than {:.3g} s", seconds_));
        if (errno != EINTR) throw HelperFailure(Cause::died, std::strerror(errno));
    }
}

size_t HelperProcess::read(void* data, size_t size) {
    for (;;) {
        wait_for_bytes();
        const ssize_t got = ::read(answer_, data, size);
        if (got > 0) return size_t(got);
        if (got == 0 || errno != EINTR) fail_without_answer();
    }
}

/// The status of a process that has closed its pipe, so that it should end at once; -1 if it
/// doesn't, or if the program has its children reaped by someone else.
int HelperProcess::wait_for_end() {
    int status = -1;
    for (int tries = 0; tries < 400; ++tries) {
        const pid_t ended = waitpid(process_, &status, WNOHANG);
        if (ended == 0 || (ended < 0 && errno == EINTR)) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            continue;
        }
        process_ = -1;
        return ended > 0 ? status : -1;
    }
    return -1;
}

void HelperProcess::fail_without_answer() {
    const int status = wait_for_end();
    if (status == -1) throw HelperFailure(Cause::died, "its reader ended");
    if (WIFEXITED(status))
        throw HelperFailure(Cause::missing,
                            fmt::format("{} ended with exit code {}; install voxelume again",
                                        program_.string(), WEXITSTATUS(status)));
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU)
        throw HelperFailure(Cause::too_long, "reading it took too much computing");
    if (signal == SIGKILL)
        throw HelperFailure(Cause::killed, "its reader was killed, perhaps for want of memory");
    throw HelperFailure(Cause::died, fmt::format("its reader ended: {}", strsignal(signal)));
}

}  // namespace voxelume
