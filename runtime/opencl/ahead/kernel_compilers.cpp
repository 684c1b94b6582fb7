// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/ahead/kernel_compilers.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "runtime/base/helper/helper_process.hpp"
#include "runtime/base/helper/helper_program.hpp"

namespace voxelume {
namespace {

/// A helper that is idle for longer ends, and frees its memory.
constexpr std::chrono::seconds kLongestRest(10);
/// The limit for HelperProcess::read, which nothing calls: `await` has a limit of its own.
constexpr double kHelperSeconds = 600;

/// Waits until `descriptor` is ready for `event`. Returns false once `wake` is readable.
bool wait_until_ready(int descriptor, short event, int wake) {
    for (;;) {
        pollfd events[] = {{descriptor, event, 0}, {wake, POLLIN, 0}};
        const int ready = poll(events, 2, -1);
        if (ready < 0 && errno == EINTR) continue;
        return ready > 0 && events[1].revents == 0;
    }
}

/// True if the system's limit of processes and threads is so low that helpers could take those that
/// PoCL needs: without a process for its linker, PoCL ends the program.
bool is_short_of_processes() {
    constexpr rlim_t kFew = 128;
    rlimit limit{};
    return getrlimit(RLIMIT_NPROC, &limit) == 0 && limit.rlim_cur < kFew;
}

/// Ends the helpers when the process ends, before objects that were made before the helpers are
/// destroyed.
struct EndAtExit {
    EndAtExit() = default;
    ~EndAtExit() { KernelCompilers::instance().end(); }
    EndAtExit(const EndAtExit&) = delete;
    EndAtExit& operator=(const EndAtExit&) = delete;
};

}  // namespace

/// The two ends of a socket for jobs.
class JobSocket {
  public:
    JobSocket() {
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_.data()) != 0) ends_ = {-1, -1};
    }
    ~JobSocket() {
        for (const int end : ends_)
            if (end >= 0) close(end);
    }
    JobSocket(const JobSocket&) = delete;
    JobSocket& operator=(const JobSocket&) = delete;

    int helpers_end() const { return ends_[1]; }
    void close_helpers_end() {
        if (ends_[1] >= 0) close(std::exchange(ends_[1], -1));
    }
    /// Returns false if nobody will read the bytes, or once `wake` is readable.
    bool send_all(const std::string& bytes, int wake) const {
        for (size_t sent = 0; sent < bytes.size();) {
            if (!wait_until_ready(ends_[0], POLLOUT, wake)) return false;
            const ssize_t some = send(ends_[0], bytes.data() + sent, bytes.size() - sent,
                                      MSG_NOSIGNAL | MSG_DONTWAIT);
            if (some < 0 && (errno == EINTR || errno == EAGAIN)) continue;
            if (some <= 0) return false;
            sent += size_t(some);
        }
        return true;
    }

  private:
    std::array<int, 2> ends_{-1, -1};
};

KernelCompilers& KernelCompilers::instance() {
    static KernelCompilers compilers;
    return compilers;
}

KernelCompilers::KernelCompilers() : process_(getpid()), wake_(eventfd(0, EFD_CLOEXEC)) {}

KernelCompilers::~KernelCompilers() {
    end();
    if (wake_ >= 0) close(wake_);
}

void KernelCompilers::allow(int processes, std::filesystem::path program) {
    const std::lock_guard lock(mutex_);
    max_processes_ = processes;
    program_ = std::move(program);
}

bool KernelCompilers::is_allowed() const {
    const std::lock_guard lock(mutex_);
    return max_processes_ > 0 && wake_ >= 0 && !is_ended_ && getpid() == process_;
}

void KernelCompilers::set_longest_wait(std::chrono::milliseconds time) {
    const std::lock_guard lock(mutex_);
    longest_wait_ = time;
}

bool KernelCompilers::start(const Target& target, const std::filesystem::path& folder) {
    static const EndAtExit end_at_exit;  // the folder's owner was made before
    const std::lock_guard lock(mutex_);
    if (is_ended_ || is_short_of_processes()) return false;
    if (!threads_.empty()) return living_ > 0 && target == target_;
    target_ = target;
    try {
        const std::filesystem::path program =
            program_.empty() ? helper_program(kKernelCompilerName) : program_;
        const std::vector<std::string> arguments = {VXL_VERSION, folder.string(),
                                                    std::to_string(target.index), target.name,
                                                    std::to_string(process_)};
        threads_.reserve(size_t(max_processes_));
        for (int i = 0; i < max_processes_; ++i) {
            threads_.emplace_back([this, program, arguments] { serve(program, arguments); });
            ++living_;
        }
    } catch (const std::exception&) {
        // The system allows no more threads; the existing ones suffice.
    }
    return living_ > 0;
}

void KernelCompilers::add(Wanted wanted) {
    {
        const std::lock_guard lock(mutex_);
        for (const auto& job : jobs_)
            if (job->wanted.key == wanted.key) return;
        jobs_.push_back(std::make_unique<Job>(Job{std::move(wanted)}));
    }
    changed_.notify_all();
}

/// The waiting job that is needed last. Null after a long wait without a job, and at the end.
KernelCompilers::Job* KernelCompilers::claim() {
    std::unique_lock lock(mutex_);
    Job* last = nullptr;
    changed_.wait_for(lock, kLongestRest, [&] {
        for (const auto& job : jobs_)
            if (job->state == State::waiting) last = job.get();
        return is_ended_ || last;
    });
    if (is_ended_ || !last) return nullptr;
    last->state = State::begun;
    return last;
}

void KernelCompilers::finish(Job& job, State state) {
    {
        const std::lock_guard lock(mutex_);
        job.state = state;
        job.wanted.job = {};
        job.taken = job.given = 0;
        compiled_ += int(state == State::done);
    }
    changed_.notify_all();
}

/// The kernel that is needed last of those that nobody compiles. Where this process compiles, too,
/// it gets the last of all: a helper would begin it later.
std::optional<CompiledKernel> KernelCompilers::give(Job& job) {
    const std::lock_guard lock(mutex_);
    if (job.left() <= size_t(job.is_shared)) return std::nullopt;
    ++job.given;
    return job.wanted.job.kernels[job.taken + job.left()];
}

/// Has a helper compile a program, kernel by kernel. Returns false if the helper has ended.
bool KernelCompilers::serve_job(Job& job, const HelperProcess& helper, const JobSocket& socket) {
    if (!socket.send_all(bytes_of(job.wanted.job), wake_)) return false;
    for (char answer = 0; wait_until_ready(helper.answer(), POLLIN, wake_) &&
                          read(helper.answer(), &answer, 1) == 1;) {
        if (HelperAnswer(answer) != HelperAnswer::wants_kernel) {
            finish(job, HelperAnswer(answer) == HelperAnswer::has_kept ? State::done : State::left);
            return true;
        }
        if (!socket.send_all(bytes_of(give(job)), wake_)) return false;
    }
    return false;
}

/// Runs a helper. The helper is a child of this thread, and would end with it.
void KernelCompilers::serve(const std::filesystem::path& program,
                            const std::vector<std::string>& arguments) {
    Job* job = nullptr;
    try {
        JobSocket socket;
        const HelperProcess helper(program, arguments, socket.helpers_end(), kHelperSeconds);
        socket.close_helpers_end();
        while ((job = claim())) {
            if (!serve_job(*job, helper, socket)) break;
            job = nullptr;
        }
    } catch (const std::exception&) {
        // Without a helper, this process compiles everything itself.
    }
    if (job) finish(*job, State::left);
    const std::lock_guard lock(mutex_);
    --living_;
}

KernelCompilers::Job* KernelCompilers::find(const std::string& key) const {
    const auto found =
        std::ranges::find_if(jobs_, [&](const auto& job) { return job->wanted.key == key; });
    return found == jobs_.end() || getpid() != process_ ? nullptr : found->get();
}

bool KernelCompilers::has_kernels_to_share(const std::string& key) const {
    const std::lock_guard lock(mutex_);
    const Job* const job = find(key);
    return job && living_ > 0 && (job->state == State::waiting || job->state == State::begun) &&
           job->left() > 1;
}

std::optional<CompiledKernel> KernelCompilers::take(const std::string& key) {
    const std::lock_guard lock(mutex_);
    Job* const job = find(key);
    if (!job || (job->state != State::waiting && job->state != State::begun) || job->left() == 0)
        return std::nullopt;
    job->is_shared = true;
    return job->wanted.job.kernels[job->taken++];
}

bool KernelCompilers::await(const std::string& key) {
    std::unique_lock lock(mutex_);
    Job* const job = find(key);
    if (!job) return false;
    if (job->state == State::waiting) {
        job->state = State::left;
        job->wanted.job = {};
        job->taken = job->given = 0;
    }
    // A helper that has no kernel yet, of those that this process has compiled, gets none.
    const auto is_over = [&] {
        return job->state != State::begun || (job->is_shared && job->given == 0);
    };
    changed_.wait_for(lock, longest_wait_, is_over);
    return job->state == State::done;
}

int KernelCompilers::started() const {
    const std::lock_guard lock(mutex_);
    return int(threads_.size());
}

int KernelCompilers::compiled() const {
    const std::lock_guard lock(mutex_);
    return compiled_;
}

void KernelCompilers::end() {
    std::vector<std::thread> threads;
    {
        const std::lock_guard lock(mutex_);
        is_ended_ = true;
        threads.swap(threads_);
    }
    changed_.notify_all();
    if (wake_ >= 0 && getpid() == process_) eventfd_write(wake_, 1);
    for (std::thread& thread : threads) getpid() == process_ ? thread.join() : thread.detach();
}

}  // namespace voxelume
