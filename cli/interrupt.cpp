// SPDX-License-Identifier: Apache-2.0
#include "cli/interrupt.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <mutex>
#include <thread>
#include <utility>

#include "cli/tell.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {
namespace {

constexpr std::chrono::milliseconds kGrace{1500};
// `timeout` sends its signal to the program and to its group, which are two signals for the
// program.
constexpr std::chrono::milliseconds kTogether{300};

// The handler may do no more than write to a pipe; a thread reads from it.
std::array<int, 2> signal_pipe{-1, -1};
std::atomic<int> signal_number = 0;
std::atomic<int> interruptibles = 0;
std::mutex telling;
bool is_told = false;  // with `telling` held

/// Never destroyed: the thread may use it when the process ends.
std::stop_source& stop_source() {
    static auto* const source = new std::stop_source;
    return *source;
}

void note_signal(int number) {
    const int error = errno;
    const auto byte = static_cast<char>(number);
    [[maybe_unused]] const ssize_t written = write(signal_pipe[1], &byte, 1);
    errno = error;
}

void handle(int number) {
    struct sigaction action {};
    if (sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) {
        // While PoCL compiles, LLVM has a handler of its own, which would remove its files.
        sigset_t ignored;
        sigemptyset(&ignored);
        sigaddset(&ignored, number);
        pthread_sigmask(SIG_BLOCK, &ignored, nullptr);
        return;
    }
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    sigaction(number, &action, nullptr);
}

/// PoCL aborts the program where its linker, a process of its own in the program's group, was ended
/// by the signal that interrupts the program. So the thread that aborts waits for the other to end
/// the program in order. The system's own action follows if the program isn't interrupted.
void await_interruption(int number) {
    constexpr int kSteps = 30;
    constexpr timespec kStep{0, 10'000'000};
    for (int i = 0; i < kSteps && signal_number == 0; ++i) nanosleep(&kStep, nullptr);
    while (signal_number != 0) pause();
    std::signal(number, SIG_DFL);
}

/// What the program says when it ends in the middle of something.
void tell_end() {
    tell_interruption(
        [] { tell("\nvoxelume: {}\n", signal_number == SIGTERM ? "terminated" : "interrupted"); });
}

void wait_for_signal() {
    char number = 0;
    while (read(signal_pipe[0], &number, 1) < 0)
        if (errno != EINTR) return;
    signal_number = number;
    stop_source().request_stop();
    if (interruptibles > 0) {
        std::this_thread::sleep_for(kTogether);
        // A later signal, of either kind, is the system's to handle.
        std::signal(SIGINT, SIG_DFL);
        std::signal(SIGTERM, SIG_DFL);
        std::this_thread::sleep_for(kGrace - kTogether);
    }
    tell_end();
    remove_unfinished_files();
    _exit(interrupted_code());
}

}  // namespace

void handle_interrupts() {
    if (pipe2(signal_pipe.data(), O_CLOEXEC) != 0) return;  // signals end the program as usual
    stop_source();
    handle(SIGINT);
    handle(SIGTERM);
    std::signal(SIGABRT, await_interruption);
    std::thread(wait_for_signal).detach();  // ignores what the first thread ignores
}

Interruptible::Interruptible() {
    ++interruptibles;
}

Interruptible::~Interruptible() {
    --interruptibles;
}

std::stop_token Interruptible::stop() const {
    return stop_source().get_token();
}

int interrupted_code() {
    return 128 + (signal_number == SIGTERM ? SIGTERM : SIGINT);
}

void tell_interruption(const std::function<void()>& say) {
    const std::lock_guard locked(telling);
    if (!std::exchange(is_told, true)) say();
}

}  // namespace voxelume::cli
