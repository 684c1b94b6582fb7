// SPDX-License-Identifier: Apache-2.0
// A helper program of ours: started, given a file, heard, and ended in time.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace voxelume {

/// The descriptors of a helper: the file that it works on, and the pipe for its answer.
inline constexpr int kHelperInput = 0, kHelperAnswer = 3;

/// A helper that ended, or was ended, before it had answered.
class HelperFailure : public std::runtime_error {
  public:
    enum class Cause {
        missing,   ///< the program couldn't be started, or is another one than expected
        died,      ///< a fault ended it, or it answered what can't be
        killed,    ///< someone ended it, or the system, which lacked memory
        too_long,  ///< the helper met its limit of time
    };

    /// `clause` is the part of a sentence that follows "the file ...: ".
    HelperFailure(Cause cause, const std::string& clause)
        : std::runtime_error(clause), cause_(cause) {}
    Cause cause() const { return cause_; }

  private:
    Cause cause_;
};

/// A program started by posix_spawn, which is safe in a process with threads: between a bare fork
/// and the next exec, every lock may be held by a thread that isn't there.
///
/// The helper inherits the environment, `input` as kHelperInput, a pipe as kHelperAnswer, and no
/// other descriptor; what it prints is dropped. Signals of the terminal don't reach it. It never
/// outlives this object.
class HelperProcess {
  public:
    /// Starts `program`, which has `seconds` to answer. Throws HelperFailure.
    HelperProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                  int input, double seconds);
    ~HelperProcess();
    HelperProcess(const HelperProcess&) = delete;
    HelperProcess& operator=(const HelperProcess&) = delete;

    /// Waits for the next bytes of the answer and takes up to `size` of them, at least one. Throws
    /// HelperFailure if there are none, or if they come too late.
    size_t read(void* data, size_t size);

    /// The descriptor of the answer's pipe, for callers that wait for other descriptors, too.
    int answer() const { return answer_; }

  private:
    void wait_for_bytes();
    [[noreturn]] void fail_without_answer();
    int wait_for_end();

    std::filesystem::path program_;
    pid_t process_ = -1;
    int answer_ = -1;
    double seconds_;
    std::chrono::steady_clock::time_point deadline_;
};

}  // namespace voxelume
