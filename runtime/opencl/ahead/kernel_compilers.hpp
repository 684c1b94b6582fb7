// SPDX-License-Identifier: Apache-2.0
// Processes that compile the kernels that this one will need later.
//
// PoCL compiles one kernel at a time in a process, which takes seconds for a first picture. Helper
// processes compile the kernels that are needed last: each compiles whole programs in a PoCL of its
// own, with a folder inside this process's folder, and keeps them in the cache, where this process
// finds them like those of an earlier run. So entries are the same with and without helpers, and a
// failing helper costs time only.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "runtime/opencl/ahead/compile_job.hpp"

namespace voxelume {

class HelperProcess;
class JobSocket;

/// The helpers of this process. Any thread may call the functions.
class KernelCompilers {
  public:
    static KernelCompilers& instance();

    /// Allows up to this many helpers at once; none is started before this call. `program` is
    /// started for each; if it is empty, the installed one is.
    void allow(int processes, std::filesystem::path program = {});
    bool is_allowed() const;

    /// Limits the time that `await` waits.
    void set_longest_wait(std::chrono::milliseconds time);

    /// A job, and the key of its program in the cache.
    struct Wanted {
        CompileJob job;
        std::string key;
    };

    /// The device that kernels are compiled for: its number and its name.
    struct Target {
        int index = 0;
        std::string name;
        bool operator==(const Target&) const = default;
    };

    /// Starts the helpers, unless they were started before: a process starts them once, for its
    /// first device. `folder` is this process's own for PoCL's files. Returns true if a helper is
    /// alive that compiles for `target`.
    bool start(const Target& target, const std::filesystem::path& folder);

    /// Adds a program that the cache lacks, unless it was added before. Helpers take the last added
    /// program first.
    void add(Wanted wanted);

    /// True if kernels of a program that this process needs now are still to be compiled, and a
    /// helper may compile some of them. The process then makes the program, compiles the kernels
    /// that `take` gives, and calls `await`.
    bool has_kernels_to_share(const std::string& key) const;

    /// The next kernel of a program for this process, which helpers don't compile; they take the
    /// last ones first. Empty if all are taken, or the last one by a helper.
    std::optional<CompiledKernel> take(const std::string& key);

    /// Tells that this process needs a program now. Waits for the helper that compiles it, if there
    /// is one; otherwise no helper will compile it. Returns true if a helper has compiled it.
    bool await(const std::string& key);

    /// The number of helpers that were started, and of the programs that they compiled.
    int started() const;
    int compiled() const;

    /// Ends all helpers for good.
    void end();

    KernelCompilers(const KernelCompilers&) = delete;
    KernelCompilers& operator=(const KernelCompilers&) = delete;

  private:
    enum class State { waiting, begun, done, left };
    struct Job {
        Wanted wanted;
        State state = State::waiting;
        size_t taken = 0;        ///< number of its first kernels that this process compiles
        size_t given = 0;        ///< number of its last kernels that a helper compiles
        bool is_shared = false;  ///< this process compiles, too

        size_t left() const { return wanted.job.kernels.size() - taken - given; }
    };

    KernelCompilers();
    ~KernelCompilers();
    void serve(const std::filesystem::path& program, const std::vector<std::string>& arguments);
    bool serve_job(Job& job, const HelperProcess& helper, const JobSocket& socket);
    Job* find(const std::string& key) const;
    Job* claim();
    std::optional<CompiledKernel> give(Job& job);
    void finish(Job& job, State state);

    mutable std::mutex mutex_;
    std::condition_variable changed_;  ///< a job's state, or the number of jobs
    std::vector<std::unique_ptr<Job>> jobs_;
    std::vector<std::thread> threads_;  ///< one for each helper, which ends with it
    Target target_;
    int living_ = 0;  ///< helpers that still take jobs
    std::filesystem::path program_;
    std::chrono::milliseconds longest_wait_{10'000};
    pid_t process_;  ///< a forked child has no threads
    int max_processes_ = 0;
    int wake_ = -1;  ///< readable once all helpers are to end
    bool is_ended_ = false;
    int compiled_ = 0;
};

}  // namespace voxelume
