// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/interrupt.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "cli/shared/tell.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {
namespace {

// `timeout` sends its signal to the program and to the program's group, so the program gets two
// signals.
constexpr std::chrono::milliseconds kTogether{300};

/// How often the handler of aborts is looked after.
constexpr timespec kLook{.tv_sec = 0, .tv_nsec = 200'000'000};

/// How long a program may still take after its last command when a signal comes.
constexpr std::chrono::milliseconds kOwnEnd{400};

std::atomic<int> signal_number = 0;
std::atomic<int> interruptibles = 0;
std::atomic<std::chrono::milliseconds> grace;  // of the last Interruptible
std::mutex telling;
bool is_told = false;  // guarded by `telling`

/// The source is never destroyed, because the thread may use it when the process ends.
std::stop_source& stop_source() {
    static auto* const source = new std::stop_source;
    return *source;
}

/// Prints the message of a program that ends in the middle of its work.
void tell_end() {
    tell_interruption([] {
        if (interrupted_code() != int(ErrorKind::render))
            tell("\nvoxelume: {}\n", signal_number == SIGTERM ? "terminated" : "interrupted");
        else
            tell(
                "voxelume: a library gave up, for the reason above; an OpenCL driver does so where "
                "it can't write files: on a full disk, below a small `ulimit -f`, or if its cache "
                "is removed while it runs\n");
    });
}

std::atomic<pid_t> ending_thread = 0;
std::atomic_flag is_ending;  // set by the one thread that ends the process
pthread_t waiting_thread;    // waits for signals

/// PoCL aborts if it can't write the files of its cache, and if those that it is about to compile
/// or load have been removed. The thread in which it aborts may hold locks, so another one ends the
/// process: the one that waits for signals, if none does so yet.
void outlast_abort(int) {
    if (gettid() == ending_thread) _exit(interrupted_code());
    if (ending_thread == 0) pthread_kill(waiting_thread, SIGABRT);
    constexpr timespec kLong{.tv_sec = 2, .tv_nsec = 0};
    do nanosleep(&kLong, nullptr);
    while (ending_thread != 0);
    _exit(interrupted_code());
}

/// Handles SIGABRT, also after LLVM has put a handler of its own in this one's place, as it does
/// when it first compiles.
void handle_aborts() {
    struct sigaction now {};
    if (sigaction(SIGABRT, nullptr, &now) != 0 || now.sa_handler != outlast_abort)
        std::signal(SIGABRT, outlast_abort);
}

/// Silences PoCL and the linkers that it starts, which report kernels whose files were removed.
void hush_drivers() {
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nothing >= 0) dup2(nothing, STDERR_FILENO);
    std::error_code error;
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", error)) {
        std::ifstream children(thread.path() / "children");
        for (pid_t child = 0; children >> child;) kill(child, SIGKILL);
    }
}

/// Ends the process, without what it hasn't finished.
[[noreturn]] void end_process() {
    tell_end();
    ending_thread = gettid();
    handle_aborts();
    hush_drivers();
    remove_unfinished_files();
    _exit(interrupted_code());
}

/// LLVM leaves the process by `exit` if it can't write a file.
void end_after_exit() {
    if (is_ending.test_and_set()) return;
    signal_number = SIGABRT;
    end_process();
}

/// Waits for one of the signals, which are blocked, and ends the program.
void wait_for_signal(const sigset_t& signals) {
    int number = 0;
    while ((number = sigtimedwait(&signals, nullptr, &kLook)) <= 0) handle_aborts();
    signal_number = number;
    stop_source().request_stop();
    if (interruptibles > 0 && number != SIGABRT) {
        std::this_thread::sleep_for(kTogether);
        constexpr timespec kNow{};
        while (sigtimedwait(&signals, nullptr, &kNow) > 0) {
        }
        // The system handles a later signal of either kind.
        std::signal(SIGINT, SIG_DFL);
        std::signal(SIGTERM, SIG_DFL);
        sigset_t later = signals;
        sigdelset(&later, SIGABRT);
        pthread_sigmask(SIG_UNBLOCK, &later, nullptr);
        std::this_thread::sleep_for(grace.load() - kTogether);
    }
    if (is_ending.test_and_set()) {
        std::this_thread::sleep_for(kOwnEnd);
        _exit(interrupted_code());
    }
    end_process();
}

bool is_ignored(int number) {
    struct sigaction action {};
    return sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void handle_interrupts() {
    stop_source();
    // The signals are blocked in every thread, because LLVM installs handlers of its own while PoCL
    // compiles. These would also take signals that are ignored, and while one of them runs, a
    // second signal would end the program at once. PoCL's linker, a process of its own, inherits
    // the mask, so that it doesn't end before the program.
    sigset_t all, awaited;
    sigemptyset(&all);
    sigemptyset(&awaited);
    for (const int number : {SIGINT, SIGTERM}) {
        sigaddset(&all, number);
        if (!is_ignored(number)) sigaddset(&awaited, number);
    }
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
    sigset_t aborts;  // blocked in the thread alone, which outlast_abort sends them to
    sigemptyset(&aborts);
    sigaddset(&aborts, SIGABRT);
    sigaddset(&awaited, SIGABRT);
    pthread_sigmask(SIG_BLOCK, &aborts, nullptr);
    std::thread waiting(wait_for_signal, awaited);
    waiting_thread = waiting.native_handle();
    waiting.detach();
    handle_aborts();
    pthread_sigmask(SIG_UNBLOCK, &aborts, nullptr);
    std::atexit(end_after_exit);
}

Interruptible::Interruptible(std::chrono::milliseconds own_grace) {
    grace = own_grace;
    ++interruptibles;
}

Interruptible::~Interruptible() {
    --interruptibles;
}

std::stop_token Interruptible::stop() const {
    return stop_source().get_token();
}

void end_interrupts() {
    if (is_ending.test_and_set())
        for (;;) pause();
}

int interrupted_code() {
    if (signal_number == SIGABRT) return int(ErrorKind::render);
    return 128 + (signal_number == SIGTERM ? SIGTERM : SIGINT);
}

void tell_interruption(const std::function<void()>& say) {
    const std::lock_guard locked(telling);
    if (!std::exchange(is_told, true)) say();
}

}  // namespace voxelume::cli
