// SPDX-License-Identifier: Apache-2.0
// What ends the program in the middle of its work: Ctrl-C, SIGTERM, and libraries that give up. It
// ends within two seconds, and leaves no half-written files.
#pragma once

#include <chrono>
#include <functional>
#include <stop_token>

namespace voxelume::cli {

/// Makes SIGINT and SIGTERM end the program: at once or, while an `Interruptible` lives, through
/// its stop token and at the latest when its grace is over. Unfinished files on disk are removed,
/// and one line says why the program ends. A second signal at least 0.3 s after the first ends the
/// program without any of this. Signals that are ignored when the program starts stay ignored.
///
/// PoCL and LLVM abort or leave the process where they can't write their files, as on a full disk:
/// it ends with exit code 1 and a line then, also without unfinished files.
void handle_interrupts();

/// Makes the program end itself from here on, unless that takes longer than 0.4 s after a signal.
/// This function doesn't return if a signal is ending the program already: the thread that does so
/// removes files, and kernels whose files it removed look like errors.
void end_interrupts();

/// A part of the program that ends soon after it is asked to.
class Interruptible {
  public:
    /// `grace` is the time that it may take from the signal to its end.
    explicit Interruptible(std::chrono::milliseconds grace = std::chrono::milliseconds(1500));
    ~Interruptible();
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;

    /// A token that a signal stops.
    std::stop_token stop() const;
};

/// The exit code of a program that was interrupted: 130 after SIGINT, 143 after SIGTERM.
int interrupted_code();

/// Calls `say`, which prints that the program was interrupted, unless this was printed before. The
/// process doesn't end meanwhile.
void tell_interruption(const std::function<void()>& say);

}  // namespace voxelume::cli
